// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evaluation/trajectory.hpp"

namespace credo::evaluation {

struct AssociationParams {
  static constexpr double kLargest_s = 4e9;  ///< of the times below: over a hundred years
  double t_max_diff_s = 0.01;
  double t_offset_s = 0.0;   ///< added to the times of the estimate
  bool interpolate = false;  ///< the reference, to the times of the estimate, instead of taking its nearest row
};

/// Poses of a reference and an estimate of the same moments: reference.poses[i] belongs to estimate.poses[i].
struct AssociatedPair {
  Trajectory reference = {};
  Trajectory estimate = {};
  int possible = 0;  ///< poses of the shorter trajectory: the most that could have been matched
};

/// Each pose of the shorter trajectory takes the pose of the longer one that is nearest in time, where that is within
/// `t_max_diff_s`; of several that want the same one, the nearest gets it and the others stay unmatched. Trajectories
/// without times are matched row by row.
/// \throws std::invalid_argument if a parameter is not finite or too large, std::runtime_error if nothing matches or if
///   without times the numbers of poses differ
[[nodiscard]] AssociatedPair associate(const Trajectory& reference, const Trajectory& estimate,
                                       const AssociationParams& params = {});

}  // namespace credo::evaluation
