// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/mapper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "geometry/angles.hpp"
#include "grids/readout.hpp"

namespace credo::mapping {
namespace {

using evidence::Believed;
using evidence::FixedLogCommonality;
using geometry::Pose2;
using geometry::PoseEstimate;
using geometry::to_radians;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kPi = std::numbers::pi;

Believed<PoseEstimate> certain(const Pose2& pose) {
  return {{pose, Eigen::Matrix3d::Zero()}, {.yes = 1.0, .no = 0.0, .unknown = 0.0}};
}

Believed<PoseEstimate> with_sigma(const Pose2& pose, double sigma_m, double sigma_rad) {
  Believed<PoseEstimate> result = certain(pose);
  result.value.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad;
  return result;
}

/// 360 beams all round.
sensors::RangeFinder panoramic() {
  return {.T_base_sensor = {},
          .height_m = 0.5,
          .angle_min_rad = -kPi,
          .angle_increment_rad = 2.0 * kPi / 360.0,
          .count = 360,
          .range_min_m = 0.1,
          .range_max_m = 8.0,
          .noise = {.sigma_0_m = 0.01, .k_per_m = 0.0},
          .scan_time_s = 0.0,
          .accuracy = {}};
}

sensors::SonarRing one_sonar() {
  sensors::SonarRing ring;
  ring.T_base_transducer = {{0.0, 0.0, 0.0}};
  return ring;
}

sensors::Rig rig_with(const sensors::RangeFinder& finder) {
  sensors::Rig rig;
  rig.range_finders = {finder};
  return rig;
}

sensors::Rig rig_with(const sensors::SonarRing& ring) {
  sensors::Rig rig;
  rig.sonar_rings = {ring};
  return rig;
}

/// Distance to the walls of the room [0, width] x [0, height] from a point within.
double distance_to_room(const Eigen::Vector2d& from, double angle, double width, double height) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double along_x = c > 0 ? (width - from.x()) / c : c < 0 ? -from.x() / c : 1e9;
  const double along_y = s > 0 ? (height - from.y()) / s : s < 0 ? -from.y() / s : 1e9;
  return std::min(along_x, along_y);
}

sensors::RangeScan scan_of_room(const sensors::RangeFinder& finder, const Pose2& base, double width, double height) {
  const Pose2 sensor = base * finder.T_base_sensor;
  sensors::RangeScan scan;
  for (int i = 0; i < finder.count; ++i)
    scan.ranges_m.push_back(
        static_cast<float>(distance_to_room(sensor.translation(), sensor.theta + finder.beam_angle(i), width, height)));
  return scan;
}

int cells_in(const grids::EvidentialGrid& grid) {
  int count = 0;
  for (const auto& [index, tile] : grid.tiles())
    for (int i = 0; i < grids::Tile::kCells; ++i) count += (tile.empty[i] | tile.occupied[i] | tile.unknown[i]) != 0;
  return count;
}

double weight(const FixedLogCommonality& cell) {  // all evidence in a cell
  return evidence::evidence_for_empty(cell.value()) + evidence::evidence_for_occupied(cell.value());
}

// ----------------------------------------------------------------------------------------------------------------
// laser

TEST(MapperLaser, AnEmptyRoomGetsItsWallsWithinACell) {
  const sensors::RangeFinder finder = panoramic();
  Mapper mapper(rig_with(finder));
  for (const Pose2& pose : {Pose2{1.0, 1.2, 0.3}, Pose2{2.5, 1.7, -1.0}, Pose2{4.6, 2.2, 2.0}, Pose2{3.1, 0.8, 0.0}})
    mapper.insert(certain(pose), scan_of_room(finder, pose, 6.0, 3.0));
  const grids::EvidentialGrid& grid = mapper.grid();
  int wrong_inside = 0, inside = 0, walls = 0, walls_found = 0;
  for (int y = -2; y < 62; ++y) {
    for (int x = -2; x < 122; ++x) {
      const grids::CellState state = grids::decide(grid.at({x, y}));
      if (x >= 1 && x < 119 && y >= 1 && y < 59) {  // more than a cell from every wall
        ++inside;
        wrong_inside += state != grids::CellState::kEmpty;
      } else if (x == 0 || y == 0 || x == 119 || y == 59) {  // the row along a wall: it or its neighbour is occupied
        ++walls;
        bool found = false;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            found |= grids::decide(grid.at({x + dx, y + dy})) == grids::CellState::kOccupied;
        walls_found += found;
      } else if (x < -1 || y < -1 || x > 120 || y > 60) {  // behind the walls
        EXPECT_NE(state, grids::CellState::kEmpty) << x << ' ' << y;
      }
    }
  }
  EXPECT_LE(wrong_inside, inside / 100);
  EXPECT_GE(walls_found, walls - 2);
}

/// The plain definition: a cell belongs to the beam nearest in angle, and gets what laser_li2006 says at its distance.
TEST(MapperLaser, EveryCellGetsTheEvidenceOfItsBeamOnce) {
  sensors::RangeFinder finder = panoramic();
  finder.T_base_sensor = {0.1, -0.05, 0.4};
  finder.angle_min_rad = -2.0;
  finder.count = 229;  // leaves a gap behind
  MapperParams params;
  params.laser.free_sigmas = params.laser.hit_sigmas = 0.0;
  params.scan.min_incidence_rad = 1.57;  // no two beams on one surface: sectors are plain
  Mapper mapper(rig_with(finder), params);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> range(0.3F, 5.0F);
  sensors::RangeScan scan;
  for (int i = 0; i < finder.count; ++i) scan.ranges_m.push_back(i % 17 == 3 ? kNan : range(random));
  const Pose2 pose{-7.33, 12.71, 0.77};
  mapper.insert(certain(pose), scan);

  const Pose2 T_sensor_map = (pose * finder.T_base_sensor).inverse();
  const auto increment = [](const evidence::GridMass& mass) {
    return evidence::quantise(evidence::log_commonality(mass, Li2006LaserParams{}.reliability));
  };
  int compared = 0, painted = 0;
  const grids::CellIndex centre = params.georeference.cell_at(pose.translation());
  for (int y = centre.y - 130; y <= centre.y + 130; ++y) {
    for (int x = centre.x - 130; x <= centre.x + 130; ++x) {
      const Eigen::Vector2d p = T_sensor_map * params.georeference.centre({x, y});
      const double rho = p.norm(), beams = geometry::wrap_angle(std::atan2(p.y(), p.x()) - finder.angle_min_rad) /
                                           finder.angle_increment_rad;
      const double place = beams < -100.0 ? beams + 360.0 : beams;  // wrap_angle cuts behind the last beams
      if (std::abs(place - std::round(place)) > 0.499) continue;    // on the border of two sectors
      const int beam = static_cast<int>(std::round(place));
      FixedLogCommonality expected{};
      if (beam >= 0 && beam < finder.count && !std::isnan(scan.ranges_m[beam])) {
        const double reading = scan.ranges_m[beam];
        if (std::abs(std::abs(rho - reading) - 0.05) < 1e-3) continue;  // on the border of the interval
        expected = increment(laser_li2006(rho, reading, 0.05));
      }
      ++compared;
      painted += expected != FixedLogCommonality{};
      ASSERT_EQ(mapper.grid().at({x, y}), expected) << x << ' ' << y << " rho " << rho << " beam " << place;
    }
  }
  EXPECT_GT(compared, 60'000);
  EXPECT_GT(painted, 5'000);
  EXPECT_EQ(mapper.counts().missing,
            std::count_if(scan.ranges_m.begin(), scan.ranges_m.end(), [](float r) { return std::isnan(r); }));
}

TEST(MapperLaser, BeamsThatTurnTheOtherWayGiveTheSameMap) {
  sensors::RangeFinder left = panoramic(), right = panoramic();
  left.angle_min_rad = -1.5;
  left.count = 181;
  right.angle_min_rad = left.beam_angle(180);
  right.angle_increment_rad = -left.angle_increment_rad;
  right.count = 181;
  Mapper a(rig_with(left)), b(rig_with(right));
  const Pose2 pose{2.0, 1.0, 0.2};
  sensors::RangeScan scan = scan_of_room(left, pose, 6.0, 3.0);
  a.insert(certain(pose), scan);
  std::reverse(scan.ranges_m.begin(), scan.ranges_m.end());
  b.insert(certain(pose), scan);
  int different = 0;
  for (int y = -10; y < 70; ++y)
    for (int x = -10; x < 130; ++x) different += a.grid().at({x, y}) != b.grid().at({x, y});
  EXPECT_LE(different, 3);  // cell centres within rounding of a border
  EXPECT_GT(cells_in(a.grid()), 3000);
}

TEST(MapperLaser, NothingComesFromNanAndLittleFromInf) {
  const sensors::RangeFinder finder = panoramic();
  Mapper nothing(rig_with(finder)), inf(rig_with(finder)), seen(rig_with(finder));
  sensors::RangeScan scan;
  scan.ranges_m.assign(360, kNan);
  nothing.insert(certain({}), scan);
  EXPECT_EQ(cells_in(nothing.grid()), 0);
  EXPECT_EQ(nothing.counts().missing, 360);

  scan.ranges_m.assign(360, kInf);
  inf.insert(certain({}), scan);
  scan.ranges_m.assign(360, 5.0F);
  seen.insert(certain({}), scan);
  const FixedLogCommonality weak = inf.grid().at({40, 0}), strong = seen.grid().at({40, 0});
  EXPECT_GT(evidence::evidence_for_empty(weak.value()), 0.0);
  EXPECT_LT(weight(weak), 0.1 * weight(strong));
  EXPECT_EQ(inf.grid().at({85, 0}), FixedLogCommonality{});  // beyond no_return_range_m
  EXPECT_EQ(inf.counts().no_returns, 360);
}

TEST(MapperLaser, ReadingsOutsideTheRangeCountAsMissing) {
  sensors::RangeFinder finder = panoramic();
  Mapper mapper(rig_with(finder));
  sensors::RangeScan scan;
  for (int i = 0; i < 360; ++i) scan.ranges_m.push_back(i % 3 == 0 ? 0.05F : i % 3 == 1 ? 8.5F : -1.0F);
  scan.ranges_m[0] = -kInf;
  mapper.insert(certain({}), scan);
  EXPECT_EQ(cells_in(mapper.grid()), 0);
  EXPECT_EQ(mapper.counts().out_of_range, 360);
}

TEST(MapperLaser, BeamsBeyondTheMappedRangeAreFreeUpToIt) {
  MapperParams params;
  params.scan.max_range_m = 3.0;
  Mapper mapper(rig_with(panoramic()), params);
  sensors::RangeScan scan;
  scan.ranges_m.assign(360, 5.0F);
  mapper.insert(certain({}), scan);
  EXPECT_EQ(grids::decide(mapper.grid().at({58, 0})), grids::CellState::kEmpty);
  EXPECT_EQ(mapper.grid().at({61, 0}), FixedLogCommonality{});
  EXPECT_EQ(mapper.grid().at({99, 0}), FixedLogCommonality{});
}

TEST(MapperLaser, TriangulationSpeaksWeaklyOfFarWalls) {
  sensors::RangeFinder finder = panoramic();
  finder.noise = {.sigma_0_m = 0.005, .k_per_m = 0.0045};
  Mapper mapper(rig_with(finder));
  const Pose2 pose{1.0, 2.0, 0.0};
  mapper.insert(certain(pose), scan_of_room(finder, pose, 5.0, 4.0));
  const double near = weight(mapper.grid().at({0, 40})), far = weight(mapper.grid().at({100, 40}));
  EXPECT_GT(near, 2.0 * far);
  EXPECT_GT(far, 0.0);
}

TEST(MapperLaser, AWallMetAtAGrazingAngleHasNoHoles) {
  sensors::RangeFinder finder = panoramic();
  Mapper mapper(rig_with(finder));
  const Pose2 pose{0.5, 0.52, 0.0};  // half a metre beside a wall along x, seen up to 5 degrees
  mapper.insert(certain(pose), scan_of_room(finder, pose, 6.0, 3.0));
  for (int x = 12; x < 100; ++x) {  // up to the beam before the corner
    const bool occupied =
        weight(mapper.grid().at({x, 0})) > 0.0 && evidence::pignistic_occupied(mapper.grid().at({x, 0}).value()) > 0.5;
    const bool below = evidence::pignistic_occupied(mapper.grid().at({x, -1}).value()) > 0.5;
    EXPECT_TRUE(occupied || below) << x;
  }
}

TEST(MapperLaser, AScanTakenWhileTurningIsCarriedAlongThePath) {
  sensors::RangeFinder finder = panoramic();
  finder.scan_time_s = 0.5;
  const Pose2 middle{2.0, 1.4, 0.3};
  const sensors::Timestamp time = 10'000'000'000;
  std::vector<sensors::OdometryReading> rows;
  for (int k = -10; k <= 10; ++k)  // 1 rad/s and 0.4 m/s
    rows.push_back({time + k * 50'000'000, Pose2{5.0, 5.0, 1.0} * Pose2{0.02 * k, 0.0, 0.05 * k}});
  const sensors::MotionPath path(rows);
  sensors::RangeScan scan;
  scan.time = time;
  for (int i = 0; i < finder.count; ++i) {
    const sensors::Timestamp now = time + sensors::from_seconds(finder.beam_time(i));
    const Pose2 sensor = middle * path.motion(time, now);
    scan.ranges_m.push_back(
        static_cast<float>(distance_to_room(sensor.translation(), sensor.theta + finder.beam_angle(i), 6.0, 3.0)));
  }
  const auto misplaced = [](const grids::EvidentialGrid& grid) {
    int wrong = 0;
    for (int y = -20; y < 80; ++y)
      for (int x = -20; x < 140; ++x) {
        const bool inside = x >= 2 && x < 118 && y >= 2 && y < 58, outside = x < -2 || x > 121 || y < -2 || y > 61;
        const double occupied = evidence::pignistic_occupied(grid.at({x, y}).value());
        wrong += (inside && occupied > 0.5) || (outside && occupied < 0.5);
      }
    return wrong;
  };
  Mapper carried(rig_with(finder)), rigid(rig_with(finder));
  carried.insert(certain(middle), scan, path);
  rigid.insert(certain(middle), scan);
  EXPECT_LE(misplaced(carried.grid()), 5);
  EXPECT_GT(misplaced(rigid.grid()), 100);
}

// ----------------------------------------------------------------------------------------------------------------
// sonar

TEST(MapperSonar, TouchesOnlyTheFanAndSaysWhatTheModelSays) {
  const sensors::SonarRing ring = one_sonar();
  MapperParams params;
  params.georeference.resolution_m = 0.04;
  const Li2007 model(ring, params.sonar);
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
        const double past = rho - sweep.ranges_m[0], eps = params.sonar.epsilon_m;
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

// ----------------------------------------------------------------------------------------------------------------
// poses

TEST(MapperPose, AnUnsurePoseMapsLessAndALostOneNothing) {
  const sensors::RangeFinder finder = panoramic();
  const Pose2 pose{1.0, 1.2, 0.3};
  const sensors::RangeScan scan = scan_of_room(finder, pose, 6.0, 3.0);
  const auto map = [&](const Believed<PoseEstimate>& from) {
    Mapper mapper(rig_with(finder));
    mapper.insert(from, scan);
    return mapper.take_grid();
  };
  const grids::CellIndex free{24, 24}, far_wall{120, 24};
  const grids::EvidentialGrid sure = map(certain(pose)), blurred = map(with_sigma(pose, 0.05, 0.0)),
                              turned = map(with_sigma(pose, 0.0, 0.02));
  EXPECT_LT(weight(blurred.at(free)), 0.6 * weight(sure.at(free)));
  EXPECT_LT(weight(turned.at(far_wall)), 0.5 * weight(sure.at(far_wall)));  // 5 m x 0.02 rad: two cells
  Believed<PoseEstimate> doubted = certain(pose), ignorant = certain(pose), lost = certain(pose);
  doubted.belief = {.yes = 0.5, .no = 0.2, .unknown = 0.3};
  ignorant.belief = {};
  lost.belief = {.yes = 0.2, .no = 0.5, .unknown = 0.3};
  EXPECT_LT(weight(map(doubted).at(free)), weight(sure.at(free)));
  EXPECT_GT(weight(map(doubted).at(free)), weight(map(ignorant).at(free)));
  EXPECT_GT(weight(map(ignorant).at(free)), 0.0);
  EXPECT_TRUE(map(lost).tiles().empty());
}

TEST(MapperPose, ALostPoseIsCountedForSonarToo) {
  Mapper mapper(rig_with(one_sonar()));
  sensors::SonarSweep sweep;
  sweep.ranges_m = {1.0F};
  Believed<PoseEstimate> lost = certain({});
  lost.belief = {.yes = 0.0, .no = 1.0, .unknown = 0.0};
  mapper.insert(lost, sweep);
  EXPECT_TRUE(mapper.grid().tiles().empty());
  EXPECT_EQ(mapper.counts().refused, 1);
  EXPECT_EQ(mapper.counts().sweeps, 1);
}

TEST(MapperPose, AFarPoseTakesNoMoreMemoryThanANearOne) {
  const sensors::RangeFinder finder = panoramic();
  sensors::RangeScan scan;
  scan.ranges_m.assign(360, 4.0F);
  Mapper near(rig_with(finder)), far(rig_with(finder));
  near.insert(certain({0.0, 0.0, 0.0}), scan);
  far.insert(certain({-5e6, 5e6, 0.0}), scan);
  EXPECT_EQ(far.grid().tiles().size(), near.grid().tiles().size());
  EXPECT_NEAR(cells_in(far.grid()), cells_in(near.grid()), 40);
}

TEST(MapperPose, RefusesPosesThatAreNone) {
  sensors::Rig rig = rig_with(panoramic());
  rig.sonar_rings = {one_sonar()};
  Mapper mapper(rig);
  sensors::RangeScan scan;
  scan.ranges_m.assign(360, 2.0F);
  sensors::SonarSweep sweep;
  sweep.ranges_m = {2.0F};
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const Pose2& pose : {Pose2{nan, 0, 0}, Pose2{0, inf, 0}, Pose2{0, 0, nan}}) {
    EXPECT_THROW(mapper.insert(certain(pose), scan), std::invalid_argument);
    EXPECT_THROW(mapper.insert(certain(pose), sweep), std::invalid_argument);
  }
  EXPECT_THROW(mapper.insert(certain({1e8, 0, 0}), scan), std::out_of_range);
  EXPECT_THROW(mapper.insert(certain({0, -1e8, 0}), sweep), std::out_of_range);
  Believed<PoseEstimate> bad = certain({});
  bad.value.covariance(1, 1) = nan;
  EXPECT_THROW(mapper.insert(bad, scan), std::invalid_argument);
  bad.value.covariance(1, 1) = -1.0;
  EXPECT_THROW(mapper.insert(bad, sweep), std::invalid_argument);
  EXPECT_TRUE(mapper.grid().tiles().empty());
}

TEST(MapperPose, RefusesAMotionThatCannotBe) {
  sensors::RangeFinder finder = panoramic();
  finder.scan_time_s = 0.1;
  Mapper mapper(rig_with(finder));
  sensors::RangeScan scan;
  scan.ranges_m.assign(360, 2.0F);
  const sensors::MotionPath jump({{0, {0, 0, 0}}, {1'000'000, {1e5, 0, 0}}});
  EXPECT_THROW(mapper.insert(certain({}), scan, jump), std::out_of_range);
  EXPECT_TRUE(mapper.grid().tiles().empty());
}

// ----------------------------------------------------------------------------------------------------------------- rig

TEST(Mapper, RefusesReadingsThatAreNotOfTheRig) {
  Mapper mapper(rig_with(panoramic()));
  sensors::RangeScan scan;
  scan.ranges_m.assign(359, 2.0F);
  EXPECT_THROW(mapper.insert(certain({}), scan), std::invalid_argument);
  scan.ranges_m.push_back(2.0F);
  scan.sensor = 1;
  EXPECT_THROW(mapper.insert(certain({}), scan), std::invalid_argument);
  scan.sensor = -1;
  EXPECT_THROW(mapper.insert(certain({}), scan), std::invalid_argument);
  sensors::SonarSweep sweep;
  sweep.ranges_m = {1.0F};
  EXPECT_THROW(mapper.insert(certain({}), sweep), std::invalid_argument);
  EXPECT_TRUE(mapper.grid().tiles().empty());
}

TEST(Mapper, RefusesAResolutionThatDoesNotFit) {
  for (const double resolution : {0.0, -0.1, std::nan(""), 1e-6, 5e-4, 5.0}) {
    MapperParams params;
    params.georeference.resolution_m = resolution;
    EXPECT_THROW(Mapper(rig_with(panoramic()), params), std::invalid_argument) << resolution;
    EXPECT_THROW(Mapper(rig_with(one_sonar()), params), std::invalid_argument) << resolution;
  }
  sensors::RangeFinder none = panoramic();
  none.count = 0;
  EXPECT_THROW(Mapper{rig_with(none)}, std::invalid_argument);
  sensors::RangeFinder still = panoramic();
  still.angle_increment_rad = 0.0;
  EXPECT_THROW(Mapper{rig_with(still)}, std::invalid_argument);
  sensors::SonarRing times = one_sonar();
  times.firing_times_s = {0.0, 0.1};
  EXPECT_THROW(Mapper{rig_with(times)}, std::invalid_argument);
}

TEST(Mapper, TheOrderOfReadingsDoesNotMatterToTheBit) {
  sensors::Rig rig = rig_with(panoramic());
  rig.sonar_rings = {one_sonar()};
  std::vector<int> order{0, 1, 2, 3, 4, 5, 6, 7};
  const auto map = [&] {
    Mapper mapper(rig);
    for (const int k : order) {
      const Pose2 pose{1.0 + 0.4 * k, 1.2, 0.3 * k};
      if (k % 2 == 0) {
        mapper.insert(with_sigma(pose, 0.01 * k, 0.002), scan_of_room(panoramic(), pose, 6.0, 3.0));
      } else {
        sensors::SonarSweep sweep;
        sweep.ranges_m = {static_cast<float>(0.3 * k)};
        mapper.insert(certain(pose), sweep);
      }
    }
    return mapper.take_grid();
  };
  const grids::EvidentialGrid first = map();
  std::reverse(order.begin(), order.end());
  EXPECT_EQ(map(), first);
  std::swap(order[1], order[5]);
  EXPECT_EQ(map(), first);
}

TEST(MapAlong, IsTheSameAsInsertingOneByOne) {
  sensors::RangeFinder finder = panoramic();
  finder.scan_time_s = 0.1;
  sensors::Rig rig = rig_with(finder);
  rig.sonar_rings = {one_sonar()};
  std::vector<sensors::OdometryReading> rows;
  std::vector<sensors::RangeScan> scans;
  std::vector<sensors::SonarSweep> sweeps;
  for (int k = 0; k < 40; ++k) {
    const sensors::Timestamp time = sensors::Timestamp{100'000'000} * k;
    const Pose2 pose{1.0 + 0.05 * k, 1.2, 0.1 * k};
    if (k < 30) rows.push_back({time, pose});  // the last scan has no pose near
    scans.push_back(scan_of_room(finder, pose, 6.0, 3.0));
    scans.back().time = time;
    sweeps.push_back({time, 0, {1.0F}});
  }
  const sensors::MotionPath trajectory(rows);
  const TrajectoryMap map = map_along(trajectory, rig, scans, sweeps);
  Mapper one_by_one(rig);
  for (std::size_t k = 0; k < 35; ++k) {
    const auto pose = certain(trajectory.pose_at(scans[k].time));
    one_by_one.insert(pose, scans[k], trajectory);
    one_by_one.insert(pose, sweeps[k], trajectory);
  }
  EXPECT_EQ(map.without_pose, 10);
  EXPECT_EQ(map.counts.scans, 35);
  EXPECT_EQ(map.grid, one_by_one.grid());
  EXPECT_EQ(map.counts, one_by_one.counts());
  EXPECT_THROW(static_cast<void>(map_along(sensors::MotionPath{}, rig, scans, sweeps)), std::invalid_argument);
}

TEST(MapAlong, TellsItsProgressAndCanBeStopped) {
  const sensors::Rig rig = rig_with(one_sonar());
  const sensors::MotionPath still(std::vector<sensors::OdometryReading>{{0, {}}});
  const std::vector<sensors::SonarSweep> sweeps(200, {0, 0, {1.0F}});
  std::vector<double> shares;
  static_cast<void>(map_along(still, rig, {}, sweeps, {}, [&](double share) { shares.push_back(share); }));
  EXPECT_GT(shares.size(), 2u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
  struct Stop {};
  EXPECT_THROW(static_cast<void>(map_along(still, rig, {}, sweeps, {}, [](double) { throw Stop(); })), Stop);
}

/// More tables of increments than are kept, by range and by reliability.
TEST(Mapper, IncrementsThatWereForgottenComeBackTheSame) {
  sensors::SonarRing ring = one_sonar();
  ring.range_max_m = 20.0;
  const sensors::Rig rig = rig_with(ring);
  Mapper all(rig);
  grids::EvidentialGrid one_by_one{grids::Georeference{}};
  for (int k = 0; k < 2000; ++k) {
    const auto pose = with_sigma({0.0, 0.0, 0.0}, 0.0025 * (k % 20), 0.0);
    const sensors::SonarSweep sweep{0, 0, {static_cast<float>(19.9 - 0.1 * (k / 20))}};
    all.insert(pose, sweep);
    Mapper single(rig);
    single.insert(pose, sweep);
    one_by_one.merge(single.grid());
  }
  EXPECT_EQ(all.grid(), one_by_one);
}

}  // namespace
}  // namespace credo::mapping
