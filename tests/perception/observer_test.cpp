// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/observer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "annulus_image.hpp"
#include "range_world.hpp"

namespace credo::perception {
namespace {

sensors::Rig range_rig() {
  sensors::Rig rig;
  rig.range_finders.push_back(full_turn(360, {0.004, 0.0015}));
  return rig;
}

sensors::Acquisition acquisition_of(const RangeWorld& world, const sensors::Rig& rig, std::uint32_t seed = 1) {
  sensors::Acquisition acquisition;
  acquisition.scan = scan_of(world, rig.range_finders.front(), {}, seed);
  return acquisition;
}

RangeWorld room() {
  RangeWorld world;
  world.add_room(-2.0, -1.5, 2.0, 1.5);
  return world;
}

std::string text_of(const Scene& scene) {
  std::ostringstream text;
  text.precision(17);
  text << scene.mean_conflict << "\n";
  for (const Primitive& p : scene.primitives)
    text << p << p.position.transpose() << p.position_covariance << p.sigma_azimuth << "\n";
  return text.str();
}

TEST(Observer, SeesARoomByItsRangeFinderAlone) {
  const sensors::Rig rig = range_rig();
  Observer observer(rig);
  const Scene& scene = observer.observe(acquisition_of(room(), rig));
  EXPECT_TRUE(scene.range_finder_seen);
  EXPECT_FALSE(scene.camera_seen);
  EXPECT_EQ(scene.segments.size(), 4u);
  EXPECT_EQ(scene.primitives.size(), 8u);
  for (const FusedSegment& segment : scene.segments) {
    EXPECT_EQ(segment.criteria[3], evidence::BinaryMass::vacuous()) << "no camera to agree or not";
    EXPECT_EQ(segment.criteria[4], evidence::BinaryMass::vacuous());
    EXPECT_EQ(segment.endpoint_case, 1);
    EXPECT_GT(segment.existence.yes, 0.8);
  }
  EXPECT_LT(scene.mean_conflict, 0.2);
}

TEST(Observer, TheSameInputGivesTheSameBytes) {
  const sensors::Rig rig = range_rig();
  Observer first(rig), second(rig);
  const auto acquisition = acquisition_of(room(), rig, 5);
  const std::string once = text_of(first.observe(acquisition));
  EXPECT_EQ(text_of(second.observe(acquisition)), once);
  (void)first.observe(acquisition_of(room(), rig, 6));
  EXPECT_EQ(text_of(first.observe(acquisition)), once) << "nothing is left of the scene before";
}

TEST(Observer, KeepsItsMemory) {
  const sensors::Rig rig = range_rig();
  Observer observer(rig);
  const auto acquisition = acquisition_of(room(), rig);
  const Scene& scene = observer.observe(acquisition);
  const auto* points = scene.points.data();
  const auto* segments = scene.segments.data();
  const auto* primitives = scene.primitives.data();
  (void)observer.observe(acquisition);
  EXPECT_EQ(scene.points.data(), points);
  EXPECT_EQ(scene.segments.data(), segments);
  EXPECT_EQ(scene.primitives.data(), primitives);
}

TEST(Observer, NothingMeasuredIsAnEmptyScene) {
  for (const sensors::Rig& rig : {sensors::Rig{}, range_rig()}) {
    Observer observer(rig);
    if (!rig.range_finders.empty()) (void)observer.observe(acquisition_of(room(), rig));
    sensors::Acquisition empty;
    empty.time = 42;
    const Scene& scene = observer.observe(empty);
    EXPECT_EQ(scene.time, 42);
    EXPECT_FALSE(scene.camera_seen);
    EXPECT_FALSE(scene.range_finder_seen);
    EXPECT_TRUE(scene.points.empty() && scene.segments.empty() && scene.primitives.empty());
    EXPECT_EQ(scene.mean_conflict, 0.0);
  }
}

/// Four dark stripes on a bright wall all round: eight radial lines.
sensors::OmniImage striped_image(const sensors::OmniCamera& camera) {
  test::AnnulusScene scene{.background = 150.0};
  for (const double at : {0.6, 1.3, 2.5, -1.0}) scene.patches.push_back({.from = at, .to = at + 0.2, .gray = 60.0});
  return {.time = 0, .pixels = test::render(camera, scene)};
}

TEST(Observer, CameraAndRangeFinderWorkTogether) {
  sensors::Rig rig = range_rig();
  rig.camera = test::test_camera();
  Observer observer(rig);
  auto acquisition = acquisition_of(room(), rig);
  acquisition.image = striped_image(*rig.camera);
  const Scene& scene = observer.observe(acquisition);
  EXPECT_TRUE(scene.camera_seen);
  ASSERT_GE(scene.radial_lines.size(), 7u);
  EXPECT_GE(scene.segments.size(), 4u + scene.radial_lines.size() - 1)
      << "each line cuts a wall, unless it is at a corner";
  for (const FusedSegment& segment : scene.segments) EXPECT_NE(segment.criteria[3], evidence::BinaryMass::vacuous());
  const auto marks = std::count_if(scene.primitives.begin(), scene.primitives.end(),
                                   [](const Primitive& p) { return !p.bearing_only && p.radial_line >= 0; });
  EXPECT_EQ(marks, static_cast<std::ptrdiff_t>(scene.radial_lines.size()));
  EXPECT_GT(scene.mean_conflict, 0.0);
}

TEST(Observer, ACameraAloneSeesBearings) {
  sensors::Rig rig;
  rig.camera = test::test_camera();
  Observer observer(rig);
  sensors::Acquisition acquisition;
  acquisition.image = striped_image(*rig.camera);
  const Scene& scene = observer.observe(acquisition);
  EXPECT_TRUE(scene.camera_seen);
  EXPECT_FALSE(scene.range_finder_seen);
  ASSERT_GE(scene.radial_lines.size(), 7u);
  EXPECT_EQ(scene.primitives.size(), scene.radial_lines.size());
  for (const Primitive& p : scene.primitives) {
    EXPECT_TRUE(p.bearing_only);
    EXPECT_GT(p.existence.yes, 0.4);
  }
}

TEST(Observer, ThePapersMethodMakesItsOwnScene) {
  const sensors::Rig rig = range_rig();
  Observer observer(rig, {.method = Method::kPaper, .radial_lines = {}, .line_fit = {}, .scene = {}});
  const Scene& scene = observer.observe(acquisition_of(room(), rig));
  EXPECT_GE(scene.segments.size(), 4u);
  const auto corners = std::count_if(scene.primitives.begin(), scene.primitives.end(),
                                     [](const Primitive& p) { return p.type == PrimitiveType::kCorner; });
  EXPECT_EQ(corners, 4);
}

TEST(Observer, RefusesShapesThatAreNoBelief) {
  ObserverParams params;
  params.scene.criteria.alignment.max_yes = 0.9;
  params.scene.criteria.alignment.max_no = 0.9;
  params.scene.criteria.alignment.no_zero_until = 0.0;
  params.scene.criteria.alignment.no_full_from = 0.5;
  EXPECT_THROW(Observer(range_rig(), params), std::invalid_argument);
}

TEST(Observer, PrimitivesPrintReadably) {
  const sensors::Rig rig = range_rig();
  Observer observer(rig);
  const std::string text = text_of(observer.observe(acquisition_of(room(), rig)));
  EXPECT_NE(text.find("corner at "), std::string::npos);
  EXPECT_NE(text.find("(joined, joined)"), std::string::npos);
}

}  // namespace
}  // namespace credo::perception
