// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/radial_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "annulus_image.hpp"
#include "geometry/angles.hpp"

namespace credo::perception {
namespace {

using geometry::angle_difference;
using geometry::to_radians;
using test::AnnulusScene;
using test::Patch;
using test::render;
using test::test_camera;

Scene look(const sensors::OmniCamera& camera, const cv::Mat& pixels, const RadialLineParams& params = {}) {
  RadialLineExtractor extractor(camera, params);
  Scene scene;
  extractor.extract({.time = 0, .pixels = pixels}, scene);
  return scene;
}

/// The line of a sign nearest to an azimuth; fails the test if none is within a degree.
RadialLine nearest(const Scene& scene, double azimuth, int polarity) {
  RadialLine best{.azimuth = azimuth + std::numbers::pi};
  for (const RadialLine& line : scene.radial_lines) {
    if (line.polarity != polarity) continue;
    if (std::abs(angle_difference(line.azimuth, azimuth)) < std::abs(angle_difference(best.azimuth, azimuth)))
      best = line;
  }
  EXPECT_LT(std::abs(angle_difference(best.azimuth, azimuth)), to_radians(1.0)) << "no line near " << azimuth;
  return best;
}

struct TrueEdge {
  double azimuth;
  int polarity;
};

/// Bright and dark sectors all around, every second one of partial height.
AnnulusScene sectors(unsigned seed, std::vector<TrueEdge>& truth) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  AnnulusScene scene{.background = uniform(70.0, 160.0), .seed = seed};
  for (double azimuth = 0.05; azimuth < 6.0;) {
    const double width = uniform(0.02, 0.25);
    const double step = (uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0) * uniform(12.0, 60.0);
    const bool partial = uniform(0.0, 1.0) < 0.5;
    const double height = partial ? uniform(68.0, 140.0) : 170.0;
    const double inner = partial ? uniform(60.0, 230.0 - height) : 0.0;
    scene.patches.push_back({azimuth, azimuth + width, scene.background + step, inner, partial ? inner + height : 1e9});
    truth.push_back({azimuth, step > 0.0 ? 1 : -1});
    truth.push_back({azimuth + width, step > 0.0 ? -1 : 1});
    azimuth += width + uniform(0.02, 0.25);
  }
  return scene;
}

struct Score {
  int edges = 0, found = 0, lines = 0;
  std::vector<double> errors_deg, sigmas;  // |error|, |error| in standard deviations
  [[nodiscard]] double recall() const { return static_cast<double>(found) / edges; }
  [[nodiscard]] double unmatched() const { return static_cast<double>(lines - found) / lines; }
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.at(values.size() / 2);
}

void score(const Scene& scene, const std::vector<TrueEdge>& truth, Score& sum) {
  sum.lines += static_cast<int>(scene.radial_lines.size());
  for (const TrueEdge& edge : truth) {
    ++sum.edges;
    double least = to_radians(1.0);
    double sigma = 0.0;
    for (const RadialLine& line : scene.radial_lines) {
      const double error = std::abs(angle_difference(line.azimuth, edge.azimuth));
      if (line.polarity != edge.polarity || error >= least) continue;
      least = error;
      sigma = line.sigma;
    }
    if (sigma == 0.0) continue;
    ++sum.found;
    sum.errors_deg.push_back(geometry::to_degrees(least));
    sum.sigmas.push_back(least / sigma);
  }
}

TEST(RadialLines, EdgesAreFoundWhereTheyAreInSpiteOfNoiseBlurCentreAndTilt) {
  Score sum;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    std::vector<TrueEdge> truth;
    AnnulusScene scene = sectors(seed, truth);
    scene.center_error_px = {seed % 2 == 0 ? 0.3 : -0.25, seed < 3 ? 0.3 : -0.2};
    scene.tilt_rad = to_radians(0.5);
    score(look(test_camera(), render(test_camera(), scene)), truth, sum);
  }
  EXPECT_LT(median(sum.errors_deg), 0.05);
  EXPECT_GT(sum.recall(), 0.9);
  EXPECT_LT(sum.unmatched(), 0.05);
}

