// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/continuity.hpp"

#include <algorithm>
#include <utility>

namespace credo::localization {

bool Continuity::breaks_off(const perception::Scene& scene, std::span<const tracking::Track> tracks,
                            std::span<const tracking::Match> matches, sensors::Timestamp latest) {
  const bool other_camera = std::exchange(camera_seen_, scene.camera_seen) != scene.camera_seen;
  const bool other_range_finder = std::exchange(range_finder_seen_, scene.range_finder_seen) != scene.range_finder_seen;
  const auto was_seen = [latest](const tracking::Track& track) { return track.last_seen_time == latest; };
  const auto followed = std::count_if(tracks.begin(), tracks.end(), was_seen);
  if (other_camera || other_range_finder || followed < params_.least_tracks) return false;
  const auto gone_on = std::count_if(matches.begin(), matches.end(), [&](const tracking::Match& match) {
    return was_seen(tracks[static_cast<std::size_t>(match.track)]);
  });
  const double share = static_cast<double>(gone_on) / static_cast<double>(followed);
  const bool broken = share < params_.broken_below * usual_;
  usual_ = params_.memory * usual_ + (1.0 - params_.memory) * share;
  return broken;
}

}  // namespace credo::localization
