// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <array>

#include "mapping/laser_calibrated.hpp"

namespace credo::mapping {
namespace {

// credo calibrate laser --worlds 60 --seed 5001 --out default.yaml: 720941 cells of 60 simulated buildings from seed
// 5001. Six for each sigma, by range; 0 where no range finder of them has it there.
constexpr std::array<double, LaserKnots::kCount> kSummedHit{
    1.26,    0.88614, 0.6642,  0.67166, 0.95438, 0.22609, 2.16036,  1.10818, 0.65732, 0.35053,
    0.56017, 0.69581, 0.56619, 0.70509, 0.59047, 0.67245, 0.55131,  0.50247, 0.5135,  0.84159,
    0.51824, 0.50503, 0.83141, 1.85433, 0,       0,       -0.04609, 0.15619, 0.31542, 0.55553};
constexpr double kSummedFree = 0.45574;
constexpr std::array<double, LaserKnots::kCount> kAloneHit{
    2.52707, 3.47593, 3.28794, 3.65776, 3.46982, 2.4753,  0.69754,  3.2021,   2.70871, 2.4495,
    2.37037, 1.93699, 0.73471, 1.78941, 2.34125, 2.06588, 2.05083,  1.75663,  0.57366, 1.13908,
    1.31479, 1.62819, 1.27036, 1.84643, 0,       0,       -0.41802, -0.02758, 0.22922, 0.42637};
constexpr double kAloneFree = 1.49567;

}  // namespace

CalibratedLaserParams default_calibrated_laser() {
  return {.free_margin = {.least_m = 0.025, .sigmas = 1.0},
          .half_width = {.least_m = 0.025, .sigmas = 0.0},
          .summed = {.free_weight = kSummedFree, .hit_weights = {kSummedHit.begin(), kSummedHit.end()}},
          .alone = {.free_weight = kAloneFree, .hit_weights = {kAloneHit.begin(), kAloneHit.end()}}};
}

}  // namespace credo::mapping
