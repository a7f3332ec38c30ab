// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/scan_beams.hpp"

#include <algorithm>
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
constexpr double kLeastShare = 1e-6;  // of the reach of the beams: some steps of single precision
constexpr double kRounding = 1e-6;    // of a turn [rad]: angle_increment often comes in single precision
constexpr double kMostMetres = 1e9;
constexpr double kWallHalfCells =
    0.55;  // to either side of a surface: half a cell, and a bit for one on a border of cells
// Neighbours whose ranges differ by more than about a quarter are not on one surface, however wide they look apart.
constexpr double kIncidencePerIncrement = 4.0;
constexpr double kMostIncidence = 0.7;  // [rad] that sparse beams ask for
// Of half a sector, where a nearer thing hides it: its edge is as likely in one place between the beams as in another,
// so what is left is hidden with 5 percent at most.
constexpr double kSeenShare = 0.1;

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
  const double sector_rad = 2.0 * std::min(half, params.max_half_sector_rad), between_rad = 2.0 * half - sector_rad,
               behind_rad = 2.0 * std::numbers::pi - 2.0 * half * (range_finder.count - 1) - sector_rad;
  sides_apart_ =
      2.0 * half > kLeastAngle && (touching_ || between_rad > kLeastAngle) && (all_round_ || behind_rad > kLeastAngle);
  const double half_sector_rad =
      std::copysign(std::min(half, params.max_half_sector_rad), range_finder.angle_increment_rad);
  half_sector_ = {static_cast<float>(std::cos(half_sector_rad)), static_cast<float>(std::sin(half_sector_rad))};
  hidden_sector_ = {static_cast<float>(std::cos(kSeenShare * half_sector_rad)),
                    static_cast<float>(std::sin(kSeenShare * half_sector_rad))};
  cells_per_metre_ = static_cast<float>(1.0 / georeference.resolution_m);
  const double sparse_rad = std::min(kIncidencePerIncrement * 2.0 * half, kMostIncidence);
  min_sine_ = static_cast<float>(std::sin(std::max(params.min_incidence_rad, sparse_rad)));
  const double widest_m = std::max(kWallHalfCells * georeference.resolution_m / double{min_sine_},
                                   double{std::ranges::max(tables_.half_width_m)});
  reach_m_ = std::min(range_finder.range_max_m, params.max_range_m) + widest_m + 2.0 * georeference.resolution_m;
  least_step_m_ = static_cast<float>(std::max(kLeastCells * georeference.resolution_m, kLeastShare * reach_m_));
  for (int beam = 0; beam < range_finder.count; ++beam) {
    const double angle = range_finder.beam_angle(beam);
    sensor_x_.push_back(static_cast<float>(std::cos(angle)));
    sensor_y_.push_back(static_cast<float>(std::sin(angle)));
  }
  const auto count = static_cast<std::size_t>(range_finder.count);
  for (std::vector<float>* values :
       {&origin_x_,      &origin_y_, &direction_x_, &direction_y_,   &range_m_,      &sine_before_, &sine_after_,
        &free_.length_m, &free_.x,   &free_.y,      &near_.length_m, &near_.x,       &near_.y,      &far_.length_m,
        &far_.x,         &far_.y,    &echo_,        &margin_m_,      &half_width_m_, &hit_share_})
    values->resize(count);
  free_level_.resize(count);
  hit_level_.resize(count);
  bin_.resize(count);
}

