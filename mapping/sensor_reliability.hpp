// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "sensors/acquisition.hpp"

namespace credo::mapping {

/// How far each instrument is to be trusted, beyond what its sensor model says of its kind: given, or found by
/// judge_instruments().
struct SensorReliabilityParams {
  std::vector<double> transducers;    ///< of all sonar rings, one ring after the other, in [0, 1]; empty: all 1
  std::vector<double> range_finders;  ///< in [0, 1]; empty: all 1
};

/// The discounting rates of a rig's instruments.
class SensorReliability {
 public:
  /// \throws std::invalid_argument if a list is neither empty nor as long as the rig has instruments, or a reliability
  ///         is not in [0, 1].
  SensorReliability(const sensors::Rig& rig, const SensorReliabilityParams& params);

  /// Precondition: the rig has it.
  [[nodiscard]] double of_finder(std::size_t finder) const { return finders_[finder]; }
  /// One for each transducer. Precondition: the rig has the ring.
  [[nodiscard]] const std::vector<double>& of_ring(std::size_t ring) const { return rings_[ring]; }

 private:
  std::vector<double> finders_;
  std::vector<std::vector<double>> rings_;
};

}  // namespace credo::mapping
