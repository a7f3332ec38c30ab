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

constexpr double kStepsPerSigma = 16.0;
constexpr double kMostSigmas = 4.0;
constexpr std::size_t kHeadingBins = 180;  // of lines: 1 degree

double direction_angle(const Vector2d& v) { return std::atan2(v.y(), v.x()); }

bool near(const Pose2& a, const Pose2& b, double apart_m, double apart_rad) {
  return (a.translation() - b.translation()).squaredNorm() < apart_m * apart_m &&
         std::abs(geometry::angle_difference(a.theta, b.theta)) < apart_rad;
}

/// Keeps the `most` first ones in the order of `before`, which is total, so that what is kept does not depend on
/// chance.
template <class Item, class Before>
void keep_first(std::vector<Item>& items, std::size_t most, Before before) {
  const auto end = items.begin() + static_cast<std::ptrdiff_t>(std::min(most, items.size()));
  std::partial_sort(items.begin(), end, items.end(), before);
  items.erase(end, items.end());
}

/// The bin of a line's direction.
std::size_t bin_of(double line_angle) {
  const double turns = line_angle / std::numbers::pi;
  return static_cast<std::size_t>((turns - std::floor(turns)) * kHeadingBins) % kHeadingBins;
}

}  // namespace

GlobalSearch::GlobalSearch(const LandmarkMap& map, const DistanceField& field, const sensors::Rig& rig,
                           const GlobalSearchParams& params)
    : map_(&map), params_(params), plausibility_(map, field, rig, params.plausibility) {
  for (int i = 0; i <= static_cast<int>(kMostSigmas * kStepsPerSigma); ++i)
    on_plan_.push_back(plausibility_.on_plan(i / kStepsPerSigma));
  if (map.surfaces().empty()) return;
  low_ = high_ = map.surfaces().front().a;
  for (const geometry::Segment& wall : map.surfaces()) {
    low_ = low_.cwiseMin(wall.a).cwiseMin(wall.b);
    high_ = high_.cwiseMax(wall.a).cwiseMax(wall.b);
  }
}

Plausibility GlobalSearch::plausibility(const Scene& scene, const Pose2& pose) {
  plausibility_.look_at(scene);
  return plausibility_.at(pose);
}

PoseCandidate GlobalSearch::refine(const Scene& scene, const geometry::PoseEstimate& expected) {
  plausibility_.look_at(scene);
  const geometry::PoseEstimate refined = plausibility_.refine(expected);
  return {refined, plausibility_.at(refined.pose)};
}

const std::vector<PoseCandidate>& GlobalSearch::search(const Scene& scene) {
  candidates_.clear();
  plausibility_.look_at(scene);
  if (plausibility_.blind() || map_->surfaces().empty()) return candidates_;
  find_headings(scene);
  thin_beams();
  seeds_.clear();
  add_point_constellations(scene);
  add_wall_constellations(scene);
  bound_constellations();
  add_lattice();
  choose_seeds();
  judge_seeds();
  return candidates_;
}

/// The turns under which the directions of the walls seen are those of walls of the plan; all where few are seen.
void GlobalSearch::find_headings(const Scene& scene) {
  constexpr int kSmoothing = 3;  // bins to either side
  headings_.clear();
  std::array<double, kHeadingBins> plan{}, votes{};
  for (const WallLandmark& wall : map_->walls())
    for (int k = -kSmoothing; k <= kSmoothing; ++k)
      plan[(bin_of(direction_angle(wall.direction)) + kHeadingBins + static_cast<std::size_t>(k)) % kHeadingBins] +=
          wall.length_m * (1.0 - std::abs(k) / (kSmoothing + 1.0));
  double seen_m = 0.0;
  for (const Primitive& wall : scene.primitives) {
    if (wall.type != PrimitiveType::kWall) continue;
    const double weight = wall.existence.pignistic() * wall.extent.length();
    seen_m += weight;
    for (std::size_t shift = 0; shift < kHeadingBins; ++shift)
      votes[shift] += weight * plan[(bin_of(wall.line.angle) + shift) % kHeadingBins];
  }
  const double most = *std::max_element(votes.begin(), votes.end());
  walls_tell_heading_ = seen_m >= params_.least_walls_m && most > 0.0;
  if (!walls_tell_heading_) {
    const int count = static_cast<int>(std::ceil(geometry::kTurn / params_.heading_step_rad));
    for (int i = 0; i < count; ++i) headings_.push_back(geometry::wrap_angle(geometry::kTurn * i / count));
    return;
  }
  for (std::size_t shift = 0; shift < kHeadingBins; ++shift) {
    const double before = votes[(shift + kHeadingBins - 1) % kHeadingBins], after = votes[(shift + 1) % kHeadingBins];
    if (votes[shift] < params_.heading_share * most || votes[shift] < before || votes[shift] <= after) continue;
    const double heading = std::numbers::pi * static_cast<double>(shift) / kHeadingBins;
    headings_.push_back(geometry::wrap_angle(heading));
    headings_.push_back(geometry::wrap_angle(heading + std::numbers::pi));
  }
}

