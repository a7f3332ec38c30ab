// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/judge_instruments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests
using testing::HasSubstr;

sensors::SonarRing sixteen() {
  sensors::SonarRing ring;
  for (int k = 0; k < 16; ++k) ring.T_base_transducer.push_back({0.0, 0.0, to_radians(22.5 * k)});
  return ring;
}

grids::EvidentialGrid sum_of(const std::vector<InstrumentMap>& maps) {
  grids::EvidentialGrid sum(maps.front().grid.georeference());
  for (const InstrumentMap& map : maps) sum.merge(map.grid);
  return sum;
}

std::vector<InstrumentVerdict> verdicts_on(const InstrumentMaps& apart) {
  return judge_instruments(apart.maps, sum_of(apart.maps));
}

/// Sixteen sonars on a loop through a room of 4 m x 3 m; each hears what is nearest in its cone.
struct Drive {
  sensors::Rig rig = rig_with(sixteen());
  sensors::MotionPath path;
  std::vector<sensors::SonarSweep> sweeps;

  Drive() {
    std::vector<sensors::OdometryReading> rows;
    for (int k = 0; k < 60; ++k) {
      const double angle = 2.0 * kPi * k / 60.0;
      const Pose2 pose{2.0 + 1.2 * std::cos(angle), 1.5 + 0.8 * std::sin(angle), geometry::wrap_angle(2.0 * angle)};
      rows.push_back({sensors::from_seconds(k), pose});
      sweeps.push_back({sensors::from_seconds(k), 0, {}});
      for (const Pose2& transducer : rig.sonar_rings[0].T_base_transducer)
        sweeps.back().ranges_m.push_back(heard(pose * transducer));
    }
    path = sensors::MotionPath(rows);
  }

  [[nodiscard]] std::vector<InstrumentVerdict> judged() const {
    return verdicts_on(map_by_instrument(path, rig, {}, sweeps));
  }

 private:
  [[nodiscard]] float heard(const Pose2& from) const {
    double nearest_m = 10.0;
    for (int step = -4; step <= 4; ++step) {
      const double aside = 0.125 * step * rig.sonar_rings[0].beam_width_rad;
      nearest_m = std::min(nearest_m, distance_to_room(from.translation(), from.theta + aside, 4.0, 3.0));
    }
    return nearest_m > rig.sonar_rings[0].range_max_m ? kInf : static_cast<float>(nearest_m);
  }
};

void expect_found(const Drive& drive, std::size_t liar) {
  const std::vector<InstrumentVerdict> verdicts = drive.judged();
  ASSERT_EQ(verdicts.size(), 16u);
  for (const InstrumentVerdict& verdict : verdicts) {
    const bool lies = verdict.instrument.transducer == static_cast<int>(liar);
    EXPECT_EQ(verdict.reliability < 0.5, lies)
        << verdict.instrument.transducer << ": " << verdict.reliability << ", opposed " << verdict.opposed;
  }
  EXPECT_THAT(summary(verdicts), HasSubstr("1 of 16 instruments doubted; least reliable: transducer " +
                                           std::to_string(liar) + " of ring 0"));
}

TEST(JudgeInstruments, FindsTheOneThatReadsShort) {
  Drive drive;
  for (sensors::SonarSweep& sweep : drive.sweeps) sweep.ranges_m[5] *= 0.7F;
  expect_found(drive, 5);
}

TEST(JudgeInstruments, FindsTheOneThatIsStuck) {
  Drive drive;
  for (sensors::SonarSweep& sweep : drive.sweeps) sweep.ranges_m[11] = 0.5F;
  expect_found(drive, 11);
}

TEST(JudgeInstruments, FindsTheOneThatReadsLong) {
  Drive drive;
  for (sensors::SonarSweep& sweep : drive.sweeps) sweep.ranges_m[0] = 2.9F;
  expect_found(drive, 0);
}

TEST(JudgeInstruments, TwoSweepsDoubtNobodyHoweverOpposed) {
  for (const float range_m : {0.5F, 2.9F}) {
    Drive drive;
    drive.sweeps.resize(2);
    drive.sweeps[1].ranges_m = drive.sweeps[0].ranges_m;
    for (sensors::SonarSweep& sweep : drive.sweeps) sweep.ranges_m[11] = range_m;
    for (const InstrumentVerdict& verdict : drive.judged()) {
      EXPECT_LE(verdict.judged, 2.0);
      EXPECT_GT(verdict.reliability, 0.7) << verdict.instrument.transducer << ", opposed " << verdict.opposed;
    }
  }
}

