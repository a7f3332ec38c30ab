// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <span>

#include "results/history.hpp"

// Drives that are written down instead of driven.
namespace credo::evaluation::test {

/// A track with a landmark.
inline results::TrackSample seen(perception::PrimitiveType type, const evidence::BinaryMass& existence) {
  return {.id = 3, .type = type, .existence = existence, .state = tracking::TrackState::kTracked, .landmark = 0};
}

/// A drive of `count` acquisitions at rest in the origin, the first ones with the one track that has these samples.
inline results::History moments_of(std::span<const results::TrackSample> samples, std::size_t count) {
  results::History history(count);
  for (results::Moment& moment : history) moment.truth = geometry::Pose2{};
  for (std::size_t i = 0; i < std::min(count, samples.size()); ++i) history[i].tracks = {samples[i]};
  return history;
}

}  // namespace credo::evaluation::test
