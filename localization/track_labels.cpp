// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/track_labels.hpp"

#include <algorithm>

namespace credo::localization {

using tracking::kNoLandmark;
using tracking::LandmarkId;
using tracking::Match;
using tracking::Track;
using tracking::Tracker;

void TrackLabels::label(std::span<const Match> matches, Tracker& tracker, SceneFit& fit) const {
  for (MapMatch& found : fit.new_matches)
    for (const Match& match : matches)
      if (match.primitive == found.primitive) {
        tracker.relabel(match.track, found.landmark);
        release(found.landmark, match.track, tracker);
        for (Observation& o : fit.observations)
          if (o.primitive == found.primitive) o.track = match.track;
        found.primitive = -1;
        break;
      }
  std::erase_if(fit.new_matches, [](const MapMatch& match) { return match.primitive < 0; });
}

void TrackLabels::release(LandmarkId landmark, int keeper, Tracker& tracker) const {
  if (map_->is_wall(landmark)) return;
  for (std::size_t t = 0; t < tracker.tracks().size(); ++t)
    if (tracker.tracks()[t].landmark == landmark && static_cast<int>(t) != keeper)
      tracker.relabel(static_cast<int>(t), kNoLandmark);
}

void TrackLabels::forget_all(Tracker& tracker) {
  in_a_row_.clear();
  for (std::size_t t = 0; t < tracker.tracks().size(); ++t) tracker.relabel(static_cast<int>(t), kNoLandmark);
}

void TrackLabels::drop_contradicting(const SceneFit& fit, Tracker& tracker) {
  for (std::size_t k = 0; k < fit.solution.outlier.size(); ++k) {
    const int index = fit.observations[k].track;
    if (index < 0) continue;
    const int id = tracker.tracks()[static_cast<std::size_t>(index)].id;
    const auto known = std::find_if(in_a_row_.begin(), in_a_row_.end(), [id](const auto& e) { return e.first == id; });
    const int before = known != in_a_row_.end() ? known->second : 0;
    if (known != in_a_row_.end()) in_a_row_.erase(known);
    if (!fit.solution.outlier[k]) continue;
    if (before + 1 > contradictions_allowed_)
      tracker.relabel(index, kNoLandmark);
    else
      in_a_row_.emplace_back(id, before + 1);
  }
}

void TrackLabels::forget_lost(std::span<const Track> tracks) {
  std::erase_if(in_a_row_, [tracks](const auto& entry) {
    return std::none_of(tracks.begin(), tracks.end(), [&entry](const Track& track) {
      return track.id == entry.first && track.state == tracking::TrackState::kTracked;
    });
  });
}

}  // namespace credo::localization
