// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests

TEST(MapperSonar, TouchesOnlyTheFanAndSaysWhatTheModelSays) {
  const sensors::SonarRing ring = one_sonar();
  MapperParams params;
  params.georeference.resolution_m = 0.04;
  const Li2007Params sonar;
  const Li2007 model(ring, sonar);
  for (const double heading : {0.0, 0.4, kPi / 2, 2.2, kPi, -1.9, -kPi / 2, -0.2}) {
    Mapper mapper(rig_with(ring), params);
    const Pose2 pose{3.21, -4.57, heading};
    sensors::SonarSweep sweep;
    sweep.ranges_m = {1.537F};
    mapper.insert(certain(pose), sweep);
    const Pose2 T_sonar_map = pose.inverse();
    double worst = 0.0, sum = 0.0;
    int touched = 0;
    const grids::CellIndex centre = params.georeference.cell_at(pose.translation());
    for (int y = centre.y - 60; y <= centre.y + 60; ++y) {
      for (int x = centre.x - 60; x <= centre.x + 60; ++x) {
        const Eigen::Vector2d p = T_sonar_map * params.georeference.centre({x, y});
        const double rho = p.norm(), theta = std::atan2(p.y(), p.x());
        const FixedLogCommonality cell = mapper.grid().at({x, y});
        if (std::abs(theta) > 0.5 * ring.beam_width_rad + 1e-9 || rho > model.reach(1.537) + 1e-9 || rho < 0.15) {
          ASSERT_EQ(cell, FixedLogCommonality{}) << x << ' ' << y;
          continue;
        }
        const auto expected = evidence::log_commonality(model.mass(rho, theta, sweep.ranges_m[0]), model.reliability());
        // The model jumps where eqs. (5) to (8) begin and end; a table cannot say on which side a cell is.
        const double past = rho - sweep.ranges_m[0], eps = sonar.epsilon_m;
        const bool at_jump =
            std::abs(past - eps) < 0.02 || std::abs(past - 2.0 * eps) < 0.02 || std::abs(rho - ring.range_min_m) < 0.02;
        if (at_jump) continue;
        const double error = std::max({std::abs(cell.value().empty - expected.empty),
                                       std::abs(cell.value().occupied - expected.occupied),
                                       std::abs(cell.value().unknown - expected.unknown)});
        ++touched;
        sum += error;
        worst = std::max(worst, error);
      }
    }
    EXPECT_GT(touched, 250);
    EXPECT_LT(sum / touched, 0.03) << heading;  // steps of the tables: half a step in lambda is 1/32
    EXPECT_LT(worst, 0.35) << heading;
  }
}

TEST(MapperSonar, EveryTransducerSpeaksOnceAboutItsCells) {
  sensors::SonarRing two = one_sonar();
  two.T_base_transducer.push_back({0.0, 0.0, 0.0});
  Mapper once(rig_with(one_sonar())), twice(rig_with(two));
  sensors::SonarSweep sweep;
  sweep.ranges_m = {2.0F};
  once.insert(certain({}), sweep);
  sweep.ranges_m = {2.0F, 2.0F};
  twice.insert(certain({}), sweep);
  grids::EvidentialGrid doubled = once.grid();
  doubled.merge(once.grid());
  EXPECT_EQ(twice.grid(), doubled);
  EXPECT_GT(cells_in(doubled), 100);
}

TEST(MapperSonar, NothingComesFromNanAndLittleFromInf) {
  Mapper mapper(rig_with(one_sonar())), inf(rig_with(one_sonar()));
  sensors::SonarSweep sweep;
  for (const float reading : {kNan, 0.1F, 3.2F, -1.0F, -kInf}) {
    sweep.ranges_m = {reading};
    mapper.insert(certain({}), sweep);
  }
  EXPECT_EQ(cells_in(mapper.grid()), 0);
  EXPECT_EQ(mapper.counts().missing, 1);
  EXPECT_EQ(mapper.counts().out_of_range, 4);
  sweep.ranges_m = {kInf};
  inf.insert(certain({}), sweep);
  EXPECT_GT(cells_in(inf.grid()), 50);
  for (int x = 5; x < 38; ++x) {
    const auto cell = inf.grid().at({x, 0}).value();
    EXPECT_GT(evidence::evidence_for_empty(cell), 0.0) << x;
    EXPECT_LT(evidence::evidence_for_empty(cell), 0.1) << x;
    EXPECT_EQ(evidence::evidence_for_occupied(cell), 0.0) << x;
  }
}

TEST(MapperSonar, FiringTimesCarryTheTransducers) {
  sensors::SonarRing ring = one_sonar();
  ring.firing_times_s = {0.1};
  const sensors::MotionPath path({{0, {0.0, 0.0, 0.0}}, {1'000'000'000, {1.0, 0.0, 0.0}}});
  Mapper carried(rig_with(ring)), expected(rig_with(one_sonar()));
  sensors::SonarSweep sweep;
  sweep.time = 500'000'000;
  sweep.ranges_m = {1.5F};
  carried.insert(certain({0.5, 0.0, 0.0}), sweep, path);
  expected.insert(certain({0.6, 0.0, 0.0}), sweep);
  EXPECT_EQ(carried.grid().bounding_box(), expected.grid().bounding_box());
}

}  // namespace
}  // namespace credo::mapping