void GlobalSearch::thin_beams() {
  const std::size_t most = walls_tell_heading_ ? 48 : 24;
  const auto beams = plausibility_.beams();
  ends_.clear();
  for (std::size_t i = 0; i < most && i < beams.size(); ++i) {
    const ScenePlausibility::Beam& beam = beams[beams.size() > most ? i * beams.size() / most : i];
    ends_.push_back({beam.point, beam.range_m, kStepsPerSigma / beam.sigma_m});
  }
}

/// Prepares bound() for poses of a heading.
void GlobalSearch::turn_beams(double heading, const Cell& cell) {
  const Eigen::Matrix2d R = Pose2{0.0, 0.0, heading}.rotation();
  turned_.clear();
  for (const BeamEnd& end : ends_)
    turned_.push_back({R * end.point, cell.half_m + cell.half_rad * end.range_m, end.inverse_sigma});
}

/// What no pose of the cell about a position exceeds, as far as the thinned beams tell.
double GlobalSearch::bound(const Vector2d& position) const {
  double sum = 0.0;
  for (const BeamEnd& end : turned_) {
    const double nearest_m = plausibility_.field()(position + end.point) - end.range_m;
    const double step = nearest_m > 0.0 ? nearest_m * end.inverse_sigma : 0.0;
    sum += on_plan_[std::min(static_cast<std::size_t>(step), on_plan_.size() - 1)];
  }
  return sum * static_cast<double>(plausibility_.beams().size()) / static_cast<double>(turned_.size());
}

/// A corner, edge or mark that is one of the plan's, under each heading.
void GlobalSearch::add_point_constellations(const Scene& scene) {
  if (!walls_tell_heading_) return;
  for (const Primitive& seen : scene.primitives) {
    if (seen.type == PrimitiveType::kWall || seen.bearing_only) continue;
    if (seen.existence.pignistic() < params_.least_belief) continue;
    for (const double heading : headings_) {
      const Vector2d arm = Pose2{0.0, 0.0, heading}.rotation() * seen.position;
      for (const PointLandmark& point : map_->points()) {
        const Vector2d position = point.position - arm;
        if (map_->type_from(point, position) == seen.type) seeds_.push_back({{position.x(), position.y(), heading}});
      }
    }
  }
}

/// Two walls that are not parallel make a pose.
void GlobalSearch::add_wall_constellations(const Scene& scene) {
  walls_.clear();
  for (const Primitive& seen : scene.primitives)
    if (seen.type == PrimitiveType::kWall && seen.existence.pignistic() >= params_.least_belief)
      walls_.push_back(&seen);
  keep_first(walls_, static_cast<std::size_t>(params_.most_walls), [](const Primitive* a, const Primitive* b) {
    const double one = a->extent.length(), other = b->extent.length();
    return one != other ? one > other : a < b;
  });
  for (std::size_t i = 0; i < walls_.size(); ++i)
    for (std::size_t j = i + 1; j < walls_.size(); ++j)
      if (std::abs(geometry::cross(walls_[i]->line.direction(), walls_[j]->line.direction())) > params_.least_wall_sine)
        add_wall_pair(*walls_[i], *walls_[j]);
}

void GlobalSearch::add_wall_pair(const Primitive& first, const Primitive& second) {
  constexpr double kSameDirection_rad = 0.1;
  const double angle_between = second.line.angle - first.line.angle;
  const double first_m = first.extent.length() - params_.wall_excess_m;
  const double second_m = second.extent.length() - params_.wall_excess_m;
  for (const WallLandmark& one : map_->walls()) {
    if (one.length_m < first_m) continue;
    const double angle = direction_angle(one.direction);
    for (const WallLandmark& other : map_->walls()) {
      if (other.length_m < second_m) continue;
      const double off = geometry::wrap_line_angle(direction_angle(other.direction) - angle - angle_between);
      if (std::abs(off) > kSameDirection_rad) continue;
      for (const double turn : {0.0, std::numbers::pi}) {
        const double heading = geometry::wrap_angle(angle - first.line.angle + turn);
        const Eigen::Matrix2d R = Pose2{0.0, 0.0, heading}.rotation();
        Eigen::Matrix2d normals;
        normals << one.normal().transpose(), other.normal().transpose();
        const Vector2d offsets(one.normal().dot(one.extent.a - R * first.line.centroid),
                               other.normal().dot(other.extent.a - R * second.line.centroid));
        const Vector2d position = normals.inverse() * offsets;
        // What is seen of a wall lies on it.
        const double along = one.direction.dot(position + R * first.line.centroid - one.extent.a);
        const double along_other = other.direction.dot(position + R * second.line.centroid - other.extent.a);
        if (along < 0.0 || along > one.length_m || along_other < 0.0 || along_other > other.length_m) continue;
        seeds_.push_back({{position.x(), position.y(), heading}});
      }
    }
  }
}

void GlobalSearch::bound_constellations() {
  const Cell cell{0.5 * params_.seed_sigma_m, 0.5 * params_.wall_heading_sigma_rad};
  for (Seed& seed : seeds_) {
    turn_beams(seed.pose.theta, cell);
    seed.bound = bound(seed.pose.translation());
  }
}

