// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evaluation/baseline_jcbb.hpp"
#include "evaluation/baseline_localizer.hpp"
#include "geometry/floor_plan.hpp"
#include "localization/landmark_map.hpp"
#include "localization/observations.hpp"

namespace credo::evaluation {

enum class EkfAssociation { kNearestNeighbour, kJointCompatibility };

struct EkfParams {
  EkfAssociation association = EkfAssociation::kNearestNeighbour;
  double gate_probability = 0.99;  ///< of the chi-square gate on each pairing
  JointCompatibilityParams joint;
  int iterations = 3;          ///< of the update, relinearised (Bell and Cathey 1993)
  double beyond_wall_m = 0.3;  ///< an observed wall's centroid may lie this far beyond the map's
  double lost_above_m = 0.25;  ///< what its confidence is about: the error stays below both
  double lost_above_deg = 5.0;
  localization::LandmarkMapParams map;           ///< as Credo's
  localization::ObservationParams observations;  ///< as Credo's
};

/// Extended Kalman filter on the primitives of a scene (Leonard and Durrant-Whyte 1991; Thrun, Burgard and Fox 2005,
/// sec. 7.5): walls as lines, corners and edges as points, radial lines as bearings. It knows the noise that Credo's
/// solver knows: of each primitive, of odometry, of the plan, and of the mounting, whose errors all readings of an
/// instrument share (they are part of the state during an update). Unlike Credo it takes the plan's and the mounting's
/// errors as new in every scene. Its confidence: the probability that its Gaussian gives to an error below both
/// limits (axis by axis), times the share of the primitives that it matched.
class EkfLocalizer {
 public:
  /// \param initial  its covariance is positive definite
  EkfLocalizer(const geometry::FloorPlan& plan, const sensors::Rig& rig, const geometry::PoseEstimate& initial,
               const EkfParams& params = {});

  localization::Localization update(const perception::Scene& scene,
                                    const std::optional<geometry::PoseEstimate>& motion);

 private:
  using State = localization::PoseState;

  [[nodiscard]] Pairings pairings(const perception::Scene& scene, const geometry::Pose2& pose,
                                  const State::Matrix& covariance) const;
  void pair(const perception::Scene& scene, const perception::Primitive& seen, tracking::LandmarkId landmark,
            const geometry::Pose2& pose, const State::Matrix& covariance, std::vector<Pairing>& found) const;
  [[nodiscard]] bool may_be(const perception::Primitive& seen, tracking::LandmarkId landmark,
                            const geometry::Pose2& pose) const;
  [[nodiscard]] std::vector<localization::Observation> observations(const perception::Scene& scene,
                                                                    const Pairings& pairings,
                                                                    const std::vector<int>& chosen,
                                                                    const geometry::Pose2& pose) const;
  [[nodiscard]] geometry::PoseEstimate corrected(const geometry::Pose2& predicted, const State::Matrix& covariance,
                                                 const std::vector<localization::Observation>& seen) const;

  EkfParams params_;
  localization::LandmarkMap map_;
  Eigen::Matrix<double, 6, 6> common_errors_;  ///< covariance of the scan's (x, y, theta) and of the camera's
  BaselineMotion motion_;
  JointCompatibility joint_;
  double gates_[3] = {};  ///< of a squared distance, by degrees of freedom
};
static_assert(Localizer<EkfLocalizer>);

}  // namespace credo::evaluation
