// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/scan_beams.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "grids/instructions.hpp"
#include "mapping/evidence_levels.hpp"
#include "mapping/resolution_fit.hpp"

namespace credo::mapping {
namespace {

using geometry::Pose2;

constexpr int kPathKnots = 16;  // poses along a scan, between which the motion is taken as even
// What is closer may change its order by rounding.
constexpr double kLeastAngle = 1e-4;  // [rad]
constexpr double kLeastCells = 1e-3;
constexpr double kRounding = 1e-9;
constexpr double kWallHalfCells =
    0.55;  // to either side of a surface: half a cell, and a bit for one on a border of cells
// Of half a sector, where a nearer thing hides it: its edge is as likely in one place between the beams as in another,
// so what is left is hidden with 5 percent at most.
constexpr double kSeenShare = 0.1;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The greatest of some lengths, 0 if there is none; eight at a time.
double greatest(const std::vector<double>& lengths) {
  std::array<double, 8> most{};
  std::size_t i = 0;
  for (; i + most.size() <= lengths.size(); i += most.size())
    for (std::size_t k = 0; k < most.size(); ++k) most[k] = most[k] > lengths[i + k] ? most[k] : lengths[i + k];
  for (; i < lengths.size(); ++i) most[0] = std::max(most[0], lengths[i]);
  return std::ranges::max(most);
}

void require(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument("range finder: " + message);
}

void check(const sensors::RangeFinder& finder, const grids::Georeference& georeference, const ScanParams& params) {
  require(finder.count > 0, "count must be above 0, not " + std::to_string(finder.count));
  require(std::isfinite(finder.angle_min_rad) && std::isfinite(finder.angle_increment_rad) &&
              finder.angle_increment_rad != 0.0 && std::abs(finder.angle_increment_rad) < 0.5 * std::numbers::pi,
          "angle_increment must be finite, not 0 and below pi/2");
  require(finder.range_min_m >= 0.0 && finder.range_max_m > finder.range_min_m && std::isfinite(finder.range_max_m),
          "range_max must be finite and above range_min");
  require(params.max_range_m > 0.0 && params.no_return_range_m >= 0.0, "ranges of the mapping must not be negative");
  require(params.no_return_reliability >= 0.0 && params.no_return_reliability <= 1.0,
          "no_return_reliability must be in [0, 1]");
  require(params.min_incidence_rad > 0.0 && params.max_half_sector_rad > 0.0,
          "min_incidence_rad and max_half_sector_rad must be above 0");
  const double reach_m = std::min(finder.range_max_m, params.max_range_m);
  require_resolution_fits(georeference.resolution_m, reach_m, "range finder");
}

}  // namespace

ScanBeams::ScanBeams(const sensors::RangeFinder& range_finder, const grids::Georeference& georeference,
                     LaserTables tables, const ScanParams& params)
    : range_finder_(range_finder), georeference_(georeference), tables_(std::move(tables)), params_(params) {
  check(range_finder, georeference, params);
  const double half = 0.5 * std::abs(range_finder.angle_increment_rad);
  touching_ = half <= params.max_half_sector_rad;
  all_round_ = touching_ && std::abs(2.0 * half * range_finder.count - 2.0 * std::numbers::pi) < kRounding;
  const double half_sector_rad =
      std::copysign(std::min(half, params.max_half_sector_rad), range_finder.angle_increment_rad);
  half_sector_cos_ = std::cos(half_sector_rad);
  half_sector_sin_ = std::sin(half_sector_rad);
  hidden_cos_ = std::cos(kSeenShare * half_sector_rad);
  hidden_sin_ = std::sin(kSeenShare * half_sector_rad);
  cells_per_metre_ = 1.0 / georeference.resolution_m;
  for (int beam = 0; beam < range_finder.count; ++beam) {
    const double angle = range_finder.beam_angle(beam);
    sensor_x_.push_back(std::cos(angle));
    sensor_y_.push_back(std::sin(angle));
  }
  const auto count = static_cast<std::size_t>(range_finder.count);
  for (std::vector<double>* values :
       {&origin_x_,      &origin_y_, &direction_x_, &direction_y_,   &range_m_,      &sine_before_, &sine_after_,
        &free_.length_m, &free_.x,   &free_.y,      &near_.length_m, &near_.x,       &near_.y,      &far_.length_m,
        &far_.x,         &far_.y,    &echo_,        &margin_m_,      &half_width_m_, &hit_share_})
    values->resize(count);
  free_level_.resize(count);
  hit_level_.resize(count);
}

/// What the readings are, and what the laser's tables hold for each.
ScanBeams::Counts ScanBeams::look_up(std::span<const float> ranges_m) {
  const double least_m = range_finder_.range_min_m, most_m = range_finder_.range_max_m;
  Counts counts;
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    const double reading_m = ranges_m[i];
    const bool echo = (reading_m >= least_m) & (reading_m <= most_m);
    counts.echoes += echo;
    counts.no_returns += reading_m == kInfinity;
    counts.missing += reading_m != reading_m;
    const double range_m = echo ? reading_m : 0.0;
    const auto bin = static_cast<std::size_t>(range_m * tables_.bins_per_metre);
    echo_[i] = echo ? 1.0 : 0.0;
    range_m_[i] = range_m;
    margin_m_[i] = tables_.free_margin_m[bin];
    half_width_m_[i] = tables_.half_width_m[bin];
    hit_share_[i] = tables_.hit_share[bin];
  }
  counts.out_of_range = static_cast<int>(ranges_m.size()) - counts.echoes - counts.no_returns - counts.missing;
  return counts;
}

