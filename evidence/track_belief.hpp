// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>

#include "evidence/binary_mass.hpp"

namespace credo::evidence {

struct TrackBeliefParams {
  /// Conflict to ignorance fits the published life of a track (lost at the fifth miss) and lets no track outlive six
  /// misses; under Dempster's rule a track of yes = 1 never dies (docs/equations.md).
  FusionRule rule = FusionRule::kConflictToIgnorance;
  /// What an acquisition without a match says (Clerentin et al., sec. 4.4).
  BinaryMass miss{.yes = 0.0, .no = 0.2, .unknown = 0.8};
};

/// Belief that a track follows something real.
struct TrackBelief {
  BinaryMass mass;
  double conflict = 0.0;  ///< met in this step
  bool keep = true;       ///< false where NO exceeds YES (by more than 1e-12): drop the track
};

/// An observation that denies itself is an unreliable source: its mass discounted by the reliability 1 - m(NO). One
/// that says no YES at all is kept as it is (Clerentin et al., sec. 4.4).
[[nodiscard]] BinaryMass discount_by_own_denial(const BinaryMass& observation);

/// What a match contributes to a track: its YES; the rest is ignorance, never NO.
/// \param match_yes  in [0, 1]. \throws std::invalid_argument for another
[[nodiscard]] inline BinaryMass match_support(double match_yes) { return BinaryMass::from(match_yes, 0.0); }

/// A new track: discount_by_own_denial(observation) and match_support(match_yes).
/// All three functions return nothing at total conflict, which Dempster's rule alone can give.
[[nodiscard]] std::optional<TrackBelief> start_track(const BinaryMass& observation, double match_yes,
                                                     const TrackBeliefParams& params = {});

/// A track that was matched: the same two and its mass so far, n-ary.
[[nodiscard]] std::optional<TrackBelief> update_track(const BinaryMass& track, const BinaryMass& observation,
                                                      double match_yes, const TrackBeliefParams& params = {});

/// A track that matched nothing.
[[nodiscard]] std::optional<TrackBelief> miss_track(const BinaryMass& track, const TrackBeliefParams& params = {});

}  // namespace credo::evidence
