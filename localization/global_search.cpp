// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/global_search.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using geometry::Pose2;
using perception::Primitive;
using perception::PrimitiveType;
using perception::Scene;

using std::numbers::pi;

double direction_of(const Vector2d& v) { return std::atan2(v.y(), v.x()); }

/// Remainder in [0, pi).
double line_direction(double angle) {
  const double rest = std::fmod(angle, pi);
  return rest < 0.0 ? rest + pi : rest;
}

bool is_believed(const Primitive& primitive, const GlobalSearchParams& params) {
  return primitive.existence.pignistic() >= params.min_believed;
}

}  // namespace

GlobalSearch::GlobalSearch(const LandmarkMap& map, const DistanceField& field, const GlobalSearchParams& params)
    : map_(&map), field_(&field), params_(params) {
  if (map.surfaces().empty()) return;
  Vector2d low = map.surfaces().front().a, high = low;
  for (const geometry::Segment& wall : map.surfaces()) {
    low = low.cwiseMin(wall.a).cwiseMin(wall.b);
    high = high.cwiseMax(wall.a).cwiseMax(wall.b);
  }
  for (double y = low.y(); y <= high.y(); y += params.lattice_m)
    for (double x = low.x(); x <= high.x(); x += params.lattice_m)
      if (field({x, y}) >= params.nearest_wall_m) lattice_.emplace_back(x, y);
}

/// Every wall of the scene votes with every wall of the map for the heading between them, modulo pi; the weight is the
/// shorter of the two lengths.
void GlobalSearch::find_headings(const Scene& scene) {
  const int bins = std::max(1, static_cast<int>(std::lround(pi / params_.heading_bin_rad)));
  const double width = pi / bins;
  votes_.assign(static_cast<std::size_t>(bins), 0.0);
  headings_.clear();
  const auto bin = [&](int i) -> double& { return votes_[static_cast<std::size_t>((i % bins + bins) % bins)]; };
  for (const Primitive& seen : scene.primitives) {
    if (seen.type != PrimitiveType::kWall || !is_believed(seen, params_)) continue;
    for (const WallLandmark& wall : map_->walls()) {
      const double at = line_direction(direction_of(wall.direction) - seen.line.angle) / width - 0.5;
      const int first = static_cast<int>(std::floor(at));
      const double weight = std::min(seen.extent.length(), wall.length_m), share = at - first;
      bin(first) += (1.0 - share) * weight;
      bin(first + 1) += share * weight;
    }
  }
  const double most = *std::max_element(votes_.begin(), votes_.end());
  if (!(most > 0.0)) {
    for (double heading = -pi; heading < pi - 1e-9; heading += params_.heading_step_rad) headings_.push_back(heading);
    return;
  }
  for (int i = 0; i < bins; ++i) {
    const double here = bin(i), before = bin(i - 1), after = bin(i + 1);
    if (here < params_.heading_share * most || here < before || here <= after) continue;
    const double middle = (i + 0.5 + (after - before) / (before + here + after)) * width;
    headings_.push_back(geometry::wrap_angle(middle));
    headings_.push_back(geometry::wrap_angle(middle + pi));
  }
}

void GlobalSearch::choose_points(const Scene& scene) {
  const auto most = static_cast<std::size_t>(params_.points);
  const std::size_t every = std::max<std::size_t>(1, (scene.points.size() + most - 1) / most);
  points_.clear();
  for (std::size_t i = 0; i < scene.points.size(); i += every) points_.push_back(scene.points[i].position);
}

void GlobalSearch::turn_points(double heading) {
  const Eigen::Matrix2d R = Pose2{0.0, 0.0, heading}.rotation();
  turned_.clear();
  for (const Vector2d& point : points_) turned_.push_back(R * point);
}

/// From a place, with the heading that `turned_` has.
double GlobalSearch::score(const Vector2d& position) const {
  double sum = 0.0;
  for (const Vector2d& point : turned_) sum += DistanceField::kReach_m - (*field_)(position + point);
  return sum / (DistanceField::kReach_m * static_cast<double>(turned_.size()));
}

void GlobalSearch::consider(const Vector2d& position, double heading) {
  if ((*field_)(position) < params_.nearest_wall_m) return;
  const double found = score(position);
  best_ = std::max(best_, found);
  // What is a step of the lattice beside its place gains as much again when it is refined.
  if (found >= best_ - 3.0 * params_.worst_score) considered_.push_back({{position.x(), position.y(), heading}, found});
}

