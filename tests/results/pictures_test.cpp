// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/pictures.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "results/history.hpp"
#include "results/plot.hpp"

#include "tests/results/has_color.hpp"

namespace credo::results {
namespace {

History history() {
  History result;
  for (int i = 0; i < 5; ++i) {
    Moment m;
    m.localization.time = i * 1'000'000'000LL;
    m.localization.estimate.pose = {0.3 * i, 1.0, 0.1};
    m.localization.estimate.covariance.diagonal() << 1e-4, 2e-4, 1e-5;
    m.localization.belief = {.yes = 0.8, .no = 0.0, .unknown = 0.2};
    m.localization.status = i == 4 ? localization::Status::kLost : localization::Status::kLocalized;
    m.tracks = {
        {.id = 1, .type = perception::PrimitiveType::kEdge, .existence = {.yes = 1.0, .no = 0.0, .unknown = 0.0}}};
    m.truth = geometry::Pose2{0.3 * i + 0.01, 1.0, 0.1};
    result.push_back(m);
  }
  return result;
}

TEST(Ticks, AreRoundAndInside) {
  EXPECT_EQ(ticks(0.0, 10.0, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks(-0.9, 1.1, 4), (std::vector<double>{-0.5, 0.0, 0.5, 1.0}));
  EXPECT_EQ(ticks(3.0, 3.0), (std::vector<double>{3.0}));
}

TEST(Ticks, AreLabelledWithTheDecimalsOfTheirStep) {
  EXPECT_EQ(tick_label(0.5, 0.5), "0.5");
  EXPECT_EQ(tick_label(0.25, 0.25), "0.25");
  EXPECT_EQ(tick_label(20.0, 10.0), "20");
  EXPECT_EQ(tick_label(-1e-17, 0.1), "0.0");
}

cv::Mat drawn(const Plot& plot) {
  Canvas canvas(300, 200);
  plot.draw(canvas, {0, 0}, {300, 200});
  return canvas.finish();
}

TEST(Plots, WhiskersWithoutAnEndAreLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto with_upper_end = [](double high) {
    Plot plot("", "", "");
    return drawn(plot.whiskers({1.0}, {0.2}, {high}, colors::kRed, "", 4.0).x_limits(0.0, 2.0).y_limits(0.0, 1.0));
  };
  EXPECT_TRUE(has(with_upper_end(0.8), colors::kRed));
  EXPECT_FALSE(has(with_upper_end(kNan), colors::kRed));
}

TEST(Plots, WhatLiesOutsideOfTheLimitsIsNotDrawn) {
  Plot plot("", "", "");
  plot.points({5.0}, {0.5}, colors::kRed, "", 5.0).y_limits(0.0, 1.0);
  EXPECT_TRUE(has(drawn(plot), colors::kRed));
  EXPECT_FALSE(has(drawn(plot.x_limits(0.0, 2.0)), colors::kRed));
}

TEST(LengthText, IsInMetresFromOneMetreOn) {
  EXPECT_EQ(length_text(0.0123), "1.2 cm");
  EXPECT_EQ(length_text(0.999), "99.9 cm");
  EXPECT_EQ(length_text(1.0), "1.00 m");
  EXPECT_EQ(length_text(-12.345), "-12.35 m");
  EXPECT_EQ(size_text(0.013, 0.012), "1.3 x 1.2 cm");
  EXPECT_EQ(size_text(363.98, 0.5), "364 x 0 m");
}

TEST(TypeColor, NoneIsThatOfTheEstimate) {
  using perception::PrimitiveType;
  for (const PrimitiveType type :
       {PrimitiveType::kCorner, PrimitiveType::kEdge, PrimitiveType::kWall, PrimitiveType::kOther})
    EXPECT_NE(color_of(type), colors::kBlue);
}

TEST(BeliefColor, GoesFromGreenToRedThroughGrey) {
  EXPECT_EQ(color_of(evidence::BinaryMass{1, 0, 0}), colors::kGreen);
  EXPECT_EQ(color_of(evidence::BinaryMass{0, 1, 0}), colors::kRed);
  const Color unknown = color_of(evidence::BinaryMass{});
  EXPECT_LT(std::abs(unknown.red - unknown.blue), 10);
}

TEST(Canvas, ClipsWhatIsOutside) {
  Canvas canvas(60, 40);
  canvas.clip({20, 10}, {40, 30});
  canvas.box({0, 0}, {60, 40}, colors::kRed);
  canvas.clip();
  const cv::Mat picture = canvas.finish();
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 5), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(picture.at<cv::Vec3b>(20, 30), cv::Vec3b(20, 58, 200));
}

TEST(Pictures, ErrorAndBeliefShowEveryStatusThatOccurred) {
  for (const cv::Mat& picture : {error_picture(history()), belief_picture(history())}) {
    EXPECT_EQ(picture.type(), CV_8UC3);
    EXPECT_TRUE(has(picture, colors::kGreen));
    EXPECT_TRUE(has(picture, colors::kRed));
  }
}

TEST(Pictures, OneMomentIsEnough) {
  const History all = history();
  const std::span<const Moment> one(all.data(), 1);
  EXPECT_FALSE(error_picture(one).empty());
  EXPECT_FALSE(belief_picture(one).empty());
}

TEST(Pictures, ThePlanShowsWallsTrailAndRobot) {
  const geometry::FloorPlan plan{.walls = {{{0, 0}, {4, 0}}, {{4, 0}, {4, 3}}}, .verticals = {{2, 0}}};
  const History all = history();
  const cv::Mat picture = plan_picture({.plan = plan, .history = all, .tracks = {}});
  EXPECT_TRUE(has(picture, {150, 154, 162}));
  EXPECT_TRUE(has(picture, colors::kBlue));
}

/// A picture with a ring every 5 m would never be done.
TEST(Pictures, AScanFromFarAwayIsDrawn) {
  perception::Scene scene;
  for (int i = 0; i < 10; ++i) scene.points.push_back({.position = {1e8, 1e8 + i}});
  EXPECT_FALSE(scan_picture(scene, 0.25).empty());
}

TEST(Pictures, AScanOfNothingIsStillAPicture) { EXPECT_FALSE(scan_picture({}, 0.25).empty()); }

TEST(Pictures, TheMapShowsOccupiedCellsUpright) {
  grids::EvidentialGrid grid(grids::Georeference{.resolution_m = 0.1});
  evidence::FixedLogCommonality occupied{.empty = -5 << 20, .occupied = 0, .unknown = -5 << 20};
  evidence::FixedLogCommonality empty{.empty = 0, .occupied = -5 << 20, .unknown = -5 << 20};
  for (int x = 0; x < 20; ++x) {
    for (int y = 0; y < 20; ++y) grid.add({x, y}, y >= 15 ? occupied : empty);
  }
  const cv::Mat picture = map_picture(grid);
  EXPECT_EQ(picture.at<cv::Vec3b>(60, 300), cv::Vec3b(36, 30, 28));  // the upper rows of the map are on top
  EXPECT_EQ(picture.at<cv::Vec3b>(600, 300), cv::Vec3b(255, 255, 255));
}

/// A map of 2 m by 2 m, all of it empty.
grids::EvidentialGrid small_map(int width) {
  grids::EvidentialGrid grid(grids::Georeference{.resolution_m = 0.1});
  for (int x = 0; x < width; ++x)
    for (int y = 0; y < 20; ++y) grid.add({x, y}, {.empty = 0, .occupied = -5 << 20, .unknown = -5 << 20});
  return grid;
}

TEST(Pictures, AWayThatLeadsOutOfTheMapStaysInItsFrame) {
  const std::vector<geometry::Pose2> way{{1.0, 1.0, 0.0}, {10.0, 1.5, 0.0}, {1.0, 10.0, 0.0}};
  const cv::Mat picture = map_picture(small_map(20), way);
  const int right = 16 + 720 + 2, foot = 34 + 720 + 2;
  EXPECT_TRUE(has(picture(cv::Rect(0, 0, right, foot)), colors::kBlue));
  EXPECT_FALSE(has(picture(cv::Rect(right, 0, picture.cols - right, picture.rows)), colors::kBlue));
  EXPECT_FALSE(has(picture(cv::Rect(0, 0, right, 32)), colors::kBlue));
}

/// Where the scale bar is, in the lower part of the map's panel.
TEST(Pictures, TheScaleBarOfANarrowMapIsWithinTheMap) {
  const cv::Mat picture = map_picture(small_map(4));
  const int middle = 16 + 360, half = 160 / 2 + 12;  // 0.4 m by 2 m (and the margin) in a box 900 pixels high
  const cv::Rect beside(middle + half, 500, 16 + 720 - middle - half, 430);
  EXPECT_FALSE(has(picture(beside), colors::kInk));
}

TEST(Pictures, TheEndsThatTheCameraSharpenedAreToldFromPoints) {
  perception::Scene scene;
  for (int i = 0; i < 10; ++i) scene.points.push_back({.position = {2.0, 0.1 * i}});
  perception::FusedSegment segment;
  segment.extent = {{2.0, 0.0}, {2.0, 1.0}};
  scene.segments = {segment};
  const cv::Mat plain = scan_picture(scene, 0.25);
  scene.segments[0].source_a = perception::EndpointSource::kCamera;
  EXPECT_GT(cv::norm(plain, scan_picture(scene, 0.25), cv::NORM_L1), 3000.0);
}

/// The columns, from the first to the last, in which a part of a picture has a colour.
std::pair<int, int> columns_with(const cv::Mat& picture, const cv::Rect& part, Color color) {
  std::pair<int, int> columns{picture.cols, -1};
  for (int u = part.x; u < part.x + part.width; ++u) {
    if (!has(picture(cv::Rect(u, part.y, 1, part.height)), color)) continue;
    columns.first = std::min(columns.first, u);
    columns.second = u;
  }
  return columns;
}

TEST(Pictures, ABandThatIsCutOffSaysSoInTheLegend) {
  History all = history();
  for (int i = 0; i < 3; ++i) all.insert(all.end(), all.begin(), all.end());
  const cv::Mat whole = error_picture(all);
  all[7].localization.estimate.covariance(0, 0) = 4.0;
  const cv::Mat cut = error_picture(all);
  const cv::Rect head(0, 10, whole.cols, 18);
  const Color swatch = mixed(colors::kPaper, colors::kSky, 0.4);
  EXPECT_LT(columns_with(cut, head, swatch).first + 100, columns_with(whole, head, swatch).first);
}

TEST(Pictures, LargeErrorsAreInMetres) {
  const cv::Rect unit(0, 60, 24, 120);
  const cv::Mat small = error_picture(history());
  History far = history();
  far[2].truth->x += 20.0;
  const cv::Mat large = error_picture(far);
  far[2].truth->x += 20.0;
  EXPECT_GT(cv::norm(small(unit), large(unit), cv::NORM_L1), 0.0);
  EXPECT_EQ(cv::norm(large(unit), error_picture(far)(unit), cv::NORM_L1), 0.0);
}

TEST(Pictures, AMissingScanIsCalledSo) {
  perception::Scene scene;
  const cv::Mat missing = scan_picture(scene, 0.25);
  scene.points.push_back({.position = {1.0, 0.0}});
  const cv::Rect title(0, 8, missing.cols, 18);
  EXPECT_LT(columns_with(missing, title, colors::kInk).second + 40,
            columns_with(scan_picture(scene, 0.25), title, colors::kInk).second);
}

TEST(Pictures, AVacuousMapIsStillAPicture) { EXPECT_FALSE(map_picture(grids::EvidentialGrid{}).empty()); }

TEST(Pictures, TheImageIsDrawnOverInTheColourOfTheType) {
  sensors::OmniCamera camera;
  camera.width_px = 320, camera.height_px = 240;
  camera.center_px = {160, 120};
  camera.inner_radius_px = 30, camera.outer_radius_px = 110;
  perception::Scene scene;
  scene.radial_lines.push_back({.azimuth = 0.0, .sigma = 0.001, .contrast = 30.0, .polarity = 1});
  perception::Primitive corner;
  corner.type = perception::PrimitiveType::kCorner;
  corner.radial_line = 0;
  scene.primitives.push_back(corner);
  const cv::Mat grey(240, 320, CV_8UC1, cv::Scalar(90));
  const cv::Mat picture = omni_picture({.time = 0, .pixels = grey}, camera, scene);
  EXPECT_TRUE(has(picture, color_of(perception::PrimitiveType::kCorner)));
  const double scale = picture.cols / 320.0;
  const cv::Vec3b beyond = picture.at<cv::Vec3b>(static_cast<int>(34 + 60 * scale), static_cast<int>(160 * scale));
  EXPECT_EQ(beyond, cv::Vec3b(90, 90, 90));  // nothing is drawn at right angles to it
}

TEST(Pictures, AreDeterministic) {
  const cv::Mat a = belief_picture(history()), b = belief_picture(history());
  EXPECT_EQ(0, std::memcmp(a.data, b.data, a.total() * a.elemSize()));
}

TEST(Pictures, SayWhenTheyCannotBeWritten) {
  EXPECT_THROW(write_png("/no/such/folder/picture.png", cv::Mat(4, 4, CV_8UC3)), std::runtime_error);
}

TEST(Conflict, CountsPairsBothWays) {
  perception::Scene scene;
  perception::FusedSegment segment;
  segment.criteria[0] = {.yes = 0.8, .no = 0.0, .unknown = 0.2};
  segment.criteria[1] = {.yes = 0.0, .no = 0.5, .unknown = 0.5};
  segment.conflict = 0.4;
  scene.segments = {segment, perception::FusedSegment{}};
  ConflictStatistics statistics;
  statistics.add(scene);
  EXPECT_EQ(statistics.segments(), 2);
  EXPECT_NEAR(statistics.mean(), 0.2, 1e-12);
  EXPECT_NEAR(statistics.of_pair(0, 1), 0.2, 1e-12);
  EXPECT_NEAR(statistics.of_pair(1, 0), 0.2, 1e-12);
  EXPECT_EQ(statistics.of_pair(2, 3), 0.0);
}

}  // namespace
}  // namespace credo::results