TEST(JudgeInstruments, ManySweepsFromOnePlaceTellAsMuchAsAFew) {
  Drive drive;
  const sensors::OdometryReading first = drive.path.rows().front();
  std::vector<sensors::OdometryReading> rows = drive.path.rows();
  for (sensors::OdometryReading& row : rows) row.T_odom_base = first.T_odom_base;
  drive.path = sensors::MotionPath(rows);
  for (sensors::SonarSweep& sweep : drive.sweeps) {
    sweep.ranges_m = drive.sweeps.front().ranges_m;
    sweep.ranges_m[11] = 0.5F;
  }
  for (const InstrumentVerdict& verdict : drive.judged()) {
    EXPECT_LT(verdict.judged, 10.0);  // 1 / FreshnessParams::correlation
    EXPECT_GT(verdict.reliability, 0.3) << verdict.instrument.transducer;
  }
}

TEST(JudgeInstruments, TrustsARingInOrder) {
  for (const InstrumentVerdict& verdict : Drive().judged()) {
    EXPECT_GT(verdict.reliability, 0.5) << verdict.instrument.transducer;
    EXPECT_EQ(verdict.readings, 60);
    EXPECT_GT(verdict.cells, 100);
  }
}

TEST(JudgeInstruments, OneThatNoOtherSpeaksOfKeepsItsTrust) {
  Drive drive;
  drive.rig = rig_with(one_sonar());
  for (sensors::SonarSweep& sweep : drive.sweeps) sweep.ranges_m.resize(1);
  const std::vector<InstrumentVerdict> verdicts = drive.judged();
  ASSERT_EQ(verdicts.size(), 1u);
  EXPECT_EQ(verdicts[0].cells, 0);
  EXPECT_EQ(verdicts[0].judged, 0.0);
  EXPECT_EQ(verdicts[0].reliability, 1.0);
}

TEST(JudgeInstruments, UndoesMostOfWhatALiarDoesToTheMap) {
  Drive drive;
  for (sensors::SonarSweep& sweep : drive.sweeps) sweep.ranges_m[5] *= 0.7F;
  const auto occupied_in_the_room = [&](const std::vector<double>& transducers) {
    TrajectoryMappingParams params;
    params.mapper.sensors.transducers = transducers;
    const grids::EvidentialGrid map = map_along(drive.path, drive.rig, {}, drive.sweeps, params).grid;
    double sum = 0.0;
    for (int y = 5; y < 55; ++y)
      for (int x = 5; x < 75; ++x) sum += evidence::pignistic_occupied(map.at({x, y}).value());
    return sum;
  };
  const std::vector<double> judged = reliabilities(drive.judged(), drive.rig).transducers;
  std::vector<double> without(16, 1.0), judged_alone(16, 1.0);
  without[5] = 0.0;
  judged_alone[5] = judged[5];
  const double harm = occupied_in_the_room({}) - occupied_in_the_room(without);
  ASSERT_GT(harm, 1.0);
  EXPECT_LT(occupied_in_the_room(judged_alone) - occupied_in_the_room(without), 0.5 * harm);
}

/// The same drive with range finders, seen from the same poses.
struct DriveWithLasers : Drive {
  std::vector<sensors::RangeScan> scans;

  explicit DriveWithLasers(int finders) {
    for (int finder = 0; finder < finders; ++finder) {
      rig.range_finders.push_back(panoramic());
      for (const auto& row : path.rows()) {
        scans.push_back(scan_of_room(panoramic(), row.T_odom_base, 4.0, 3.0));
        scans.back().time = row.time;
        scans.back().sensor = finder;
      }
    }
  }

  [[nodiscard]] InstrumentMaps mapped(bool with_sonar) const {
    return map_by_instrument(path, rig, scans, with_sonar ? sweeps : std::vector<sensors::SonarSweep>{});
  }
};

TEST(JudgeInstruments, FindsTheRangeFinderThatReadsShort) {
  DriveWithLasers drive(3);
  for (sensors::RangeScan& scan : drive.scans)
    if (scan.sensor == 1)
      for (float& range_m : scan.ranges_m) range_m *= 0.8F;
  const std::vector<InstrumentVerdict> verdicts = verdicts_on(drive.mapped(false));
  ASSERT_EQ(verdicts.size(), 3u);
  for (const InstrumentVerdict& verdict : verdicts)
    EXPECT_EQ(verdict.reliability < 0.5, verdict.instrument.finder == 1) << verdict.instrument.name();
  EXPECT_THAT(summary(verdicts), HasSubstr("1 of 3 instruments doubted; least reliable: range finder 1"));
  const SensorReliabilityParams found = reliabilities(verdicts, drive.rig);
  EXPECT_LT(found.range_finders[1], 0.5);
  EXPECT_EQ(found.transducers, std::vector<double>(16, 1.0));
}

