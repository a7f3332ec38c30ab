// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mapping/mapper.hpp"

namespace credo::mapping {

/// What the others say of a transducer.
struct TransducerVerdict {
  int ring = 0;
  int transducer = 0;
  std::int64_t readings = 0;  ///< of it that were mapped
  std::int64_t cells = 0;     ///< that it speaks of, and others do
  double opposed = 0.0;      ///< share of its evidence that the others contradict, in [0, 1]; 0 where nothing is shared
  double reliability = 1.0;  ///< that it deserves, in [0, 1]

  friend bool operator==(const TransducerVerdict&, const TransducerVerdict&) = default;
};

/// Judges each sonar transducer by its conflict with what all others have said of the same cells: the map is a sum, so
/// that a transducer's own contribution is taken out of it exactly. Its evidence for "occupied" is opposed by the mass
/// of "empty" that the others leave after Dempster's rule, its evidence for "empty" by that of "occupied"; `opposed` is
/// the mean of the two shares, each over the cells that the others decide, so that the many empty cells do not hide a
/// few false walls. A ring in order contradicts itself, too, where cones reach round corners; the reliability is
/// therefore the odds of being right against those of the median transducer, 1 at most.
/// \param params  `mapper.sensors` does not count: the verdict is of what the sensors say by themselves
/// \returns one for each transducer, in the order of SensorReliabilityParams::transducers
/// \throws as map_along
[[nodiscard]] std::vector<TransducerVerdict> judge_transducers(const sensors::MotionPath& T_map_base,
                                                               const sensors::Rig& rig,
                                                               std::span<const sensors::SonarSweep> sweeps,
                                                               const TrajectoryMappingParams& params = {});

/// The verdicts as the mapper takes them.
[[nodiscard]] std::vector<double> reliabilities(std::span<const TransducerVerdict> verdicts);

/// One line for a person: how many transducers are doubted, and the one that is most.
[[nodiscard]] std::string summary(std::span<const TransducerVerdict> verdicts);

}  // namespace credo::mapping
