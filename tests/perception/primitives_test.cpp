// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/primitives.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/angles.hpp"
#include "range_world.hpp"

namespace credo::perception {
namespace {

using geometry::to_radians;
using enum PrimitiveType;

TEST(JunctionType, ByTheAngleOnTheRobotsSide) {
  const double sure = 0.01;
  EXPECT_EQ(junction_type(to_radians(90), sure, 0.0).type, kCorner);
  EXPECT_EQ(junction_type(to_radians(120), sure, 0.0).type, kCorner);
  EXPECT_EQ(junction_type(to_radians(180), sure, 0.0).type, kWall);
  EXPECT_EQ(junction_type(to_radians(172), sure, 0.0).type, kWall);
  EXPECT_EQ(junction_type(to_radians(270), sure, 0.0).type, kEdge);
  EXPECT_EQ(junction_type(to_radians(235), sure, 0.0).type, kEdge);
  const JunctionType corner = junction_type(to_radians(90), sure, 0.0);
  EXPECT_NEAR(corner.kind.yes, 0.81, 1e-12);
  EXPECT_NEAR(corner.kind.no, 0.0, 1e-12);
}

TEST(JunctionType, APartOfACurveIsNoCorner) {
  for (const double turn : {25.0, 28.0}) {
    EXPECT_LT(junction_type(to_radians(180.0 - turn), 0.01, 0.0).believed, 0.15) << turn;
    EXPECT_LT(junction_type(to_radians(180.0 + turn), 0.01, 0.0).believed, 0.15) << turn;
  }
}

TEST(JunctionType, EndsThatAreApartAreOfNoRegularType) {
  EXPECT_EQ(junction_type(to_radians(90), 0.01, 8.0).type, kOther);
  EXPECT_EQ(junction_type(to_radians(90), 0.01, 1.0).type, kCorner);
}

TEST(JunctionType, AnUnsureAngleIsIgnorance) {
  const double sure = junction_type(to_radians(90), 0.05, 0.0).believed;
  const double unsure = junction_type(to_radians(90), 0.4, 0.0).believed;
  EXPECT_LT(unsure, 0.5 * sure);
  EXPECT_LT(junction_type(to_radians(90), 1.0, 0.0).believed, 1e-12);
}

TEST(JunctionType, PaperIsInDegreesAndMetres) {
  const PrimitiveParams paper = PrimitiveParams::paper();
  EXPECT_EQ(junction_type(to_radians(90), 1.0, 0.0, paper).type, kCorner);
  EXPECT_NEAR(junction_type(to_radians(90), 1.0, 0.0, paper).kind.yes, 0.81, 1e-9);
  EXPECT_EQ(junction_type(to_radians(150), 0.0, 0.04, paper).type, kCorner);
  EXPECT_EQ(junction_type(to_radians(90), 0.0, 0.30, paper).type, kOther);
}

TEST(FreeEndType, IsAnEdgeAsFarAsTheJumpSays) {
  const JunctionType clear = free_end_type(SegmentEnd::kFree, 20.0), faint = free_end_type(SegmentEnd::kFree, 5.0);
  EXPECT_EQ(clear.type, kEdge);
  EXPECT_EQ(faint.type, kEdge);
  EXPECT_GT(clear.believed, 2.0 * faint.believed);
  EXPECT_NEAR(clear.kind.no, 0.0, 1e-12);
  const JunctionType open = free_end_type(SegmentEnd::kOpen, 0.0);
  EXPECT_EQ(open.type, kEdge);
  EXPECT_LT(open.believed, clear.believed);
}

TEST(RadialLineExistence, GrowsWithSupportAndContrast) {
  const RadialLine strong{.contrast = 60.0, .visible_share = 0.9}, weak{.contrast = 5.0, .visible_share = 0.25};
  const auto yes = [](const RadialLine& line) { return radial_line_existence(line, 1.0).mass.yes; };
  EXPECT_GT(yes(strong), 0.7);
  EXPECT_LT(yes(weak), 0.2);
  EXPECT_GT(radial_line_existence({.contrast = 3.0, .visible_share = 0.1}, 1.0).mass.no, 0.1);
}

/// A scene from walls and the azimuths of radial lines, by the parts that come before the names.
struct Made {
  Scene scene;
  std::vector<RangeSegment> segments;

  Made(const RangeWorld& world, const sensors::RangeFinder& finder, const std::vector<double>& azimuths = {},
       std::uint32_t seed = 0, const PrimitiveParams& params = {}) {
    const sensors::RangeScan scan = scan_of(world, finder, {}, seed);
    Segmented segmented = segment_scan(scan, finder);
    scene.points = segmented.points;
    segments = segmented.segments;
    for (const double azimuth : azimuths)
      scene.radial_lines.push_back(
          {.azimuth = azimuth, .sigma = 0.002, .contrast = 40.0, .polarity = 1, .visible_share = 0.8});
    scene.camera_seen = !azimuths.empty();
    Cooperation cooperation;
    cooperate(scene.radial_lines, scene.camera_origin, scene.points, finder.angle_increment_rad, {}, segments,
              cooperation);
    FusedWholes wholes;
    fuse_segments(segments, cooperation, finder.angle_increment_rad, {finder.noise, {}}, {}, scene, wholes);
    name_primitives({segments, cooperation, wholes, finder.angle_increment_rad}, params, scene);
  }

