// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <array>

#include "mapping/laser_calibrated.hpp"

namespace credo::mapping {
namespace {

// credo calibrate laser --worlds 60 --seed 5001 --out default.yaml: 721391 cells of 60 simulated buildings from seed
// 5001. Six for each sigma, by range; where no range finder of them has it there, what all hits have in common.
constexpr std::array<double, LaserKnots::kCount> kSummedHit{
    1.49217, 1.0228,  0.67836, 0.74407, 0.64116, 1.35708, 1.19458, 0.99814, 0.69138,  0.45369,
    0.72557, 0.35945, 0.84227, 0.60796, 0.6429,  0.68861, 0.53723, 1.38304, -0.03197, 0.42323,
    0.37047, 0.4817,  0.50275, 0.77024, 0.47358, 0.22398, 0.32695, 0.25391, 0.71533,  0.49852};
constexpr double kSummedFree = 0.46352;
constexpr std::array<double, LaserKnots::kCount> kAloneHit{
    2.65978, 3.55142, 3.27404, 3.36933, 3.23704, 3.50433, 1.11089, 3.08982, 2.88969, 2.45661,
    2.92537, 2.30512, 0.90195, 1.84689, 2.38436, 2.15032, 1.88163, 2.0652,  0.60634, 0.97273,
    1.47375, 1.39465, 1.21654, 1.39514, 0.19676, 0.58058, 0.77693, 0.56329, 0.66229, 0.22183};
constexpr double kAloneFree = 1.48464;

}  // namespace

CalibratedLaserParams default_calibrated_laser() {
  return {.free_margin = {.least_m = 0.025, .sigmas = 1.0},
          .half_width = {.least_m = 0.025, .sigmas = 0.0},
          .summed = {.free_weight = kSummedFree, .hit_weights = {kSummedHit.begin(), kSummedHit.end()}},
          .alone = {.free_weight = kAloneFree, .hit_weights = {kAloneHit.begin(), kAloneHit.end()}}};
}

}  // namespace credo::mapping
