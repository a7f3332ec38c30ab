// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/experiment_pictures.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

#include "tests/results/has_color.hpp"

namespace credo::results {
namespace {

History two_moments() {
  History history(2);
  for (Moment& moment : history) moment.truth = geometry::Pose2{1.0, 1.0, 0.0};
  history[0].localization.estimate.pose = {1.0, 1.2, 0.0};
  history[1].localization.estimate.pose = {1.6, 1.0, 0.0};
  history[0].localization.belief = {.yes = 0.9, .no = 0.0, .unknown = 0.1};
  return history;
}

TEST(ExperimentPictures, PositionsShowThePlanAndEachDriveInItsColor) {
  const History history = two_moments();
  geometry::FloorPlan plan;
  plan.walls = {{{0.0, 0.0}, {4.0, 0.0}}, {{4.0, 0.0}, {4.0, 3.0}}};
  const cv::Mat picture = positions_picture(plan, std::vector<NamedDrive>{{"one", colors::kOrange, history}});
  EXPECT_TRUE(has(picture, colors::kOrange));
  EXPECT_FALSE(has(picture, colors::kBlue));
}

TEST(ExperimentPictures, BeliefsHaveALineForEachDrive) {
  const History history = two_moments();
  const cv::Mat picture = beliefs_picture(
      std::vector<NamedDrive>{{"one", colors::kOrange, history}, {"two", colors::kBlue, std::span(history).first(1)}});
  EXPECT_TRUE(has(picture, colors::kOrange));
  EXPECT_TRUE(has(picture, colors::kBlue));
}

TEST(ExperimentPictures, ALifeShowsItsMassesAndItsLoss) {
  std::vector<TrackSample> samples(3);
  samples[0].existence = {.yes = 0.5, .no = 0.1, .unknown = 0.4};
  samples[0].type = perception::PrimitiveType::kEdge;
  samples[1].state = samples[2].state = tracking::TrackState::kMissed;
  samples[2].existence = {.yes = 0.2, .no = 0.3, .unknown = 0.5};
  const cv::Mat lost = track_life_picture("edge", samples, 5, true);
  EXPECT_TRUE(has(lost, colors::kGreen));
  EXPECT_TRUE(has(lost, color_of(perception::PrimitiveType::kEdge)));
  EXPECT_GT(cv::norm(lost, track_life_picture("edge", samples, 5, false)), 0.0);
}

}  // namespace
}  // namespace credo::results
