// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <array>

#include "mapping/laser_calibrated.hpp"

namespace credo::mapping {
namespace {

// credo calibrate laser --worlds 60 --seed 5001 --out default.yaml: 720941 cells of 0 datasets and 60 simulated
// buildings from seed 5001. Six for each sigma, by range; 0 where no range finder of them has it there.
constexpr std::array<double, LaserKnots::kCount> kHitWeights{
    1.26,    0.88614, 0.6642,  0.67166, 0.95438, 0.22609, 2.16036,  1.10818, 0.65732, 0.35053,
    0.56017, 0.69581, 0.56619, 0.70509, 0.59047, 0.67245, 0.55131,  0.50247, 0.5135,  0.84159,
    0.51824, 0.50503, 0.83141, 1.85433, 0,       0,       -0.04609, 0.15619, 0.31542, 0.55553};
constexpr double kFreeWeight = 0.45574;

}  // namespace

CalibratedLaserParams default_calibrated_laser() {
  return {.free_margin = {.least_m = 0.025, .sigmas = 1.0},
          .half_width = {.least_m = 0.025, .sigmas = 0.0},
          .free_weight = kFreeWeight,
          .hit_weights = {kHitWeights.begin(), kHitWeights.end()}};
}

}  // namespace credo::mapping
