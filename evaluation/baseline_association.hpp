// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace credo::evaluation {

/// A track and an observation inside its gate.
struct GatedPair {
  int track = 0;
  int observation = 0;
  double innovation = 0.0;  ///< observed minus predicted [rad]
  double variance = 1.0;    ///< of the innovation: prediction and observation [rad^2]

  [[nodiscard]] double distance_squared() const { return innovation * innovation / variance; }
};

/// Each track takes the observation that is nearest in standard deviations, whoever else wants it.
/// \returns by track, its observation or -1
[[nodiscard]] std::vector<int> nearest_neighbour(int tracks, std::span<const GatedPair> pairs);

/// The assignment of as many pairs as pay: the least sum of squared distances, where a track without an observation
/// costs `gate_squared` (Blackman 1986).
/// \param gate_squared  squared distance of the gate
/// \returns by track, its observation or -1
[[nodiscard]] std::vector<int> global_nearest_neighbour(int tracks, int observations, std::span<const GatedPair> pairs,
                                                        double gate_squared);

struct JpdaParams {
  double detection_probability = 0.8;  ///< of a landmark that was seen a moment ago
  double gate_probability = 0.999;     ///< of the gate that made the pairs
  double clutter_per_rad = 2.0;        ///< observations of one type that are nobody's, per radian
  std::size_t most_states = 4096;      ///< of joint events that are kept apart; below that the result is exact
};

/// Joint probabilistic data association (Fortmann, Bar-Shalom and Scheffe, IEEE J. Oceanic Engineering 8(3), 1983), as
/// its association probabilities: of each pair, over all joint events in which an observation has at most one track
/// and a track at most one observation. Summed without listing the events: track by track over the sets of
/// observations that are taken and still wanted.
/// \returns by pair
[[nodiscard]] std::vector<double> joint_probabilities(int tracks, int observations, std::span<const GatedPair> pairs,
                                                      const JpdaParams& params = {});

/// The decision that JPDA leaves open: each track's likeliest observation, where that is likelier than none and has
/// more than `at_least`. From 1/2 on no observation goes to two tracks. \returns by track, its observation or -1
[[nodiscard]] std::vector<int> joint_probabilistic(int tracks, int observations, std::span<const GatedPair> pairs,
                                                   double at_least, const JpdaParams& params = {});

}  // namespace credo::evaluation
