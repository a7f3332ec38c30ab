// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/map_rule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests

constexpr sensors::Timestamp kStep = 100'000'000;

/// A ring of eight and a laser on their way through a room of 5 m x 4 m.
struct DriveOfBoth {
  sensors::Rig rig;
  sensors::MotionPath path;
  std::vector<sensors::RangeScan> scans;
  std::vector<sensors::SonarSweep> sweeps;

  DriveOfBoth() {
    rig = rig_with(panoramic());
    sensors::SonarRing ring;
    for (int i = 0; i < 8; ++i) ring.T_base_transducer.push_back({0.0, 0.0, i * kPi / 4.0});
    rig.sonar_rings = {ring};
    std::vector<sensors::OdometryReading> rows;
    for (int step = 0; step < 20; ++step) {
      const Pose2 pose{1.0 + 0.15 * step, 1.5, 0.05 * step};
      rows.push_back({step * kStep, pose});
      scans.push_back(scan_of_room(rig.range_finders[0], pose, 5.0, 4.0));
      scans.back().time = step * kStep;
      sensors::SonarSweep sweep;
      sweep.time = step * kStep;
      for (const Pose2& transducer : ring.T_base_transducer) {
        const double range_m = distance_to_room(pose.translation(), (pose * transducer).theta, 5.0, 4.0);
        sweep.ranges_m.push_back(range_m > ring.range_max_m ? kInf : static_cast<float>(range_m));
      }
      sweeps.push_back(sweep);
    }
    path = sensors::MotionPath(std::move(rows));
  }

  [[nodiscard]] RuleMap mapped(const MapRule& rule, const TrajectoryMappingParams& params = {}) const {
    return map_along(path, rig, scans, sweeps, params, rule);
  }
};

TEST(MapRule, EveryRuleFindsTheRoom) {
  const DriveOfBoth drive;
  for (const NamedRule& rule : map_rules()) {
    const RuleMap made = drive.mapped(rule.rule);
    const auto at = [&](double x, double y) { return made.map.at(made.map.georeference.cell_at({x, y})); };
    EXPECT_GT(at(2.5, 2.0).empty, at(2.5, 2.0).occupied) << rule.name;
    EXPECT_GT(at(5.01, 2.0).occupied, at(5.01, 2.0).empty) << rule.name;
    EXPECT_EQ(made.counts.scans, 20) << rule.name;
    EXPECT_EQ(made.counts.sweeps, 20) << rule.name;
    EXPECT_FALSE(made.map.saw({-200, 0})) << rule.name;
  }
}

TEST(MapRule, DsmcAndDempsterDecideAlikeInEveryCell) {
  const DriveOfBoth drive;
  const grids::MassMap dsmc = drive.mapped(grids::ReadOut::kDsmc).map;
  const grids::MassMap dempster = drive.mapped(grids::ReadOut::kDempster).map;
  ASSERT_EQ(dsmc.box, dempster.box);
  for (std::size_t i = 0; i < dsmc.masses.size(); ++i)
    ASSERT_EQ(dsmc.masses[i].occupied > dsmc.masses[i].empty, dempster.masses[i].occupied > dempster.masses[i].empty);
}

TEST(MapRule, AFoldOfDempsterAgreesWithTheSum) {
  const DriveOfBoth drive;
  const grids::MassMap fold = drive.mapped(DempsterFold{}).map, sum = drive.mapped(grids::ReadOut::kDempster).map;
  int cells = 0, alike = 0;
  for (int y = sum.box.min.y; y < sum.box.min.y + sum.box.height; ++y)
    for (int x = sum.box.min.x; x < sum.box.min.x + sum.box.width; ++x) {
      if (!sum.saw({x, y})) continue;
      ++cells;
      alike += std::abs(fold.at({x, y}).occupied - sum.at({x, y}).occupied) < 0.05;
    }
  EXPECT_GT(alike, 0.97 * cells);  // tables round angles and distances
}

/// Of the laser alone, whose evidence is the same in both: a sonar's comes from tables in the one.
TEST(MapRule, FloatsHoldTheMassesOfFixedPoint) {
  DriveOfBoth drive;
  drive.sweeps.clear();
  const grids::MassMap floats = drive.mapped(DempsterFloatFold{}).map,
                       fixed = drive.mapped(grids::ReadOut::kDempster).map;
  ASSERT_EQ(floats.box, fixed.box);
  EXPECT_EQ(floats.seen, fixed.seen);
  constexpr double kTolerance = 1e-3;
  for (std::size_t i = 0; i < fixed.masses.size(); ++i) {
    ASSERT_NEAR(floats.masses[i].occupied, fixed.masses[i].occupied, kTolerance);
    ASSERT_NEAR(floats.masses[i].empty, fixed.masses[i].empty, kTolerance);
  }
}

TEST(MapRule, FoldsTakeReadingsInByTimeHoweverTheyAreGiven) {
  const DriveOfBoth drive;
  DriveOfBoth reversed = drive;
  std::ranges::reverse(reversed.scans);
  std::ranges::reverse(reversed.sweeps);
  for (const MapRule& rule : {MapRule{ChangingFold{}}, MapRule{Pcr2Fold{}}, MapRule{DempsterFold{}}})
    EXPECT_EQ(reversed.mapped(rule).map.masses, drive.mapped(rule).map.masses);
}

/// The wall comes a metre nearer while the robot stands: rules that forget see it, whatever was said a hundred times.
TEST(MapRule, ARobotAtRestFollowsAChangeByRulesThatForget) {
  const sensors::Rig rig = rig_with(panoramic());
  const Pose2 here{1.0, 2.0, 0.3};
  std::vector<sensors::OdometryReading> rows;
  std::vector<sensors::RangeScan> scans;
  for (int k = 0; k < 108; ++k) {
    rows.push_back({k * kStep, here});
    scans.push_back(scan_of_room(rig.range_finders[0], here, k < 100 ? 5.0 : 4.0, 4.0));
    scans.back().time = k * kStep;
  }
  const sensors::MotionPath path(std::move(rows));
  for (const char* name : {"changing", "dsmh", "pcr2", "pcr5"}) {
    const RuleMap made = map_along(path, rig, scans, {}, {}, map_rule(name).rule);
    EXPECT_EQ(made.without_pose, 0);
    const evidence::GridMass wall = made.map.at(made.map.georeference.cell_at({4.02, 2.0}));
    EXPECT_GT(wall.occupied, wall.empty) << name;
  }
}

TEST(MapRule, SameReadingsGiveTheSameMap) {
  const DriveOfBoth drive;
  EXPECT_EQ(drive.mapped(Pcr5Fold{}).map.masses, drive.mapped(Pcr5Fold{}).map.masses);
}

TEST(MapRule, AnUnknownNameIsToldWithTheKnownOnes) {
  EXPECT_THAT([] { static_cast<void>(map_rule("pcr7")); },
              testing::ThrowsMessage<std::invalid_argument>(
                  testing::AllOf(testing::HasSubstr("'pcr7'"), testing::HasSubstr("pcr5"))));
  EXPECT_THROW(static_cast<void>(sonar_params("sonar", 0.05)), std::invalid_argument);
}

TEST(MapRule, AllModelsByName) {
  const sensors::SonarRing ring = one_sonar();
  for (const std::string_view name : sonar_model_names()) {
    const SonarParams params = sonar_params(name, 0.05);
    EXPECT_EQ(name_of(params), name);
    EXPECT_GT(sonar_model(ring, params).mass(0.5, 0.0, 2.0).empty, 0.0) << name;
  }
}

}  // namespace
}  // namespace credo::mapping