/// What the readings are, and what the laser's tables hold for each.
ScanBeams::Counts ScanBeams::look_up(std::span<const float> ranges_m) {
  const auto least_m = static_cast<float>(range_finder_.range_min_m),
             most_m = static_cast<float>(std::min(range_finder_.range_max_m, kMostMetres));
  const auto bins_per_metre = static_cast<float>(tables_.bins_per_metre);
  const float* const readings_m = ranges_m.data();
  int echoes = 0, no_returns = 0, missing = 0;
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
        int some_echoes = 0, some_no_returns = 0, some_missing = 0;
#pragma GCC ivdep
        for (std::size_t i = 0; i < range_m_.size(); ++i) {
          const float reading_m = readings_m[i];
          const bool echo = (reading_m >= least_m) & (reading_m <= most_m);
          some_echoes += echo ? 1 : 0;
          some_no_returns += reading_m == std::numeric_limits<float>::infinity() ? 1 : 0;
          some_missing += reading_m != reading_m ? 1 : 0;
          const float range_m = echo ? reading_m : 0.0F;
          echo_[i] = echo ? 1.0F : 0.0F;
          range_m_[i] = range_m;
          bin_[i] = static_cast<int>(range_m * bins_per_metre);
        }
        echoes = some_echoes;
        no_returns = some_no_returns;
        missing = some_missing;
      });
  for (std::size_t i = 0; i < bin_.size(); ++i) {
    const auto bin = static_cast<std::size_t>(bin_[i]);
    margin_m_[i] = tables_.free_margin_m[bin];
    half_width_m_[i] = tables_.half_width_m[bin];
    hit_share_[i] = tables_.hit_share[bin];
  }
  return {.echoes = echoes,
          .no_returns = no_returns,
          .missing = missing,
          .out_of_range = static_cast<int>(ranges_m.size()) - echoes - no_returns - missing};
}

/// What every beam says, and how strongly. As all loops over the beams without a branch, and told (`ivdep`) that the
/// arrays do not overlap, so that it is vectorised.
ScanBeams::Counts ScanBeams::classify(std::span<const float> ranges_m, const PoseReliability& reliability) {
  const Counts counts = look_up(ranges_m);
  const auto max_range_m = static_cast<float>(std::min(params_.max_range_m, kMostMetres));
  const float reach_m = std::min(max_range_m, static_cast<float>(std::min(range_finder_.range_max_m, kMostMetres)));
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::size_t i = 0; i < range_m_.size(); ++i) {
          const float echo = echo_[i], range_m = range_m_[i], half_width_m = half_width_m_[i];
          const float trust = reliability.at(std::min(range_m, reach_m));
          const float in_reach = range_m <= max_range_m ? echo : 0.0F;
          free_level_[i] = level_of(echo * trust);
          hit_level_[i] = level_of(in_reach * trust * hit_share_[i]);
          free_.length_m[i] = echo * std::min(std::max(0.0F, range_m - margin_m_[i]), reach_m);
          near_.length_m[i] = echo * std::max(0.0F, range_m - half_width_m);
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
    free_.length_m[i] = static_cast<float>(free_m);
  }
}

/// Beams [begin, end) are taken from one pose.
void ScanBeams::set_pose(std::size_t begin, std::size_t end, const Pose2& sensor) {
  const auto c = static_cast<float>(std::cos(sensor.theta)), s = static_cast<float>(std::sin(sensor.theta));
  const auto x = static_cast<float>((sensor.x - georeference_.origin_x_m) / georeference_.resolution_m - base_.x);
  const auto y = static_cast<float>((sensor.y - georeference_.origin_y_m) / georeference_.resolution_m - base_.y);
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
  const float min_sine = min_sine_;
  const auto resolution = static_cast<float>(georeference_.resolution_m);
  const std::size_t count = range_m_.size();
  sine_before_.front() = sine_after_.back() = 0.0F;
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::size_t i = 0; i + 1 < count; ++i) {
          const float along_x = range_m_[i + 1] * direction_x_[i + 1] - range_m_[i] * direction_x_[i] +
                                (origin_x_[i + 1] - origin_x_[i]) * resolution;
          const float along_y = range_m_[i + 1] * direction_y_[i + 1] - range_m_[i] * direction_y_[i] +
                                (origin_y_[i + 1] - origin_y_[i]) * resolution;
          const float length = std::sqrt(along_x * along_x + along_y * along_y);
          const float across = std::abs(direction_x_[i] * along_y - direction_y_[i] * along_x);
          const float across_next = std::abs(direction_x_[i + 1] * along_y - direction_y_[i + 1] * along_x);
          const bool joined =
              (hit_level_[i] > 0) & (hit_level_[i + 1] > 0) & (length > 0.0F) & (across >= min_sine * length);
          const float per_length = 1.0F / (joined ? length : 1.0F);
          sine_after_[i] = joined ? across * per_length : 0.0F;
          sine_before_[i + 1] = joined ? std::max(min_sine, across_next * per_length) : 0.0F;
        }
      });
}

