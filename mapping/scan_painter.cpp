// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/scan_painter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "geometry/segment.hpp"
#include "mapping/resolution_fit.hpp"

namespace credo::mapping {
namespace {

using geometry::Pose2;

constexpr int kPathKnots = 16;  // poses along a scan, between which the motion is taken as even
constexpr double kWallHalfCells =
    0.55;  // to either side of a surface: half a cell, and a bit for one on a border of cells

int free_class(double reliability) { return level_of(reliability) - 1; }  // -1: none
int hit_class(double reliability) {
  const int level = level_of(reliability);
  return level > 0 ? kLevels + level - 1 : -1;
}

Eigen::Vector2d turned(const Eigen::Vector2d& v, double c, double s) {
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
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

ScanPainter::ScanPainter(const sensors::RangeFinder& range_finder, const grids::Georeference& georeference,
                         LaserTables tables, const ScanParams& params)
    : range_finder_(range_finder), georeference_(georeference), tables_(std::move(tables)), params_(params) {
  check(range_finder, georeference, params);
  const double half = 0.5 * std::abs(range_finder.angle_increment_rad);
  touching_ = half <= params.max_half_sector_rad;
  const double half_sector_rad =
      std::copysign(std::min(half, params.max_half_sector_rad), range_finder.angle_increment_rad);
  half_sector_ = {std::cos(half_sector_rad), std::sin(half_sector_rad)};
  cells_per_metre_ = 1.0 / georeference.resolution_m;
  for (int beam = 0; beam < range_finder.count; ++beam) {
    const double angle = range_finder.beam_angle(beam);
    directions_.emplace_back(std::cos(angle), std::sin(angle));
  }
  for (int level = 1; level <= kLevels; ++level) {
    increments_[level - 1] = tables_.free[level];
    increments_[kLevels + level - 1] = tables_.hit[level];
  }
  beams_.resize(range_finder.count);
}

/// What every beam says, and how strongly.
ScanPainter::Counts ScanPainter::classify(std::span<const float> ranges_m, const PoseReliability& reliability) {
  const double reach_m = std::min(params_.max_range_m, range_finder_.range_max_m);
  const double no_return_m = std::min(params_.no_return_range_m, reach_m);
  const int no_return_class = free_class(tables_.no_return_reliability * reliability.at(no_return_m));
  Counts counts;
  for (std::size_t i = 0; i < ranges_m.size(); ++i) {
    Beam& beam = beams_[i];
    const double range_m = ranges_m[i];
    beam.range_m = 0.0;
    beam.free_m = beam.near_m = beam.far_m = 0.0;
    beam.free_class = beam.hit_class = -1;
    if (std::isnan(range_m)) {
      ++counts.missing;
    } else if (std::isinf(range_m) && range_m > 0.0) {
      ++counts.no_returns;
      beam.free_m = no_return_m;
      beam.free_class = no_return_class;
    } else if (range_m < range_finder_.range_min_m || range_m > range_finder_.range_max_m) {
      ++counts.out_of_range;
    } else {
      ++counts.echoes;
      const auto bin = static_cast<std::size_t>(range_m * tables_.bins_per_metre);
      const double half_width_m = tables_.half_width_m[bin];
      const double trust = reliability.at(std::min(range_m, reach_m));
      beam.range_m = range_m;
      beam.free_class = free_class(trust);
      if (range_m <= params_.max_range_m) beam.hit_class = hit_class(trust * tables_.hit_share[bin]);
      beam.free_m = std::min(std::max(0.0, range_m - tables_.free_margin_m[bin]), reach_m);
      beam.near_m = std::max(0.0, range_m - half_width_m);
      beam.far_m = range_m + half_width_m;
    }
  }
  return counts;
}

/// Origins and directions of the beams, in cells, each when it was taken.
void ScanPainter::place(const Pose2& T_map_base, const sensors::MotionPath& path, sensors::Timestamp time) {
  const auto sensor_at = [&](double seconds) {
    const Pose2 T_map_now = T_map_base * path.motion(time, time + sensors::from_seconds(seconds));
    return T_map_now * range_finder_.T_base_sensor;
  };
  const auto set = [this](Beam& beam, const Pose2& sensor, double c, double s, const Eigen::Vector2d& direction) {
    beam.origin = {(sensor.x - georeference_.origin_x_m) / georeference_.resolution_m,
                   (sensor.y - georeference_.origin_y_m) / georeference_.resolution_m};
    beam.direction = turned(direction, c, s);
  };
  const int count = range_finder_.count;
  if (path.empty() || range_finder_.scan_time_s == 0.0) {
    const Pose2 sensor = T_map_base * range_finder_.T_base_sensor;
    const double c = std::cos(sensor.theta), s = std::sin(sensor.theta);
    for (int i = 0; i < count; ++i) set(beams_[i], sensor, c, s, directions_[i]);
    return;
  }
  int next = 0;
  Pose2 from = sensor_at(range_finder_.beam_time(0));
  for (int knot = 1; knot <= kPathKnots; ++knot) {
    const int begin = next, end = knot * count / kPathKnots;
    if (end <= begin) continue;
    const Pose2 to = sensor_at(range_finder_.beam_time(end));
    for (; next < end; ++next) {
      const Pose2 sensor = geometry::interpolate(from, to, static_cast<double>(next - begin) / (end - begin));
      set(beams_[next], sensor, std::cos(sensor.theta), std::sin(sensor.theta), directions_[next]);
    }
    from = to;
  }
}

/// Which neighbours hit one surface. Where it is met at a grazing angle, the occupied part is widened so that every
/// cell that the surface passes through has its centre in it: about half a cell to either side of the surface.
void ScanPainter::join() {
  const double min_sine = std::sin(params_.min_incidence_rad);
  const double resolution = georeference_.resolution_m;
  double sine_before = 0.0;  // of the incidence on the surface shared with the beam before; 0: none shared
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    Beam& beam = beams_[i];
    double sine_after = 0.0, sine_of_next = 0.0;
    if (i + 1 < beams_.size() && beam.hit_class >= 0 && beams_[i + 1].hit_class >= 0) {
      const Beam& next = beams_[i + 1];
      const Eigen::Vector2d along =
          next.range_m * next.direction - beam.range_m * beam.direction + (next.origin - beam.origin) * resolution;
      const double length = along.norm();
      const double sine = std::abs(geometry::cross(beam.direction, along));
      if (length > 0.0 && sine >= min_sine * length) {
        sine_after = sine / length;
        sine_of_next = std::max(min_sine, std::abs(geometry::cross(next.direction, along)) / length);
      }
    }
    beam.joined = sine_after > 0.0;
    const double sine = std::max(sine_before, sine_after);  // of two surfaces, the one met more steeply
    const double across_m = kWallHalfCells * resolution;
    if (sine > 0.0 && (beam.far_m - beam.range_m) * sine < across_m) {
      beam.far_m = beam.range_m + across_m / sine;
      beam.near_m = std::max(0.0, beam.range_m - across_m / sine);
      beam.free_m = std::min(beam.free_m, beam.near_m);
    }
    sine_before = sine_of_next;
  }
}

/// Where a beam meets an outline, in cells.
Eigen::Vector2d ScanPainter::tip(std::size_t beam, Outline outline) const {
  const Beam& b = beams_[beam];
  return b.origin + b.*outline * cells_per_metre_ * b.direction;
}

/// Where an outline enters a beam's sector: half-way from the beam before where both hit one surface.
Eigen::Vector2d ScanPainter::start(std::size_t beam, Outline outline) const {
  if (beam > 0 && beams_[beam - 1].joined) return 0.5 * (tip(beam - 1, outline) + tip(beam, outline));
  const Beam& b = beams_[beam];
  return b.origin + b.*outline * cells_per_metre_ * turned(b.direction, half_sector_.x(), -half_sector_.y());
}

/// Where it leaves it.
Eigen::Vector2d ScanPainter::end(std::size_t beam, Outline outline) const {
  if (beams_[beam].joined) return 0.5 * (tip(beam, outline) + tip(beam + 1, outline));
  const Beam& b = beams_[beam];
  return b.origin + b.*outline * cells_per_metre_ * turned(b.direction, half_sector_.x(), half_sector_.y());
}

/// Sectors of one class that touch make one contour.
void ScanPainter::add_free_contours() {
  for (std::size_t first = 0, last = 0; first < beams_.size(); first = last + 1) {
    last = first;
    const int free_class = beams_[first].free_class;
    if (free_class < 0) continue;
    corners_ = {beams_[first].origin, start(first, &Beam::free_m), tip(first, &Beam::free_m)};
    for (; last + 1 < beams_.size() && beams_[last + 1].free_class == free_class; ++last) {
      if (!beams_[last].joined) {
        if (!touching_) break;
        corners_.push_back(end(last, &Beam::free_m));
        corners_.push_back(start(last + 1, &Beam::free_m));
      }
      corners_.push_back(tip(last + 1, &Beam::free_m));
    }
    corners_.push_back(end(last, &Beam::free_m));
    corners_.push_back(beams_[last].origin);
    filler_.add_contour(corners_, free_class);
  }
}

/// What hits one surface makes one contour: along its far side, and back along its near one.
void ScanPainter::add_hit_contours() {
  for (std::size_t first = 0, last = 0; first < beams_.size(); first = last + 1) {
    last = first;
    const int hit_class = beams_[first].hit_class;
    if (hit_class < 0) continue;
    while (beams_[last].joined && beams_[last + 1].hit_class == hit_class) ++last;
    corners_ = {start(first, &Beam::far_m)};
    for (std::size_t i = first; i <= last; ++i) corners_.push_back(tip(i, &Beam::far_m));
    corners_.push_back(end(last, &Beam::far_m));
    corners_.push_back(end(last, &Beam::near_m));
    for (std::size_t i = last + 1; i > first; --i) corners_.push_back(tip(i - 1, &Beam::near_m));
    corners_.push_back(start(first, &Beam::near_m));
    filler_.add_contour(corners_, hit_class);
  }
}

ScanPainter::Counts ScanPainter::paint(grids::EvidentialGrid& grid, const Pose2& T_map_base,
                                       const PoseReliability& reliability, std::span<const float> ranges_m,
                                       const sensors::MotionPath& path, sensors::Timestamp time) {
  if (ranges_m.size() != beams_.size())
    throw std::invalid_argument("a scan has " + std::to_string(ranges_m.size()) + " ranges, its range finder " +
                                std::to_string(beams_.size()) + " beams");
  const Counts counts = classify(ranges_m, reliability);
  place(T_map_base, path, time);
  join();
  const Eigen::Vector2d here = T_map_base * range_finder_.T_base_sensor.translation();
  const Eigen::Vector2d origin(georeference_.origin_x_m, georeference_.origin_y_m);
  const double most_m = std::max(range_finder_.range_max_m, 1.0);
  double reach = 0.0, moved = 0.0;  // of the longest beam [m]; how far the sensor comes within the scan [m^2]
  for (const Beam& beam : beams_) {
    const double square = (beam.origin * georeference_.resolution_m + origin - here).squaredNorm();
    if (!(square <= most_m * most_m))
      throw std::out_of_range("the motion given with a scan carries the sensor " + std::to_string(std::sqrt(square)) +
                              " m away within the scan: leave the motion out or correct it");
    moved = std::max(moved, square);
    reach = std::max(reach, std::max(beam.free_m, beam.far_m));
  }
  reach += std::sqrt(moved) + 2.0 * georeference_.resolution_m;
  static_cast<void>(georeference_.cell_at(here - Eigen::Vector2d(reach, reach)));
  static_cast<void>(georeference_.cell_at(here + Eigen::Vector2d(reach, reach)));
  filler_.clear();
  add_free_contours();
  add_hit_contours();
  filler_.fill(grid, increments_);
  return counts;
}

}  // namespace credo::mapping