  [[nodiscard]] std::vector<Primitive> of(PrimitiveType type) const {
    std::vector<Primitive> result;
    for (const Primitive& p : scene.primitives)
      if (p.type == type) result.push_back(p);
    return result;
  }
  [[nodiscard]] const Primitive* near(PrimitiveType type, double x, double y, double within = 0.1) const {
    for (const Primitive& p : scene.primitives)
      if (p.type == type && !p.bearing_only && (p.position - Eigen::Vector2d(x, y)).norm() < within) return &p;
    return nullptr;
  }
};

TEST(Primitives, ARoomHasFourWallsAndFourCorners) {
  RangeWorld world;
  world.add_room(-2.0, -1.5, 2.0, 1.5);
  const Made made(world, full_turn(360), {}, 3);
  EXPECT_EQ(made.of(kWall).size(), 4u);
  EXPECT_EQ(made.of(kCorner).size(), 4u);
  EXPECT_EQ(made.scene.primitives.size(), 8u);
  for (const double x : {-2.0, 2.0})
    for (const double y : {-1.5, 1.5}) {
      const Primitive* corner = made.near(kCorner, x, y, 0.02);
      ASSERT_NE(corner, nullptr) << x << " " << y;
      EXPECT_NEAR(corner->interior_angle, std::numbers::pi / 2.0, 0.02);
      EXPECT_GT(corner->existence.yes, 0.9);
      EXPECT_NEAR(corner->range_m, std::hypot(x, y), 0.02);
    }
  for (const Primitive& wall : made.of(kWall)) EXPECT_GT(wall.existence.yes, 0.8);
}

TEST(Primitives, ARecessHasCornersAndEdges) {
  RangeWorld world;  // a corridor wall with a niche opposite the robot
  world.add(-3.0, 1.2, -0.8, 1.2);
  world.add(-0.8, 1.2, -0.8, 1.8);
  world.add(-0.8, 1.8, 0.8, 1.8);
  world.add(0.8, 1.8, 0.8, 1.2);
  world.add(0.8, 1.2, 3.0, 1.2);
  world.add(-3.0, -1.2, 3.0, -1.2);
  const Made made(world, full_turn(720), {}, 3);
  for (const double side : {-1.0, 1.0}) {
    EXPECT_NE(made.near(kEdge, side * 0.8, 1.2, 0.03), nullptr) << side;
    EXPECT_NE(made.near(kCorner, side * 0.8, 1.8, 0.03), nullptr) << side;
  }
  const auto edges = made.of(kEdge);
  EXPECT_EQ(
      std::count_if(edges.begin(), edges.end(), [](const Primitive& p) { return std::abs(p.position.x()) < 2.5; }), 2);
  EXPECT_EQ(made.of(kCorner).size(), 2u);
}

TEST(Primitives, OneFaceOfAnEdgeIsAnEdgeAndTheShadowBehindItIsNothing) {
  RangeWorld world;
  world.add(-3.0, 1.0, 0.5, 1.0);
  world.add(-3.0, 2.5, 4.0, 2.5);
  const Made made(world, full_turn(720), {}, 3);
  const Primitive* edge = made.near(kEdge, 0.5, 1.0, 0.03);
  ASSERT_NE(edge, nullptr);
  EXPECT_EQ(edge->interior_angle, 0.0) << "only one face is seen";
  EXPECT_EQ(made.near(kEdge, 1.25, 2.5, 0.5), nullptr) << "where the view past it meets the wall behind";
  EXPECT_EQ(made.near(kOther, 1.25, 2.5, 0.5), nullptr);
  EXPECT_TRUE(made.of(kCorner).empty());
}

TEST(Primitives, ADoorFrameInAFlatWallIsAnOtherOnTheWall) {
  RangeWorld world;
  world.add_room(-2.0, -1.5, 2.0, 1.5);
  const double left = std::atan2(1.5, -0.4), right = std::atan2(1.5, 0.5);
  const Made made(world, full_turn(360), {right, left}, 3);
  EXPECT_EQ(made.of(kWall).size(), 4u) << "the wall stays one";
  EXPECT_EQ(made.scene.segments.size(), 6u) << "of three pieces";
  for (const double x : {-0.4, 0.5}) {
    const Primitive* mark = made.near(kOther, x, 1.5, 0.02);
    ASSERT_NE(mark, nullptr) << x;
    EXPECT_GE(mark->radial_line, 0);
    EXPECT_NEAR(mark->sigma_azimuth, 0.002, 2e-4);
    EXPECT_EQ(mark->last_segment, mark->first_segment + 1);
    EXPECT_GT(mark->existence.yes, 0.8);
  }
  const auto walls = made.of(kWall);
  const auto cut = std::find_if(walls.begin(), walls.end(), [](const Primitive& w) { return w.position.y() > 1.4; });
  ASSERT_NE(cut, walls.end());
  EXPECT_NEAR(cut->extent.length(), 4.0, 0.03);
  EXPECT_EQ(cut->last_segment - cut->first_segment, 2);
}

TEST(Primitives, ARadialLineAtACornerSharpensIt) {
  RangeWorld world;
  world.add_room(-2.0, -1.5, 2.0, 1.5);
  const sensors::RangeFinder finder = full_turn(180, {0.01, 0.01});
  const Made without(world, finder, {}, 3), with(world, finder, {std::atan2(1.5, 2.0)}, 3);
  const Primitive *a = without.near(kCorner, 2.0, 1.5, 0.15), *b = with.near(kCorner, 2.0, 1.5, 0.15);
  ASSERT_NE(a, nullptr);
  ASSERT_NE(b, nullptr);
  EXPECT_EQ(a->radial_line, -1);
  EXPECT_EQ(b->radial_line, 0);
  EXPECT_LT(b->sigma_azimuth, a->sigma_azimuth);
  EXPECT_LE(b->sigma_azimuth, 0.002);
  EXPECT_NEAR(b->azimuth, std::atan2(1.5, 2.0), 0.004);
  EXPECT_TRUE(with.of(kOther).empty()) << "a line is at one place only";
}

TEST(Primitives, ARadialLineIntoTheOpenIsABearing) {
  RangeWorld world;
  world.add(-2.0, 1.0, 2.0, 1.0);
  const Made made(world, full_turn(360), {-1.0}, 3);
  const auto others = made.of(kOther);
  ASSERT_EQ(others.size(), 1u);
  EXPECT_TRUE(others[0].bearing_only);
  EXPECT_NEAR(others[0].azimuth, -1.0, 1e-12);
  EXPECT_EQ(others[0].endpoint_case, 0);
  EXPECT_GT(others[0].existence.yes, 0.4);
}

TEST(Primitives, EveryRadialLineIsAtExactlyOneOfThem) {
  RangeWorld world;
  world.add_room(-2.0, -1.5, 2.0, 1.5);
  world.add(0.6, 0.3, 0.6, 0.9);
  std::vector<double> azimuths;
  for (int i = 0; i < 24; ++i) azimuths.push_back(-3.1 + 0.26 * i);
  const auto uses = [](const Made& made, int line) {
    return std::count_if(made.scene.primitives.begin(), made.scene.primitives.end(),
                         [line](const Primitive& p) { return p.radial_line == line; });
  };
  const Made made(world, full_turn(360), azimuths, 3, PrimitiveParams{});
  for (int l = 0; l < 24; ++l) EXPECT_EQ(uses(made, l), 1) << l;

  // The paper's landmarks all have a segment: a line that ends none cuts walls, and is no landmark itself.
  const Made paper(world, full_turn(360), azimuths, 3, PrimitiveParams::paper());
  for (int l = 0; l < 24; ++l) EXPECT_LE(uses(paper, l), 1) << l;
  for (const Primitive& primitive : paper.scene.primitives) EXPECT_FALSE(primitive.bearing_only);
}

// Errors of corners over many scans, in the metric of the covariances they state: chi-square with 2 degrees of freedom.
TEST(Primitives, CornersSayHowGoodTheyAre) {
  RangeWorld world;
  world.add_room(-1.8, -1.5, 2.0, 1.4);
  const sensors::RangeFinder finder = full_turn(256, {0.01, 0.005});
  double sum = 0.0;
  int n = 0;
  for (std::uint32_t seed = 1; seed <= 150; ++seed) {
    const Made made(world, finder, {}, seed);
    for (const Primitive& corner : made.of(kCorner)) {
      const Eigen::Vector2d truth(corner.position.x() > 0.0 ? 2.0 : -1.8, corner.position.y() > 0.0 ? 1.4 : -1.5);
      const Eigen::Vector2d error = corner.position - truth;
      const double det = corner.position_covariance.determinant();
      ASSERT_GT(det, 0.0);
      sum += std::min(30.0, error.dot(corner.position_covariance.inverse() * error));
      ++n;
    }
  }
  EXPECT_GT(n, 570);
  EXPECT_NEAR(sum / n, 2.0, 0.5);
}

TEST(Primitives, ThePapersWallsAreTheSegmentsThemselves) {
  RangeWorld world;
  world.add_room(-2.0, -1.5, 2.0, 1.5);
  const Made made(world, full_turn(360), {std::atan2(1.5, 0.3)}, 3, PrimitiveParams::paper());
  EXPECT_EQ(made.of(kWall).size(), 5u);
}

}  // namespace
}  // namespace credo::perception
