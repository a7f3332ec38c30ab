// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/track.hpp"

#include <ostream>

namespace credo::tracking {

const char* to_string(TrackState state) {
  switch (state) {
    case TrackState::kTracked: return "tracked";
    case TrackState::kUndecided: return "undecided";
    case TrackState::kMissed: return "missed";
  }
  return "unknown";
}

std::ostream& operator<<(std::ostream& out, const Track& track) {
  out << "track " << track.id << " (" << to_string(track.type) << ", " << to_string(track.state) << ", azimuth "
      << geometry::to_degrees(track.azimuth) << " +- " << geometry::to_degrees(track.sigma_azimuth) << " deg, "
      << track.existence << ", " << track.hits << " hits, " << track.misses_in_a_row << " misses in a row";
  if (track.landmark != kNoLandmark) out << ", landmark " << track.landmark;
  return out << ")";
}

}  // namespace credo::tracking
