// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_hypotheses.hpp"

#include <algorithm>
#include <cmath>

namespace credo::localization {

using geometry::Pose2;
using geometry::PoseEstimate;
using perception::Scene;

PoseHypotheses::PoseHypotheses(GlobalSearch& search, SceneFitter& fitter, const PoseHypothesesParams& params)
    : search_(&search), fitter_(&fitter), params_(params) {}

void PoseHypotheses::clear() {
  members_.clear();
  none_ = way_m_ = turn_rad_ = 0.0;
  scenes_ = 0;
}

bool PoseHypotheses::same(const Pose2& a, const Pose2& b) const {
  return (a.translation() - b.translation()).norm() < params_.same_m &&
         std::abs(geometry::angle_difference(a.theta, b.theta)) < params_.same_rad;
}

void PoseHypotheses::add(const SplitPose& pose) {
  members_.emplace_back();
  members_.back().fit.pose = pose;
}

double PoseHypotheses::independent_points(const Scene& scene) const {
  return std::min(static_cast<double>(scene.points.size()), static_cast<double>(params_.independent_points));
}

/// Matches the scene anew from where a member expects the robot, and adds what the scene says of it.
void PoseHypotheses::weigh(const Scene& scene, double novelty, Member& member) {
  const SplitPose expected = member.fit.pose;
  fitter_->fit_anew(scene, {expected.pose, expected.covariance()}, expected, member.fit);
  fitter_->gather(scene, member.fit);
  const LocalizationEvidence& evidence = member.fit.evidence;
  member.log_plausibility -=
      novelty * (independent_points(scene) * fitter_->scan_matcher().mean_cost(scene.points, member.fit.pose.pose) +
                 params_.missing_cost * (evidence.in_sight - evidence.recognised));
  ++member.scenes;
}

/// \param history  log plausibility that a place gets for the scenes before, in which it was not there
void PoseHypotheses::look_for_more(const Scene& scene, double history, double novelty) {
  const double position = params_.searched_sigma_m * params_.searched_sigma_m;
  const double turn = params_.searched_sigma_rad * params_.searched_sigma_rad;
  for (const PoseCandidate& candidate : search_->search(scene)) {
    const auto is_it = [&](const Member& m) { return same(m.fit.pose.pose, candidate.pose); };
    if (std::any_of(members_.begin(), members_.end(), is_it)) continue;
    Member member;
    member.fit.pose = {candidate.pose, Eigen::Vector3d(position, position, turn).asDiagonal(), Eigen::Matrix3d::Zero()};
    member.log_plausibility = history;
    weigh(scene, novelty, member);
    members_.push_back(std::move(member));
  }
}

void PoseHypotheses::sort_out() {
  std::stable_sort(members_.begin(), members_.end(),
                   [](const Member& a, const Member& b) { return a.log_plausibility > b.log_plausibility; });
  std::vector<Member> kept;
  for (Member& member : members_) {
    const auto is_it = [&](const Member& m) { return same(m.fit.pose.pose, member.fit.pose.pose); };
    if (std::any_of(kept.begin(), kept.end(), is_it)) continue;
    if (!kept.empty() && member.log_plausibility < kept.front().log_plausibility + params_.drop_below) continue;
    kept.push_back(std::move(member));
  }
  members_ = std::move(kept);
  // Only differences count.
  const double best = members_.empty() ? none_ : members_.front().log_plausibility;
  none_ -= best;
  for (Member& member : members_) member.log_plausibility -= best;
}

void PoseHypotheses::update(const Scene& scene, const PoseEstimate& motion) {
  const double way = scenes_ == 0 ? 0.0 : motion.pose.translation().norm();
  const double turn = scenes_ == 0 ? 0.0 : std::abs(motion.pose.theta);
  const double novelty = scenes_ == 0 ? 1.0 : std::min(1.0, way / params_.novel_m + turn / params_.novel_rad);
  way_m_ += way;
  turn_rad_ += turn;
  for (Member& member : members_) {
    if (scenes_ > 0) member.fit.pose = moved(member.fit.pose, motion);
    weigh(scene, novelty, member);
  }
  const double none_cost = params_.none_cost * independent_points(scene);
  none_ -= novelty * none_cost;
  ++scenes_;
  sort_out();
  const bool none_fits = members_.empty() || none_ > 0.0;
  if (none_fits) {
    // The robot is where none of them is: all starts again.
    way_m_ = turn_rad_ = none_ = 0.0;
    for (Member& member : members_) member.log_plausibility = -0.5 * none_cost;
  }
  if (none_fits || scenes_ <= params_.searches) {
    look_for_more(scene, none_fits ? 0.0 : none_ + novelty * none_cost, none_fits ? 1.0 : novelty);
    if (none_fits) none_ = -none_cost;
    sort_out();
  }
}

std::vector<Hypothesis> PoseHypotheses::listed() const {
  std::vector<Hypothesis> list;
  const double second = std::max(none_, members_.size() > 1 ? members_[1].log_plausibility : none_);
  for (const Member& member : members_) {
    const double plausibility = std::exp(member.log_plausibility);
    if (plausibility < params_.listed_above) break;
    list.push_back({.pose = member.fit.pose.pose,
                    .belief = list.empty() ? 1.0 - std::min(1.0, std::exp(second)) : 0.0,
                    .plausibility = plausibility});
  }
  return list;
}

const SceneFit* PoseHypotheses::best() const { return members_.empty() ? nullptr : &members_.front().fit; }

bool PoseHypotheses::resolved() const {
  if (members_.empty() || members_.front().scenes < params_.resolved_scenes) return false;
  const double second = std::max(none_, members_.size() > 1 ? members_[1].log_plausibility : none_);
  return second < -params_.resolved_gap && (way_m_ >= params_.resolved_way_m || turn_rad_ >= params_.resolved_turn_rad);
}

double PoseHypotheses::lead_over(const Pose2& pose) const {
  for (const Member& member : members_)
    if (same(member.fit.pose.pose, pose)) return -member.log_plausibility;
  return -params_.drop_below;
}

}  // namespace credo::localization