TEST(JudgeInstruments, SonarTellsHowFarItOpposesALaser) {
  DriveWithLasers drive(1);
  const auto opposed = [&] { return verdicts_on(drive.mapped(true)).front().opposed; };
  const double in_order = opposed();
  for (sensors::RangeScan& scan : drive.scans)
    for (float& range_m : scan.ranges_m) range_m *= 0.8F;
  EXPECT_GT(opposed(), in_order + 0.05);
}

TEST(JudgeInstruments, TheSonarThatLiesIsTheLeastReliableBesideALaserToo) {
  DriveWithLasers drive(1);
  for (sensors::SonarSweep& sweep : drive.sweeps) sweep.ranges_m[5] *= 0.7F;
  const std::vector<InstrumentVerdict> verdicts = verdicts_on(drive.mapped(true));
  EXPECT_THAT(summary(verdicts), HasSubstr("least reliable: transducer 5 of ring 0"));
}

TEST(InstrumentMaps, SumUpToTheMapOfAllToTheBit) {
  const DriveWithLasers drive(2);
  const InstrumentMaps apart = drive.mapped(true);
  ASSERT_EQ(apart.maps.size(), 18u);
  EXPECT_EQ(apart.maps[1].instrument.name(), "range finder 1");
  EXPECT_EQ(apart.maps[4].instrument.name(), "transducer 2 of ring 0");
  const TrajectoryMap together = map_along(drive.path, drive.rig, drive.scans, drive.sweeps);
  EXPECT_EQ(apart.counts, together.counts);
  EXPECT_EQ(apart.without_pose, together.without_pose);
  EXPECT_TRUE(sum_of(apart.maps) == together.grid);
}

TEST(InstrumentMaps, SayHowFarTheyAreWhileARingIsMappedAndCanBeEnded) {
  Drive drive;
  const std::vector<sensors::SonarSweep> once = drive.sweeps;
  for (int more = 0; more < 3; ++more) drive.sweeps.insert(drive.sweeps.end(), once.begin(), once.end());
  std::vector<double> shares;
  static_cast<void>(
      map_by_instrument(drive.path, drive.rig, {}, drive.sweeps, {}, [&](double share) { shares.push_back(share); }));
  ASSERT_EQ(shares.size(), 4u);  // 240 sweeps, 64 at a time
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_LT(shares.front(), 0.3);
  EXPECT_EQ(shares.back(), 1.0);
  const auto end = [](double) { throw std::runtime_error("enough"); };
  EXPECT_THROW(static_cast<void>(map_by_instrument(drive.path, drive.rig, {}, drive.sweeps, {}, end)),
               std::runtime_error);
}

TEST(InstrumentMaps, RefusesReadingsThatAreNotOfTheRig) {
  DriveWithLasers drive(1);
  drive.scans.front().sensor = 7;
  EXPECT_THROW(static_cast<void>(drive.mapped(false)), std::invalid_argument);
}

TEST(SensorReliability, OfZeroMapsNothingAndOfAHalfLess) {
  const auto evidence = [](double transducer, double finder) {
    sensors::Rig rig = rig_with(panoramic());
    rig.sonar_rings = {one_sonar()};
    MapperParams params;
    params.sensors = {.transducers = {transducer}, .range_finders = {finder}};
    Mapper mapper(rig, params);
    if (transducer >= 0.0 && finder == 1.0)
      mapper.insert(certain({}), sensors::SonarSweep{0, 0, {1.0F}});
    else
      mapper.insert(certain({}), scan_of_room(panoramic(), {1.0, 1.0, 0.0}, 6.0, 3.0));
    return weight(mapper.grid().at({10, 0}));
  };
  EXPECT_EQ(evidence(0.0, 1.0), 0.0);
  EXPECT_LT(evidence(0.5, 1.0), evidence(1.0, 1.0));
  EXPECT_EQ(evidence(1.0, 0.0), 0.0);
  EXPECT_GT(evidence(1.0, 0.5), 0.0);
}

TEST(SensorReliability, RefusesListsThatAreNotOfTheRig) {
  const auto make = [](const SensorReliabilityParams& sensors) {
    MapperParams params;
    params.sensors = sensors;
    Mapper mapper(rig_with(one_sonar()), params);
  };
  EXPECT_THROW(make({.transducers = {1.0, 1.0}, .range_finders = {}}), std::invalid_argument);
  EXPECT_THROW(make({.transducers = {1.1}, .range_finders = {}}), std::invalid_argument);
  EXPECT_THROW(make({.transducers = {}, .range_finders = {1.0}}), std::invalid_argument);
  EXPECT_NO_THROW(make({.transducers = {0.3}, .range_finders = {}}));
}

}  // namespace
}  // namespace credo::mapping