TEST(RadialLines, SigmaCoversTheErrorsWithoutARimToo) {
  sensors::OmniCamera blind = test_camera();
  blind.rim_radius_px.reset();
  Score sum;
  for (unsigned seed = 11; seed <= 14; ++seed) {
    std::vector<TrueEdge> truth;
    AnnulusScene scene = sectors(seed, truth);
    scene.center_error_px = {seed % 2 == 0 ? 0.3 : -0.3, seed < 13 ? 0.2 : -0.3};
    score(look(blind, render(test_camera(), scene)), truth, sum);
  }
  double square = 0.0;
  for (const double z : sum.sigmas) square += std::min(z, 4.0) * std::min(z, 4.0);
  const double rms = std::sqrt(square / static_cast<double>(sum.sigmas.size()));
  EXPECT_GT(rms, 0.4);
  EXPECT_LT(rms, 1.5);
}

TEST(RadialLines, AzimuthFollowsZeroSignAndMounting) {
  for (const int sign : {-1, 1}) {
    sensors::OmniCamera camera = test_camera();
    camera.azimuth_sign = sign;
    camera.azimuth_zero_rad = 0.7;
    camera.T_base_camera = {0.1, -0.05, 0.4};
    const AnnulusScene scene{.patches = {{1.0, 1.5, 180.0}}};
    const Scene seen = look(camera, render(camera, scene));
    ASSERT_EQ(seen.radial_lines.size(), 2U);
    EXPECT_NEAR(seen.radial_lines[0].azimuth, 1.0, to_radians(0.05));
    EXPECT_EQ(seen.radial_lines[0].polarity, 1);
    EXPECT_NEAR(seen.radial_lines[1].azimuth, 1.5, to_radians(0.05));
    EXPECT_EQ(seen.radial_lines[1].polarity, -1);
    EXPECT_EQ(seen.camera_origin, Eigen::Vector2d(0.1, -0.05));
  }
}

TEST(RadialLines, ContrastAndVisibleShareAreThoseOfTheEdge) {
  const AnnulusScene scene{.patches = {{1.0, 1.5, 160.0, 0.0, 145.0}}};
  const Scene seen = look(test_camera(), render(test_camera(), scene));
  const RadialLine line = nearest(seen, 1.0, 1);
  EXPECT_NEAR(line.contrast, 40.0, 4.0);
  EXPECT_NEAR(line.visible_share, 0.5, 0.05);
}

TEST(RadialLines, TwoEdgesOfOneSignADegreeApartStayTwo) {
  const AnnulusScene scene{.patches = {{1.0, 1.5, 160.0}, {1.02, 1.5, 200.0}}};
  const Scene seen = look(test_camera(), render(test_camera(), scene));
  EXPECT_NEAR(nearest(seen, 1.0, 1).azimuth, 1.0, to_radians(0.2));
  EXPECT_NEAR(nearest(seen, 1.02, 1).azimuth, 1.02, to_radians(0.2));
}

TEST(RadialLines, NarrowBarKeepsItsWidth) {
  const AnnulusScene scene{.patches = {{1.0, 1.02, 60.0}, {3.0, 3.02, 180.0}}};
  const Scene seen = look(test_camera(), render(test_camera(), scene));
  EXPECT_NEAR(nearest(seen, 1.0, -1).azimuth, 1.0, to_radians(0.05));
  EXPECT_NEAR(nearest(seen, 1.02, 1).azimuth, 1.02, to_radians(0.05));
  EXPECT_NEAR(nearest(seen, 3.0, 1).azimuth, 3.0, to_radians(0.05));
  EXPECT_NEAR(nearest(seen, 3.02, -1).azimuth, 3.02, to_radians(0.05));
}

