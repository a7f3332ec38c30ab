// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "localization/pose_solver.hpp"

namespace credo::evaluation {

/// A landmark that an observation may be, linearised at the prediction: residual + by_state * error + noise = 0.
struct Pairing {
  tracking::LandmarkId landmark = tracking::kNoLandmark;
  bool exclusive = true;  ///< the landmark is seen once; a wall may be seen in pieces
  int rows = 2;           ///< 1: the second row is zero, with unit noise
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();
  localization::PoseState::Jacobian by_state = localization::PoseState::Jacobian::Zero();
  Eigen::Matrix2d noise = Eigen::Matrix2d::Identity();
  double distance_squared = 0.0;  ///< Mahalanobis, of this pairing alone
};

/// By observation, those that are compatible on their own, nearest first.
using Pairings = std::vector<std::vector<Pairing>>;

/// Each observation takes its nearest landmark; of several that want one that is seen once, the nearest gets it.
/// \returns by observation, the index of its pairing or -1
[[nodiscard]] std::vector<int> nearest_neighbours(const Pairings& pairings);

struct JointCompatibilityParams {
  double probability = 0.99;  ///< of the chi-square gate on the joint distance
  int most_nodes = 20'000;    ///< of the tree that are looked at: the best until then counts
};

/// Joint compatibility branch and bound (Neira and Tardos, IEEE Trans. Robotics and Automation 17(6), 2001): the
/// largest set of pairings whose residuals are compatible all together, as is each set on the way to it; of equally
/// large ones, the nearest. One prediction error explains them all, which tells apart what looks equally likely one by
/// one.
class JointCompatibility {
 public:
  explicit JointCompatibility(const JointCompatibilityParams& params = {}) : params_(params) {}

  /// \param covariance  of the state's error, which the residuals share
  /// \returns by observation, the index of its pairing or -1
  [[nodiscard]] std::vector<int> associate(const Pairings& pairings, const localization::PoseState::Matrix& covariance);

 private:
  void reach(std::size_t degrees);

  JointCompatibilityParams params_;
  std::vector<double> limits_{0.0};  ///< of the squared distance, by degrees of freedom
};

}  // namespace credo::evaluation
