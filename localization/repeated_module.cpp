// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/repeated_module.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace credo::localization {
namespace {

using Eigen::Vector2d;

std::vector<geometry::Segment> extents_of(const std::vector<WallLandmark>& walls) {
  std::vector<geometry::Segment> extents;
  for (const WallLandmark& wall : walls) extents.push_back(wall.extent);
  return extents;
}

/// Indices of points by growing x.
std::vector<std::size_t> by_x(const std::vector<PointLandmark>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&points](std::size_t i, std::size_t j) { return points[i].position.x() < points[j].position.x(); });
  return order;
}

}  // namespace

RepeatedModules::RepeatedModules(const LandmarkMap& map, const IntegrityParams& slips,
                                 const RepeatedModuleParams& params)
    : map_(&map),
      slips_(slips),
      params_(params),
      tolerance_m_(std::max(params.tolerance_m, params.tolerance_sigmas * map.uncertainty_m())),
      walls_(extents_of(map.walls())) {
  const std::vector<PointLandmark>& points = map.points();
  const std::vector<std::size_t> order = by_x(points);
  const double reach = params.farthest_m + tolerance_m_;
  for (const PointLandmark& from : points) {
    begin_.push_back(ways_.size());
    const auto first = std::lower_bound(order.begin(), order.end(), from.position.x() - reach,
                                        [&points](std::size_t i, double x) { return points[i].position.x() < x; });
    for (auto to = first; to != order.end(); ++to) {
      const Vector2d shift = points[*to].position - from.position;
      if (shift.x() > reach) break;
      const double length = shift.norm();
      if (points[*to].vertical == from.vertical && length >= tolerance_m_ && length <= reach)
        ways_.push_back({shift, *to});
    }
  }
  begin_.push_back(ways_.size());
  constexpr std::size_t kUsual = 128;
  seen_points_.reserve(kUsual);
  seen_walls_.reserve(kUsual);
  near_.reserve(kUsual);
  shifts_.reserve(kUsual);
  aliases_.reserve(kUsual);
}

std::span<const RepeatedModules::Way> RepeatedModules::ways_from(std::size_t point) const {
  return {ways_.data() + begin_[point], ways_.data() + begin_[point + 1]};
}

/// The way that is nearest to a shift, and within the tolerance of it, to a point that looks like the one seen; null
/// where there is none.
const RepeatedModules::Way* RepeatedModules::way_near(const SeenPoint& seen, const Vector2d& shift,
                                                      double tolerance_m) const {
  const std::span<const Way> ways = ways_from(seen.point);
  const Way* nearest = nullptr;
  double least = tolerance_m * tolerance_m;
  auto way = std::lower_bound(ways.begin(), ways.end(), shift.x() - tolerance_m,
                              [](const Way& w, double x) { return w.shift.x() < x; });
  for (; way != ways.end() && way->shift.x() <= shift.x() + tolerance_m; ++way) {
    const double squared = (way->shift - shift).squaredNorm();
    if (squared > least || map_->type_from(map_->points()[way->to], viewpoint_ + shift) != seen.type) continue;
    least = squared;
    nearest = &*way;
  }
  return nearest;
}

/// Whether a wall of the plan stands where the wall would be seen after the shift.
bool RepeatedModules::stands(const SeenWall& seen, const Vector2d& shift) {
  const Vector2d place = seen.place + shift;
  if (geometry::distance(place, seen.wall->extent) <= tolerance_m_) return true;
  walls_.list_near(place, tolerance_m_, near_);
  return std::any_of(near_.begin(), near_.end(), [&](int index) {
    const WallLandmark& other = map_->walls()[static_cast<std::size_t>(index)];
    return std::abs(geometry::cross(other.direction, seen.wall->direction)) <= std::sin(params_.parallel_rad) &&
           geometry::distance(place, other.extent) <= tolerance_m_;
  });
}

/// Whether a point before this one has a way that is about the same.
bool RepeatedModules::proposed_before(std::size_t seed, const Vector2d& shift) const {
  return std::any_of(seen_points_.begin(), seen_points_.begin() + static_cast<std::ptrdiff_t>(seed),
                     [&](const SeenPoint& seen) { return way_near(seen, shift, 0.5 * tolerance_m_) != nullptr; });
}

