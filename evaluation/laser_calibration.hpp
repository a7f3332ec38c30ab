// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "datasets/map_server.hpp"
#include "evaluation/logistic_regression.hpp"
#include "evaluation/map_experiment.hpp"
#include "mapping/laser_calibrated.hpp"
#include "sim/random_world.hpp"

namespace credo::evaluation {

struct LaserCalibrationParams {
  double resolution_m = 0.05;  ///< side of the cells that are learned from
  int empty_stride = 4;  ///< of the empty cells far from walls, which are many, each so-manieth is taken, and counts as
                         ///< often
  int alone_stride = 25;  ///< each so-manieth scan is taken alone, too
  LogisticParams regression;
};

/// Learns mapping::CalibratedLaser from drives whose true map is known: what the ScanPainter can paint, by what it
/// painted. How often each weight counts in a cell is told by maps of the drive that are made with one weight alone.
/// What a reading is worth by itself is learned from maps of single scans, beside walls.
class LaserCalibration {
 public:
  /// \throws std::invalid_argument if a parameter is out of its range
  explicit LaserCalibration(const LaserCalibrationParams& params = {});

  /// Cells are learned from as MapScore counts them: those that were seen, but for those deep inside of a solid.
  /// \param T_map_base  the poses of the drive. \param finder  of the rig, whose scans these are
  /// \throws std::length_error if the truth has more than TrueCells::kMostCells
  void add(const sensors::MotionPath& T_map_base, const sensors::RangeFinder& finder,
           std::span<const sensors::RangeScan> scans, const datasets::OccupancyMap& truth,
           const CalibrationProgress& progress = {});

  [[nodiscard]] std::int64_t cells() const { return static_cast<std::int64_t>(cells_.size()); }

  /// The weights and lengths under which the states of all cells are likeliest: a logistic regression for each pair of
  /// lengths, one length improved after the other, with a ridge that draws the weights of all hits together; with these
  /// lengths another one, whose rows are the cells of single scans that are beside walls, for the weights of a reading
  /// by itself. \throws std::invalid_argument if no cell was learned from
  [[nodiscard]] mapping::CalibratedLaserParams fit(const CalibrationProgress& progress = {}) const;

  /// How often the weights count in a cell.
  struct Cell {
    grids::CellIndex at;
    bool occupied = false;
    bool near = false;                                        ///< to cells of the other kind, within kWallTolerance
    double count = 1.0;                                       ///< how often the cell does
    std::vector<float> free;                                  ///< for each margin that is tried
    std::vector<std::vector<LogisticRegression::Entry>> hit;  ///< for each half-width that is
  };

 private:
  /// Scans of a drive that are taken alone, and the cells of the building.
  struct SingleScans {
    sensors::MotionPath T_map_base;
    sensors::RangeFinder finder;
    std::vector<sensors::RangeScan> scans;
    std::size_t first_cell = 0, last_cell = 0;  ///< of cells_, the last one not among them
  };

  [[nodiscard]] LogisticRegression::Fit fit_with(std::size_t margin, std::size_t half_width) const;
  [[nodiscard]] LogisticRegression::Fit fit_alone(std::size_t margin, std::size_t half_width,
                                                  const CalibrationProgress& progress) const;

  LaserCalibrationParams params_;
  std::vector<Cell> cells_;
  std::vector<SingleScans> single_scans_;
};

/// A drive of a range finder, alone, through a building that is drawn from a random seed.
/// \param sigma_m  its noise at any range instead of its own; 0: its own
[[nodiscard]] MapDrive laser_drive(std::uint64_t seed, const sim::RandomWorldParams& params = {}, double sigma_m = 0.0);
/// In every second building the range finder is a time of flight, of 5 to 80 mm; else it is drawn among those that
/// triangulate.
void add_simulated_drive(LaserCalibration& calibration, std::uint64_t seed, sim::RandomWorldParams params = {},
                         const CalibrationProgress& progress = {});

}  // namespace credo::evaluation
