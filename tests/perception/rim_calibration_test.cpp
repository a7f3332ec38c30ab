// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/rim_calibration.hpp"

#include <gtest/gtest.h>

#include "annulus_image.hpp"
#include "perception/annulus_table.hpp"

namespace credo::perception {
namespace {

using test::AnnulusScene;
using test::render;
using test::test_camera;

TEST(RimCalibration, CentreIsFoundToATenthOfAPixel) {
  for (const Eigen::Vector2d& error :
       {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.6, -0.4), Eigen::Vector2d(-0.9, 0.7)}) {
    const sensors::OmniCamera camera = test_camera();
    const AnnulusScene scene{
        .patches = {{0.5, 1.5, 200.0}, {2.0, 3.0, 40.0}}, .struts = {{1.7, 1.74, 10.0}}, .center_error_px = error};
    RimCalibration rim(camera, {});
    rim.update(render(camera, scene).ptr<std::uint8_t>());
    EXPECT_LT((rim.center_px() - camera.center_px - error).norm(), 0.1);
    EXPECT_LT(rim.sigma_px(), 0.1);
  }
}

TEST(RimCalibration, RimTooFarFromTheCalibrationIsNotBelieved) {
  const sensors::OmniCamera camera = test_camera();
  RimCalibration rim(camera, {});
  rim.update(render(camera, {.center_error_px = {3.5, 0.0}}).ptr<std::uint8_t>());
  EXPECT_EQ(rim.center_px(), camera.center_px);
  EXPECT_EQ(rim.sigma_px(), camera.accuracy.center_px);
}

TEST(RimCalibration, WithoutARimTheCalibrationStays) {
  sensors::OmniCamera camera = test_camera();
  const cv::Mat image = render(camera, {.center_error_px = {0.5, 0.5}});
  const cv::Mat dark = render(camera, {.exposure = 0.01});
  RimCalibration unseen(camera, {});
  unseen.update(dark.ptr<std::uint8_t>());
  EXPECT_EQ(unseen.center_px(), camera.center_px);
  camera.rim_radius_px.reset();
  RimCalibration none(camera, {});
  EXPECT_FALSE(none.find(image.ptr<std::uint8_t>()).has_value());
}

TEST(AnnulusTable, SamplesAreTheInterpolatedImage) {
  const sensors::OmniCamera camera = test_camera();
  cv::Mat ramp(camera.height_px, camera.width_px, CV_8UC1);
  for (int v = 0; v < ramp.rows; ++v) {
    for (int u = 0; u < ramp.cols; ++u) ramp.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>((u + v) / 5);
  }
  const double radius = 150.0;
  const AnnulusTable table(camera, camera.center_px, std::span(&radius, 1), 0.7);
  const AnnulusRow& row = table.rows().at(0);
  EXPECT_EQ(row.columns % 16, 0);
  EXPECT_GE(row.columns * 0.7, 2.0 * 3.14159 * radius);
  std::vector<std::int16_t> samples(static_cast<std::size_t>(row.columns));
  table.sample(ramp.ptr<std::uint8_t>(), 0, samples.data());
  for (int i = 0; i < row.columns; ++i) {
    const Eigen::Vector2d pixel =
        camera.center_px + radius * camera.image_direction(2.0 * 3.14159265358979 * i / row.columns);
    EXPECT_NEAR(samples[static_cast<std::size_t>(i)] / 4.0, (pixel.x() + pixel.y()) / 5.0 - 0.4, 0.9);
    EXPECT_TRUE(table.usable(0, i));
  }
}

TEST(AnnulusTable, SamplesOutsideTheImageAreNotUsable) {
  const sensors::OmniCamera camera = test_camera();
  const double radius = 260.0;  // beyond the upper and lower border
  const AnnulusTable table(camera, camera.center_px, std::span(&radius, 1), 1.0);
  const int columns = table.rows().at(0).columns;
  EXPECT_TRUE(table.usable(0, 0));
  EXPECT_FALSE(table.usable(0, columns / 4));
  EXPECT_THROW(AnnulusTable(camera, camera.center_px, std::span(&radius, 1), 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace credo::perception
