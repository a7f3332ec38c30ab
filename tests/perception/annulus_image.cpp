// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "annulus_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace credo::perception::test {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr int kPoints = 4;  // per pixel and direction
constexpr int kBlurReach = 4;

/// \param azimuth  in [0, 2 pi)
bool covers(const Patch& patch, double azimuth, double radius) {
  if (radius < patch.inner_px || radius >= patch.outer_px) return false;
  const double from = patch.from < 0.0 ? patch.from + kTurn : patch.from;
  const double ahead = azimuth - from < 0.0 ? azimuth - from + kTurn : azimuth - from;
  return ahead < patch.to - patch.from;
}

double positive(double azimuth) {
  const double turn = std::fmod(azimuth, kTurn);
  return turn < 0.0 ? turn + kTurn : turn;
}

double gray_at(const sensors::OmniCamera& camera, const AnnulusScene& scene, double u, double v) {
  const double du = u - camera.center_px.x() - scene.center_error_px.x();
  const double dv = v - camera.center_px.y() - scene.center_error_px.y();
  const double radius = std::hypot(du, dv);
  const double azimuth =
      positive(camera.azimuth_zero_rad + camera.azimuth_sign * std::atan2(dv, du) + camera.T_base_camera.theta);
  const double rim = *camera.rim_radius_px;
  if (radius > rim + 6.0) return 2.0;
  for (const Patch& strut : scene.struts) {
    if (covers(strut, azimuth, radius)) return strut.gray;
  }
  if (radius > rim) return 0.2 * scene.background;
  if (radius < camera.inner_radius_px - 2.0) return radius < 0.3 * camera.inner_radius_px ? 10.0 : 45.0;
  const double tan_elevation = (radius - camera.horizon_radius_px) / camera.mirror->focal_px;
  const double seen = positive(azimuth + scene.tilt_rad * tan_elevation * std::cos(azimuth));
  double gray = scene.background;
  for (const Patch& patch : scene.patches) {
    if (covers(patch, seen, radius)) gray = patch.gray;
  }
  return gray;
}

void blur(cv::Mat& image, double sigma) {
  std::array<float, 2 * kBlurReach + 1> kernel{};
  float sum = 0.0F;
  for (int i = -kBlurReach; i <= kBlurReach; ++i) {
    sum += kernel[i + kBlurReach] = static_cast<float>(std::exp(-0.5 * i * i / (sigma * sigma)));
  }
  for (int axis = 0; axis < 2; ++axis) {
    const cv::Mat source = image.clone();
    for (int v = 0; v < image.rows; ++v) {
      for (int u = 0; u < image.cols; ++u) {
        float value = 0.0F;
        for (int i = -kBlurReach; i <= kBlurReach; ++i) {
          const int su = std::clamp(axis == 0 ? u + i : u, 0, image.cols - 1);
          const int sv = std::clamp(axis == 0 ? v : v + i, 0, image.rows - 1);
          value += kernel[i + kBlurReach] * source.at<float>(sv, su);
        }
        image.at<float>(v, u) = value / sum;
      }
    }
  }
}

}  // namespace

sensors::OmniCamera test_camera() {
  sensors::OmniCamera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.center_px = {320.4, 239.1};
  camera.inner_radius_px = 60.0;
  camera.outer_radius_px = 230.0;
  camera.horizon_radius_px = 120.0;
  camera.rim_radius_px = 233.0;
  camera.mirror = sensors::ConicMirror{.half_angle_rad = 0.9076, .apex_distance_m = 0.06, .focal_px = 480.0};
  camera.accuracy = {.center_px = 0.3, .tilt_rad = 0.01};
  return camera;
}

cv::Mat render(const sensors::OmniCamera& camera, const AnnulusScene& scene) {
  cv::Mat corners(camera.height_px + 1, camera.width_px + 1, CV_32FC1);
  for (int v = 0; v < corners.rows; ++v) {
    for (int u = 0; u < corners.cols; ++u) {
      corners.at<float>(v, u) = static_cast<float>(gray_at(camera, scene, u - 0.5, v - 0.5));
    }
  }
  cv::Mat image(camera.height_px, camera.width_px, CV_32FC1);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const float first = corners.at<float>(v, u);
      image.at<float>(v, u) = first;
      if (first == corners.at<float>(v, u + 1) && first == corners.at<float>(v + 1, u) &&
          first == corners.at<float>(v + 1, u + 1)) {
        continue;
      }
      double sum = 0.0;
      for (int i = 0; i < kPoints * kPoints; ++i) {
        sum += gray_at(camera, scene, u - 0.5 + (i % kPoints + 0.5) / kPoints, v - 0.5 + (i / kPoints + 0.5) / kPoints);
      }
      image.at<float>(v, u) = static_cast<float>(sum / (kPoints * kPoints));
    }
  }
  if (scene.blur_px > 0.0) blur(image, scene.blur_px);
  std::mt19937 random(scene.seed);
  std::normal_distribution<double> noise(0.0, scene.noise > 0.0 ? scene.noise : 1.0);
  cv::Mat pixels(image.size(), CV_8UC1);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const double level = scene.exposure * image.at<float>(v, u) + (scene.noise > 0.0 ? noise(random) : 0.0);
      pixels.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(std::lround(std::clamp(level, 0.0, 255.0)));
    }
  }
  return pixels;
}

}  // namespace credo::perception::test
