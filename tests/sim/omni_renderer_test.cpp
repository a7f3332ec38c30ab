// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/omni_renderer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

using geometry::Pose2;

cv::Mat ideal_image(const World& world, const Pose2& pose, std::uint64_t seed = 1) {
  const OmniRenderer renderer(world, seed);
  OmniRenderer::Workspace workspace(world);
  return renderer.render_ideal(std::span(&pose, 1), workspace).clone();
}

/// A dark panel that begins 3 m ahead, `left_m` to the left: a vertical edge in view of every row.
World room_with_edge(double left_m, const char* material) {
  World world = ideal_room();
  world.panels.push_back(
      {{3.0, left_m}, {3.0, left_m + 1.5}, 0.0, world.ceiling_m, material_index(world, material), false});
  return world;
}

/// Where the edge crosses each column, from the share of its pixels that the dark panel covers: the mean difference to
/// where geometry has it over all columns, and the root mean square.
struct EdgeError {
  double mean = 0.0, rms = 0.0;
};
EdgeError edge_error(double left_m) {
  const World with = room_with_edge(left_m, "dark"), without = room_with_edge(left_m, "plain");
  const Pose2 pose;
  const cv::Mat dark = ideal_image(with, pose), bright = ideal_image(without, pose);
  const double base = dark.at<float>(2, 2);
  const double ratio = with.materials[static_cast<std::size_t>(material_index(with, "dark"))].albedo / 0.8;
  const Eigen::Vector2d center = with.camera->camera.center_px;
  const double slope = -left_m / 3.0;  // azimuth grows counter-clockwise, v grows down
  EdgeError error;
  int columns = 0;
  for (int u = static_cast<int>(center.x()) + 80; u < static_cast<int>(center.x()) + 215; ++u, ++columns) {
    const double expected = center.y() + slope * (u - center.x());
    const int last = static_cast<int>(expected) + 6;
    double covered = 0.0;  // rows from the top of the window to the edge
    for (int v = last - 11; v <= last; ++v) {
      const double light = (dark.at<float>(v, u) - base) / (bright.at<float>(v, u) - base);
      covered += (1.0 - light) / (1.0 - ratio);
    }
    const double found = last - 11 - 0.5 + covered;
    error.mean += found - expected;
    error.rms += (found - expected) * (found - expected);
  }
  error.mean /= columns;
  error.rms = std::sqrt(error.rms / columns);
  return error;
}

TEST(OmniRenderer, EdgesLieWhereGeometryHasThem) {
  for (const double left_m : {0.02, 0.11, 0.37, 0.62, 0.93}) {
    const EdgeError error = edge_error(left_m);
    EXPECT_LT(std::abs(error.mean), 0.02) << left_m;
    EXPECT_LT(error.rms, 0.11) << left_m;  // 9 rays give ninths of a pixel
  }
}

TEST(OmniRenderer, NoiseVarianceGrowsWithTheLight) {
  World world = ideal_room();
  world.nuisances.noise_grey = 1.5;
  world.nuisances.read_noise_grey = 0.7;
  const OmniRenderer renderer(world, 3);
  OmniRenderer::Workspace workspace(world);
  const Pose2 pose;
  constexpr int kImages = 40;
  cv::Mat sum = cv::Mat::zeros(480, 640, CV_64FC1), squares = sum.clone(), image;
  for (int i = 0; i < kImages; ++i) {
    renderer.render(std::span(&pose, 1), static_cast<std::uint64_t>(i), workspace).convertTo(image, CV_64FC1);
    sum += image;
    squares += image.mul(image);
  }
  // Least squares of variance = read^2 + 1/12 + slope * mean over the pixels.
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      const double mean = sum.at<double>(v, u) / kImages;
      const double variance = (squares.at<double>(v, u) - kImages * mean * mean) / (kImages - 1);
      if (mean < 20.0 || mean > 245.0) continue;
      n += 1, x += mean, y += variance, xx += mean * mean, xy += mean * variance;
    }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  EXPECT_NEAR(slope, (1.5 * 1.5 - 0.7 * 0.7) / 128.0, 0.0006);
  EXPECT_NEAR((y - slope * x) / n, 0.7 * 0.7 + 1.0 / 12.0, 0.08);
}