/// What every beam says, and how strongly. As all loops over the beams without a branch, and told (`ivdep`) that the
/// arrays do not overlap, so that it is vectorised.
ScanBeams::Counts ScanBeams::classify(std::span<const float> ranges_m, const PoseReliability& reliability) {
  const Counts counts = look_up(ranges_m);
  const double reach_m = std::min(params_.max_range_m, range_finder_.range_max_m);
  const double max_range_m = params_.max_range_m;
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::size_t i = 0; i < range_m_.size(); ++i) {
          const double echo = echo_[i], range_m = range_m_[i], half_width_m = half_width_m_[i];
          const double trust = reliability.at(std::min(range_m, reach_m));
          const double in_reach = range_m <= max_range_m ? echo : 0.0;
          free_level_[i] = level_of(echo * trust);
          hit_level_[i] = level_of(in_reach * trust * hit_share_[i]);
          free_.length_m[i] = echo * std::min(std::max(0.0, range_m - margin_m_[i]), reach_m);
          near_.length_m[i] = echo * std::max(0.0, range_m - half_width_m);
          far_.length_m[i] = echo * (range_m + half_width_m);
        }
      });
  if (counts.no_returns > 0) classify_no_returns(ranges_m, reliability);
  return counts;
}

/// Beams that nothing came back from; few in most scans.
void ScanBeams::classify_no_returns(std::span<const float> ranges_m, const PoseReliability& reliability) {
  const double free_m = std::min({params_.no_return_range_m, params_.max_range_m, range_finder_.range_max_m});
  const int free = level_of(tables_.no_return_reliability * reliability.at(free_m));
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    if (ranges_m[i] != std::numeric_limits<float>::infinity()) continue;
    free_level_[i] = free;
    free_.length_m[i] = free_m;
  }
}

/// Beams [begin, end) are taken from one pose.
void ScanBeams::set_pose(std::size_t begin, std::size_t end, const Pose2& sensor) {
  const double c = std::cos(sensor.theta), s = std::sin(sensor.theta);
  const double x = (sensor.x - georeference_.origin_x_m) / georeference_.resolution_m;
  const double y = (sensor.y - georeference_.origin_y_m) / georeference_.resolution_m;
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::size_t i = begin; i < end; ++i) {
          origin_x_[i] = x;
          origin_y_[i] = y;
          direction_x_[i] = c * sensor_x_[i] - s * sensor_y_[i];
          direction_y_[i] = s * sensor_x_[i] + c * sensor_y_[i];
        }
      });
}

/// Origins and directions of the beams, each when it was taken.
/// \return how far the sensor comes from where it is at `time` [m]
double ScanBeams::place(const Pose2& T_map_base, const sensors::MotionPath& path, sensors::Timestamp time) {
  const auto sensor_at = [&](double seconds) {
    const Pose2 T_map_now = T_map_base * path.motion(time, time + sensors::from_seconds(seconds));
    return T_map_now * range_finder_.T_base_sensor;
  };
  const Pose2 here = T_map_base * range_finder_.T_base_sensor;
  const int count = range_finder_.count;
  moving_ = !path.empty() && range_finder_.scan_time_s != 0.0;
  if (!moving_) {
    set_pose(0, static_cast<std::size_t>(count), here);
    return 0.0;
  }
  int next = 0;
  double moved_m = 0.0;
  Pose2 from = sensor_at(range_finder_.beam_time(0));
  for (int knot = 1; knot <= kPathKnots; ++knot) {
    const int begin = next, end = knot * count / kPathKnots;
    if (end <= begin) continue;
    const Pose2 to = sensor_at(range_finder_.beam_time(end));
    for (; next < end; ++next) {
      const Pose2 sensor = geometry::interpolate(from, to, static_cast<double>(next - begin) / (end - begin));
      set_pose(next, next + 1, sensor);
      moved_m = std::max(moved_m, (sensor.translation() - here.translation()).norm());
    }
    from = to;
  }
  return moved_m;
}

