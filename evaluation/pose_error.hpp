// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/alignment.hpp"

namespace credo::evaluation {

/// What of an error pose E is looked at. The names are evo's.
enum class PoseRelation {
  kTranslationPart,  ///< ||t(E)|| [m]
  kRotationPart,     ///< ||R(E) - I||_F
  kAngleDegrees,     ///< |log R(E)| [deg]
  kAngleRadians,     ///< |log R(E)| [rad]
  kFull,             ///< ||E - I||_F
  kPointDistance,    ///< of the positions alone [m]
};

enum class DeltaUnit { kFrames, kMetres, kDegrees, kRadians };

/// Of a series of errors. `std` is that of the population (n, not n - 1).
struct Statistics {
  double max = 0.0, mean = 0.0, median = 0.0, min = 0.0, rmse = 0.0, sse = 0.0, std = 0.0;
};

/// \throws std::invalid_argument if there are none
[[nodiscard]] Statistics statistics(std::span<const double> errors);

struct PoseErrors {
  std::string title;  ///< as evo prints it
  std::vector<double> errors = {};
  std::vector<sensors::Timestamp> times = {};  ///< of the pose (APE) or of the second pose of the pair (RPE)
  Statistics statistics = {};
};

/// Absolute pose error: E_i = P_i^-1 Q_i of estimate P and reference Q (Sturm et al., IROS 2012; evo).
[[nodiscard]] PoseErrors absolute_pose_error(const AssociatedPair& pair, PoseRelation relation);

struct RelativeErrorParams {
  static constexpr double kLargestDelta = 1e6;  ///< of whatever unit
  PoseRelation relation = PoseRelation::kTranslationPart;
  double delta = 1.0;
  DeltaUnit unit = DeltaUnit::kFrames;
  double relative_tolerance = 0.1;  ///< of delta, where all pairs are taken
  bool all_pairs = false;           ///< every start, instead of pairs that follow each other
  bool pairs_from_reference = false;
};

/// Relative pose error: E_i = (Q_i^-1 Q_j)^-1 (P_i^-1 P_j) over the pairs (i, j) that are `delta` apart (Sturm et al.,
/// IROS 2012; evo).
/// \throws std::runtime_error if no pair is `delta` apart, or if `delta` is not above 0 and at most kLargestDelta
[[nodiscard]] PoseErrors relative_pose_error(const AssociatedPair& pair, const RelativeErrorParams& params);

/// The pairs of poses that are `delta` apart, as evo picks them: along the path for metres; by the accumulated angle
/// for consecutive pairs and by the direct angle for all pairs.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> pairs_at(const std::vector<StampedPose>& poses,
                                                                        const RelativeErrorParams& params);

/// evo's block: the title, what was aligned, and the statistics by name.
[[nodiscard]] std::string to_text(const PoseErrors& errors, const AlignmentParams& alignment);

}  // namespace credo::evaluation
