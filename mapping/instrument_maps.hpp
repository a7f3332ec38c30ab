// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <string>
#include <vector>

#include "mapping/mapper.hpp"

namespace credo::mapping {

/// A range finder, or a transducer of a sonar ring, by their numbers in the rig.
struct Instrument {
  static constexpr int kNone = -1;

  int finder = kNone;
  int ring = kNone, transducer = kNone;

  [[nodiscard]] bool is_sonar() const { return transducer != kNone; }
  /// "range finder 0", "transducer 3 of ring 0".
  [[nodiscard]] std::string name() const;
  friend bool operator==(const Instrument&, const Instrument&) = default;
};

/// All that one instrument said.
struct InstrumentMap {
  Instrument instrument;
  grids::EvidentialGrid grid;
  std::int64_t readings = 0;  ///< ranges, and inf, that were mapped
  double sweeps = 0.0;  ///< or scans that they are of, those from one place counted as what is new in them (Freshness)
};

struct InstrumentMaps {
  std::vector<InstrumentMap> maps;  ///< range finders, then transducers; none of those without readings
  MappingCounts counts;
  std::int64_t without_pose = 0;  ///< readings left out for want of a pose near in time
};

/// The map of a drive, as map_along, but what each instrument said kept apart. The sum of these maps (merge) is the one
/// of map_along to the bit where the poses are sure (`params.covariance` zero): to keep them apart costs the memory
/// of one map for each, however many the cores, and no reading is mapped twice. Sonar from an unsure pose is discounted
/// here and not blurred.
/// \param progress  as map_along's
/// \throws as map_along
[[nodiscard]] InstrumentMaps map_by_instrument(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                                               std::span<const sensors::RangeScan> scans,
                                               std::span<const sensors::SonarSweep> sweeps,
                                               const TrajectoryMappingParams& params = {},
                                               const std::function<void(double share)>& progress = {});

}  // namespace credo::mapping
