// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <array>

#include "mapping/laser_calibrated.hpp"

namespace credo::mapping {
namespace {

// credo calibrate laser --worlds 60 --seed 5001 --out default.yaml: 722239 cells of 60 simulated buildings from seed
// 5001. Six for each sigma, by range; where no range finder of them has it there, what all hits have in common.
constexpr std::array<double, LaserKnots::kCount> kSummedHit{
    1.46733, 1.02309, 0.67804, 0.72634, 0.68985, 1.1636,  1.36602, 0.94676, 0.6944,   0.4482,
    0.7199,  0.35054, 0.8586,  0.60183, 0.63007, 0.69227, 0.53626, 1.34691, -0.03328, 0.42051,
    0.37178, 0.47282, 0.5002,  0.76272, 0.45672, 0.22088, 0.32386, 0.25369, 0.71068,  0.46736};
constexpr double kSummedFree = 0.46271;
constexpr std::array<double, LaserKnots::kCount> kAloneHit{
    2.6514,  3.56548, 3.275,   3.36007, 3.23751, 3.36731, 1.12382, 3.07042, 2.88514, 2.45955,
    2.9125,  2.28911, 0.90083, 1.85891, 2.35741, 2.15177, 1.87281, 2.03943, 0.60435, 0.97272,
    1.48106, 1.39853, 1.21487, 1.35785, 0.19873, 0.6038,  0.78022, 0.56396, 0.66761, 0.24952};
constexpr double kAloneFree = 1.4868;

}  // namespace

CalibratedLaserParams default_calibrated_laser() {
  return {.free_margin = {.least_m = 0.025, .sigmas = 1.0},
          .half_width = {.least_m = 0.025, .sigmas = 0.0},
          .summed = {.free_weight = kSummedFree, .hit_weights = {kSummedHit.begin(), kSummedHit.end()}},
          .alone = {.free_weight = kAloneFree, .hit_weights = {kAloneHit.begin(), kAloneHit.end()}}};
}

}  // namespace credo::mapping
