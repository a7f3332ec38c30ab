// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/poses_by_hand.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "datasets/trajectory.hpp"

namespace credo::apps {
namespace {

void require_within(const std::vector<sensors::Timestamp>& times, sensors::Timestamp time) {
  if (!times.empty() && time >= times.front() && time <= times.back()) return;
  const std::string drive =
      times.empty() ? ", which has no acquisition"
                    : ", " + datasets::to_seconds(times.front()) + " to " + datasets::to_seconds(times.back()) + " s";
  throw std::runtime_error("--pose-at: found the time " + datasets::to_seconds(time) + " s, expected one of the drive" +
                           drive);
}

}  // namespace

PosesByHand::PosesByHand(const datasets::Dataset& dataset, const std::vector<sensors::Timestamp>& times,
                         std::vector<datasets::TimedPose> poses)
    : poses_(std::move(poses)),
      covariance_(dataset.header.initial_pose ? dataset.header.initial_pose->covariance
                                              : datasets::default_initial_covariance()),
      noise_(dataset.header.rig.odometry.value_or(sensors::OdometryNoise{})) {
  for (const datasets::TimedPose& pose : poses_) require_within(times, pose.time);
  std::stable_sort(poses_.begin(), poses_.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
}

std::optional<geometry::PoseEstimate> PosesByHand::next(const sensors::Acquisition& acquisition) {
  std::optional<geometry::PoseEstimate> latest;
  for (; done_ < poses_.size() && poses_[done_].time <= acquisition.time; ++done_)
    latest = geometry::compose({poses_[done_].pose, covariance_},
                               noise_.along(acquisition.path, poses_[done_].time, acquisition.time));
  return latest;
}

}  // namespace credo::apps
