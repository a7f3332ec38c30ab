// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/ego_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace credo::localization {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using geometry::PoseEstimate;
using perception::ScanLine;

/// How far a line of the scan lies beyond where a wall has been seen, along it; at most 0 where they overlap. [m]
double gap_between(const WallFilter& filter, const ScanLine& line, const FilteredWall& wall) {
  const double angle = filter.state()[wall.column + 1];
  const Vector2d along(std::cos(angle), std::sin(angle));
  const geometry::Pose2 pose = filter.pose().pose;
  const double a = along.dot(pose * line.extent.a - wall.anchor), b = along.dot(pose * line.extent.b - wall.anchor);
  return std::max(wall.low_m - std::max(a, b), std::min(a, b) - wall.high_m);
}

/// 1-sigma of the pose along a wall. [m]
double sigma_along(const WallFilter& filter, const FilteredWall& wall) {
  const double angle = filter.state()[wall.column + 1];
  const Vector2d along(std::cos(angle), std::sin(angle));
  return std::sqrt(along.dot(filter.pose().covariance.topLeftCorner<2, 2>() * along));
}

/// Squared Mahalanobis distance of a line of the scan from a wall.
double distance_squared(const WallFilter& filter, const ScanLine& line, const FilteredWall& wall) {
  const std::array<WallRow, 2> rows = WallFilter::rows(filter.state(), line, wall);
  const Eigen::Matrix2d S = filter.innovation_covariance(rows);
  const Vector2d residual(rows[0].residual, rows[1].residual);
  return residual.dot(S.inverse() * residual);
}

/// Whether two walls are pieces of one line.
bool on_one_line(const WallFilter& filter, const FilteredWall& a, const FilteredWall& b, double within_m) {
  const double angle = filter.state()[a.column + 1];
  const Vector2d normal(-std::sin(angle), std::cos(angle));
  return std::abs(normal.dot(b.anchor - a.anchor) + filter.state()[b.column] - filter.state()[a.column]) < within_m;
}

/// The lines with all that is to be allowed for.
std::vector<ScanLine> as_far_as_trusted(std::span<const ScanLine> seen, const EgoMotionParams& params) {
  std::vector<ScanLine> lines(seen.begin(), seen.end());
  for (ScanLine& line : lines) {
    line.line.sigma_across = std::hypot(line.line.sigma_across, params.min_sigma_across_m);
    line.line.sigma_angle = std::hypot(line.line.sigma_angle, params.min_sigma_angle_rad);
    for (std::optional<double>& sigma : line.end_sigma_m)
      if (sigma) sigma = std::hypot(*sigma, params.min_sigma_end_m);
  }
  return lines;
}

struct Found {
  std::optional<std::size_t> wall;
  double distance = 0.0;  ///< squared Mahalanobis distance
  bool ambiguous = false;
};

/// The wall that a line of the scan is.
Found find_wall(const WallFilter& filter, const ScanLine& line, const EgoMotionParams& params) {
  const std::vector<FilteredWall>& walls = filter.walls();
  Found found;
  double nearest = params.ambiguous_gate;
  std::vector<std::size_t> near;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (gap_between(filter, line, walls[w]) > params.apart_m + 3.0 * sigma_along(filter, walls[w])) continue;
    const double distance = distance_squared(filter, line, walls[w]);
    if (distance >= params.ambiguous_gate) continue;
    near.push_back(w);
    if (distance >= nearest) continue;
    nearest = distance;
    found.wall = w;
  }
  found.ambiguous = std::any_of(near.begin(), near.end(), [&](std::size_t w) {
    return !on_one_line(filter, walls[*found.wall], walls[w], params.same_line_m);
  });
  found.distance = nearest;
  if (nearest >= params.wall_gate) found.wall.reset();
  // Near a wall, and yet not on it: neither that wall for certain nor a new one.
  found.ambiguous = found.ambiguous || (!near.empty() && !found.wall);
  return found;
}

}  // namespace

EgoMotion::EgoMotion(const PoseEstimate& start, const EgoMotionParams& params,
                     const ConstantVelocityParams& constant_velocity)
    : params_(params), filter_(start, params.systematic), predictor_(constant_velocity) {}

void EgoMotion::restart(const PoseEstimate& pose) {
  filter_.restart(pose);
  time_.reset();
}

void EgoMotion::update(const perception::Scene& scene, const std::optional<PoseEstimate>& motion) {
  std::vector<ScanLine> lines;
  perception::scan_lines(scene, params_.lines, lines);
  update(scene.time, lines, motion, scene.carry_covariance);
}

void EgoMotion::update(sensors::Timestamp time, std::span<const ScanLine> seen,
                       const std::optional<PoseEstimate>& motion, const Matrix3d& carry_covariance) {
  const std::vector<ScanLine> trusted = as_far_as_trusted(seen, params_);
  const bool held_against_walls = !filter_.walls().empty() && !trusted.empty();
  // 1. Predict.
  if (time_)
    filter_.move(motion ? *motion : predictor_.predict(sensors::seconds_between(*time_, time)), motion.has_value());
  // 2. Match, and where that explains little, from other poses too.
  Matching matching = match(filter_, trusted);
  if (held_against_walls && matching.explained < params_.search_below)
    matching = search(trusted, motion ? params_.slip_turn_rad : params_.unforeseen_turn_rad, std::move(matching));

  // 3. Correct the pose; 4. walls that appeared, and belief.
  correct(matching, trusted, carry_covariance);
  matched_ = static_cast<int>(matching.matches.size());
  belief_ = held_against_walls ? params_.unexplained(1.0 - matching.explained) : evidence::BinaryMass::vacuous();
  const PoseEstimate latest = step();
  filter_.forget(std::hypot(latest.pose.x, latest.pose.y), params_.most_unseen_m, params_.most_walls);
  if (time_ && time > *time_) predictor_.add(latest.pose, sensors::seconds_between(*time_, time));
  time_ = time;
}