/// Where a surface is met at a grazing angle, the occupied part is widened so that every cell that the surface passes
/// through has its centre in it: about half a cell to either side of the surface.
void ScanBeams::widen() {
  const std::size_t count = range_m_.size();
  const auto across_m = static_cast<float>(kWallHalfCells * georeference_.resolution_m);
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
#pragma GCC ivdep
        for (std::size_t i = 0; i < count; ++i) {
          const float before = sine_before_[i], after = sine_after_[i];
          const float range_m = range_m_[i], free_m = free_.length_m[i], near_m = near_.length_m[i],
                      far_m = far_.length_m[i];
          const float sine = before > after ? before : after;  // of two surfaces, the one met more steeply
          const bool widened = (sine > 0.0F) & ((far_m - range_m) * sine < across_m);
          const float half_m = across_m / (widened ? sine : 1.0F);
          const float wide_near_m = std::max(0.0F, range_m - half_m), wide_far_m = range_m + half_m;
          const float wide_free_m = std::min(free_m, wide_near_m);
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
          const float length = outline.length_m[i] * cells_per_metre_;
          outline.x[i] = origin_x_[i] + length * direction_x_[i];
          outline.y[i] = origin_y_[i] + length * direction_y_[i];
        }
      });
}

/// How the outlines lie to each other: whether the occupied part begins as the free one ends, so that one outline will
/// do for both, and whether all regions lie side by side around one place, with outlines that are the same or apart.
void ScanBeams::compare_outlines() {
  const float least_m = least_step_m_;
  int between = 0, close = 0;
  grids::run_with(
      grids::best_instructions(), [&]() __attribute__((always_inline)) {
        int some_between = 0, some_close = 0;
#pragma GCC ivdep
        for (std::size_t i = 0; i < range_m_.size(); ++i) {
          const float free_m = free_.length_m[i], near_m = near_.length_m[i], far_m = far_.length_m[i];
          const auto hit = static_cast<float>(hit_level_[i]);
          const float gap_m = near_m - free_m, thick_m = far_m - near_m;
          const float is_between = gap_m != 0.0F ? hit : 0.0F;
          const float is_thin = (thick_m < least_m) | ((gap_m != 0.0F) & (gap_m < least_m)) ? hit : 0.0F;
          const float is_short = (free_m > 0.0F) & (free_m < least_m) ? 1.0F : 0.0F;
          some_between += static_cast<int>(is_between);
          some_close += static_cast<int>(is_thin + is_short);
        }
        between = some_between;
        close = some_close;
      });
  near_is_end_of_free_ = between == 0;
  apart_ = !moving_ && sides_apart_ && close == 0;
}

ScanBeams::Counts ScanBeams::read(const Pose2& T_map_base, const PoseReliability& reliability,
                                  std::span<const float> ranges_m, const sensors::MotionPath& path,
                                  sensors::Timestamp time) {
  if (ranges_m.size() != range_m_.size())
    throw std::invalid_argument("a scan has " + std::to_string(ranges_m.size()) + " ranges, its range finder " +
                                std::to_string(range_m_.size()) + " beams");
  const Counts counts = classify(ranges_m, reliability);
  const Eigen::Vector2d here = T_map_base * range_finder_.T_base_sensor.translation();
  base_ = georeference_.cell_at(here);
  const double moved_m = place(T_map_base, path, time);
  if (!(moved_m <= std::max(reach_m_, 1.0)))
    throw std::out_of_range("the motion given with a scan carries the sensor " + std::to_string(moved_m) +
                            " m away within the scan: leave the motion out or correct it");
  join();
  widen();
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(reach_m_ + moved_m);
  static_cast<void>(georeference_.cell_at(here - margin));
  static_cast<void>(georeference_.cell_at(here + margin));
  compare_outlines();
  measure(free_);
  measure(far_);
  if (!near_is_end_of_free_) measure(near_);
  return counts;
}

}  // namespace credo::mapping
