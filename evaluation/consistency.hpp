// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
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
  int dimension = 3;
  std::vector<std::size_t> indices = {};  ///< those where every run has an error
  std::vector<double> anees = {};         ///< at each of them, over the runs
  Bounds bounds = {};                     ///< 95 %, of one index
  double share_inside = 0.0;              ///< of the indices
  double mean = 0.0;
  /// At least 90 % of the indices inside the bounds, and the mean within a third of the dimension: in 2..4 for a pose.
  [[nodiscard]] bool met() const {
    return share_inside >= 0.9 && 3.0 * mean >= 2.0 * dimension && 3.0 * mean <= 4.0 * dimension;
  }
};

/// \param nees_by_run  runs x indices; nan where there is no error; indices beyond the shortest run are left out
/// \param dimension  of the error: 3 for a pose, 2 for a position, 1 for a heading
/// \throws std::invalid_argument if there is no index where every run has an error
[[nodiscard]] Consistency consistency(std::span<const std::vector<double>> nees_by_run, int dimension = 3);

}  // namespace credo::evaluation
