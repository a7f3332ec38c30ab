// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <utility>
#include <vector>

#include "localization/landmark_map.hpp"
#include "localization/scene_fit.hpp"
#include "tracking/tracker.hpp"

namespace credo::localization {

/// Which landmark of the map each track is: tracks get one, keep it while the poses agree with it, and lose it when
/// they do not. A point of the map is one thing, so one track at most has it.
class TrackLabels {
 public:
  /// \param map  must outlive this
  /// \param contradictions_allowed  a track that contradicts the pose more often in a row loses its landmark
  TrackLabels(const LandmarkMap& map, int contradictions_allowed)
      : map_(&map), contradictions_allowed_(contradictions_allowed) {}

  /// A track that had no landmark, and whose primitive has now been matched to the map, gets it. Such matches are taken
  /// out of fit.new_matches.
  void label(std::span<const tracking::Match> matches, tracking::Tracker& tracker, SceneFit& fit) const;
  /// A point's earlier tracks let go of it. \param keeper  the track that has it now
  void release(tracking::LandmarkId landmark, int keeper, tracking::Tracker& tracker) const;
  /// No track has a landmark any more: the pose that they came from was another.
  void forget_all(tracking::Tracker& tracker);
  /// A wrong match shows as a residual that the pose does not explain. Once may be bad luck; a track that goes on is
  /// somebody else.
  void drop_contradicting(const SceneFit& fit, tracking::Tracker& tracker);
  /// What is counted in a row is forgotten with its track. After Tracker::update.
  void forget_lost(std::span<const tracking::Track> tracks);

 private:
  const LandmarkMap* map_;
  int contradictions_allowed_;
  std::vector<std::pair<int, int>> in_a_row_;  ///< track id, contradictions in a row
};

}  // namespace credo::localization
