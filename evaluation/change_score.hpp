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
  std::int64_t unchanged = 0;     ///< cells that are the same in all states and were seen in five sweeps
  std::int64_t wrong = 0;         ///< of them, at the end
  std::int64_t said_changed = 0;  ///< of them, that the rule `changing` counts a change of

  /// Shares; nan of nothing.
  [[nodiscard]] double followed_3() const { return static_cast<double>(right_3) / static_cast<double>(changed_3); }
  [[nodiscard]] double followed_5() const { return static_cast<double>(right_5) / static_cast<double>(changed_5); }
  [[nodiscard]] double wrong_share() const { return static_cast<double>(wrong) / static_cast<double>(unchanged); }
  [[nodiscard]] double said_changed_share() const {
    return static_cast<double>(said_changed) / static_cast<double>(unchanged);
  }
};

/// Maps the scans by a rule, as map_along does, and looks after each.
/// \param scans   by time
/// \param states  of the world, by time
/// \throws std::invalid_argument if there is no state, or the trajectory is empty
[[nodiscard]] ChangeScore change_score(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                                       std::span<const sensors::RangeScan> scans,
                                       std::span<const datasets::TruthState> states,
                                       const mapping::TrajectoryMappingParams& params, const mapping::MapRule& rule,
                                       const std::function<void(double share)>& progress = {});

}  // namespace credo::evaluation
