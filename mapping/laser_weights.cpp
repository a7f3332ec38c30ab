// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <array>

#include "mapping/laser_calibrated.hpp"

namespace credo::mapping {
namespace {

// credo calibrate laser --worlds 60 --seed 5001 --out default.yaml: 721471 cells of 60 simulated buildings from seed
// 5001. Six for each sigma, by range; where no range finder of them has it there, what all hits have in common.
constexpr std::array<double, LaserKnots::kCount> kSummedHit{
    1.48556, 1.02004, 0.6795,  0.74341, 0.64143, 1.35674, 1.22194, 0.96376, 0.69591,  0.45262,
    0.72613, 0.35919, 0.83018, 0.62531, 0.6286,  0.69049, 0.53724, 1.38357, -0.03257, 0.42421,
    0.3705,  0.4783,  0.5041,  0.76966, 0.47379, 0.22366, 0.32768, 0.25284, 0.71556,  0.49804};
constexpr double kSummedFree = 0.46348;
constexpr std::array<double, LaserKnots::kCount> kAloneHit{
    2.655,   3.56342, 3.27303, 3.37068, 3.23735, 3.50494, 1.12476, 3.06683, 2.88829, 2.45727,
    2.92544, 2.3056,  0.89651, 1.85787, 2.3595,  2.15578, 1.87943, 2.06667, 0.60762, 0.97083,
    1.48014, 1.39501, 1.21676, 1.3954,  0.1968,  0.58067, 0.77719, 0.56305, 0.66251, 0.22185};
constexpr double kAloneFree = 1.48559;

}  // namespace

CalibratedLaserParams default_calibrated_laser() {
  return {.free_margin = {.least_m = 0.025, .sigmas = 1.0},
          .half_width = {.least_m = 0.025, .sigmas = 0.0},
          .summed = {.free_weight = kSummedFree, .hit_weights = {kSummedHit.begin(), kSummedHit.end()}},
          .alone = {.free_weight = kAloneFree, .hit_weights = {kAloneHit.begin(), kAloneHit.end()}}};
}

}  // namespace credo::mapping