void GlobalSearch::add_lattice() {
  const double half_rad = walls_tell_heading_ ? params_.wall_heading_sigma_rad : 0.5 * params_.heading_step_rad;
  double side_m = params_.coarsest_m;
  const auto cells = [&] { return ((high_ - low_) / side_m).array().ceil().prod(); };
  std::size_t coarser = 0;  // levels
  for (; cells() > params_.most_cells; ++coarser) side_m *= 2.0;
  const auto better = [](const Seed& a, const Seed& b) {
    if (a.bound != b.bound) return a.bound > b.bound;
    if (a.pose.theta != b.pose.theta) return a.pose.theta < b.pose.theta;
    return a.pose.y != b.pose.y ? a.pose.y < b.pose.y : a.pose.x < b.pose.x;
  };
  for (std::size_t level = 0; level < coarser + params_.most_nodes.size(); ++level, side_m *= 0.5) {
    level == 0 ? lay_cells(side_m, half_rad) : quarter_cells(side_m, half_rad);
    keep_first(nodes_, level < coarser ? params_.most_coarser_nodes : params_.most_nodes[level - coarser], better);
  }
  seeds_.insert(seeds_.end(), nodes_.begin(), nodes_.end());
}

/// Cells all over the plan, as far as one of their poses may be plausible.
void GlobalSearch::lay_cells(double side_m, double half_rad) {
  nodes_.clear();
  const auto steps = [&](double extent_m) { return static_cast<int>(std::ceil(extent_m / side_m)); };
  const int columns = steps(high_.x() - low_.x()), rows = steps(high_.y() - low_.y());
  for (const double heading : headings_) {
    turn_beams(heading, {side_m * std::numbers::sqrt2 / 2.0, half_rad});
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const Vector2d position = low_ + side_m * Vector2d(column + 0.5, row + 0.5);
        const double reached = bound(position);
        if (reached >= params_.least_log_ratio) nodes_.push_back({{position.x(), position.y(), heading}, reached});
      }
  }
}

/// Four cells of half the side in place of each. \param side_m  the new one
void GlobalSearch::quarter_cells(double side_m, double half_rad) {
  std::sort(nodes_.begin(), nodes_.end(), [](const Seed& a, const Seed& b) { return a.pose.theta < b.pose.theta; });
  children_.clear();
  double heading = std::numeric_limits<double>::quiet_NaN();
  for (const Seed& node : nodes_) {
    if (node.pose.theta != heading) {
      heading = node.pose.theta;
      turn_beams(heading, {side_m * std::numbers::sqrt2 / 2.0, half_rad});
    }
    for (const double dx : {-0.5, 0.5})
      for (const double dy : {-0.5, 0.5}) {
        const Vector2d position = node.pose.translation() + side_m * Vector2d(dx, dy);
        const double reached = bound(position);
        if (reached >= params_.least_log_ratio) children_.push_back({{position.x(), position.y(), heading}, reached});
      }
  }
  nodes_.swap(children_);
}

/// The best ones that are not the same place.
void GlobalSearch::choose_seeds() {
  constexpr std::size_t kMostCompared = 5000;
  keep_first(seeds_, kMostCompared, [](const Seed& a, const Seed& b) {
    if (a.bound != b.bound) return a.bound > b.bound;
    if (a.pose.theta != b.pose.theta) return a.pose.theta < b.pose.theta;
    return a.pose.y != b.pose.y ? a.pose.y < b.pose.y : a.pose.x < b.pose.x;
  });
  chosen_.clear();
  for (const Seed& seed : seeds_) {
    if (chosen_.size() >= params_.most_refined) return;
    const bool new_place = std::none_of(chosen_.begin(), chosen_.end(), [&](const Seed& other) {
      return near(seed.pose, other.pose, params_.seed_apart_m, params_.seed_apart_rad);
    });
    if (new_place) chosen_.push_back(seed);
  }
}

void GlobalSearch::judge_seeds() {
  const double position = params_.seed_sigma_m * params_.seed_sigma_m;
  const double turn = params_.seed_sigma_rad * params_.seed_sigma_rad;
  judged_.clear();
  for (const Seed& seed : chosen_) {
    const geometry::PoseEstimate refined =
        plausibility_.refine({seed.pose, Eigen::Vector3d(position, position, turn).asDiagonal()});
    judged_.push_back({refined, plausibility_.at(refined.pose)});
  }
  std::stable_sort(judged_.begin(), judged_.end(), [](const PoseCandidate& a, const PoseCandidate& b) {
    return a.plausibility.log_ratio > b.plausibility.log_ratio;
  });
  for (const PoseCandidate& candidate : judged_) {
    if (candidates_.size() >= params_.most_candidates) return;
    if (candidate.plausibility.log_ratio < judged_.front().plausibility.log_ratio - params_.depth) return;
    const bool new_place = std::none_of(candidates_.begin(), candidates_.end(), [&](const PoseCandidate& other) {
      return near(candidate.estimate.pose, other.estimate.pose, params_.apart_m, params_.apart_rad);
    });
    if (new_place) candidates_.push_back(candidate);
  }
}

}  // namespace credo::localization