TEST(OmniRenderer, MotionBlurIsTheMeanOverTheExposure) {
  const World world = room_with_edge(0.4, "dark");
  const OmniRenderer renderer(world, 1);
  OmniRenderer::Workspace workspace(world);
  const Pose2 poses[2] = {{0.0, 0.0, 0.0}, {0.02, 0.0, 0.01}};
  const cv::Mat a = renderer.render_ideal(std::span(poses, 1), workspace).clone();
  const cv::Mat b = renderer.render_ideal(std::span(poses + 1, 1), workspace).clone();
  const cv::Mat both = renderer.render_ideal(std::span(poses), workspace);
  EXPECT_LT(cv::norm(both - 0.5 * (a + b), cv::NORM_INF), 1e-3);
  EXPECT_GT(cv::norm(both - a, cv::NORM_INF), 10.0);
}

TEST(OmniRenderer, BlurKeepsTheLight) {
  World world = room_with_edge(0.4, "dark");
  const cv::Mat sharp = ideal_image(world, {});
  world.nuisances.blur_px = 0.7;
  const cv::Mat blurred = ideal_image(world, {});
  EXPECT_NEAR(cv::mean(blurred)[0], cv::mean(sharp)[0], 0.01);
  EXPECT_GT(cv::norm(blurred - sharp, cv::NORM_INF), 10.0);
}

