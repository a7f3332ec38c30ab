// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>

#include "perception/scene.hpp"
#include "tracking/tracker.hpp"

namespace credo::localization {

struct ContinuityParams {
  int least_tracks = 10;       ///< fewer say nothing
  double usual = 0.8;          ///< share of the tracks that go on, before any have
  double memory = 0.8;         ///< the weight that an acquisition has in the next one's usual share
  double broken_below = 0.65;  ///< of the usual share: it is 0.7 and more, and about half after a kidnapping
                               ///< (`credo simulate random`, seeds 91001 to 91006, and 82045 kidnapped)
};

/// Whether what is followed goes on, be it on the plan or not. Someone who carries the robot away to where the plan
/// looks alike carries it away from all that the plan does not have, too.
class Continuity {
 public:
  explicit Continuity(const ContinuityParams& params = {}) : params_(params), usual_(params.usual) {}

  /// One scene. \param latest  the time of the scene before
  /// \returns whether far fewer tracks go on than usually; false where another instrument sees than before
  bool breaks_off(const perception::Scene& scene, std::span<const tracking::Track> tracks,
                  std::span<const tracking::Match> matches, sensors::Timestamp latest);

 private:
  ContinuityParams params_;
  double usual_;
  bool camera_seen_ = true, range_finder_seen_ = true;
};

}  // namespace credo::localization
