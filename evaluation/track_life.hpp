// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "evidence/track_belief.hpp"
#include "results/history.hpp"

namespace credo::evaluation {

/// A track from its first sighting to its loss, or to the end of the drive.
struct TrackLife {
  int id = 0;
  std::size_t first = 0;                      ///< index of the acquisition that it began in
  std::vector<results::TrackSample> samples;  ///< of that acquisition and all that follow; never empty
  /// What the last miss made of its mass: NO exceeds YES. Nothing where the drive ended before, or where a sighting
  /// that denies itself ended it.
  std::optional<evidence::BinaryMass> lost_with;

  /// The samples, and where it was lost one more with what the last miss left.
  [[nodiscard]] std::vector<results::TrackSample> with_loss() const;
  /// Index of the acquisition of its last sighting.
  [[nodiscard]] std::size_t last_seen() const;
  [[nodiscard]] int sightings() const;
  /// Acquisitions after the last sighting, that of the loss included. Precondition: lost_with.
  [[nodiscard]] int until_lost() const;
  /// It began or went on as a corner, an edge or an other, went on as a wall, and as one of those again (Clerentin et
  /// al., sec. 5, fig. 22: edge, wall, edge).
  [[nodiscard]] bool was_wall_between() const;
};

/// The lives of all tracks of a drive, by id.
/// \param params  those of the tracker
[[nodiscard]] std::vector<TrackLife> track_lives(std::span<const results::Moment> history,
                                                 const evidence::TrackBeliefParams& params = {});

}  // namespace credo::evaluation
