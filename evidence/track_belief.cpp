// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/track_belief.hpp"

namespace credo::evidence {
namespace {

std::optional<TrackBelief> life_step(const std::optional<FusedBinaryMass>& fused) {
  constexpr double kRounding = 1e-12;
  if (!fused) return std::nullopt;
  return TrackBelief{fused->mass, fused->conflict, fused->mass.no <= fused->mass.yes + kRounding};
}

}  // namespace

BinaryMass discount_by_own_denial(const BinaryMass& observation) {
  return observation.yes > 0.0 ? discount(observation, 1.0 - observation.no) : observation;
}

std::optional<TrackBelief> start_track(const BinaryMass& observation, double match_yes,
                                       const TrackBeliefParams& params) {
  return life_step(fuse({discount_by_own_denial(observation), match_support(match_yes)}, params.rule));
}

std::optional<TrackBelief> update_track(const BinaryMass& track, const BinaryMass& observation, double match_yes,
                                        const TrackBeliefParams& params) {
  return life_step(fuse({discount_by_own_denial(observation), match_support(match_yes), track}, params.rule));
}

std::optional<TrackBelief> miss_track(const BinaryMass& track, const TrackBeliefParams& params) {
  return life_step(fuse({track, params.miss}, params.rule));
}

}  // namespace credo::evidence