/// Which neighbours hit one surface.
void ScanBeams::join() {
  const double min_sine = std::sin(params_.min_incidence_rad);
  const double resolution = georeference_.resolution_m;
  const std::size_t count = range_m_.size();
  sine_before_.front() = sine_after_.back() = 0.0;
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::size_t i = 0; i + 1 < count; ++i) {
          const double along_x = range_m_[i + 1] * direction_x_[i + 1] - range_m_[i] * direction_x_[i] +
                                 (origin_x_[i + 1] - origin_x_[i]) * resolution;
          const double along_y = range_m_[i + 1] * direction_y_[i + 1] - range_m_[i] * direction_y_[i] +
                                 (origin_y_[i + 1] - origin_y_[i]) * resolution;
          const double length = std::sqrt(along_x * along_x + along_y * along_y);
          const double across = std::abs(direction_x_[i] * along_y - direction_y_[i] * along_x);
          const double across_next = std::abs(direction_x_[i + 1] * along_y - direction_y_[i + 1] * along_x);
          const bool joined =
              (hit_level_[i] > 0) & (hit_level_[i + 1] > 0) & (length > 0.0) & (across >= min_sine * length);
          const double divisor = joined ? length : 1.0;
          sine_after_[i] = joined ? across / divisor : 0.0;
          sine_before_[i + 1] = joined ? std::max(min_sine, across_next / divisor) : 0.0;
        }
      });
}

/// Where a surface is met at a grazing angle, the occupied part is widened so that every cell that the surface passes
/// through has its centre in it: about half a cell to either side of the surface.
void ScanBeams::widen() {
  const std::size_t count = range_m_.size();
  const double across_m = kWallHalfCells * georeference_.resolution_m;
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::size_t i = 0; i < count; ++i) {
          const double before = sine_before_[i], after = sine_after_[i];
          const double range_m = range_m_[i], free_m = free_.length_m[i], near_m = near_.length_m[i],
                       far_m = far_.length_m[i];
          const double sine = before > after ? before : after;  // of two surfaces, the one met more steeply
          const bool widened = (sine > 0.0) & ((far_m - range_m) * sine < across_m);
          const double half_m = across_m / (widened ? sine : 1.0);
          const double wide_near_m = std::max(0.0, range_m - half_m), wide_far_m = range_m + half_m;
          const double wide_free_m = std::min(free_m, wide_near_m);
          far_.length_m[i] = widened ? wide_far_m : far_m;
          near_.length_m[i] = widened ? wide_near_m : near_m;
          free_.length_m[i] = widened ? wide_free_m : free_m;
        }
      });
}

void ScanBeams::measure(Outline& outline) const {
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::size_t i = 0; i < outline.x.size(); ++i) {
          const double length = outline.length_m[i] * cells_per_metre_;
          outline.x[i] = origin_x_[i] + length * direction_x_[i];
          outline.y[i] = origin_y_[i] + length * direction_y_[i];
        }
      });
}

bool ScanBeams::shares_first_side(std::size_t beam) const {
  return sine_before_[beam] > 0.0 || (touching_ && (beam > 0 || (all_round_ && !moving_)));
}

/// Up to where all that a beam says begins: nothing of it is nearer.
double ScanBeams::first_end_m(std::size_t beam) const {
  const double free_m = free_.length_m[beam];
  return hit_level_[beam] > 0 ? std::min(free_m, near_.length_m[beam]) : free_m;
}

double ScanBeams::hidden_from_m(std::size_t beam, double turn) const {
  const std::size_t other = turn > 0.0 ? after(beam) : before(beam), first = turn > 0.0 ? beam : other;
  const bool are_neighbours = all_round_ || first + 1 < count();
  if (!are_neighbours || sine_after_[first] > 0.0 || hit_level_[other] == 0) return kInfinity;
  const double edge_m = far_.length_m[other];
  return first_end_m(beam) > edge_m + kLeastCells * georeference_.resolution_m ? edge_m : kInfinity;
}

