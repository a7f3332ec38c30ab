// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_hypotheses.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/principal_axes.hpp"

namespace credo::localization {
namespace {

using geometry::PoseEstimate;
using perception::Scene;

bool meet(const geometry::Pose2& a, const geometry::Pose2& b, double within_m, double within_rad) {
  return (a.translation() - b.translation()).norm() < within_m &&
         std::abs(geometry::angle_difference(a.theta, b.theta)) < within_rad;
}

}  // namespace

void PoseHypotheses::clear() {
  tracked_.clear();
  held_.clear();
  none_ = 0.0;
  checked_ = false;
  scenes_ = 0;
}

PoseHypotheses::Held* PoseHypotheses::held_near(const geometry::Pose2& pose) {
  const auto found = std::find_if(held_.begin(), held_.end(), [&](const Held& held) {
    return meet(held.estimate.pose, pose, params_.meet_m, params_.meet_rad);
  });
  return found == held_.end() ? nullptr : &*found;
}

void PoseHypotheses::update(const Scene& scene, const PoseEstimate& motion) {
  ++scenes_;
  if (held_.empty()) {
    start(scene);
  } else {
    carry(scene, motion);
    if (scene.range_finder_seen) {
      weigh(std::min(1.0, motion.pose.translation().norm() / params_.fresh_way_m));
      doubt();
      if (none_ > params_.search_from_none)
        // What is searched for is one of the poses that "none of these" stands for.
        search_again(scene, params_.depth, none_ + params_.most_at_once);
    }
  }
  checked_ = convincing();
  if (checked_) search_again(scene, params_.rival_within, -params_.rival_behind);
  fit_best(scene);
}

/// All poses that may explain the scene, and the tracked ones.
void PoseHypotheses::start(const Scene& scene) {
  for (const PoseEstimate& pose : tracked_) {
    const PoseCandidate refined = search_->refine(scene, pose);
    held_.push_back({.estimate = refined.estimate, .now = refined.plausibility, .scenes = 1});
  }
  tracked_.clear();
  for (const PoseCandidate& candidate : search_->search(scene))
    held_.push_back({.estimate = candidate.estimate, .now = candidate.plausibility, .scenes = 1});
  weigh(1.0);
  doubt();
}

/// Moves all; refines them where something is seen.
void PoseHypotheses::carry(const Scene& scene, const PoseEstimate& motion) {
  const Eigen::Matrix3d unknown =
      Eigen::Vector3d(params_.settled_m, params_.settled_m, params_.settled_rad).cwiseAbs2().asDiagonal();
  for (Held& held : held_) {
    held.estimate = geometry::compose(held.estimate, motion);
    held.way_m += motion.pose.translation().norm();
    held.turn_rad += std::abs(motion.pose.theta);
    if (!scene.range_finder_seen) continue;
    const PoseCandidate refined = search_->refine(scene, held.estimate);
    held.estimate = {refined.estimate.pose, refined.estimate.covariance + unknown};
    held.now = refined.plausibility;
    ++held.scenes;
  }
}

/// Adds the latest scene's log ratios.
/// \param freshness  0..1, as how much of a witness of its own the scene counts
void PoseHypotheses::weigh(double freshness) {
  if (held_.empty()) return;
  double best_now = held_.front().now.log_ratio;
  for (const Held& held : held_) best_now = std::max(best_now, held.now.log_ratio);
  for (Held& held : held_) {
    const double lacking = best_now - held.now.log_ratio - params_.model_error;
    held.log -= freshness * std::clamp(lacking, 0.0, params_.most_at_once);
  }
  tidy();
}

/// "None of these" against the pose that all scenes speak for, not the one that fits the latest best.
void PoseHypotheses::doubt() {
  if (held_.empty()) return;
  none_ -= std::clamp(held_.front().now.log_ratio, -params_.most_at_once, params_.most_at_once);
  none_ = std::clamp(none_, -params_.most_against_none, params_.most_against_none);
}

/// Candidates that are not held yet join, as plausible as `log_of_best` and what they lack to the best pose held. Where
/// one is held but did not find its way from where the wheels led (they slipped in a turn, and what is near fits
/// nowhere), it is put there, and what it lacked on the way is not held against it.
/// \param within  log ratio behind that pose at which a candidate does not join
void PoseHypotheses::search_again(const Scene& scene, double within, double log_of_best) {
  const double best_now = held_.front().now.log_ratio;
  double ahead = 0.0;
  kept_.clear();
  for (const PoseCandidate& candidate : search_->search(scene)) {
    const double behind = candidate.plausibility.log_ratio - best_now;
    if (behind < -within) break;
    const double log = log_of_best + std::clamp(behind, -params_.most_at_once, 0.0);
    if (Held* held = held_near(candidate.estimate.pose)) {
      if (candidate.plausibility.log_ratio < held->now.log_ratio + params_.model_error) continue;
      held->estimate = candidate.estimate;
      held->now = candidate.plausibility;
      held->log = std::max(held->log, std::min(log, 0.0));
      continue;
    }
    ahead = std::max(ahead, log);
    kept_.push_back({.estimate = candidate.estimate, .log = log, .now = candidate.plausibility, .scenes = 1});
  }
  held_.insert(held_.end(), kept_.begin(), kept_.end());
  none_ -= ahead;
  tidy();
}

/// By falling log from 0; those that have met become one; what is far behind and contradicted again goes.
void PoseHypotheses::tidy() {
  if (held_.empty()) return;
  std::stable_sort(held_.begin(), held_.end(), [](const Held& a, const Held& b) { return a.log > b.log; });
  const Held best = held_.front();
  kept_.clear();
  for (const Held& held : held_) {
    if (kept_.size() >= params_.most) break;
    const double log = held.log - best.log;
    if (log < -params_.depth && held.now.log_ratio < best.now.log_ratio - params_.most_at_once) continue;
    const bool met = std::any_of(kept_.begin(), kept_.end(), [&](const Held& better) {
      return meet(held.estimate.pose, better.estimate.pose, params_.meet_m, params_.meet_rad);
    });
    if (met) continue;
    kept_.push_back(held);
    kept_.back().log = std::max(log, -params_.depth);
  }
  held_.swap(kept_);
}

/// What the scene's primitives say from the best pose.
void PoseHypotheses::fit_best(const Scene& scene) {
  if (held_.empty()) return;
  const PoseEstimate& best = held_.front().estimate;
  fitter_->fit_anew(scene, best, fitter_->uncalibrated(best), best_);
  fitter_->gather(scene, best_);
}

double PoseHypotheses::plausibility_of_none() const { return held_.empty() ? 1.0 : std::exp(std::min(0.0, none_)); }

double PoseHypotheses::belief_in_best() const {
  if (held_.empty() || none_ >= 0.0) return 0.0;
  const double second = held_.size() > 1 ? std::exp(held_[1].log) : 0.0;
  return 1.0 - std::max(second, plausibility_of_none());
}

std::vector<Hypothesis> PoseHypotheses::listed() const {
  std::vector<Hypothesis> list;
  const double best = std::exp(std::min(0.0, -none_));
  for (const Held& held : held_) {
    const double plausibility = best * std::exp(held.log);
    if (plausibility < params_.shown_plausibility) break;
    list.push_back({held.estimate.pose, list.empty() ? belief_in_best() : 0.0, plausibility});
  }
  return list;
}

double PoseHypotheses::lead_over(const geometry::Pose2& pose) const {
  for (const Held& held : held_)
    if (meet(held.estimate.pose, pose, params_.meet_m, params_.meet_rad)) return -held.log;
  return params_.depth;
}

/// All that is asked of a resolved pose, but that rivals have been searched for.
bool PoseHypotheses::convincing() const {
  if (held_.empty()) return false;
  const Held& held = held_.front();
  const Eigen::Matrix3d& P = held.estimate.covariance;
  const double sigma_m = std::sqrt(geometry::largest_variance(P.topLeftCorner<2, 2>()));
  return belief_in_best() >= params_.least_belief && held.now.log_ratio >= params_.least_log_ratio &&
         held.now.scan_share() >= params_.least_scan_share && held.scenes >= params_.least_scenes &&
         (held.way_m >= params_.least_way_m || held.turn_rad >= params_.least_turn_rad) &&
         sigma_m <= params_.most_sigma_m && std::sqrt(P(2, 2)) <= params_.most_sigma_rad;
}

}  // namespace credo::localization