TEST(RadialLines, EdgesWhereAzimuthsBeginAnewAreAsSureAsElsewhere) {
  // Half a column before azimuth 0 the first extremum of a circle lies behind its last column.
  sensors::OmniCamera camera = test_camera();
  camera.azimuth_zero_rad += 0.4;  // azimuth 0 lies along no row of pixels
  for (const double azimuth : {-0.002, -0.001, -0.0005, 0.0}) {
    const AnnulusScene scene{.patches = {{azimuth, azimuth + 0.02, 180.0}, {1.0 + azimuth, 1.02 + azimuth, 180.0}}};
    const Scene seen = look(camera, render(camera, scene));
    for (const auto& [at, polarity] : {TrueEdge{azimuth, 1}, TrueEdge{azimuth + 0.02, -1}}) {
      const RadialLine here = nearest(seen, at, polarity), there = nearest(seen, 1.0 + at, polarity);
      EXPECT_NEAR(angle_difference(here.azimuth, at), angle_difference(there.azimuth, 1.0 + at), 8e-4) << azimuth;
      EXPECT_LT(here.sigma, 1.1 * there.sigma) << azimuth;
      EXPECT_GT(here.visible_share, there.visible_share - 0.03) << azimuth;
    }
  }
}

TEST(RadialLines, TiltIsLearnedAndBendsShortLinesUpright) {
  std::vector<TrueEdge> truth;
  AnnulusScene scene = sectors(21, truth);
  scene.tilt_rad = to_radians(1.0);
  RadialLineExtractor extractor(test_camera());
  Scene seen;
  std::vector<double> medians;
  for (unsigned i = 0; i < 6; ++i) {
    scene.seed = i;
    extractor.extract({.time = i, .pixels = render(test_camera(), scene)}, seen);
    Score once;
    score(seen, truth, once);
    medians.push_back(median(once.errors_deg));
  }
  EXPECT_LT(medians.back(), 0.03);
  EXPECT_LT(medians.back(), medians.front());
}

TEST(RadialLines, StrutsAreNoLandmarksButDarkPillarsAre) {
  const double back = 1.7 + std::numbers::pi;
  const AnnulusScene scene{.patches = {{0.5, 0.54, 20.0}, {2.6, 2.9, 170.0}},
                           .struts = {{1.7, 1.74, 10.0}, {back, back + 0.04, 10.0}}};
  const Scene seen = look(test_camera(), render(test_camera(), scene));
  for (const RadialLine& line : seen.radial_lines) {
    EXPECT_GT(std::abs(angle_difference(line.azimuth, 1.72)), 0.04);
    EXPECT_GT(std::abs(angle_difference(line.azimuth, back + 0.02)), 0.04);
  }
  EXPECT_EQ(seen.radial_lines.size(), 4U);
}

TEST(RadialLines, MaskedPartsAreNotUsed) {
  sensors::OmniCamera camera = test_camera();
  camera.mask = cv::Mat(camera.height_px, camera.width_px, CV_8UC1, cv::Scalar(255));
  camera.mask(cv::Rect(0, 0, camera.width_px, 239)) = cv::Scalar(0);  // above the centre: azimuths 0 .. pi
  const AnnulusScene scene{.patches = {{1.0, 1.5, 180.0}, {-1.5, -1.0, 180.0}}};
  const Scene seen = look(camera, render(camera, scene));
  ASSERT_EQ(seen.radial_lines.size(), 2U);
  EXPECT_NEAR(seen.radial_lines[0].azimuth, -1.5, to_radians(0.1));
  EXPECT_NEAR(seen.radial_lines[1].azimuth, -1.0, to_radians(0.1));
}

