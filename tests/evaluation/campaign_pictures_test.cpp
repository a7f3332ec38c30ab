// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign_pictures.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "results/canvas.hpp"

namespace credo::evaluation {
namespace {

const CampaignSpec kSpec{.worlds = {"a"}, .seeds = 1, .degradations = {"nominal", "people"}};

std::vector<CampaignRun> runs_with(double error_m) {
  CampaignRow row;
  row.sample.localization.estimate.pose.x = error_m;
  row.sample.localization.status = localization::Status::kLocalized;
  row.sample.localization.protection = {0.1, 0.2, 0.01, 0.02};
  return {{.key = {"a", 1, "nominal"}, .rows = {row}, .refused = ""}};
}

/// Pixels of just this colour, legend left out.
int count(const cv::Mat& picture, const results::Color& color) {
  const cv::Scalar bgr(color.blue, color.green, color.red);
  cv::Mat found;
  cv::inRange(picture.rowRange(62, picture.rows), bgr, bgr, found);
  return cv::countNonZero(found);
}

TEST(AvailabilityPicture, ShowsMisleadingAcquisitionsInRed) {
  EXPECT_EQ(count(availability_picture(kSpec, runs_with(0.01)), results::colors::kRed), 0);
  EXPECT_GT(count(availability_picture(kSpec, runs_with(0.3)), results::colors::kRed), 1000);
}

TEST(ErrorPicture, HasARowForEachDegradationAndTakesEmptyOnes) {
  CampaignSpec more = kSpec;
  more.degradations.push_back("kidnap");
  EXPECT_GT(error_picture(more, {}).rows, error_picture(kSpec, {}).rows);
  EXPECT_GT(count(error_picture(kSpec, runs_with(0.01)), results::colors::kRed), 5);
}

TEST(ProtectionPicture, DrawsPointsBeyondItsEndsAtThem) {
  const int inside = count(protection_picture(runs_with(0.3)), results::colors::kRed);
  EXPECT_GT(inside, 5);
  EXPECT_GT(count(protection_picture(runs_with(30.0)), results::colors::kRed), 0);
}

}  // namespace
}  // namespace credo::evaluation
