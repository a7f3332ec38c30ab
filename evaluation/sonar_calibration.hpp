// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "datasets/map_server.hpp"
#include "evaluation/logistic_regression.hpp"
#include "evaluation/map_experiment.hpp"
#include "mapping/mapper.hpp"
#include "sim/random_world.hpp"

namespace credo::evaluation {

struct SonarCalibrationParams {
  double resolution_m = 0.05;  ///< side of the cells that are learned from
  int empty_stride = 4;        ///< of the empty cells, which are many, each so-manieth is taken, and counts as often
  LogisticParams regression;
};

/// Learns the weights of mapping::CalibratedSonar from drives whose true map is known.
class SonarCalibration {
 public:
  /// \throws std::invalid_argument if a parameter is out of its range
  explicit SonarCalibration(const SonarCalibrationParams& params = {});

  /// Cells on walls that could be seen are learned as occupied, those farther than one cell from any as empty.
  /// \param T_map_base  the poses of the drive. \param ring  of the rig, whose sweeps these are
  /// \throws std::length_error if the truth has more than TrueCells::kMostCells
  void add(const sensors::MotionPath& T_map_base, const sensors::SonarRing& ring,
           std::span<const sensors::SonarSweep> sweeps, const datasets::OccupancyMap& truth,
           const CalibrationProgress& progress = {});

  [[nodiscard]] std::int64_t cells() const { return regression_.rows(); }

  /// The weights under which the states of all cells are likeliest: logistic regression with a ridge.
  /// \throws std::invalid_argument if no cell was learned from.
  [[nodiscard]] std::vector<double> fit(const CalibrationProgress& progress = {}) const;

 private:
  SonarCalibrationParams params_;
  LogisticRegression regression_;
};

/// A drive of a 16-sonar ring (pioneer-16), alone, through a building that is drawn from a random seed.
[[nodiscard]] MapDrive sonar_drive(std::uint64_t seed, const sim::RandomWorldParams& params = {});
void add_simulated_drive(SonarCalibration& calibration, std::uint64_t seed, const sim::RandomWorldParams& params = {},
                         const CalibrationProgress& progress = {});

}  // namespace credo::evaluation
