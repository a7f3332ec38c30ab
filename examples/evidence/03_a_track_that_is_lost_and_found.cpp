// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// A track that is lost and found: belief over time
//
// Problem   A robot follows a landmark. Now and then it is not seen: hidden for a moment, or never there. How long is
//           the track to be believed? (Clerentin et al., sec. 4.4)
//
// Symbols   m_obs    belief in what is observed: (YES, NO, unknown)
//           YES_m    how far it matches the track's prediction
//           m_track  belief that the track follows something real
//           k        conflict of this step
//
// Model     Frame {YES, NO}. A track starts from m_obs, discounted by its own denial, and YES_m. A match fuses both
//           with m_track; a miss fuses (0, 0.2, 0.8). The track is dropped where NO exceeds YES.
//
// Shown     The same life under two rules. Where the conflict becomes ignorance the track is in doubt at once, found
//           again, and dropped at the fifth miss in a row. Dempster's rule remembers every match that there ever was:
//           the track outlives the landmark.

#include <array>
#include <iomanip>
#include <iostream>
#include <optional>

#include "evidence/track_belief.hpp"

using namespace credo::evidence;

namespace {

const BinaryMass kObservation = BinaryMass::from(0.6, 0.1);
constexpr double kMatchYes = 0.7;

std::optional<TrackBelief> step(const std::optional<TrackBelief>& track, bool seen, const TrackBeliefParams& params) {
  if (track && seen) return update_track(track->mass, kObservation, kMatchYes, params);
  if (track) return miss_track(track->mass, params);
  return start_track(kObservation, kMatchYes, params);
}

void print(const std::optional<TrackBelief>& track) {
  if (!track) {
    std::cout << "  |  none         -      -       -      -";
    return;
  }
  const BinaryMass& mass = track->mass;
  std::cout << (track->keep ? "  |  kept   " : "  |  dropped") << std::setw(7) << mass.yes << std::setw(7) << mass.no
            << std::setw(8) << mass.unknown << std::setw(7) << track->conflict;
}

}  // namespace

int main() {
  constexpr std::array kSeen{true,  true,  true,  false, false, true,  true,
                             false, false, false, false, false, false, true};
  const TrackBeliefParams moved{.rule = FusionRule::kConflictToIgnorance};
  const TrackBeliefParams divided{.rule = FusionRule::kDempster};

  std::cout << std::fixed << std::setprecision(3);
  std::cout << "            |  conflict to ignorance               |  Dempster's rule\n"
            << " t          |  track      YES     NO unknown      k  |  track      YES     NO unknown      k\n";
  std::optional<TrackBelief> with_moved, with_divided;
  for (std::size_t t = 0; t < kSeen.size(); ++t) {
    const bool seen = kSeen[t];
    if (with_moved || seen) with_moved = step(with_moved, seen, moved);
    if (with_divided || seen) with_divided = step(with_divided, seen, divided);
    std::cout << std::setw(2) << t + 1 << (seen ? "  seen  " : "  missed");
    print(with_moved);
    print(with_divided);
    std::cout << '\n';
    if (with_moved && !with_moved->keep) with_moved.reset();  // the next sight starts a new track
    if (with_divided && !with_divided->keep) with_divided.reset();
  }

  std::cout
      << "\nmisses until a track of (YES, 0, rest) is dropped\n   YES   conflict to ignorance   Dempster's rule\n";
  for (const double yes : {0.5, 0.9, 0.99, 0.999}) {
    std::cout << std::setw(6) << yes;
    for (const TrackBeliefParams& params : {moved, divided}) {
      TrackBelief track{BinaryMass::from(yes, 0.0)};
      int misses = 0;
      for (; track.keep; ++misses) track = *miss_track(track.mass, params);
      std::cout << std::setw(20) << misses;
    }
    std::cout << '\n';
  }
}
