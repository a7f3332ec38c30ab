// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "evaluation/proportion.hpp"
#include "evaluation/samples.hpp"

namespace credo::evaluation {

/// Probabilities that are about the same, and how often what they say came true.
struct ReliabilityBin {
  double probability = 0.0;  ///< mean
  Proportion came_true = {};
};

/// How far probabilities are to be taken at their word (DeGroot and Fienberg, 1983). Zeros without any.
struct Reliability {
  std::vector<ReliabilityBin> bins = {};  ///< of equal count, by probability; those that are not empty
  double calibration_error = 0.0;         ///< ECE: mean |probability - frequency| of the bins, by their count
  double brier = 0.0;                     ///< mean (probability - outcome)^2 (Brier, 1950)
  double log_loss = 0.0;                  ///< mean -ln of the probability of the outcome, which counts as >= 1e-6
};

/// Precondition: as many probabilities, in [0, 1], as outcomes.
[[nodiscard]] Reliability reliability(std::span<const double> probabilities, const std::vector<bool>& came_true,
                                      int bins = 10);

/// The calibration error of reliability() alone.
[[nodiscard]] double calibration_error(std::span<const double> probabilities, const std::vector<bool>& came_true,
                                       int bins = 10);

/// Beliefs whose Bel and Pl are about the same, and how often the claim was true.
struct BeliefBin {
  double belief = 0.0, plausibility = 0.0;  ///< means
  Proportion came_true = {};

  /// [Bel, Pl] and the 95 % interval of the frequency have a point in common.
  [[nodiscard]] bool agrees() const;
};

/// Whether [Bel, Pl] holds the frequency with which a claim is true. The counterpart of the reliability diagram for
/// beliefs that may be ignorant; the width is what the ignorance costs.
struct IntervalCalibration {
  std::vector<BeliefBin> bins = {};  ///< those of a square grid over (Bel, Pl) that are not empty, by Bel, then Pl
  Proportion covered = {};           ///< beliefs in bins that agree
  double mean_width = 0.0;           ///< of [Bel, Pl], over the beliefs
};

/// \param per_side  bins of the grid along Bel, and along Pl. Precondition: as many beliefs as outcomes
[[nodiscard]] IntervalCalibration interval_calibration(std::span<const evidence::BinaryMass> beliefs,
                                                       const std::vector<bool>& came_true, int per_side = 5);

/// What the errors are if only poses of at least a certain BetP(YES) are accepted.
struct RiskPoint {
  double threshold = 0.0;  ///< least BetP(YES)
  double coverage = 0.0;   ///< share of the poses that is accepted
  double mean_position_m = 0.0, mean_heading_rad = 0.0;
  double lost = 0.0;  ///< share of the accepted
};

/// By falling threshold: coverage grows to 1 (El-Yaniv and Wiener, 2010). Of the samples that have a pose.
[[nodiscard]] std::vector<RiskPoint> risk_coverage(std::span<const EvaluatedRun> runs, const ScoreParams& params = {});

/// Area under the lost share over coverage; nothing without points. 0 is perfect; of a belief that knows nothing it is
/// the share of the lost.
[[nodiscard]] std::optional<double> area_under_risk(std::span<const RiskPoint> curve);

}  // namespace credo::evaluation
