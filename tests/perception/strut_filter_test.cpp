// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/strut_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "annulus_image.hpp"
#include "geometry/angles.hpp"

namespace credo::perception {
namespace {

using test::AnnulusScene;
using test::Patch;
using test::render;
using test::test_camera;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kNoise = 1.5;

RadialLine line(double azimuth, int polarity, double visible_share = 1.0) {
  return {.azimuth = azimuth, .sigma = 0.001, .contrast = 50.0, .polarity = polarity, .visible_share = visible_share};
}

/// The two edges of something dark.
std::vector<RadialLine> edges_of(const Patch& dark) { return {line(dark.from, -1), line(dark.to, +1)}; }

class StrutFilterOfOneCamera : public ::testing::Test {
 protected:
  /// Azimuths of the lines that are left of `lines` after an image.
  std::vector<double> left(const AnnulusScene& scene, std::vector<RadialLine> lines, double noise = kNoise) {
    return left(render(camera_, scene), std::move(lines), noise);
  }
  std::vector<double> left(const cv::Mat& image, std::vector<RadialLine> lines, double noise = kNoise) {
    filter_.remove(image.ptr<std::uint8_t>(), noise, lines);
    std::vector<double> azimuths;
    for (const RadialLine& kept : lines) azimuths.push_back(kept.azimuth);
    return azimuths;
  }
  void use(const StrutParams& params) { filter_ = StrutFilter(camera_, camera_.center_px, 0.7, params); }

  sensors::OmniCamera camera_ = test_camera();
  StrutFilter filter_{camera_, camera_.center_px, 0.7, {}};
  const Patch bar_{1.70, 1.74, 10.0};
  const AnnulusScene with_bar_{.struts = {bar_}};
};

TEST_F(StrutFilterOfOneCamera, ABarIsTakenOutAndTheEdgesBesideItStay) {
  EXPECT_THAT(left(with_bar_, {line(1.60, -1), line(1.66, +1), line(1.70, -1), line(1.74, +1), line(1.78, -1)}),
              ElementsAre(1.60, 1.66, 1.78));
}

TEST_F(StrutFilterOfOneCamera, ABarAcrossTheEndOfTheTurnIsTakenOut) {
  const Patch bar{-0.02, 0.02, 10.0};
  const std::vector<RadialLine> lines{line(0.02, +1), line(1.0, +1), line(geometry::kTurn - 0.02, -1)};
  EXPECT_THAT(left({.struts = {bar}}, lines), ElementsAre(1.0));
}

TEST_F(StrutFilterOfOneCamera, EveryBarIsTakenOut) {
  const Patch other{4.0, 4.05, 10.0};
  std::vector<RadialLine> lines = edges_of(bar_);
  for (const RadialLine& edge : edges_of(other)) lines.push_back(edge);
  EXPECT_THAT(left({.struts = {bar_, other}}, lines), IsEmpty());
}

TEST_F(StrutFilterOfOneCamera, ADarkThingOfTheWorldIsNoBar) {
  EXPECT_THAT(left({.patches = {bar_}}, edges_of(bar_)), ElementsAre(bar_.from, bar_.to))
      << "nothing crosses the camera's reflection";
}

TEST_F(StrutFilterOfOneCamera, WhatIsTooWideOrTooShortOrBrightIsNoBar) {
  const Patch wide{1.70, 1.85, 10.0}, bright{1.70, 1.74, 200.0};
  EXPECT_THAT(left({.struts = {wide}}, edges_of(wide)), ElementsAre(wide.from, wide.to));
  EXPECT_THAT(left(with_bar_, {line(1.70, -1, 0.5), line(1.74, +1)}), ElementsAre(1.70, 1.74));
  EXPECT_THAT(left({.struts = {bright}}, {line(1.70, +1), line(1.74, -1)}), ElementsAre(1.70, 1.74));
}

TEST_F(StrutFilterOfOneCamera, ADropThatNoiseExplainsIsNoBar) {
  EXPECT_THAT(left(with_bar_, edges_of(bar_), 30.0), ElementsAre(bar_.from, bar_.to));
}

TEST_F(StrutFilterOfOneCamera, ABarIsRememberedWhereOneEdgeIsMissedAndThenForgotten) {
  use({.remembered_images = 3});
  const cv::Mat image = render(camera_, with_bar_);
  ASSERT_THAT(left(image, edges_of(bar_)), IsEmpty());
  for (int i = 0; i < 3; ++i) EXPECT_THAT(left(image, {line(1.70, -1)}), IsEmpty());
  EXPECT_THAT(left(image, {line(1.70, -1)}), ElementsAre(1.70));
}

TEST_F(StrutFilterOfOneCamera, ABarThatIsSeenAgainIsNotForgotten) {
  use({.remembered_images = 2});
  const cv::Mat image = render(camera_, with_bar_);
  for (int i = 0; i < 4; ++i) {
    ASSERT_THAT(left(image, edges_of(bar_)), IsEmpty());
    EXPECT_THAT(left(image, {}), IsEmpty());
    EXPECT_THAT(left(image, {line(1.74, +1)}), IsEmpty());
  }
}

TEST_F(StrutFilterOfOneCamera, ABarIsBelievedOnceItWasSeenOftenEnough) {
  use({.seen_to_believe = 2});
  const cv::Mat image = render(camera_, with_bar_);
  EXPECT_THAT(left(image, edges_of(bar_)), ElementsAre(bar_.from, bar_.to));
  EXPECT_THAT(left(image, edges_of(bar_)), IsEmpty());
}

TEST_F(StrutFilterOfOneCamera, AboutAnotherCentreTheBarsAreStillKnown) {
  ASSERT_THAT(left(with_bar_, edges_of(bar_)), IsEmpty());
  const Eigen::Vector2d error(3.0, 2.5);
  filter_.recenter(camera_, camera_.center_px + error);
  EXPECT_THAT(left({.center_error_px = error}, {line(1.70, -1)}), IsEmpty());
  const Patch other{4.0, 4.05, 10.0};
  EXPECT_THAT(left({.struts = {other}, .center_error_px = error}, edges_of(other)), IsEmpty()) << "and new ones found";
}

}  // namespace
}  // namespace credo::perception
