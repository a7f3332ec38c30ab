// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "grids/mass_map.hpp"
#include "mapping/cell_rules.hpp"
#include "mapping/fan.hpp"
#include "mapping/mapper.hpp"
#include "mapping/scan_painter.hpp"

namespace credo::mapping {

/// Calls take_in(cell, mass) for each cell that a reading says something of, its mass discounted by the reliabilities
/// of the model and of the pose.
template <typename TakeIn>
void for_each_mass(const grids::Georeference& georeference, const sensors::SonarRing& ring, const AnySonarModel& model,
                   const PlacedReading& reading, const TakeIn& take_in) {
  const bool echo = std::isfinite(reading.range_m);
  const double reach_m = echo ? model.reach(reading.range_m) : model.no_echo().reach();
  const double reliability = reading.reliability * (echo ? model.reliability() : model.no_echo().reliability());
  if (!(reach_m > 0.0 && reliability > 0.0)) return;
  const Fan fan(georeference, reading.T_map_transducer, 0.5 * ring.beam_width_rad, reach_m);
  const geometry::Pose2 T_transducer_map = reading.T_map_transducer.inverse();
  const CellRun rows = fan.rows();
  for (int row = rows.begin; row < rows.end; ++row) {
    const CellRun run = fan.run(row);
    for (int column = run.begin; column < run.end; ++column) {
      const grids::CellIndex cell{column, row};
      const Eigen::Vector2d there = T_transducer_map * georeference.centre(cell);
      const double rho_m = there.norm(), theta_rad = std::atan2(there.y(), there.x());
      const evidence::GridMass mass = evidence::discount(
          echo ? model.mass(rho_m, theta_rad, reading.range_m) : model.no_echo().mass(rho_m, theta_rad), reliability);
      if (mass != evidence::GridMass::vacuous()) take_in(cell, mass);
    }
  }
}

/// The same readings as `Mapper` into cells of any rule, one after the other. Slower: each cell asks the sensor model
/// itself, so that masses without ignorance stay what they are. An unsure pose blurs each reading of a transducer and
/// each scan: the mean over the poses that may be. Readings of a robot at rest count less and less (Freshness), unless
/// the rule forgets; so they are to be given by time. A laser model that was learned gives a rule that forgets what a
/// reading is worth by itself.
template <CellRule Rule>
class SequentialMapper {
 public:
  using Cell = typename Rule::Cell;

  /// \throws std::invalid_argument as Mapper.
  SequentialMapper(const sensors::Rig& rig, const MapperParams& params, Rule rule = {})
      : rig_(rig),
        params_(params),
        reliability_(rig, params.sensors),
        rule_(std::move(rule)),
        freshness_(params.freshness),
        grid_(params.georeference) {
    for (const sensors::SonarRing& ring : rig.sonar_rings) sonars_.push_back(sonar_model(ring, params.sonar));
    for (const sensors::RangeFinder& finder : rig.range_finders)
      scans_.emplace_back(finder, params.georeference, laser_tables(params.laser, finder, params.scan, kTaken),
                          params.scan);
  }

  /// \throws as Mapper::insert
  void insert(const evidence::Believed<geometry::PoseEstimate>& T_map_base, const sensors::SonarSweep& sweep,
              const sensors::MotionPath& path = {}) {
    const auto ring = static_cast<std::size_t>(sweep.sensor);
    const bool there = sweep.sensor >= 0 && ring < rig_.sonar_rings.size();
    require_sensor(rig_.sonar_rings.size(), sweep.sensor, sweep.ranges_m.size(),
                   there ? rig_.sonar_rings[ring].T_base_transducer.size() : 0, "sonar ring");
    const double share = share_of(sweep, T_map_base);
    // Calls take(transducer, cell, mass).
    const auto spread = [&](const evidence::Believed<geometry::PoseEstimate>& pose, const auto& take) {
      MappingCounts counts;
      place_sweep(rig_, params_.georeference, params_.pose, pose, sweep, path, counts, placed_,
                  reliability_.of_ring(ring), share);
      for (const PlacedReading& reading : placed_)
        for_each_mass(params_.georeference, rig_.sonar_rings[ring], sonars_[ring], reading,
                      [&](grids::CellIndex cell, const evidence::GridMass& mass) {
                        take(static_cast<std::size_t>(reading.transducer), cell, mass);
                      });
      return counts;
    };
    const auto poses = blurred(T_map_base, sweep.ranges_m, rig_.sonar_rings[ring].range_max_m);
    if (poses.empty()) {
      counts_ += spread(T_map_base, [&](std::size_t, grids::CellIndex cell, const evidence::GridMass& mass) {
        take_in(cell, mass, sweep.time);
      });
      return;
    }
    std::vector<MassMean> means(sweep.ranges_m.size(), MassMean(params_.georeference));
    MappingCounts counts;
    for (const auto& pose : poses)
      counts = spread(pose, [&](std::size_t transducer, grids::CellIndex cell, const evidence::GridMass& mass) {
        means[transducer].add(cell, mass);
      });
    counts_ += counts;
    for (const MassMean& mean : means)
      mean.for_each(poses.size(),
                    [&](grids::CellIndex cell, const evidence::GridMass& mass) { take_in(cell, mass, sweep.time); });
  }