/// What a line says of a wall: across, in angle, and along it by ends that it has been seen to have.
std::vector<WallRow> EgoMotion::rows(const WallFilter& filter, const ScanLine& line, const FilteredWall& wall,
                                     double doubt) const {
  const std::array<WallRow, 2> across = WallFilter::rows(filter.state(), line, wall);
  std::vector<WallRow> rows(across.begin(), across.end());
  for (const int end : {0, 1}) {
    const auto e = static_cast<std::size_t>(end);
    if (!line.end_sigma_m[e] || wall.end_column[e] < 0) continue;
    const WallRow row = WallFilter::end_row(filter.state(), line, wall, end);
    if (row.residual * row.residual <= params_.end_gate * filter.innovation_covariance({&row, 1})(0, 0))
      rows.push_back(row);
  }
  for (WallRow& row : rows) row.variance *= doubt;
  return rows;
}

EgoMotion::Matching EgoMotion::match(const WallFilter& predicted, std::span<const ScanLine> lines) const {
  Matching result{.filter = predicted, .matches = {}, .appeared = {}};
  std::vector<std::size_t> open(lines.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  std::stable_sort(open.begin(), open.end(),
                   [lines](std::size_t a, std::size_t b) { return lines[a].support > lines[b].support; });
  double all = 0.0, explained = 0.0;
  for (const ScanLine& line : lines) all += line.support;
  // What is ambiguous now may not be once others have made the pose surer.
  for (bool progress = true; progress && !open.empty();) {
    progress = false;
    std::vector<std::size_t> undecided;
    result.appeared.clear();
    for (const std::size_t i : open) {
      const Found found = find_wall(result.filter, lines[i], params_);
      if (!found.wall || found.ambiguous) {
        (found.ambiguous ? undecided : result.appeared).push_back(i);
        continue;
      }
      const double doubt = 1.0 + found.distance / (params_.robust_scale * params_.robust_scale);
      const std::vector<WallRow> found_rows = rows(result.filter, lines[i], result.filter.walls()[*found.wall], doubt);
      result.filter.update(found_rows, result.filter.state(), Matrix3d::Zero());
      result.matches.push_back({i, *found.wall, doubt});
      explained += lines[i].support;
      progress = true;
    }
    undecided.insert(undecided.end(), result.appeared.begin(), result.appeared.end());
    std::sort(undecided.begin(), undecided.end(), [lines](std::size_t a, std::size_t b) {
      return lines[a].support != lines[b].support ? lines[a].support > lines[b].support : a < b;
    });
    open = std::move(undecided);
  }
  result.explained = all > 0.0 ? explained / all : 0.0;
  if (result.explained < params_.least_explained) {
    result.matches.clear();
    result.filter = predicted;
  }
  return result;
}

/// The matching that explains most from poses less certain than the predicted one, which then is as uncertain; `found`
/// where none explains much more. Small turns are tried first, and kept where larger ones explain no more.
EgoMotion::Matching EgoMotion::search(std::span<const ScanLine> lines, double most_turn, Matching found) {
  const double m = params_.search_sigma_m, step = params_.search_step_rad;
  const auto widened = [&](double sigma_rad) {
    WallFilter wide = filter_;
    wide.widen(Eigen::Vector3d(m * m, m * m, sigma_rad * sigma_rad).asDiagonal());
    return wide;
  };
  WallFilter wide = widened(0.5 * step);
  const double needed = std::max(params_.search_least, found.explained + params_.search_gain);
  bool better = false;
  for (int k = 0; k * step <= most_turn; ++k)
    for (const int sign : {1, -1}) {
      if (k == 0 && sign < 0) continue;
      wide.turn(sign * k * step);
      Matching tried = match(wide, lines);
      wide.turn(-sign * k * step);
      if (tried.explained < needed || tried.matches.size() < static_cast<std::size_t>(params_.search_walls) ||
          (better && tried.explained <= found.explained))
        continue;
      found = std::move(tried);
      better = true;
    }
  if (better) filter_ = widened(most_turn);
  return found;
}

/// All matches at once, linearised where they have led one by one.
void EgoMotion::correct(const Matching& matching, std::span<const ScanLine> lines, const Matrix3d& common) {
  std::vector<WallRow> all;
  for (const Match& match : matching.matches) {
    const std::vector<WallRow> some =
        rows(matching.filter, lines[match.line], matching.filter.walls()[match.wall], match.doubt);
    all.insert(all.end(), some.begin(), some.end());
  }
  filter_.update(all, matching.filter.state(), common);
  for (const Match& match : matching.matches) filter_.extend(match.wall, lines[match.line]);
  for (const std::size_t i : matching.appeared) filter_.add(lines[i], common);
}

}  // namespace credo::localization
