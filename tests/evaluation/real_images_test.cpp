// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "geometry/angles.hpp"
#include "perception/radial_lines.hpp"

namespace credo::perception {
namespace {

/// The parabolic mirror's image: centre and annulus from its calibration. Azimuths need no more of a mirror.
sensors::OmniCamera parabolic_camera() {
  sensors::OmniCamera camera;
  camera.model = sensors::OmniCamera::Model::kMei;
  camera.width_px = 1280;
  camera.height_px = 1024;
  camera.center_px = {643.67, 524.83};
  camera.inner_radius_px = 65.0;
  camera.outer_radius_px = 340.0;
  camera.horizon_radius_px = 260.0;
  camera.accuracy.center_px = 0.8;
  return camera;
}

int found_again(const std::vector<RadialLine>& lines, const std::vector<RadialLine>& others, double tolerance) {
  int count = 0;
  for (const RadialLine& line : lines) {
    for (const RadialLine& other : others) {
      if (other.polarity != line.polarity) continue;
      if (std::abs(geometry::angle_difference(line.azimuth, other.azimuth)) > tolerance) continue;
      ++count;
      break;
    }
  }
  return count;
}

// The camera stands still, a person with a board moves: most lines must be there again in the next image, and far fewer
// where nothing is expected (the same lines turned by 2.5 degrees).
TEST(RealImages, StaticEdgesAreFoundAgainFromImageToImage) {
  const char* data = std::getenv("CREDO_DATA");
  if (data == nullptr) GTEST_SKIP() << "set CREDO_DATA to the folder with the recordings";
  const sensors::OmniCamera camera = parabolic_camera();
  RadialLineExtractor extractor(camera);
  std::vector<std::vector<RadialLine>> lines;
  for (int i = 1; i <= 6; ++i) {
    const std::string path = std::string(data) + "/real/omni_parabolic/img_para_00" + std::to_string(i) + ".png";
    const cv::Mat pixels = cv::imread(path, cv::IMREAD_GRAYSCALE);
    ASSERT_FALSE(pixels.empty()) << path;
    Scene scene;
    extractor.extract({.time = i, .pixels = pixels}, scene);
    ASSERT_TRUE(scene.camera_seen) << path;
    lines.push_back(scene.radial_lines);
  }
  int all = 0;
  int again = 0;
  int by_chance = 0;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    std::vector<RadialLine> turned = lines[i];
    for (RadialLine& line : turned) line.azimuth += geometry::to_radians(2.5);
    const double tolerance = geometry::to_radians(0.3);
    all += static_cast<int>(lines[i].size());
    again += found_again(lines[i], lines[i + 1], tolerance);
    by_chance += found_again(turned, lines[i + 1], tolerance);
  }
  ASSERT_GT(all, 0);
  const double share = static_cast<double>(again) / all;
  const double chance = static_cast<double>(by_chance) / all;
  RecordProperty("lines_per_image", std::to_string(all / 5.0));
  RecordProperty("found_again", std::to_string(share));
  std::cout << "radial lines per image: " << all / 5.0 << ", found again within 0.3 degrees: " << share
            << ", by chance: " << chance << '\n';
  EXPECT_GT(share, 0.5);
  EXPECT_GT(share, 2.0 * chance);
}

}  // namespace
}  // namespace credo::perception
