// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>

#include "localization/pose_solver.hpp"

namespace credo::localization {

struct MisfitParams {
  /// Squared residual per degree of freedom, in expected standard deviations, where nothing is wrong: the median over
  /// nominal drives (`credo simulate random`, seeds 91001 to 91006). It is above 1 as some readings are always far off,
  /// which robust weights keep out of the pose.
  double usual = 1.3;
  double outlier = 25.0;     ///< at most as much counts of one observation, its squared residual
  double memory = 0.6;       ///< the weight that an acquisition has in the next one
  double usual_dofs = 10.0;  ///< degrees of freedom with the usual misfit that are taken as known before the first
  double least = 0.6;  ///< of a variance factor: the residuals of few landmarks are small, as the pose follows them
  double contradiction = 4.0;  ///< from this variance factor on landmarks contradict each other
};

/// By how much errors are larger than their covariances say, squared: about 1 where nothing is wrong.
struct VarianceFactors {
  double all = 1.0;
  double walls = 1.0;  ///< of what walls alone say
};

/// How far what is matched contradicts itself, lately: like the variance of unit weight a posteriori of least squares
/// (Birge's ratio, squared), but with outliers counted to a limit, against what is usual, and over the number of the
/// residuals, of which the prior's are not. Sensors in another state than their models have them, a plan less exact
/// than it says, and wrong matches that agree with each other and with nothing else show in it.
class Misfit {
 public:
  explicit Misfit(const MisfitParams& params = {});

  /// One acquisition. \param observations  those of the solution
  void add(std::span<const Observation> observations, const PoseSolution& solution);

  [[nodiscard]] VarianceFactors variance_factors() const { return {factor_of(all_), factor_of(walls_)}; }
  [[nodiscard]] bool contradicting() const { return variance_factors().all > params_.contradiction; }

 private:
  /// Squared residuals and degrees of freedom, the latest ones weighing most.
  struct Sum {
    double squares = 0.0;
    double dofs = 0.0;
  };
  void remember(const Sum& latest, Sum& sum) const;
  [[nodiscard]] double factor_of(const Sum& sum) const;

  MisfitParams params_;
  Sum all_, walls_;
};

}  // namespace credo::localization