  /// A scan's evidence is that of `Mapper` on an empty map: each cell takes it in once.
  void insert(const evidence::Believed<geometry::PoseEstimate>& T_map_base, const sensors::RangeScan& scan,
              const sensors::MotionPath& path = {}) {
    const auto finder = static_cast<std::size_t>(scan.sensor);
    const bool there = scan.sensor >= 0 && finder < rig_.range_finders.size();
    require_sensor(rig_.range_finders.size(), scan.sensor, scan.ranges_m.size(),
                   there ? static_cast<std::size_t>(rig_.range_finders[finder].count) : 0, "range finder");
    const double trust = share_of(scan, T_map_base) * reliability_.of_finder(finder);
    const auto paint = [&](grids::EvidentialGrid& grid, const evidence::Believed<geometry::PoseEstimate>& pose) {
      const PoseReliability reliability(pose, params_.georeference.resolution_m, params_.pose, trust);
      if (reliability.maps_nothing()) return MappingCounts{.scans = 1, .refused = 1};
      const MappingCounts counts =
          counts_of(scans_[finder].paint(grid, pending_, pose.value.pose, reliability, scan.ranges_m, path, scan.time));
      pending_.settle(grid);
      return counts;
    };
    grids::EvidentialGrid one(params_.georeference);
    const auto poses = blurred(T_map_base, scan.ranges_m, rig_.range_finders[finder].range_max_m);
    counts_ += poses.empty() ? paint(one, T_map_base) : paint_mean(one, poses, paint);
    fold(one, scan.time);
  }

  [[nodiscard]] const grids::CellGrid<Cell>& grid() const { return grid_; }
  [[nodiscard]] const MappingCounts& counts() const { return counts_; }
  /// Readings of a cell that the rule abandoned.
  [[nodiscard]] std::int64_t abandoned() const { return abandoned_; }
  [[nodiscard]] grids::MassMap masses() const {
    return grids::mass_map(grid_, [&](const Cell& cell) { return rule_.masses(cell); });
  }

 private:
  static constexpr ReadingsTaken kTaken = Rule::kForgets ? ReadingsTaken::kAlone : ReadingsTaken::kSummed;

  template <typename Reading>
  [[nodiscard]] double share_of(const Reading& reading, const evidence::Believed<geometry::PoseEstimate>& T_map_base) {
    return Rule::kForgets ? 1.0 : freshness_.of_next(reading, T_map_base.value.pose);
  }

  [[nodiscard]] std::vector<evidence::Believed<geometry::PoseEstimate>> blurred(
      const evidence::Believed<geometry::PoseEstimate>& T_map_base, std::span<const float> ranges_m,
      double range_max_m) const {
    return poses_for_blur(T_map_base, ranges_m, range_max_m, params_.georeference.resolution_m, params_.blur);
  }

  void take_in(grids::CellIndex cell, const evidence::GridMass& mass, sensors::Timestamp time) {
    abandoned_ += rule_.update(grid_.see(cell), mass, time) ? 0 : 1;
  }

  void fold(const grids::EvidentialGrid& one, sensors::Timestamp time) {
    for (const auto& [index, tile] : one.tiles())
      for (int place = 0; place < grids::Tile::kCells; ++place) {
        const evidence::FixedLogCommonality cell{tile.empty[place], tile.occupied[place], tile.unknown[place]};
        if (cell == evidence::FixedLogCommonality{}) continue;
        take_in(grids::cell_of(index, place), evidence::masses(cell.value()), time);
      }
  }

  sensors::Rig rig_;
  MapperParams params_;
  SensorReliability reliability_;
  Rule rule_;
  Freshness freshness_;
  grids::CellGrid<Cell> grid_;
  std::vector<AnySonarModel> sonars_;  // one for each ring
  std::vector<ScanPainter> scans_;     // one for each range finder
  std::vector<PlacedReading> placed_;  // of the sweep at hand
  PendingRegions pending_;             // of the scan at hand
  MappingCounts counts_;
  std::int64_t abandoned_ = 0;
};

}  // namespace credo::mapping
