// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/history.hpp"

namespace credo::results {

std::vector<TrackSample> sample(std::span<const tracking::Track> tracks) {
  std::vector<TrackSample> samples;
  samples.reserve(tracks.size());
  for (const tracking::Track& t : tracks) samples.push_back({t.id, t.type, t.existence, t.state, t.landmark});
  return samples;
}

void ConflictStatistics::add(const perception::Scene& scene) {
  for (const perception::FusedSegment& segment : scene.segments) {
    ++segments_;
    total_ += segment.conflict;
    for (std::size_t i = 0; i < 5; ++i) {
      for (std::size_t j = 0; j < 5; ++j) {
        const evidence::BinaryMass &a = segment.criteria[i], &b = segment.criteria[j];
        if (i != j) pairs_[i][j] += a.yes * b.no + a.no * b.yes;
      }
    }
  }
}

}  // namespace credo::results
