// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/map_extent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/terminal.hpp"
#include "grids/readout.hpp"

namespace credo::apps {
namespace {

using Point = Eigen::Vector2d;

/// How far a reading lets a sensor see; 0 for one that says nothing.
/// \param open_m  how far an open beam is believed; its end leaves little evidence
template <typename Sensor>
double seen_m(double range_m, const Sensor& sensor, double open_m) {
  constexpr double kInner = 0.8;
  if (std::isinf(range_m) && range_m > 0.0) return kInner * open_m;
  return range_m >= sensor.range_min_m && range_m <= sensor.range_max_m ? range_m : 0.0;
}

}  // namespace

Eigen::AlignedBox2d seen_ground(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                                std::span<const sensors::RangeScan> scans, std::span<const sensors::SonarSweep> sweeps,
                                const mapping::TrajectoryMappingParams& params) {
  Eigen::AlignedBox2d box;
  if (T_map_base.empty()) return box;
  const mapping::ScanParams& p = params.mapper.scan;
  for (const sensors::RangeScan& scan : scans) {
    if (!mapping::covers(T_map_base, scan.time, params.max_gap_s)) continue;
    const sensors::RangeFinder& finder = rig.range_finders.at(static_cast<std::size_t>(scan.sensor));
    const geometry::Pose2 T_map_sensor = T_map_base.pose_at(scan.time) * finder.T_base_sensor;
    const double reach_m = std::min(finder.range_max_m, p.max_range_m);
    const double open_m = p.no_return_reliability > 0.0 ? std::min(p.no_return_range_m, reach_m) : 0.0;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double azimuth = finder.angle_min_rad + static_cast<double>(i) * finder.angle_increment_rad;
      const double length_m = std::min(seen_m(scan.ranges_m[i], finder, open_m), reach_m);
      if (length_m > 0.0) box.extend(T_map_sensor * Point(length_m * std::cos(azimuth), length_m * std::sin(azimuth)));
    }
  }
  for (const sensors::SonarSweep& sweep : sweeps) {
    if (!mapping::covers(T_map_base, sweep.time, params.max_gap_s)) continue;
    const sensors::SonarRing& ring = rig.sonar_rings.at(static_cast<std::size_t>(sweep.sensor));
    const geometry::Pose2 T_map_sweep = T_map_base.pose_at(sweep.time);
    for (std::size_t i = 0; i < std::min(sweep.ranges_m.size(), ring.T_base_transducer.size()); ++i) {
      const double length_m = seen_m(sweep.ranges_m[i], ring, ring.range_max_m);
      if (length_m > 0.0) box.extend(T_map_sweep * ring.T_base_transducer[i] * Point(length_m, 0.0));
    }
  }
  return box;
}

void require_map_fits(const Eigen::AlignedBox2d& ground, double resolution_m) {
  if (ground.isEmpty()) return;
  const Point size = ground.sizes();
  const double most = static_cast<double>(grids::kLargestPicture);
  if (size.prod() <= most * resolution_m * resolution_m) return;
  constexpr double kRoom = 1.05;  // for the width of the beams
  const double fitting_m = kRoom * std::sqrt(size.prod() / most);
  const double step = std::pow(10.0, std::floor(std::log10(fitting_m)) - 1.0);  // two digits are enough
  throw std::length_error(fmt::format(
      "the readings are from {:.1f} x {:.1f} m, which is more than the {:.0f} cells that a map may have at a "
      "resolution of {:g} m: choose one of {:g} m or coarser, ask for map.cgrid alone with --large, or look for a pose "
      "that is far off",
      size.x(), size.y(), most, resolution_m, std::ceil(fitting_m / step) * step));
}

void warn_without_pictures(const grids::EvidentialGrid& grid) {
  const grids::CellBox box = grid.bounding_box();
  say_warning(
      fmt::format("the map is {} x {} cells, more than the {} of the largest picture: it is in map.cgrid, and "
                  "there is no map.yaml and no map_belief.tiff",
                  box.width, box.height, grids::kLargestPicture));
}

}  // namespace credo::apps
