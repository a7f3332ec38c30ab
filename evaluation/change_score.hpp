// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "datasets/truth_states.hpp"
#include "mapping/map_rule.hpp"

namespace credo::evaluation {

/// How a map follows a world that changes. A cell has changed where it is free in one state and occupied in the next; a
/// sweep is one in which the cell is seen. Right is as in MapScore: occupied within one cell of a true wall; empty
/// where it is, or where the map says occupied within one cell.
struct ChangeScore {
  std::int64_t changed_3 = 0;  ///< changes of a cell that was seen in three sweeps since, before it changed again
  std::int64_t right_3 = 0;    ///< of them, right after the third
  std::int64_t changed_5 = 0;  ///< the same after five
  std::int64_t right_5 = 0;
  std::int64_t unchanged = 0;  ///< cells that are the same in all states and were seen in five sweeps
  std::int64_t wrong = 0;      ///< of them, at the end

  [[nodiscard]] double followed_3() const { return changed_3 > 0 ? double(right_3) / double(changed_3) : 0.0; }
  [[nodiscard]] double followed_5() const { return changed_5 > 0 ? double(right_5) / double(changed_5) : 0.0; }
  [[nodiscard]] double wrong_share() const { return unchanged > 0 ? double(wrong) / double(unchanged) : 0.0; }
};

/// Maps the scans in the order of their times by a rule, and looks after each.
/// \param states  of the world, by time
/// \throws std::invalid_argument if there is no state, or the trajectory is empty
[[nodiscard]] ChangeScore change_score(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                                       std::span<const sensors::RangeScan> scans,
                                       std::span<const datasets::TruthState> states,
                                       const mapping::TrajectoryMappingParams& params, const mapping::MapRule& rule,
                                       const std::function<void(double share)>& progress = {});

}  // namespace credo::evaluation
