// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/fan.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "geometry/angles.hpp"

namespace credo::mapping {
namespace {

using geometry::Pose2;
constexpr double kPi = std::numbers::pi;

/// Checks every cell around the apex against its own distance and angle.
void expect_cells_of_cone(const Pose2& pose, double half_width_rad, double reach_m) {
  const grids::Georeference georeference{.resolution_m = 0.05, .origin_x_m = 0.013, .origin_y_m = -0.2};
  const Fan fan(georeference, pose, half_width_rad, reach_m);
  const grids::CellIndex apex = georeference.cell_at(pose.translation());
  const int around = static_cast<int>(reach_m / georeference.resolution_m) + 3;
  const CellRun rows = fan.rows();
  for (int y = apex.y - around; y <= apex.y + around; ++y) {
    const CellRun run = y >= rows.begin && y < rows.end ? fan.run(y) : CellRun{};
    for (int x = apex.x - around; x <= apex.x + around; ++x) {
      const Eigen::Vector2d p = pose.inverse() * georeference.centre({x, y});
      const double within = half_width_rad - std::abs(std::atan2(p.y(), p.x())), before = reach_m - p.norm();
      if (std::abs(within) < 1e-9 || std::abs(before) < 1e-9 || p.norm() < 1e-9) continue;  // on a border
      ASSERT_EQ(x >= run.begin && x<run.end, within> 0.0 && before > 0.0)
          << "cell " << x << ' ' << y << ", heading " << pose.theta << ", half width " << half_width_rad;
    }
  }
}

TEST(Fan, RunsHoldTheCellsWhoseCentresLieInTheCone) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 300; ++k)
    expect_cells_of_cone({share(random), -share(random), kPi * (2.0 * share(random) - 1.0)}, 0.02 + 1.5 * share(random),
                         0.1 + 2.0 * share(random));
}

TEST(Fan, EdgesThatAreLevelOrUprightBoundAsOthersDo) {
  for (int quarter = -4; quarter <= 4; ++quarter)
    for (const double half_width : {kPi / 8.0, kPi / 4.0, 3.0 * kPi / 8.0})
      for (const double sign : {-1.0, 0.0, 1.0})
        for (const double x : {0.013, 0.038, 0.05})  // on a corner of cells, on a centre, between
          expect_cells_of_cone({x, x - 0.213, quarter * kPi / 4.0 + sign * half_width}, half_width, 1.0);
}

}  // namespace
}  // namespace credo::mapping
