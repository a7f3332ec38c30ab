// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

namespace credo::localization {

/// A probability that is known to an interval only.
struct ProbabilityInterval {
  double low = 0.0;
  double high = 0.0;
};

/// What would be true under a hypothesis, against the pose that is reported.
struct FaultHypothesis {
  ProbabilityInterval probability;
  double separation_m = 0.0, separation_rad = 0.0;  ///< of the pose without what is wrong
  double sigma_m = 0.0, sigma_rad = 0.0;            ///< of the same; the largest direction
};

/// A component of the hypotheses: of the probability an end, of separation and sigma the position's or the heading's.
struct FaultComponent {
  double ProbabilityInterval::*end = &ProbabilityInterval::high;
  double FaultHypothesis::*separation = &FaultHypothesis::separation_m;
  double FaultHypothesis::*sigma = &FaultHypothesis::sigma_m;
};

/// Finds protection levels. Keeps its memory.
class ProtectionLevel {
 public:
  ProtectionLevel();

  /// The smallest error that all hypotheses together exceed with a probability of at most `risk`, to 2 %: under each
  /// the error is the separation and a normal one. Infinity where `most` is exceeded more often.
  /// \param hypotheses  not empty; that of no fault is the first
  [[nodiscard]] double operator()(std::span<const FaultHypothesis> hypotheses, const FaultComponent& of, double risk,
                                  double most);

 private:
  /// One component of a hypothesis; all of them lie close together, for they are summed up again and again.
  struct Term {
    double probability = 0.0;
    double separation = 0.0;
    double inverse_sigma = 0.0;
  };
  [[nodiscard]] double excess(double level) const;

  std::vector<Term> terms_;
};

}  // namespace credo::localization
