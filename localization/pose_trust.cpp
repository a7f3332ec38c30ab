// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_trust.hpp"

#include <Eigen/Dense>

namespace credo::localization {
namespace {

/// Squared Mahalanobis distance of a pose from where it was foreseen.
double squared_step(const geometry::Pose2& pose, const geometry::PoseEstimate& foreseen) {
  const Eigen::Vector3d step(pose.x - foreseen.pose.x, pose.y - foreseen.pose.y,
                             geometry::angle_difference(pose.theta, foreseen.pose.theta));
  return step.dot(foreseen.covariance.inverse() * step);
}

}  // namespace

void PoseTrust::found(const geometry::PoseEstimate& pose) { reckoned_ = pose; }

void PoseTrust::confirmed() {
  unconfirmed_ = false;
  undoubted_ = params_.trusted_again_after;
}

/// Where nothing is seen there is no evidence against the pose: what was believed fades into not knowing.
evidence::FusedBinaryMass PoseTrust::believe(const LocalizationEvidence& evidence, const evidence::BinaryMass& before,
                                             bool blind) const {
  if (blind) return {evidence::discount(before, params_.blind_reliability), 0.0};
  return localization_belief(evidence, belief_);
}

/// Of a pose that is not where the wheels have led.
bool PoseTrust::borne_out(const LocalizationEvidence& evidence) {
  const bool agrees =
      evidence.camera_seen ? bearing_belief(evidence, belief_).yes >= belief_.bearings.max_yes : undoubted_ > 0;
  borne_out_ = agrees ? borne_out_ + 1 : 0;
  return borne_out_ >= (evidence.camera_seen ? params_.borne_out_after : params_.borne_out_blind_after);
}

void PoseTrust::weigh(const LocalizationEvidence& evidence, const evidence::BinaryMass& before,
                      const Integrity* integrity, Localization& fix) {
  const evidence::BinaryMass on_plan = agreement_belief(evidence, belief_);
  unchecked_ = evidence.scan_agreement && on_plan.no < 0.5 ? 0 : unchecked_ + 1;
  const evidence::FusedBinaryMass belief = believe(evidence, before, integrity != nullptr && fix.detected == 0);
  fix.belief = belief.mass;
  fix.conflict = belief.conflict;
  fix.innovation = squared_step(fix.estimate.pose, reckoned_);
  const bool as_foreseen = fix.innovation <= status_.max_innovation;
  if (integrity != nullptr && !as_foreseen)
    fix.belief = evidence::discount(fix.belief, params_.contradiction_reliability);
  if (integrity != nullptr && unchecked_ > params_.checked_for)
    fix.belief = evidence::discount(fix.belief, params_.unchecked_reliability);

  const evidence::BinaryMass by_camera = bearing_belief(evidence, belief_);
  fix.unrecognised = recognition_belief(evidence, belief_).no > 0.0;
  fix.off_plan = on_plan.no > 0.0;
  fix.contradicted = by_camera.no > 0.0 ||
                     (integrity != nullptr && integrity->instrument_separation > params_.max_instrument_separation);
  // Once doubted, it takes more than not to be doubted.
  const bool recovering = undoubted_ < params_.trusted_again_after;
  const bool recognised = !recovering ||
                          recognition_belief(evidence, belief_).yes >= 0.5 * belief_.recognised.max_yes ||
                          evidence.in_sight < belief_.least_in_sight;
  undoubted_ = !recognised || fix.unrecognised || fix.off_plan || fix.contradicted ? 0 : undoubted_ + 1;
  fix.doubted = unconfirmed_ || undoubted_ < params_.trusted_again_after;
  in_place_ = integrity == nullptr || (as_foreseen && undoubted_ > 0) || (!as_foreseen && borne_out(evidence));
  if (as_foreseen) borne_out_ = 0;
}

void PoseTrust::go_on_from(const geometry::PoseEstimate& pose) {
  if (in_place_) reckoned_ = pose;
}

}  // namespace credo::localization
