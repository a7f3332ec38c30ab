// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/landmark_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace credo::localization {
namespace {

using geometry::angle_difference;
using geometry::Segment;

constexpr double kPi = std::numbers::pi;

/// Disjoint sets over 0 .. n-1.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t i, std::size_t j) { parent_[std::max(find(i), find(j))] = std::min(find(i), find(j)); }

 private:
  std::vector<std::size_t> parent_;
};

/// A wall's end (or a wall that passes by) at a junction.
struct Arm {
  std::size_t wall = 0;
  double direction = 0.0;
};

struct Junction {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  std::vector<Arm> arms;
};

Eigen::Vector2d end_of(const std::vector<Segment>& walls, std::size_t end) {
  return end % 2 == 0 ? walls[end / 2].a : walls[end / 2].b;
}

double angle_of(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }

/// Wall ends within the tolerance of each other become one junction at their mean; the two ends of one wall never do.
/// \param junction_of_end  by end
std::vector<Junction> join_ends(const std::vector<Segment>& walls, const WallGrid& grid, double tolerance,
                                std::vector<int>& junction_of_end) {
  const std::size_t ends = 2 * walls.size();
  Groups groups(ends);
  std::vector<int> near;
  for (std::size_t i = 0; i < ends; ++i) {
    grid.list_near(end_of(walls, i), tolerance, near);
    for (const int wall : near)
      for (const std::size_t j : {2 * static_cast<std::size_t>(wall), 2 * static_cast<std::size_t>(wall) + 1})
        if (j > i && i / 2 != j / 2 && (end_of(walls, i) - end_of(walls, j)).norm() <= tolerance &&
            groups.find(i) != groups.find(j ^ 1U) && groups.find(i ^ 1U) != groups.find(j))
          groups.unite(i, j);
  }
  std::vector<std::size_t> junction_of(ends, ends);
  std::vector<Junction> junctions;
  for (std::size_t i = 0; i < ends; ++i) {
    std::size_t& junction = junction_of[groups.find(i)];
    if (junction == ends) {
      junction = junctions.size();
      junctions.emplace_back();
    }
    Junction& joined = junctions[junction];
    junction_of_end.push_back(static_cast<int>(junction));
    joined.arms.push_back({i / 2, angle_of(end_of(walls, i ^ 1U) - end_of(walls, i))});
    joined.position += (end_of(walls, i) - joined.position) / static_cast<double>(joined.arms.size());
  }
  return junctions;
}

/// An end that touches the interior of another wall joins it: the wall passes by with two arms.
void join_interiors(const std::vector<Segment>& walls, const WallGrid& grid, double tolerance,
                    std::vector<Junction>& junctions) {
  std::vector<int> near;
  for (Junction& junction : junctions) {
    grid.list_near(junction.position, tolerance, near);
    for (const int index : near) {
      const auto w = static_cast<std::size_t>(index);
      const bool ends_here =
          std::any_of(junction.arms.begin(), junction.arms.end(), [w](const Arm& arm) { return arm.wall == w; });
      if (ends_here || geometry::distance(junction.position, walls[w]) > tolerance) continue;
      const double along = (junction.position - walls[w].a).dot(walls[w].direction());
      if (along <= tolerance || along >= walls[w].length() - tolerance) continue;
      const double direction = angle_of(walls[w].b - walls[w].a);
      junction.arms.push_back({w, direction});
      junction.arms.push_back({w, geometry::wrap_angle(direction + kPi)});
    }
  }
}

/// Walls that go straight on at a junction are one.
Groups join_collinear(const std::vector<Segment>& walls, const std::vector<Junction>& junctions, double max_turn) {
  Groups groups(walls.size());
  for (const Junction& junction : junctions)
    for (std::size_t i = 0; i < junction.arms.size(); ++i)
      for (std::size_t j = i + 1; j < junction.arms.size(); ++j) {
        const double turn = std::abs(angle_difference(junction.arms[i].direction + kPi, junction.arms[j].direction));
        if (turn < max_turn) groups.unite(junction.arms[i].wall, junction.arms[j].wall);
      }
  return groups;
}

