// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <numbers>
#include <string>

#include "evidence/parameter_check.hpp"
#include "localization/localizer.hpp"

namespace credo::localization {
namespace {

using evidence::ParameterCheck;
using std::numbers::pi;

std::string element(const char* name, std::size_t i) { return std::string(name) + "[" + std::to_string(i) + "]"; }

void check_map(const ParameterCheck& check, const LandmarkMapParams& p) {
  check.not_negative("join_tolerance_m", p.join_tolerance_m);
  check.positive("min_wall_length_m", p.min_wall_length_m);
  check.within("max_collinear_turn_rad", p.max_collinear_turn_rad, 0.0, pi);
  check.within("min_corner_angle_rad", p.min_corner_angle_rad, 0.0, pi);
  check.within("max_corner_angle_rad", p.max_corner_angle_rad, p.min_corner_angle_rad, pi);
  check.not_negative("visibility_margin_m", p.visibility_margin_m);
}

void check_matching(const ParameterCheck& check, const MapMatchingParams& p) {
  check.shape("wall_angle", p.wall_angle);
  check.shape("wall_across", p.wall_across);
  check.shape("wall_excess", p.wall_excess);
  check.positive("farthest_m", p.farthest_m);
  check.positive("wall_end_sigma_m", p.wall_end_sigma_m);
  check.shape("point_range", p.point_range);
  check.shape("point_azimuth", p.point_azimuth);
  check.mass("other_type", p.other_type);
  check.require(p.min_margin >= 0.0 && p.min_margin < 1.0, "min_margin", p.min_margin,
                "a number of at least 0 and below 1");
  check.shape("paper_wall_angle_deg", p.paper_wall_angle_deg);
  check.shape("paper_wall_length_m", p.paper_wall_length_m);
  check.shape("paper_wall_center_m", p.paper_wall_center_m);
  check.shape("paper_point_range_m", p.paper_point_range_m);
  check.shape("paper_point_azimuth_deg", p.paper_point_azimuth_deg);
}

void check_observations(const ParameterCheck& check, const ObservationParams& p) {
  check.positive("min_bearing_sigma_rad", p.min_bearing_sigma_rad);
  check.positive("min_wall_sigma_m", p.min_wall_sigma_m);
  check.positive("min_wall_sigma_rad", p.min_wall_sigma_rad);
  check.not_negative("as_built_sigma_m", p.as_built_sigma_m);
  check.not_negative("as_built_sigma_rad", p.as_built_sigma_rad);
}

void check_solver(const ParameterCheck& check, const PoseSolverParams& p) {
  check.positive("robust_scale", p.robust_scale);
  check.at_least("reweightings", p.reweightings, 1);
  check.positive("doubtful_step", p.doubtful_step);
  check.share("doubtful_share", p.doubtful_share);
  check.between("outlier_probability", p.outlier_probability, 0.0, 1.0);
}

/// A search has at most some hundred steps in each direction: it would not end.
void check_scan(const ParameterCheck& check, const ScanAgreementParams& p) {
  check.at_least("most_points", p.most_points, 1);
  check.at_least("least_points", p.least_points, 1);
  check.positive("on_plan_m", p.on_plan_m);
  check.not_negative("on_plan_sigmas", p.on_plan_sigmas);
  check.share("before_weight", p.before_weight);
  check.positive("search_sigmas", p.search_sigmas);
  check.within("search_at_most_m", p.search_at_most_m, 0.0, 10.0);
  check.within("search_at_most_rad", p.search_at_most_rad, 0.0, 3.2);
  check.within("search_step_m", p.search_step_m, 0.01, 10.0);
  check.within("search_step_rad", p.search_step_rad, 0.002, 3.2);
  check.not_negative("prior_weight", p.prior_weight);
}

void check_evidence(const ParameterCheck& check, const LocalizationEvidenceParams& p) {
  check.not_negative("on_plan_sigmas", p.on_plan_sigmas);
  check.not_negative("on_plan_m", p.on_plan_m);
  check.not_negative("on_plan_at_most_m", p.on_plan_at_most_m);
  check.share("on_plan_weight", p.on_plan_weight);
  check.share("unmapped_weight", p.unmapped_weight);
  check.positive("sight_m", p.sight_m);
  check.not_negative("clutter_m", p.clutter_m);
  check.within("beside_rad", p.beside_rad, 0.0, pi);
}

void check_bearings(const ParameterCheck& check, const BearingAgreementParams& p) {
  check.not_negative("nearest_m", p.nearest_m);
  check.positive("sight_m", p.sight_m);
  check.require(p.sight_m > p.nearest_m, "sight_m", p.sight_m, "a number above nearest_m");
  check.within("agree_rad", p.agree_rad, 1e-4, pi);  // bins of the votes are as wide
  check.within("turned_at_most_rad", p.turned_at_most_rad, 0.0, pi);
  check.at_least("least_votes", p.least_votes, 1);
}

void check_fit(const ParameterCheck& check, const SceneFitParams& p) {
  check_matching(check.in("matching"), p.matching);
  check_observations(check.in("observations"), p.observations);
  check_solver(check.in("solver"), p.solver);
  check_scan(check.in("scan"), p.scan);
  check_evidence(check.in("evidence"), p.evidence);
  check_bearings(check.in("bearings"), p.bearings);
  check.at_least("matching_rounds", p.matching_rounds, 1);
}

void check_belief(const ParameterCheck& check, const LocalizationBeliefParams& p) {
  check.shape("count", p.count);
  check.shape("ratio", p.ratio);
  check.shape("recognised", p.recognised);
  check.shape("scan_agreement", p.scan_agreement);
  check.shape("bearings", p.bearings);
  check.shape("separation", p.separation);
  check.at_least("least_in_sight", p.least_in_sight, 1);
  check.share("wall_reliability", p.wall_reliability);
  check.share("other_reliability", p.other_reliability);
}

void check_interval(const ParameterCheck& check, const ProbabilityInterval& interval) {
  check.share("low", interval.low);
  check.within("high", interval.high, interval.low, 1.0);
}

void check_integrity(const ParameterCheck& check, const IntegrityParams& p) {
  check.between("risk", p.risk, 0.0, 1.0);
  double from = 0.0;
  for (std::size_t i = 0; i < p.point_faults.size(); ++i) {
    const ParameterCheck of = check.in(element("point_faults", i));
    of.within("from_belief", p.point_faults[i].from_belief, from, i == 0 ? 0.0 : 1.0);
    check_interval(of.in("fault"), p.point_faults[i].fault);
    from = p.point_faults[i].from_belief;
  }
  check_interval(check.in("wall_fault"), p.wall_fault);
  check_interval(check.in("points_together"), p.points_together);
  check.positive("sigma_overbound", p.sigma_overbound);
  check_interval(check.in("instrument_fault"), p.instrument_fault);
  check_interval(check.in("prediction_fault"), p.prediction_fault);
  check.not_negative("slip_m", p.slip_m);
  check.not_negative("slip_rad", p.slip_rad);
}

void check_plausibility(const ParameterCheck& check, const PlausibilityParams& p) {
  check.at_least("most_beams", p.most_beams, 1);
  check.finite("on_plan", p.on_plan);
  check.finite("before", p.before);
  check.finite("behind", p.behind);
  check.positive("on_plan_sigma_m", p.on_plan_sigma_m);
  check.finite("silent_before_wall", p.silent_before_wall);
  check.finite("silent_in_the_open", p.silent_in_the_open);
  check.share("surely_in_reach", p.surely_in_reach);
  check.share("steepest_incidence", p.steepest_incidence);
  check.not_negative("beam_weight", p.beam_weight);
  check.positive("sight_m", p.sight_m);
  check.positive("bearing_sigma_rad", p.bearing_sigma_rad);
  check.not_negative("bearing_sigma_m", p.bearing_sigma_m);
  check.share("recognised_share", p.recognised_share);
  check.between("most_mapped_share", p.most_mapped_share, 0.0, 1.0);
  check.not_negative("bearing_weight", p.bearing_weight);
}

void check_search(const ParameterCheck& check, const GlobalSearchParams& p) {
  check_plausibility(check.in("plausibility"), p.plausibility);
  check.not_negative("least_walls_m", p.least_walls_m);
  check.share("heading_share", p.heading_share);
  check.within("wall_heading_sigma_rad", p.wall_heading_sigma_rad, 1e-4, pi);
  check.within("heading_step_rad", p.heading_step_rad, 1e-3, pi);  // each heading has a lattice of its own
  check.share("least_belief", p.least_belief);
  check.at_least("most_walls", p.most_walls, 1);
  check.not_negative("wall_excess_m", p.wall_excess_m);
  check.between("least_wall_sine", p.least_wall_sine, 0.0, 1.0);
  check.within("coarsest_m", p.coarsest_m, 0.01, 1e3);
  check.within("most_cells", p.most_cells, 1.0, 1e9);
  check.at_least("most_coarser_nodes", static_cast<std::int64_t>(p.most_coarser_nodes), 1);
  for (std::size_t i = 0; i < p.most_nodes.size(); ++i)
    check.at_least(element("most_nodes", i), static_cast<std::int64_t>(p.most_nodes[i]), 1);
  check.finite("least_log_ratio", p.least_log_ratio);
  check.at_least("most_refined", static_cast<std::int64_t>(p.most_refined), 1);
  check.not_negative("seed_apart_m", p.seed_apart_m);
  check.not_negative("seed_apart_rad", p.seed_apart_rad);
  check.positive("seed_sigma_m", p.seed_sigma_m);
  check.positive("seed_sigma_rad", p.seed_sigma_rad);
  check.not_negative("apart_m", p.apart_m);
  check.not_negative("apart_rad", p.apart_rad);
  check.at_least("most_candidates", static_cast<std::int64_t>(p.most_candidates), 1);
  check.not_negative("depth", p.depth);
}

void check_hypotheses(const ParameterCheck& check, const PoseHypothesesParams& p) {
  check.at_least("most", static_cast<std::int64_t>(p.most), 1);
  check.not_negative("meet_m", p.meet_m);
  check.not_negative("meet_rad", p.meet_rad);
  check.positive("settled_m", p.settled_m);
  check.positive("settled_rad", p.settled_rad);
  check.positive("fresh_way_m", p.fresh_way_m);
  check.not_negative("model_error", p.model_error);
  check.positive("most_at_once", p.most_at_once);
  check.not_negative("depth", p.depth);
  check.not_negative("most_against_none", p.most_against_none);
  check.finite("search_from_none", p.search_from_none);
  check.not_negative("rival_within", p.rival_within);
  check.not_negative("rival_behind", p.rival_behind);
  check.share("least_belief", p.least_belief);
  check.finite("least_log_ratio", p.least_log_ratio);
  check.share("least_scan_share", p.least_scan_share);
  check.at_least("least_scenes", p.least_scenes, 1);
  check.not_negative("least_way_m", p.least_way_m);
  check.not_negative("least_turn_rad", p.least_turn_rad);
  check.positive("most_sigma_m", p.most_sigma_m);
  check.positive("most_sigma_rad", p.most_sigma_rad);
  check.share("shown_plausibility", p.shown_plausibility);
}

void check_status(const ParameterCheck& check, const StatusParams& p) {
  check.share("min_belief_yes", p.min_belief_yes);
  check.positive("max_position_sigma_m", p.max_position_sigma_m);
  check.positive("max_innovation", p.max_innovation);
  check.positive("max_heading_sigma_rad", p.max_heading_sigma_rad);
  check.positive("max_protection_m", p.max_protection_m);
  check.positive("max_protection_rad", p.max_protection_rad);
}

void check_continuity(const ParameterCheck& check, const ContinuityParams& p) {
  check.at_least("least_tracks", p.least_tracks, 1);
  check.share("usual", p.usual);
  check.share("memory", p.memory);
  check.share("broken_below", p.broken_below);
}

void check_misfit(const ParameterCheck& check, const MisfitParams& p) {
  check.positive("usual", p.usual);
  check.positive("outlier", p.outlier);
  check.share("memory", p.memory);
  check.positive("usual_dofs", p.usual_dofs);
  check.share("least", p.least);
  check.positive("contradiction", p.contradiction);
}

void check_trust(const ParameterCheck& check, const PoseTrustParams& p) {
  check.share("contradiction_reliability", p.contradiction_reliability);
  check.positive("max_instrument_separation", p.max_instrument_separation);
  check.at_least("checked_for", p.checked_for, 0);
  check.share("unchecked_reliability", p.unchecked_reliability);
  check.share("blind_reliability", p.blind_reliability);
  check.positive("returned_innovation", p.returned_innovation);
  check.at_least("borne_out_after", p.borne_out_after, 1);
  check.at_least("borne_out_blind_after", p.borne_out_blind_after, 1);
  check.at_least("trusted_again_after", p.trusted_again_after, 0);
  check.at_least("trusted_again_alone_after", p.trusted_again_alone_after, 0);
}

void check_constant_velocity(const ParameterCheck& check, const ConstantVelocityParams& p) {
  check.not_negative("translation_sigma_share", p.translation_sigma_share);
  check.positive("translation_sigma_m", p.translation_sigma_m);
  check.not_negative("rotation_sigma_share", p.rotation_sigma_share);
  check.positive("rotation_sigma_rad", p.rotation_sigma_rad);
  check.positive("first_step_m", p.first_step_m);
  check.positive("first_turn_rad", p.first_turn_rad);
  check.within("max_unforeseen_turn_rad", p.max_unforeseen_turn_rad, 0.0, pi);
  check.within("turn_bin_rad", p.turn_bin_rad, 1e-4, pi);
  check.not_negative("turn_lead", p.turn_lead);
  check.share("turn_share", p.turn_share);
}

void check_scan_lines(const ParameterCheck& check, const perception::ScanLineParams& p) {
  check.at_least("min_support", p.min_support, 2);
  check.positive("max_sigma_rad", p.max_sigma_rad);
  check.share("least_pignistic", p.least_pignistic);
  check.within("curved_turn_rad", p.curved_turn_rad, 0.0, pi);
  check.within("straight_turn_rad", p.straight_turn_rad, 0.0, pi);
  check.not_negative("curved_face_m", p.curved_face_m);
}

void check_ego_motion(const ParameterCheck& check, const EgoMotionParams& p) {
  check_scan_lines(check.in("lines"), p.lines);
  check.not_negative("systematic.turn_per_metre_rad", p.systematic.turn_per_metre_rad);
  check.not_negative("systematic.turn_per_radian_rad", p.systematic.turn_per_radian_rad);
  check.positive("min_sigma_across_m", p.min_sigma_across_m);
  check.positive("min_sigma_angle_rad", p.min_sigma_angle_rad);
  check.positive("min_sigma_end_m", p.min_sigma_end_m);
  check.positive("wall_gate", p.wall_gate);
  check.not_negative("apart_m", p.apart_m);
  check.positive("ambiguous_gate", p.ambiguous_gate);
  check.not_negative("same_line_m", p.same_line_m);
  check.positive("robust_scale", p.robust_scale);
  check.share("least_explained", p.least_explained);
  check.positive("end_gate", p.end_gate);
  check.share("search_below", p.search_below);
  check.positive("search_sigma_m", p.search_sigma_m);
  check.within("slip_turn_rad", p.slip_turn_rad, 0.0, pi);
  check.within("unforeseen_turn_rad", p.unforeseen_turn_rad, 0.0, pi);
  check.within("search_step_rad", p.search_step_rad, 1e-3, pi);
  check.share("search_gain", p.search_gain);
  check.share("search_least", p.search_least);
  check.at_least("search_walls", p.search_walls, 1);
  check.positive("most_unseen_m", p.most_unseen_m);
  check.at_least("most_walls", static_cast<std::int64_t>(p.most_walls), 1);
  check.shape("unexplained", p.unexplained);
}

void check_calibration_walk(const ParameterCheck& check, const CalibrationWalk& p) {
  check.not_negative("mounting_m", p.mounting_m);
  check.not_negative("mounting_rad", p.mounting_rad);
  check.not_negative("harmonic_rad", p.harmonic_rad);
}

/// What is the localizer's own.
void check_own(const ParameterCheck& check, const LocalizerParams& p) {
  check.require(p.trust.returned_innovation <= p.status.max_innovation, "trust.returned_innovation",
                p.trust.returned_innovation, "at most status.max_innovation");
  check.share("search_below", p.search_below);
  check.share("search_matched_below", p.search_matched_below);
  check.not_negative("search_gain", p.search_gain);
  check.not_negative("matched_share_weight", p.matched_share_weight);
  check.positive("unforeseen_turn_sigma_rad", p.unforeseen_turn_sigma_rad);
  check.positive("searched_sigma_m", p.searched_sigma_m);
  check.positive("searched_sigma_rad", p.searched_sigma_rad);
  check.not_negative("doubt_sigma_m", p.doubt_sigma_m);
  check.not_negative("doubt_sigma_rad", p.doubt_sigma_rad);
  check.at_least("doubts_before_search", p.doubts_before_search, 1);
  check.not_negative("elsewhere_lead", p.elsewhere_lead);
  check.at_least("contradictions_allowed", p.contradictions_allowed, 0);
}

}  // namespace

LocalizerParams LocalizerParams::with_method(perception::Method chosen) const {
  LocalizerParams params = *this;
  params.method = params.tracker.method = params.belief.method = chosen;
  params.fit.method = params.fit.matching.method = params.fit.evidence.method = chosen;
  params.map.cut_walls_at_points = chosen == perception::Method::kPaper;
  return params;
}

void check(const LocalizerParams& params) {
  const ParameterCheck check("localizer: ");
  tracking::check(params.tracker, "localizer: tracker.");
  check_map(check.in("map"), params.map);
  check_fit(check.in("fit"), params.fit);
  check_belief(check.in("belief"), params.belief);
  check_integrity(check.in("integrity"), params.integrity);
  check_search(check.in("search"), params.search);
  check_hypotheses(check.in("hypotheses"), params.hypotheses);
  check_status(check.in("status"), params.status);
  check_continuity(check.in("continuity"), params.continuity);
  check_misfit(check.in("misfit"), params.misfit);
  check_trust(check.in("trust"), params.trust);
  check_constant_velocity(check.in("constant_velocity"), params.constant_velocity);
  check_ego_motion(check.in("ego_motion"), params.ego_motion);
  check_calibration_walk(check.in("calibration_walk"), params.calibration_walk);
  check_own(check, params);
}

}  // namespace credo::localization
