// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>

#include "localization/distance_field.hpp"
#include "localization/landmark_map.hpp"
#include "sensors/acquisition.hpp"

namespace credo::localization {

struct ScanAgreementParams {
  int most_points = 120;        ///< of a scan that are looked at, evenly chosen
  int least_points = 30;        ///< fewer say nothing
  double on_plan_m = 0.10;      ///< a point this near to a wall of the plan, and
  double on_plan_sigmas = 2.0;  ///< so many of its standard deviations, lies on it
  double before_weight = 0.10;  ///< of a point in the plan's free space: something may have been put there

  // The search, in steps around the pose that is expected.
  double search_sigmas = 2.5;       ///< how far, in the expected pose's standard deviations, but
  double search_at_most_m = 1.0;    ///< no farther
  double search_at_most_rad = 1.6;  ///< and no turn larger
  double search_step_m = 0.10;
  double search_step_rad = 0.0262;  ///< 1.5 degrees
  double prior_weight = 0.004;      ///< of a squared Mahalanobis distance from the expected pose, against the mean fit
};

/// How a scan lies on the plan as seen from a pose. Counts of points.
struct ScanAgreement {
  int on_plan = 0;
  int before = 0;  ///< where the plan has free space
  int behind = 0;  ///< behind a wall of the plan: it cannot be seen there

  /// The share of what says something that agrees; nothing for fewer than least_points.
  [[nodiscard]] std::optional<double> share(const ScanAgreementParams& params = {}) const;
};

/// The raw scan against the plan. The primitives that a pose rests on agree with it by their choice; the points do not.
class ScanMatcher {
 public:
  /// \param map  must outlive this
  explicit ScanMatcher(const LandmarkMap& map, const ScanAgreementParams& params = {});

  /// No points where the plan is so large (kilometres) that the field is coarser than on_plan_m.
  /// \param points  in the base frame
  [[nodiscard]] ScanAgreement compare(std::span<const sensors::ScanPoint> points,
                                      const geometry::Pose2& T_map_base) const;

  [[nodiscard]] const DistanceField& field() const { return field_; }

  /// The pose about an expected one from which most points lie near walls: exhaustive in steps (Olson, ICRA 2009), then
  /// refined. Where the plan looks the same along a direction the expected pose decides.
  /// \param expected  its covariance is positive definite
  [[nodiscard]] geometry::Pose2 search(std::span<const sensors::ScanPoint> points,
                                       const geometry::PoseEstimate& expected);

 private:
  [[nodiscard]] double fit(const geometry::Pose2& pose) const;

  const LandmarkMap* map_;
  ScanAgreementParams params_;
  DistanceField field_;
  std::vector<Eigen::Vector2d> chosen_;  ///< points of the search
  std::vector<Eigen::Vector2d> turned_;  ///< the same, turned into the map's directions
};

}  // namespace credo::localization