TEST(OmniRenderer, TheRimIsSeenAroundTheTrueCenter) {
  World world = ideal_room();
  world.nuisances.center_px = 3.0;
  const OmniRenderer renderer(world, 5);
  OmniRenderer::Workspace workspace(world);
  const Pose2 pose;
  const cv::Mat image = renderer.render_ideal(std::span(&pose, 1), workspace);
  const Eigen::Vector2d center = renderer.optics().center_px;
  EXPECT_GT((center - world.camera->camera.center_px).norm(), 0.1);
  const double rim = *world.camera->camera.rim_radius_px;
  int compared = 0;
  for (double angle = 0.0; angle < 6.28; angle += 0.2) {
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    const auto pixel = [&](double radius) {
      const Eigen::Vector2d p = center + radius * ray;
      return cv::Point(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
    };
    // The image is hardly higher than the mirror.
    if (!cv::Rect(0, 0, image.cols, image.rows).contains(pixel(rim + 3.0))) continue;
    EXPECT_GT(image.at<float>(pixel(rim - 3.0)), image.at<float>(pixel(rim + 3.0)) + 20.0F) << angle;
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

TEST(OmniRenderer, TiltMovesEdgesAwayFromTheHorizonOnly) {
  World world = room_with_edge(0.3, "dark");
  const cv::Mat upright = ideal_image(world, {});
  world.nuisances.tilt_rad = 0.02;
  const cv::Mat tilted = ideal_image(world, {}, 4);
  const Eigen::Vector2d center = world.camera->camera.center_px;
  // Difference along the circle across the edge, near the horizon ring and near the rim.
  const auto difference = [&](double radius) {
    double sum = 0.0;
    for (double angle = -0.2; angle < 0.0; angle += 0.25 / radius) {
      const int u = static_cast<int>(std::lround(center.x() + radius * std::cos(angle)));
      const int v = static_cast<int>(std::lround(center.y() + radius * std::sin(angle)));
      sum += std::abs(upright.at<float>(v, u) - tilted.at<float>(v, u)) * 0.25;
    }
    return sum;
  };
  EXPECT_GT(difference(220.0), 3.0 * difference(world.camera->camera.horizon_radius_px));
}

TEST(TrueVerticals, AreTheEdgesOfThePanelAndTheCornersOfTheRoom) {
  const World world = room_with_edge(0.4, "dark");
  const OmniRenderer renderer(world, 1);
  OmniRenderer::Workspace workspace(world);
  const Pose2 pose{0.5, 0.2, 0.3};
  const auto edges = renderer.true_verticals(pose, workspace);
  const auto found = [&](const Eigen::Vector2d& foot) {
    const Eigen::Vector2d p = pose.inverse() * foot;
    return std::count_if(edges.begin(), edges.end(), [&](const TrueVertical& edge) {
      return std::abs(geometry::angle_difference(edge.azimuth_rad, std::atan2(p.y(), p.x()))) < 1e-9;
    });
  };
  for (const Eigen::Vector2d& foot :
       {Eigen::Vector2d(3.0, 0.4), Eigen::Vector2d(3.0, 1.9), Eigen::Vector2d(-4.0, 4.0), Eigen::Vector2d(-4.0, -4.0),
        Eigen::Vector2d(4.0, -4.0), Eigen::Vector2d(4.0, 4.0)})
    EXPECT_EQ(found(foot), 1) << foot.transpose();
  EXPECT_EQ(edges.size(), 6U);
  for (const TrueVertical& edge : edges) {
    EXPECT_GE(edge.contrast, OmniRenderer::kFaintest_grey);
    EXPECT_LE(edge.visible_share, 1.0);
  }
}

TEST(TrueVerticals, AreHiddenBehindPanelsAndStruts) {
  World world = room_with_edge(0.4, "dark");
  const auto visible = [](const World& w) {
    const OmniRenderer renderer(w, 1);
    OmniRenderer::Workspace workspace(w);
    return renderer.true_verticals({}, workspace).size();
  };
  const std::size_t all = visible(world);
  World screened = world;
  screened.panels.push_back({{2.0, -1.5}, {2.0, 1.5}, 0.0, world.ceiling_m, material_index(world, "wood"), false});
  // The screen hides both edges of the panel and shows its own.
  EXPECT_EQ(visible(screened), all);
  World barred = world;
  barred.camera->struts_rad = {-std::atan2(0.4, 3.0)};
  EXPECT_EQ(visible(barred), all - 1);
}

/// Every strong edge is a step of the picture at its azimuth.
TEST(TrueVerticals, ArePlacesWhereTheImageChanges) {
  World world = load_world(shipped("demo"));
  world.nuisances = ideal_room().nuisances;
  world.camera->struts_rad.clear();
  const Pose2 pose{2.2, 4.3, 0.2};
  const OmniRenderer renderer(world, 1);
  OmniRenderer::Workspace workspace(world);
  const auto edges = renderer.true_verticals(pose, workspace);
  const cv::Mat image = renderer.render_ideal(std::span(&pose, 1), workspace);
  const sensors::OmniCamera& camera = world.camera->camera;
  const auto grey = [&](double azimuth, double radius) {
    const Eigen::Vector2d p = camera.center_px + radius * camera.image_direction(azimuth);
    return std::min(255.0F,
                    image.at<float>(static_cast<int>(std::lround(p.y())), static_cast<int>(std::lround(p.x()))));
  };
  int strong = 0;
  for (const TrueVertical& edge : edges) {
    if (edge.visible_share < 0.8 || edge.contrast < 15.0) continue;
    ++strong;
    double step = 0.0;
    for (int i = 0; i < 50; ++i) {
      const double radius = 80.0 + 3.0 * i, beside = 1.2 / radius;
      step += std::abs(grey(edge.azimuth_rad + beside, radius) - grey(edge.azimuth_rad - beside, radius)) / 50.0;
    }
    EXPECT_GT(step, 0.4 * edge.contrast) << edge.azimuth_rad;
  }
  EXPECT_GT(strong, 10);
}

}  // namespace
}  // namespace credo::sim