/// The mean shift of the points that are there again; nothing where a wall is not, or more than `absent` points are
/// not.
std::optional<Vector2d> RepeatedModules::confirmed(const Vector2d& proposed, std::size_t absent) {
  for (const SeenWall& seen : seen_walls_)
    if (!stands(seen, proposed)) return std::nullopt;
  Vector2d sum = Vector2d::Zero();
  std::size_t missed = 0;
  for (const SeenPoint& seen : seen_points_) {
    if (const Way* way = way_near(seen, proposed, tolerance_m_))
      sum += way->shift;
    else if (++missed > absent)
      return std::nullopt;
  }
  return sum / static_cast<double>(seen_points_.size() - missed);
}

void RepeatedModules::list_seen(std::span<const Observation> observations, const PoseSolution& solution) {
  seen_points_.clear();
  seen_walls_.clear();
  const geometry::Pose2& T_map_base = solution.pose.pose;
  viewpoint_ = T_map_base.translation();
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Observation& o = observations[i];
    if (solution.outlier[i]) continue;
    if (map_->is_wall(o.landmark)) {
      const WallLandmark& wall = map_->wall(o.landmark);
      const double along = wall.direction.dot(T_map_base * o.base_point - wall.extent.a);
      seen_walls_.push_back({&wall, wall.extent.a + along * wall.direction});
    } else {
      const PointLandmark& point = map_->point(o.landmark);
      seen_points_.push_back(
          {static_cast<std::size_t>(&point - map_->points().data()), map_->type_from(point, viewpoint_)});
    }
  }
  const auto key = [this](const SeenPoint& seen) { return std::pair(ways_from(seen.point).size(), seen.point); };
  std::sort(seen_points_.begin(), seen_points_.end(),
            [&key](const SeenPoint& a, const SeenPoint& b) { return key(a) < key(b); });
  const auto same = [](const SeenPoint& a, const SeenPoint& b) { return a.point == b.point; };
  seen_points_.erase(std::unique(seen_points_.begin(), seen_points_.end(), same), seen_points_.end());
}

/// A shift that is not known yet.
void RepeatedModules::add(const Vector2d& shift) {
  const bool known = std::any_of(shifts_.begin(), shifts_.end(), [&](const Vector2d& other) {
    return (other - shift).squaredNorm() <= tolerance_m_ * tolerance_m_;
  });
  if (!known) shifts_.push_back(shift);
}

/// The wheels have slipped into the circle about the shifted pose from which it is found: the density of a normal
/// distribution of slip_m in both directions, at the shift, times the circle's area.
Alias RepeatedModules::alias_at(const Vector2d& shift) const {
  const double variance = slips_.slip_m * slips_.slip_m;
  const double inside = params_.capture_m * params_.capture_m / (2.0 * variance);
  const double there = std::min(1.0, inside * std::exp(-shift.squaredNorm() / (2.0 * variance)));
  const ProbabilityInterval& fault = slips_.prediction_fault;
  return {.distance_m = shift.norm(), .turn_rad = 0.0, .probability = {fault.low * there, fault.high * there}};
}

std::span<const Alias> RepeatedModules::find(std::span<const Observation> observations, const PoseSolution& solution) {
  list_seen(observations, solution);
  shifts_.clear();
  aliases_.clear();
  const std::size_t seen = seen_points_.size();
  const auto least = static_cast<std::size_t>(std::max(1, params_.least_points));
  if (seen < least) return aliases_;
  constexpr double kRounding = 1e-9;
  const double spared = (1.0 - params_.least_share) * static_cast<double>(seen) + kRounding;
  const std::size_t absent = std::min(seen - least, static_cast<std::size_t>(spared));
  // Of one point more than may be absent, one at least is there again: it proposes the shift.
  for (std::size_t seed = 0; seed <= absent; ++seed)
    for (const Way& way : ways_from(seen_points_[seed].point)) {
      const double length = way.shift.norm();
      if (length < 2.0 * tolerance_m_ || length > params_.farthest_m || proposed_before(seed, way.shift)) continue;
      if (const std::optional<Vector2d> shift = confirmed(way.shift, absent)) add(*shift);
    }
  for (const Vector2d& shift : shifts_) aliases_.push_back(alias_at(shift));
  std::sort(aliases_.begin(), aliases_.end(),
            [](const Alias& a, const Alias& b) { return a.distance_m < b.distance_m; });
  return aliases_;
}

}  // namespace credo::localization