void GlobalSearch::try_constellations(const Scene& scene, double heading) {
  const Eigen::Matrix2d R = Pose2{0.0, 0.0, heading}.rotation();
  const std::vector<Primitive>& seen = scene.primitives;
  for (const Primitive& point : seen) {
    if (point.type == PrimitiveType::kWall || point.bearing_only || !is_believed(point, params_)) continue;
    for (const PointLandmark& landmark : map_->points()) {
      const Vector2d place = landmark.position - R * point.position;
      if (map_->type_from(landmark, place) == point.type) consider(place, heading);
    }
  }
  // Two walls: n_1 and n_2 in the map, and how far from them the robot is.
  constexpr double kParallel = 0.5;  // sine of the angle between two walls
  constexpr double kSameDirection_rad = 0.1;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i].type != PrimitiveType::kWall || !is_believed(seen[i], params_)) continue;
    for (std::size_t j = i + 1; j < seen.size(); ++j) {
      if (seen[j].type != PrimitiveType::kWall || !is_believed(seen[j], params_)) continue;
      if (std::abs(std::sin(seen[i].line.angle - seen[j].line.angle)) < kParallel) continue;
      for (const WallLandmark& first : map_->walls()) {
        if (std::abs(geometry::wrap_line_angle(seen[i].line.angle + heading - direction_of(first.direction))) >
            kSameDirection_rad)
          continue;
        for (const WallLandmark& second : map_->walls()) {
          if (std::abs(geometry::wrap_line_angle(seen[j].line.angle + heading - direction_of(second.direction))) >
              kSameDirection_rad)
            continue;
          Eigen::Matrix2d normals;
          normals << first.normal().transpose(), second.normal().transpose();
          const Vector2d offsets(first.normal().dot(first.extent.a - R * seen[i].line.centroid),
                                 second.normal().dot(second.extent.a - R * seen[j].line.centroid));
          consider(normals.inverse() * offsets, heading);
        }
      }
    }
  }
}

void GlobalSearch::try_lattice(double heading) {
  for (const Vector2d& place : lattice_) consider(place, heading);
}

/// Uphill in ever smaller steps of position and heading.
void GlobalSearch::refine(PoseCandidate& candidate) {
  for (double step = 0.5 * params_.lattice_m; step > 0.01; step *= 0.5) {
    const double turn = 0.14 * step;  // 1 degree at 12.5 cm
    const Pose2 centre = candidate.pose;
    for (const int k : {-1, 0, 1}) {
      const double heading = geometry::wrap_angle(centre.theta + k * turn);
      turn_points(heading);
      for (const int i : {-1, 0, 1})
        for (const int j : {-1, 0, 1}) {
          const Pose2 pose{centre.x + i * step, centre.y + j * step, heading};
          const double found = score(pose.translation());
          if (found > candidate.score) candidate = {pose, found};
        }
    }
  }
}

/// The best first; of those that are near each other the best one. Refined twice: roughly sorted before, and sorted
/// out after.
void GlobalSearch::keep_different() {
  const auto near = [&](const PoseCandidate& a, const PoseCandidate& b) {
    return (a.pose.translation() - b.pose.translation()).norm() < params_.apart_m &&
           std::abs(geometry::angle_difference(a.pose.theta, b.pose.theta)) < params_.apart_rad;
  };
  const auto better = [](const PoseCandidate& a, const PoseCandidate& b) { return a.score > b.score; };
  const auto sort_out = [&](std::size_t most) {
    std::stable_sort(considered_.begin(), considered_.end(), better);
    candidates_.clear();
    for (const PoseCandidate& one : considered_) {
      if (candidates_.size() >= most) break;
      if (std::none_of(candidates_.begin(), candidates_.end(), [&](const auto& kept) { return near(kept, one); }))
        candidates_.push_back(one);
    }
  };
  const auto most = static_cast<std::size_t>(params_.most);
  sort_out(5 * most);
  for (PoseCandidate& candidate : candidates_) refine(candidate);
  considered_ = candidates_;
  sort_out(most);
  const double least = candidates_.empty() ? 0.0 : candidates_.front().score - params_.worst_score;
  std::erase_if(candidates_, [least](const PoseCandidate& candidate) { return candidate.score < least; });
}

const std::vector<PoseCandidate>& GlobalSearch::search(const Scene& scene) {
  candidates_.clear();
  considered_.clear();
  best_ = 0.0;
  choose_points(scene);
  if (points_.empty() || lattice_.empty()) return candidates_;
  find_headings(scene);
  for (const double heading : headings_) {
    turn_points(heading);
    try_constellations(scene, heading);
    try_lattice(heading);
  }
  keep_different();
  return candidates_;
}

}  // namespace credo::localization