struct WallEnd {
  Eigen::Vector2d position;
  int junction = 0;
};

/// Of the least-squares line through the ends, at `along` from extent.a: the end at t_i moves it by
/// 1/n + (along - t)(t_i - t) / sum((t_i - t)^2), t being the mean. Ends in one junction move together.
void add_plan_terms(const std::vector<WallEnd>& ends, WallLandmark& wall) {
  const double n = static_cast<double>(ends.size());
  const auto along = [&wall](const WallEnd& end) { return (end.position - wall.extent.a).dot(wall.direction); };
  double mean = 0.0, spread = 0.0;
  for (const WallEnd& end : ends) mean += along(end) / n;
  for (const WallEnd& end : ends) spread += (along(end) - mean) * (along(end) - mean);
  for (const WallEnd& end : ends) {
    const double slope = (along(end) - mean) / spread;
    const double offset = 1.0 / n - mean * slope;
    const auto known = std::find_if(wall.plan_terms.begin(), wall.plan_terms.end(),
                                    [&end](const PlanTerm& term) { return term.junction == end.junction; });
    if (known == wall.plan_terms.end()) {
      wall.plan_terms.push_back({end.junction, offset, slope});
    } else {
      known->offset += offset;
      known->slope += slope;
    }
  }
}

/// The line through all the ends (total least squares) between the outermost of them.
WallLandmark wall_through(const std::vector<WallEnd>& ends) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const WallEnd& end : ends) mean += end.position / static_cast<double>(ends.size());
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const WallEnd& end : ends) {
    const Eigen::Vector2d d = end.position - mean;
    xx += d.x() * d.x(), xy += d.x() * d.y(), yy += d.y() * d.y();
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  WallLandmark wall;
  wall.direction = {std::cos(angle), std::sin(angle)};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const WallEnd& end : ends) {
    low = std::min(low, (end.position - mean).dot(wall.direction));
    high = std::max(high, (end.position - mean).dot(wall.direction));
  }
  wall.extent = {mean + low * wall.direction, mean + high * wall.direction};
  wall.length_m = high - low;
  add_plan_terms(ends, wall);
  return wall;
}

/// How far the ends of a group stray from one line. [m]
double straightness(const WallLandmark& wall, const std::vector<WallEnd>& ends) {
  double worst = 0.0;
  for (const WallEnd& end : ends) worst = std::max(worst, std::abs((end.position - wall.extent.a).dot(wall.normal())));
  return worst;
}

/// The plan's walls that have a length.
std::vector<Segment> surfaces_of(const geometry::FloorPlan& plan) {
  std::vector<Segment> surfaces;
  for (const Segment& wall : plan.walls)
    if (wall.length() > 0.0) surfaces.push_back(wall);
  return surfaces;
}

/// Walls by the wall that they are a part of; of the others' groups none.
std::vector<std::vector<std::size_t>> members(Groups& groups, std::size_t walls) {
  std::vector<std::vector<std::size_t>> parts(walls);
  for (std::size_t w = 0; w < walls; ++w) parts[groups.find(w)].push_back(w);
  std::erase_if(parts, [](const std::vector<std::size_t>& part) { return part.empty(); });
  return parts;
}

}  // namespace

Eigen::Matrix2d WallLandmark::plan_covariance(double along_m, double uncertainty_m) const {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const PlanTerm& term : plan_terms) {
    const Eigen::Vector2d moved(term.offset + term.slope * along_m, term.slope);
    sum += moved * moved.transpose();
  }
  return uncertainty_m * uncertainty_m * sum;
}