TEST(RadialLines, DarknessAndGlareAreNotSeen) {
  const sensors::OmniCamera camera = test_camera();
  const cv::Mat image = render(camera, {.patches = {{1.0, 1.5, 180.0}}, .exposure = 0.005});
  const Scene dark = look(camera, image);
  EXPECT_FALSE(dark.camera_seen);
  EXPECT_TRUE(dark.radial_lines.empty());
  EXPECT_TRUE(dark.gray.values.empty());
  const Scene glare = look(camera, render(camera, {.patches = {{1.0, 1.5, 180.0}}, .exposure = 6.0}));
  EXPECT_FALSE(glare.camera_seen);
  EXPECT_GT(glare.saturated_share, 0.9);
}

TEST(RadialLines, PlainWallHasNoLines) {
  AnnulusScene scene;
  for (int i = 0; i < 360; ++i) {  // shading that varies all around, as lamps make it
    const double azimuth = to_radians(i);
    scene.patches.push_back({azimuth, azimuth + to_radians(1.0), 120.0 + 40.0 * std::sin(azimuth)});
  }
  scene.noise = 3.0;
  const Scene seen = look(test_camera(), render(test_camera(), scene));
  EXPECT_TRUE(seen.camera_seen);
  EXPECT_TRUE(seen.radial_lines.empty());
}

TEST(RadialLines, SameImageGivesTheSameBytesAgain) {
  std::vector<TrueEdge> truth;
  const cv::Mat image = render(test_camera(), sectors(5, truth));
  const Scene first = look(test_camera(), image);
  const Scene second = look(test_camera(), image);
  ASSERT_EQ(first.radial_lines.size(), second.radial_lines.size());
  for (std::size_t i = 0; i < first.radial_lines.size(); ++i) {
    EXPECT_EQ(first.radial_lines[i].azimuth, second.radial_lines[i].azimuth);
    EXPECT_EQ(first.radial_lines[i].sigma, second.radial_lines[i].sigma);
  }
  EXPECT_EQ(first.gray.values, second.gray.values);
}

TEST(RadialLines, ImageWithGapsBetweenItsRowsIsReadAlike) {
  const cv::Mat image = render(test_camera(), {.patches = {{1.0, 1.5, 180.0}}});
  cv::Mat wide(image.rows, image.cols + 64, CV_8UC1, cv::Scalar(99));
  const cv::Mat window = wide(cv::Rect(32, 0, image.cols, image.rows));
  image.copyTo(window);
  EXPECT_EQ(look(test_camera(), window).radial_lines.at(0).azimuth,
            look(test_camera(), image).radial_lines.at(0).azimuth);
}

TEST(RadialLines, WrongImageIsRefusedWithWhatWasFound) {
  RadialLineExtractor extractor(test_camera());
  Scene scene;
  const cv::Mat small(100, 200, CV_8UC1, cv::Scalar(0));
  EXPECT_THAT([&] { extractor.extract({.time = 0, .pixels = small}, scene); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("found 200 x 100")));
  sensors::OmniCamera camera = test_camera();
  camera.inner_radius_px = camera.outer_radius_px;
  EXPECT_THROW(RadialLineExtractor{camera}, std::invalid_argument);
}

TEST(GrayCurve, IsTheGreyLevelAtTheHorizonByAzimuth) {
  const Scene seen = look(test_camera(), render(test_camera(), {.background = 100.0, .patches = {{1.0, 1.5, 160.0}}}));
  ASSERT_EQ(seen.gray.values.size(), 1024U);
  const auto at = [&](double azimuth) {
    return seen.gray.values[static_cast<std::size_t>(std::lround(azimuth / (2.0 * std::numbers::pi) * 1024.0))];
  };
  EXPECT_NEAR(at(0.9), 100.0, 4.0 * seen.gray.noise);
  EXPECT_NEAR(at(1.25), 160.0, 4.0 * seen.gray.noise);
  EXPECT_NEAR(at(1.6), 100.0, 4.0 * seen.gray.noise);
  EXPECT_NEAR(seen.gray.noise, 1.5 / std::sqrt(5.0), 0.25);
}

}  // namespace
}  // namespace credo::perception
