// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <numbers>

#include "evidence/parameter_check.hpp"
#include "tracking/tracker.hpp"

namespace credo::tracking {
namespace {

using evidence::ParameterCheck;
using std::numbers::pi;

void check_prediction(const ParameterCheck& check, const PredictionParams& p) {
  check.within("observations_paper", p.observations_paper, 1, History::kCapacity);
  check.within("observations", p.observations, 1, History::kCapacity);
  check.not_negative("expected_step_m", p.expected_step_m);
  check.not_negative("expected_turn_rad", p.expected_turn_rad);
  check.not_negative("expected_turn_change_rad", p.expected_turn_change_rad);
  check.positive("nearest_m", p.nearest_m);
}

void check_association(const ParameterCheck& check, const AssociationParams& p) {
  check.shape("azimuth_deg", p.azimuth_deg);
  check.shape("sigmas", p.sigmas);
  check.require(p.min_margin >= 0.0 && p.min_margin < 1.0, "min_margin", p.min_margin,
                "a number of at least 0 and below 1");
  check.share("reliability_of_other_type", p.reliability_of_other_type);
  check.share("reliability_of_other_polarity", p.reliability_of_other_polarity);
  check.positive("floor_azimuth_rad", p.floor_azimuth_rad);
  check.positive("floor_position_m", p.floor_position_m);
  const ParameterCheck floors = check.in("wall_floors");
  floors.positive("angle_rad", p.wall_floors.angle_rad);
  floors.positive("across_m", p.wall_floors.across_m);
  floors.positive("gap_m", p.wall_floors.gap_m);
}

void check_transition(const ParameterCheck& check, const TransitionParams& p) {
  check.not_negative("max_distance_m", p.max_distance_m);
  check.within("max_angle_rad", p.max_angle_rad, 0.0, pi);
  check.not_negative("unmoved_m", p.unmoved_m);
}

}  // namespace

void check(const TrackerParams& params, const std::string& before) {
  const ParameterCheck check(before);
  check_prediction(check.in("prediction"), params.prediction);
  check_association(check.in("association"), params.association);
  check_transition(check.in("transition"), params.transition);
  check.mass("belief.miss", params.belief.miss);
  check.at_least("max_undecided_in_a_row", params.max_undecided_in_a_row, 0);
  check.mass("given", params.given);
  check.at_least("sightings_to_change_type", params.sightings_to_change_type, 1);
}

}  // namespace credo::tracking
