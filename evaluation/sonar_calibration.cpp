// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/sonar_calibration.hpp"

#include <cmath>
#include <stdexcept>

#include "evaluation/true_cells.hpp"
#include "evidence/parameter_check.hpp"
#include "mapping/fan.hpp"
#include "mapping/sonar_calibrated.hpp"
#include "sim/presets.hpp"

namespace credo::evaluation {
namespace {

using grids::CellBox;
using grids::CellIndex;
using mapping::SonarKnots;
using State = TrueCells::State;

/// Which cells of a drive are learned from, and how often each weight counts in them.
class Counts {
 public:
  Counts(const datasets::OccupancyMap& truth, const grids::Georeference& georeference, int empty_stride)
      : georeference_(georeference),
        truth_(truth, georeference, box_of(truth, georeference)),
        rows_(static_cast<std::size_t>(truth_.box().width) * static_cast<std::size_t>(truth_.box().height), kNone) {
    int empty = 0;
    const CellBox& box = truth_.box();
    for (int y = box.min.y; y < box.min.y + box.height; ++y)
      for (int x = box.min.x; x < box.min.x + box.width; ++x) {
        const CellIndex cell{x, y};
        const bool wall = truth_.at(cell) == State::kOccupied && truth_.near(cell, State::kEmpty, 1);
        const bool open =
            truth_.at(cell) == State::kEmpty && !truth_.near(cell, State::kOccupied, 1) && empty++ % empty_stride == 0;
        if (!wall && !open) continue;
        rows_[place(cell)] = wall ? kWallUnseen : kOpenUnseen;
      }
  }

  void take_in(const mapping::PlacedReading& reading, const sensors::SonarRing& ring) {
    const bool echo = std::isfinite(reading.range_m);
    const double half_width_rad = 0.5 * ring.beam_width_rad;
    const double reach_m = echo ? reading.range_m + SonarKnots::kPast.back() : ring.range_max_m;
    const mapping::Fan fan(georeference_, reading.T_map_transducer, half_width_rad, reach_m);
    const geometry::Pose2 T_transducer_map = reading.T_map_transducer.inverse();
    const mapping::CellRun rows = fan.rows();
    for (int row = rows.begin; row < rows.end; ++row) {
      const mapping::CellRun run = fan.run(row);
      for (int column = run.begin; column < run.end; ++column) {
        const CellIndex cell{column, row};
        if (!truth_.box().contains(cell) || rows_[place(cell)] == kNone) continue;
        float* counts = &counts_[row_of(cell) * SonarKnots::kCount];
        const Eigen::Vector2d there = T_transducer_map * georeference_.centre(cell);
        const double rho_m = there.norm(), off_axis = std::abs(std::atan2(there.y(), there.x())) / half_width_rad;
        const auto count = [&](std::size_t i, double share) { counts[i] += static_cast<float>(share); };
        if (off_axis > 1.0 || (!echo && rho_m < ring.range_min_m)) continue;
        echo ? mapping::for_each_echo_weight(rho_m, off_axis, reading.range_m, count)
             : mapping::for_each_no_echo_weight(rho_m, off_axis, count);
      }
    }
  }

  /// visit(occupied, counts of all weights) for each cell that a reading spoke of.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t i = 0; i < occupied_.size(); ++i)
      visit(occupied_[i], std::span(counts_).subspan(i * SonarKnots::kCount, SonarKnots::kCount));
  }

 private:
  static constexpr int kNone = -1, kWallUnseen = -2, kOpenUnseen = -3;

  /// Of a cell that is learned from: its own, made when it is first seen.
  [[nodiscard]] std::size_t row_of(CellIndex cell) {
    int& row = rows_[place(cell)];
    if (row < 0) {
      occupied_.push_back(row == kWallUnseen);
      row = static_cast<int>(occupied_.size()) - 1;
      counts_.resize(occupied_.size() * SonarKnots::kCount, 0.0F);
    }
    return static_cast<std::size_t>(row);
  }
  [[nodiscard]] std::size_t place(CellIndex cell) const {
    const CellBox& box = truth_.box();
    return static_cast<std::size_t>(cell.y - box.min.y) * static_cast<std::size_t>(box.width) +
           static_cast<std::size_t>(cell.x - box.min.x);
  }

  grids::Georeference georeference_;
  TrueCells truth_;
  std::vector<int> rows_;  ///< by cell, or kNone: not learned from, or what it is where no reading spoke of it
  std::vector<bool> occupied_;
  std::vector<float> counts_;
};

}  // namespace

SonarCalibration::SonarCalibration(const SonarCalibrationParams& params)
    : params_(params), regression_(SonarKnots::kCount, params.regression) {
  const evidence::ParameterCheck check("sonar calibration: ");
  check.positive("resolution_m", params.resolution_m);
  check.at_least("empty_stride", params.empty_stride, 1);
}

void SonarCalibration::add(const sensors::MotionPath& T_map_base, const sensors::SonarRing& ring,
                           std::span<const sensors::SonarSweep> sweeps, const datasets::OccupancyMap& truth,
                           const CalibrationProgress& progress) {
  const grids::Georeference georeference{.resolution_m = params_.resolution_m};
  Counts counts(truth, georeference, params_.empty_stride);
  sensors::Rig rig;
  rig.sonar_rings = {ring};
  mapping::MappingCounts ignored;
  std::vector<mapping::PlacedReading> placed;
  double done = 0.0;
  for (const sensors::SonarSweep& sweep : sweeps) {
    if (progress) progress(done++ / static_cast<double>(sweeps.size()));
    mapping::place_sweep(
        rig, georeference, {},
        {{T_map_base.pose_at(sweep.time), Eigen::Matrix3d::Zero()}, {.yes = 1.0, .no = 0.0, .unknown = 0.0}}, sweep,
        T_map_base, ignored, placed);
    for (const mapping::PlacedReading& reading : placed) counts.take_in(reading, ring);
  }
  std::vector<LogisticRegression::Entry> entries;
  counts.for_each([&](bool occupied, std::span<const float> cell) {
    entries.clear();
    for (std::size_t i = 0; i < cell.size(); ++i)
      if (cell[i] > 0.0F) entries.push_back({static_cast<std::uint32_t>(i), cell[i]});
    if (!entries.empty())
      regression_.add(entries, occupied, occupied ? 1.0 : static_cast<double>(params_.empty_stride));
  });
}

std::vector<double> SonarCalibration::fit(const CalibrationProgress& progress) const {
  if (cells() == 0) throw std::invalid_argument("sonar calibration: no reading was of a cell whose truth is known");
  if (progress) progress(0.0);
  return regression_.fit().weights;
}

MapDrive sonar_drive(std::uint64_t seed, const sim::RandomWorldParams& params) {
  sim::World world = sim::random_world(seed, params);
  world.camera.reset();
  world.range_finders.clear();
  world.sonars = {sim::sonar_preset("pioneer-16")};
  return play_for_mapping(world, seed);
}

void add_simulated_drive(SonarCalibration& calibration, std::uint64_t seed, const sim::RandomWorldParams& params,
                         const CalibrationProgress& progress) {
  const MapDrive drive = sonar_drive(seed, params);
  calibration.add(drive.T_map_base, drive.rig.sonar_rings.front(), drive.sweeps, drive.truth, progress);
}

}  // namespace credo::evaluation
