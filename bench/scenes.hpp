// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "geometry/pose.hpp"
#include "geometry/segment.hpp"

// Places that a robot may stand in, and what its instruments read there.
namespace credo::bench {

inline constexpr int kPoses = 16;

/// Walls in [0, width] x [0, height], and poses among them.
struct Scene {
  std::string name;
  double width_m = 0.0, height_m = 0.0;
  std::vector<geometry::Segment> walls;
  std::vector<geometry::Pose2> poses;
};

/// Distance to the nearest wall along the x axis of a pose; infinite where none is. [m]
[[nodiscard]] inline double distance_along(const Scene& scene, const geometry::Pose2& from) {
  const Eigen::Vector2d along(std::cos(from.theta), std::sin(from.theta));
  double nearest = std::numeric_limits<double>::infinity();
  for (const geometry::Segment& wall : scene.walls) {
    const Eigen::Vector2d span = wall.b - wall.a, offset = wall.a - from.translation();
    const double turn = geometry::cross(along, span);
    if (turn == 0.0) continue;
    const double distance = geometry::cross(offset, span) / turn, place = geometry::cross(offset, along) / turn;
    if (distance > 0.0 && place >= 0.0 && place <= 1.0) nearest = std::min(nearest, distance);
  }
  return nearest;
}

inline void add_box(Scene& scene, double x, double y, double width, double height) {
  const Eigen::Vector2d a(x, y), b(x + width, y), c(x + width, y + height), d(x, y + height);
  for (const geometry::Segment& wall : {geometry::Segment{a, b}, {b, c}, {c, d}, {d, a}}) scene.walls.push_back(wall);
}

/// A room with boxes of 0.2 to 0.8 m in it, and poses that stand clear of them.
/// \param boxes  fewer stand there where two poses would be shut in
[[nodiscard]] inline Scene room(std::string name, double width_m, double height_m, int boxes) {
  Scene scene{.name = std::move(name), .width_m = width_m, .height_m = height_m, .walls = {}, .poses = {}};
  add_box(scene, 0.0, 0.0, width_m, height_m);
  std::mt19937 random(17);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;  // the same with every library
  };
  for (int k = 0; k < kPoses; ++k)
    scene.poses.push_back({between(0.15, 0.85) * width_m, between(0.15, 0.85) * height_m, between(-3.14, 3.14)});
  for (int k = 0; k < boxes; ++k) {
    const double w = between(0.2, 0.8), h = between(0.2, 0.8);
    const double x = between(0.0, width_m - w), y = between(0.0, height_m - h);
    const bool clear = std::ranges::all_of(scene.poses, [&](const geometry::Pose2& pose) {
      const double across = std::abs(pose.x - x - 0.5 * w) - 0.5 * w, up = std::abs(pose.y - y - 0.5 * h) - 0.5 * h;
      return std::max(across, up) > 0.4;
    });
    if (clear) add_box(scene, x, y, w, h);
  }
  return scene;
}

/// Small to large, empty to cluttered.
[[nodiscard]] inline std::vector<Scene> scenes() {
  return {room("chamber 5x4 m", 5.0, 4.0, 0), room("room 12x8 m", 12.0, 8.0, 0),
          room("furnished 12x8 m", 12.0, 8.0, 24), room("corridor 30x2.4 m", 30.0, 2.4, 0),
          room("hall 30x20 m, 60 boxes", 30.0, 20.0, 60)};
}

}  // namespace credo::bench
