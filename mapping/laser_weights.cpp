// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <array>

#include "mapping/laser_calibrated.hpp"

namespace credo::mapping {
namespace {

// credo calibrate laser --worlds 60 --seed 5001 --out default.yaml: 721471 cells of 60 simulated buildings from seed
// 5001. Six for each sigma, by range; where no range finder of them has it there, what all hits have in common.
constexpr std::array<double, LaserKnots::kCount> kSummedHit{
    1.4856,  1.02001, 0.67956, 0.74324, 0.64176, 1.35654, 1.22195, 0.96377, 0.69591,  0.45264,
    0.72612, 0.35919, 0.83019, 0.62532, 0.62861, 0.69049, 0.53724, 1.38358, -0.03257, 0.42421,
    0.3705,  0.47832, 0.50409, 0.76967, 0.47445, 0.22322, 0.32784, 0.25281, 0.7156,   0.49802};
constexpr double kSummedFree = 0.46348;
constexpr std::array<double, LaserKnots::kCount> kAloneHit{
    2.655,   3.56344, 3.27304, 3.37071, 3.23737, 3.50495, 1.12479, 3.06682, 2.88834, 2.4572,
    2.92603, 2.30587, 0.89652, 1.85788, 2.35951, 2.15578, 1.87943, 2.06669, 0.60763, 0.97084,
    1.48015, 1.39501, 1.21677, 1.39541, 0.1968,  0.58067, 0.77719, 0.56305, 0.66251, 0.22186};
constexpr double kAloneFree = 1.48562;

}  // namespace

CalibratedLaserParams default_calibrated_laser() {
  return {.free_margin = {.least_m = 0.025, .sigmas = 1.0},
          .half_width = {.least_m = 0.025, .sigmas = 0.0},
          .summed = {.free_weight = kSummedFree, .hit_weights = {kSummedHit.begin(), kSummedHit.end()}},
          .alone = {.free_weight = kAloneFree, .hit_weights = {kAloneHit.begin(), kAloneHit.end()}}};
}

}  // namespace credo::mapping
