// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/lanes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "geometry/pose.hpp"
#include "geometry/segment.hpp"
#include "sim/free_space.hpp"
#include "sim/passage.hpp"

namespace credo::sim {
namespace {

using geometry::Segment;
using Point = Eigen::Vector2d;

constexpr double kAlongLane_m = 0.25 * FreeSpace::kCell_m;

/// What a robot can reach, in a frame whose x axis is the lane through the start.
class LaneField {
 public:
  LaneField(const FreeSpace& space, const Lanes& lanes)
      : space_(&space), T_map_lanes_{lanes.start.x(), lanes.start.y(), lanes.heading_rad} {
    for (const Point& place : space.places()) extent_.extend(T_map_lanes_.inverse() * place);
  }

  /// The stretches of the lane at `offset_m`, in the order of x.
  [[nodiscard]] std::vector<Segment> stretches(double offset_m) const {
    std::vector<Segment> stretches;
    bool inside = false;
    const int steps = static_cast<int>(std::ceil((extent_.max().x() - extent_.min().x()) / kAlongLane_m));
    for (int i = 0; i <= steps; ++i) {
      const Point place = T_map_lanes_ * Point(extent_.min().x() + i * kAlongLane_m, offset_m);
      const bool was_inside = std::exchange(inside, space_->reaches(place));
      if (inside && !was_inside) stretches.push_back({place, place});
      if (inside) stretches.back().b = place;
    }
    return stretches;
  }

  /// Numbers of the first and the last lane; 0 is the one through the start.
  [[nodiscard]] int first_lane(double spacing_m) const { return static_cast<int>(extent_.min().y() / spacing_m); }
  [[nodiscard]] int last_lane(double spacing_m) const { return static_cast<int>(extent_.max().y() / spacing_m); }

 private:
  const FreeSpace* space_;
  geometry::Pose2 T_map_lanes_;
  Eigen::AlignedBox2d extent_;  ///< of what is reached
};

/// The part of the start's lane that lies before the robot, from the start on; the part behind it stays a stretch.
std::optional<Segment> take_start(const Lanes& lanes, std::vector<Segment>& stretches) {
  for (Segment& stretch : stretches) {
    if (geometry::distance(lanes.start, stretch) > kAlongLane_m) continue;
    return Segment{lanes.start, std::exchange(stretch.b, lanes.start)};
  }
  return std::nullopt;
}

[[noreturn]] void refuse_lanes(const World& world, const Lanes& lanes, const char* what) {
  std::ostringstream message;
  message << what << " [" << lanes.start.x() << ", " << lanes.start.y() << "], with a robot of radius "
          << world.robot_radius_m << " m and a margin of " << lanes.margin_m << " m";
  throw std::invalid_argument(message.str());
}

}  // namespace

std::vector<Waypoint> sweep_in_lanes(const World& world, const Lanes& lanes) {
  const FreeSpace space(world, {world.robot_radius_m + lanes.margin_m, height_of_robot(world)}, lanes.start);
  if (!space.reaches(lanes.start))
    refuse_lanes(world, lanes, "there is no room for the robot at the start of the lanes,");
  const LaneField field(space, lanes);
  std::vector<Segment> left;
  for (int lane = field.first_lane(lanes.spacing_m); lane <= field.last_lane(lanes.spacing_m); ++lane)
    for (const Segment& stretch : field.stretches(lane * lanes.spacing_m)) left.push_back(stretch);
  const std::optional<Segment> ahead = take_start(lanes, left);
  const double shortest_m = 0.5 * lanes.spacing_m;
  std::erase_if(left, [&](const Segment& stretch) { return stretch.length() < shortest_m; });
  if (left.empty() && !(ahead && ahead->length() >= shortest_m))
    refuse_lanes(world, lanes, "no lane fits into what the robot can reach from");

  std::vector<Waypoint> path{{.position = lanes.start}};
  if (ahead && ahead->length() >= kAlongLane_m) path.push_back({.position = ahead->b});
  while (!left.empty()) {
    std::vector<Point> ends;
    for (const Segment& stretch : left) ends.insert(ends.end(), {stretch.a, stretch.b});
    // Every stretch lies in what is reached.
    const auto [end, way] = space.nearest(path.back().position, ends).value();
    for (std::size_t i = 1; i < way.size(); ++i) path.push_back({.position = way[i]});
    const auto stretch = left.begin() + static_cast<std::ptrdiff_t>(end / 2);
    path.push_back({.position = end % 2 == 0 ? stretch->b : stretch->a});
    left.erase(stretch);
  }
  return path;
}

}  // namespace credo::sim
