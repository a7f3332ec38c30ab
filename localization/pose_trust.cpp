// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_trust.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace credo::localization {
namespace {

Eigen::Vector3d difference(const geometry::Pose2& a, const geometry::Pose2& b) {
  return {a.x - b.x, a.y - b.y, geometry::angle_difference(a.theta, b.theta)};
}

}  // namespace

void PoseTrust::found(const geometry::PoseEstimate& pose) {
  reckoned_ = pose;
  strayed_ = false;
}

void PoseTrust::given(const geometry::PoseEstimate& pose) {
  found(pose);
  in_place_ = true;
  unconfirmed_ = false;
  borne_out_ = undoubted_ = 0;
}

void PoseTrust::confirmed() {
  unconfirmed_ = false;
  undoubted_ = std::max(params_.trusted_again_after, params_.trusted_again_alone_after);
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

/// Whether too little time has gone since a doubt. One instrument alone agrees more easily with what it has told
/// before.
bool PoseTrust::recovering(const LocalizationEvidence& evidence) const {
  const bool alone = !evidence.camera_seen || !evidence.range_finder_seen;
  return undoubted_ < (alone ? params_.trusted_again_alone_after : params_.trusted_again_after);
}

void PoseTrust::weigh(const LocalizationEvidence& evidence, const evidence::BinaryMass& before,
                      const Integrity* integrity, Localization& fix) {
  const evidence::BinaryMass on_plan = agreement_belief(evidence, belief_);
  unchecked_ = evidence.scan_agreement && on_plan.no < 0.5 ? 0 : unchecked_ + 1;
  const evidence::FusedBinaryMass belief = believe(evidence, before, integrity != nullptr && fix.detected == 0);
  fix.belief = belief.mass;
  fix.conflict = belief.conflict;
  const Eigen::Vector3d step = difference(fix.estimate.pose, reckoned_.pose);  // from where it was foreseen
  fix.innovation = step.dot(reckoned_.covariance.inverse() * step);
  const bool as_foreseen = fix.innovation <= (strayed_ ? params_.returned_innovation : status_.max_innovation);
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
  const bool recognised = !recovering(evidence) ||
                          recognition_belief(evidence, belief_).yes >= 0.5 * belief_.recognised.max_yes ||
                          evidence.in_sight < belief_.least_in_sight;
  undoubted_ = is_contested(fix) || !recognised ? 0 : undoubted_ + 1;
  in_place_ = integrity == nullptr || (as_foreseen ? undoubted_ > 0 : borne_out(evidence));
  strayed_ = !as_foreseen && !in_place_;
  if (as_foreseen) borne_out_ = 0;
  // The robot is here or where the wheels have led.
  if (strayed_) fix.estimate.covariance += 0.5 * step * step.transpose();
  fix.doubted = unconfirmed_ || recovering(evidence) || strayed_;
}

void PoseTrust::go_on_from(const geometry::PoseEstimate& pose) {
  if (in_place_) reckoned_ = pose;
}

}  // namespace credo::localization
