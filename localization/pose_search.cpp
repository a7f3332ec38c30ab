// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// Looking for the pose, nearby and in the whole plan.

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "localization/localizer_state.hpp"

namespace credo::localization {
namespace {

using Eigen::Matrix3d;
using geometry::Pose2;
using geometry::PoseEstimate;
using perception::Scene;

/// Second moment of poses about one of them, weighted by their plausibilities.
Matrix3d spread(const std::vector<Hypothesis>& hypotheses, const Pose2& about) {
  Matrix3d sum = Matrix3d::Zero();
  double total = 0.0;
  for (const Hypothesis& h : hypotheses) {
    const Eigen::Vector3d off(h.pose.x - about.x, h.pose.y - about.y,
                              geometry::angle_difference(h.pose.theta, about.theta));
    sum += h.plausibility * off * off.transpose();
    total += h.plausibility;
  }
  return sum / total;
}

}  // namespace

/// By which two ways to match a scene are compared: the belief in the pose and the share of what is seen that it
/// explains.
double Localizer::State::quality(const SceneFit& of, const Scene& scene) const {
  const double share = of.evidence.matched / std::max(1.0, static_cast<double>(scene.primitives.size()));
  return localization_belief(of.evidence, params.belief).mass.pignistic() + params.matched_share_weight * share;
}

/// Far less is matched than in the acquisition before.
bool Localizer::State::lost_sight() const {
  return fit.evidence.matched < params.search_matched_below * matched_before;
}

/// Gathers the evidence about the pose. Primitives that were matched wrongly agree with the wrong pose that they make;
/// the raw scan and the landmarks that should be in sight do not. Where these speak against the pose, everything is
/// matched anew from the pose nearby from which the scan lies best on the plan, and what is believed more is kept.
void Localizer::State::search_pose(const Scene& scene, bool odometry) {
  fitter.gather(scene, fit);
  if (!fit.evidence.scan_agreement) return;
  const bool off_plan = *fit.evidence.scan_agreement < params.search_below;
  const bool unrecognised = recognition_belief(fit.evidence, params.belief).no > 0.0;
  if (!off_plan && !unrecognised && !lost_sight()) return;
  wide = predicted;
  widen(wide, doubt());
  if (match_anew(scene, wide) || odometry) return;
  const double turn = params.unforeseen_turn_sigma_rad;
  widen(wide, Eigen::Vector3d(0.0, 0.0, turn * turn).asDiagonal());
  // Without wheels only matches that go on show that the robot has not turned round.
  if (!match_anew(scene, wide) && lost_sight()) jumped = true;
}

/// Matches everything from the pose that the scan fits best about an expected one.
/// \returns whether that is better than what was there, which is kept else.
bool Localizer::State::match_anew(const Scene& scene, const CalibratedPose& expected) {
  const double position = params.searched_sigma_m * params.searched_sigma_m;
  const double turn = params.searched_sigma_rad * params.searched_sigma_rad;
  const PoseEstimate found{fitter.scan_matcher().search(scene.points, {expected.pose, expected.covariance()}),
                           Eigen::Vector3d(position, position, turn).asDiagonal()};
  fitter.fit_anew(scene, found, expected, other);
  fitter.gather(scene, other);
  if (!(quality(other, scene) > quality(fit, scene) + params.search_gain)) return false;
  std::swap(fit, other);
  jumped = jumped || (fit.pose.pose.translation() - expected.pose.translation()).norm() > params.hypotheses.meet_m;
  labels.forget_all(tracker);
  return true;
}

/// The plan does not look as it should from the pose.
bool Localizer::State::doubtful() const {
  return agreement_belief(fit.evidence, params.belief).no > 0.0 ||
         recognition_belief(fit.evidence, params.belief).no > 0.0;
}

/// Follows all poses that the robot may have, from when the pose is doubted, or has jumped, until one is left. That one
/// is taken.
void Localizer::State::look_elsewhere(const Scene& scene, const PoseEstimate& motion) {
  if (params.method == perception::Method::kPaper || map.empty()) return;
  doubted = absolute && doubtful() ? doubted + 1 : 0;
  if (absolute && elsewhere.empty()) {
    if (doubted < params.doubts_before_search && !jumped && !trust.waits_for_a_search()) return;
    elsewhere.add(fit.pose);
  }
  if (absolute && jumped) trust.jumped();
  elsewhere.update(scene, motion);
  if (!elsewhere.resolved()) return;
  const SceneFit& best = *elsewhere.best();
  const bool is_tracked = absolute && elsewhere.lead_over(fit.pose.pose) == 0.0;
  // What was seen while an instrument lied may speak for a pose that explains less now than the tracked one.
  if (!absolute || (!is_tracked && quality(best, scene) > quality(fit, scene))) {
    go_to(best);
    trust.confirmed();
  } else if (is_tracked) {
    trust.confirmed();
  }
  elsewhere.clear();
}

/// The pose is another one than was thought. What was learned about the instruments may rest on wrong matches: it is
/// learned anew.
void Localizer::State::go_to(const SceneFit& found) {
  fit = found;
  labels.forget_all(tracker);
  misfit = Misfit(params.misfit);
  absolute = found_elsewhere = true;
  doubted = 0;
  trust.found(fit.estimate());
}

/// What is known of other poses, while they are looked for. Before there is an absolute pose the most plausible one is
/// told, believed as far as the others are implausible.
void Localizer::State::report_hypotheses(Localization& fix) const {
  if (elsewhere.empty()) return;
  fix.hypotheses = elsewhere.listed();
  fix.elsewhere = absolute && elsewhere.lead_over(fit.pose.pose) > params.elsewhere_lead;
  if (!absolute && !fix.hypotheses.empty()) {
    const double believed = fix.hypotheses.front().belief;
    fix.estimate = elsewhere.best()->estimate();
    fix.belief = {.yes = believed, .no = 0.0, .unknown = 1.0 - believed};
    fix.matched = elsewhere.best()->evidence.matched;
    fix.reason = "the place is not confirmed yet";
  }
  if (fix.hypotheses.size() < 2) {
    fix.hypotheses.clear();
    return;
  }
  fix.estimate.covariance += spread(fix.hypotheses, fix.estimate.pose);
  fix.status = Status::kAmbiguous;
  fix.reason = "several poses fit: a place that looks like others";
}

}  // namespace credo::localization
