// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/pose.hpp"

namespace credo::evaluation {

/// Normalised estimation error squared e^T P^-1 e, with e = truth - estimate (theta wrapped) and P in the map frame,
/// which is how PoseEstimate defines its covariance (Bar-Shalom et al., Estimation with Applications, sec. 5.4).
/// Expected: 3.
/// \returns infinity for a covariance that is not positive definite
[[nodiscard]] double nees(const geometry::PoseEstimate& estimate, const geometry::Pose2& truth);
/// Of the position alone. Expected: 2.
[[nodiscard]] double position_nees(const geometry::PoseEstimate& estimate, const geometry::Pose2& truth);
/// Of the heading alone. Expected: 1.
[[nodiscard]] double heading_nees(const geometry::PoseEstimate& estimate, const geometry::Pose2& truth);

/// P(X <= x) for X ~ chi-square with `degrees` degrees of freedom.
[[nodiscard]] double chi_square_cdf(double x, double degrees);
/// The x with chi_square_cdf(x, degrees) = probability. Precondition: 0 < probability < 1.
[[nodiscard]] double chi_square_quantile(double probability, double degrees);

/// Where the average of N independent NEES values of `dimension` lies with the given probability (two-sided).
struct Bounds {
  double lower = 0.0;
  double upper = 0.0;
};
[[nodiscard]] Bounds anees_bounds(int runs, int dimension, double probability = 0.95);

/// ANEES of N independent runs: by the index of the acquisition, and over all of it.
struct Consistency {
  int runs = 0;
  std::vector<double> anees = {};  ///< by index, over the runs
  Bounds bounds = {};              ///< 95 %, of one index
  double share_inside = 0.0;       ///< of the indices
  double mean = 0.0;
  /// At least 90 % of the indices inside the bounds, and the mean in 2..4.
  [[nodiscard]] bool met() const { return share_inside >= 0.9 && mean >= 2.0 && mean <= 4.0; }
};

/// \param nees_by_run  runs x indices, of dimension 3; indices beyond the shortest run are left out
/// \throws std::runtime_error if there is no run, or an empty one
[[nodiscard]] Consistency consistency(std::span<const std::vector<double>> nees_by_run);

}  // namespace credo::evaluation