ScanBeams::Point ScanBeams::beside(std::size_t beam, double length_m, double turn_cos, double turn_sin) const {
  const double length = length_m * cells_per_metre_;
  return {origin_x_[beam] + length * (turn_cos * direction_x_[beam] - turn_sin * direction_y_[beam]),
          origin_y_[beam] + length * (turn_sin * direction_x_[beam] + turn_cos * direction_y_[beam])};
}

ScanBeams::Point ScanBeams::side(std::size_t beam, double length_m, double turn) const {
  if (length_m > hidden_from_m(beam, turn)) return hidden_side(beam, length_m, turn);
  return beside(beam, length_m, half_sector_cos_, turn * half_sector_sin_);
}

ScanBeams::Point ScanBeams::hidden_side(std::size_t beam, double length_m, double turn) const {
  return beside(beam, length_m, hidden_cos_, turn * hidden_sin_);
}

ScanBeams::Point ScanBeams::end(std::size_t beam, const Outline& outline) const {
  if (sine_after_[beam] > 0.0)
    return {0.5 * (outline.x[beam] + outline.x[beam + 1]), 0.5 * (outline.y[beam] + outline.y[beam + 1])};
  return side(beam, outline.length_m[beam], 1.0);
}

ScanBeams::Point ScanBeams::start(std::size_t beam, const Outline& outline) const {
  if (sine_before_[beam] > 0.0) return end(beam - 1, outline);
  const double length_m = outline.length_m[beam];
  const bool is_common = shares_first_side(beam) && length_m <= hidden_from_m(beam, -1.0);
  return is_common ? side(before(beam), length_m, 1.0) : side(beam, length_m, -1.0);
}

/// How the outlines lie to each other: whether the occupied part begins as the free one ends, so that one outline will
/// do for both, and whether all regions lie side by side around one place, with outlines that are the same or apart.
void ScanBeams::compare_outlines() {
  const double least_m = kLeastCells * georeference_.resolution_m;
  int between = 0, close = 0;
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
        int some_between = 0, some_close = 0;
#pragma GCC ivdep
        for (std::size_t i = 0; i < range_m_.size(); ++i) {
          const double free_m = free_.length_m[i], near_m = near_.length_m[i], far_m = far_.length_m[i];
          const double hit = hit_level_[i], gap_m = near_m - free_m, thick_m = far_m - near_m;
          const double is_between = gap_m != 0.0 ? hit : 0.0;
          const double is_thin = (thick_m < least_m) | ((gap_m != 0.0) & (gap_m < least_m)) ? hit : 0.0;
          const double is_short = (free_m > 0.0) & (free_m < least_m) ? 1.0 : 0.0;
          some_between += static_cast<int>(is_between);
          some_close += static_cast<int>(is_thin + is_short);
        }
        between = some_between;
        close = some_close;
      });
  near_is_end_of_free_ = between == 0;
  const double increment = std::abs(range_finder_.angle_increment_rad), around = increment * range_finder_.count;
  const bool sides_apart =
      increment > kLeastAngle && (touching_ || increment - 2.0 * params_.max_half_sector_rad > kLeastAngle);
  apart_ = !moving_ && sides_apart && around <= 2.0 * std::numbers::pi + kRounding && close == 0;
}

ScanBeams::Counts ScanBeams::read(const Pose2& T_map_base, const PoseReliability& reliability,
                                  std::span<const float> ranges_m, const sensors::MotionPath& path,
                                  sensors::Timestamp time) {
  if (ranges_m.size() != range_m_.size())
    throw std::invalid_argument("a scan has " + std::to_string(ranges_m.size()) + " ranges, its range finder " +
                                std::to_string(range_m_.size()) + " beams");
  const Counts counts = classify(ranges_m, reliability);
  const double moved_m = place(T_map_base, path, time);
  if (!(moved_m <= std::max(range_finder_.range_max_m, 1.0)))
    throw std::out_of_range("the motion given with a scan carries the sensor " + std::to_string(moved_m) +
                            " m away within the scan: leave the motion out or correct it");
  join();
  widen();
  const double reach_m = std::max(greatest(free_.length_m), greatest(far_.length_m)) + moved_m;
  const Eigen::Vector2d here = T_map_base * range_finder_.T_base_sensor.translation();
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(reach_m + 2.0 * georeference_.resolution_m);
  static_cast<void>(georeference_.cell_at(here - margin));
  static_cast<void>(georeference_.cell_at(here + margin));
  compare_outlines();
  measure(free_);
  measure(far_);
  if (!near_is_end_of_free_) measure(near_);
  return counts;
}

}  // namespace credo::mapping
