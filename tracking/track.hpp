// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "evidence/binary_mass.hpp"
#include "perception/scene.hpp"

namespace credo::tracking {

/// What the map calls a landmark; opaque to tracking.
using LandmarkId = std::int32_t;
inline constexpr LandmarkId kNoLandmark = -1;

enum class TrackState {
  kTracked,    ///< matched in the latest scene
  kUndecided,  ///< the latest scene was ambiguous: the mass is kept
  kMissed,     ///< not seen in the latest scene: temporarily or definitively lost
};

/// A landmark followed over time, with the belief that it is really there (Clerentin et al., sec. 4.4).
struct Track {
  int id = 0;  ///< never used again
  perception::PrimitiveType type = perception::PrimitiveType::kOther;
  evidence::BinaryMass existence;
  TrackState state = TrackState::kTracked;
  LandmarkId landmark = kNoLandmark;
  double azimuth = 0.0;        ///< in the base frame of the latest scene: observed, or predicted while missed [rad]
  double sigma_azimuth = 0.0;  ///< [rad]
  perception::Primitive last_seen;  ///< in the base frame of `last_seen_time`
  sensors::Timestamp last_seen_time = 0;
  int primitive = -1;  ///< index into the latest Scene::primitives, -1 while missed or undecided
  int hits = 0;
  int misses_in_a_row = 0;
};

/// A track and the primitive of the latest scene that continues it.
struct Match {
  int track = 0;           ///< index into Tracker::tracks()
  int primitive = 0;       ///< index into Scene::primitives
  double match_yes = 0.0;  ///< m_match(P_i)
  /// A wall has become a corner, an edge or an other, or the other way round (Clerentin et al., sec. 4.4): the track is
  /// the same, what the map calls it is not. match_yes is 0: there was no matching.
  bool transition = false;
};

[[nodiscard]] const char* to_string(TrackState state);
std::ostream& operator<<(std::ostream& out, const Track& track);

}  // namespace credo::tracking
