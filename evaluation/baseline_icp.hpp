// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evaluation/baseline_localizer.hpp"
#include "geometry/floor_plan.hpp"

namespace credo::evaluation {

struct IcpParams {
  int iterations = 20;
  double reach_m = 0.5;        ///< points farther from every wall have no partner
  double robust_sigmas = 2.5;  ///< scale of the Cauchy loss, as that of Credo's solver
  double converged_m = 1e-4;   ///< a step below both ends the iterations
  double converged_rad = 1e-5;
  double inlier_m = 0.10;  ///< a point this near to its wall lies on it, for the confidence
};

/// Scan to plan by iterative closest points, point to line (Chen and Medioni 1992; Censi 2008), Cauchy's robust loss,
/// started and held by the prediction where the plan leaves a direction free. Its noise is the rig's: a point's own
/// sigma and the plan's; the mounting's and the carried motion's, which move the whole scan, are added to the
/// covariance. Its confidence: the share of the points that lie on the plan.
class IcpLocalizer {
 public:
  /// \param initial  its covariance is positive definite
  IcpLocalizer(const geometry::FloorPlan& plan, const sensors::Rig& rig, const geometry::PoseEstimate& initial,
               const IcpParams& params = {});

  localization::Localization update(const perception::Scene& scene,
                                    const std::optional<geometry::PoseEstimate>& motion);

  /// The same from a start that is given, whatever came before. \param start  its covariance is positive definite
  localization::Localization update_from(const geometry::PoseEstimate& start, const perception::Scene& scene);

 private:
  IcpParams params_;
  std::vector<geometry::Segment> walls_;
  double plan_variance_ = 0.0;
  Eigen::Matrix3d mounting_ = Eigen::Matrix3d::Zero();
  BaselineMotion motion_;
};
static_assert(Localizer<IcpLocalizer>);

}  // namespace credo::evaluation
