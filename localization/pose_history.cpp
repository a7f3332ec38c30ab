// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_history.hpp"

namespace credo::localization {

using geometry::Pose2;
using geometry::PoseEstimate;

void PoseHistory::add(const Fix& fix) {
  before_ = latest_;
  latest_ = fix;
}

void PoseHistory::forget() {
  before_.reset();
  latest_.reset();
}

evidence::Believed<PoseEstimate> PoseHistory::pose_at(sensors::Timestamp time) const {
  const bool between = before_ && time < latest_->time && time >= before_->time;
  const Fix& anchor = between ? *before_ : *latest_;
  PoseEstimate estimate = anchor.estimate;
  estimate.pose = anchor.estimate.pose * path_.motion(anchor.time, time);
  if (!between) return {estimate, anchor.belief};
  const double share =
      sensors::seconds_between(before_->time, time) / sensors::seconds_between(before_->time, latest_->time);
  const Pose2 arrived = before_->estimate.pose * path_.motion(before_->time, latest_->time);
  const Pose2 missed = arrived.inverse() * latest_->estimate.pose;
  estimate.pose = estimate.pose * geometry::interpolate({}, missed, share);
  estimate.covariance = (1.0 - share) * before_->estimate.covariance + share * latest_->estimate.covariance;
  const bool earlier_is_weaker = before_->belief.pignistic() < latest_->belief.pignistic();
  return {estimate, earlier_is_weaker ? before_->belief : latest_->belief};
}

}  // namespace credo::localization