LandmarkMap::LandmarkMap(const geometry::FloorPlan& plan, const LandmarkMapParams& params)
    : params_(params), uncertainty_m_(plan.uncertainty_m), surfaces_(surfaces_of(plan)), grid_(surfaces_) {
  const double tolerance = std::max(params.join_tolerance_m, 3.0 * plan.uncertainty_m);
  std::vector<int> junction_of_end;
  std::vector<Junction> junctions = join_ends(surfaces_, grid_, tolerance, junction_of_end);
  join_interiors(surfaces_, grid_, tolerance, junctions);

  Groups groups = join_collinear(surfaces_, junctions, params.max_collinear_turn_rad);
  for (const std::vector<std::size_t>& parts : members(groups, surfaces_.size())) {
    std::vector<WallEnd> ends;  // two by two
    for (const std::size_t part : parts)
      for (const std::size_t end : {2 * part, 2 * part + 1})
        ends.push_back({end_of(surfaces_, end), junction_of_end[end]});
    const WallLandmark whole = wall_through(ends);
    const bool straight = straightness(whole, ends) <= tolerance;
    const auto keep = [&](const WallLandmark& wall) {
      if (wall.length_m >= params_.min_wall_length_m) walls_.push_back(wall);
    };
    if (straight)
      keep(whole);
    else
      for (std::size_t i = 0; i < ends.size(); i += 2) keep(wall_through({ends[i], ends[i + 1]}));
  }

  for (const Junction& junction : junctions) {
    PointLandmark point{.position = junction.position, .vertical = false, .arms = {}, .plan_term = {}};
    for (const Arm& arm : junction.arms) point.arms.push_back(arm.direction);
    std::sort(point.arms.begin(), point.arms.end());
    point.plan_term.junction = junction_count();
    points_.push_back(point);
  }
  for (const Eigen::Vector2d& vertical : plan.verticals)
    points_.push_back({.position = vertical, .vertical = true, .arms = {}, .plan_term = {junction_count()}});
  if (params.cut_walls_at_points) cut_walls_at_points(tolerance);
}

void LandmarkMap::cut_walls_at_points(double tolerance) {
  std::vector<WallLandmark> pieces;
  std::vector<double> cuts;
  for (const WallLandmark& wall : walls_) {
    cuts = {0.0, wall.length_m};
    for (const PointLandmark& point : points_) {
      const double along = (point.position - wall.extent.a).dot(wall.direction);
      const bool on_it = geometry::distance(point.position, wall.extent) <= tolerance;
      if (on_it && along > 0.0 && along < wall.length_m) cuts.push_back(along);
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      if (cuts[i] - cuts[i - 1] < params_.min_wall_length_m) continue;
      WallLandmark piece = wall;
      piece.extent = {wall.extent.a + cuts[i - 1] * wall.direction, wall.extent.a + cuts[i] * wall.direction};
      piece.length_m = cuts[i] - cuts[i - 1];
      for (PlanTerm& term : piece.plan_terms) term.offset += term.slope * cuts[i - 1];
      pieces.push_back(piece);
    }
  }
  walls_ = std::move(pieces);
}

std::optional<perception::PrimitiveType> LandmarkMap::type_from(const PointLandmark& point,
                                                                const Eigen::Vector2d& viewpoint) const {
  if (point.vertical) return perception::PrimitiveType::kOther;
  if (point.arms.size() == 1) return perception::PrimitiveType::kEdge;
  const double to_viewer = angle_of(viewpoint - point.position);
  for (std::size_t i = 0; i < point.arms.size(); ++i) {
    const double from = point.arms[i];
    const double raw = point.arms[(i + 1) % point.arms.size()] - from;
    const double sector = raw <= 0.0 ? raw + 2.0 * kPi : raw;
    double offset = std::fmod(to_viewer - from, 2.0 * kPi);
    if (offset < 0.0) offset += 2.0 * kPi;
    if (offset > sector) continue;
    const double solid = 2.0 * kPi - sector;
    if (sector >= params_.min_corner_angle_rad && sector <= params_.max_corner_angle_rad)
      return perception::PrimitiveType::kCorner;
    if (solid >= params_.min_corner_angle_rad && solid <= params_.max_corner_angle_rad)
      return perception::PrimitiveType::kEdge;
    return std::nullopt;
  }
  return std::nullopt;
}

bool LandmarkMap::sees(const Eigen::Vector2d& viewpoint, const Eigen::Vector2d& target, double margin_m) const {
  const Eigen::Vector2d way = target - viewpoint;
  const double reach = way.norm() - margin_m;
  if (reach <= 0.0) return true;
  return !grid_.any_crossing(viewpoint, way.normalized(), reach);
}

}  // namespace credo::localization
