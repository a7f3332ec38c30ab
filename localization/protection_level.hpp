// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
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
  static constexpr std::size_t kLanes = 8;
  using Lanes = Eigen::Array<double, kLanes, 1>;
  /// One component of a few hypotheses, side by side. The last one is filled up with what has no probability.
  struct Block {
    Lanes probability = Lanes::Zero();
    Lanes separation = Lanes::Zero();
    Lanes inverse_sigma = Lanes::Zero();
  };
  void take(std::span<const FaultHypothesis> hypotheses, const FaultComponent& of);
  [[nodiscard]] double excess(double level, double enough = std::numeric_limits<double>::infinity()) const;

  std::vector<Block> blocks_;
};

}  // namespace credo::localization
