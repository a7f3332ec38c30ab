// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "grids/readout.hpp"
#include "mapping/evidence_levels.hpp"
#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests

/// What one beam may add to a cell, at any trust; nothing, too.
std::vector<FixedLogCommonality> single_increments() {
  const Li2006Laser laser;
  std::vector<FixedLogCommonality> single{{}};
  for (const auto& mass : {laser.free_mass(), laser.hit_mass()})
    for (const FixedLogCommonality& increment : increments(mass, laser.reliability())) single.push_back(increment);
  return single;
}

/// After one scan.
void expect_every_cell_is_updated_once(const grids::EvidentialGrid& grid) {
  static const std::vector<FixedLogCommonality> kSingle = single_increments();
  for (const auto& [index, tile] : grid.tiles())
    for (int i = 0; i < grids::Tile::kCells; ++i)
      ASSERT_TRUE(std::ranges::find(kSingle, FixedLogCommonality{tile.empty[i], tile.occupied[i], tile.unknown[i]}) !=
                  kSingle.end())
          << "cell " << i << " of tile " << index.x << ' ' << index.y;
}

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

/// The plain definition: a cell belongs to the beam nearest in angle, and gets what laser_li2006 says at its distance;
/// but nothing where the beam on its other side ends nearer, unless it lies within a tenth of the half sector.
TEST(MapperLaser, EveryCellGetsTheEvidenceOfItsBeamOnce) {
  sensors::RangeFinder finder = panoramic();
  finder.T_base_sensor = {0.1, -0.05, 0.4};
  finder.angle_min_rad = -2.0;
  finder.count = 229;  // leaves a gap behind
  MapperParams params;
  params.laser = Li2006LaserParams{.free_sigmas = 0.0, .hit_sigmas = 0.0};
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
  int compared = 0, painted = 0, hidden_cells = 0;
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
        const int other = place > beam ? beam + 1 : beam - 1;
        const double aside = std::abs(place - beam);
        const bool ends = other >= 0 && other < finder.count && !std::isnan(scan.ranges_m[other]);
        const double edge = ends ? scan.ranges_m[other] + 0.05 : kInf;
        if (std::abs(aside - 0.05) < 1e-3 || std::abs(rho - edge) < 1e-3) continue;
        const bool hidden = rho > edge && reading - 0.05 > edge && aside > 0.05;
        hidden_cells += hidden;
        if (!hidden) expected = increment(laser_li2006(rho, reading, 0.05));
      }
      ++compared;
      painted += expected != FixedLogCommonality{};
      ASSERT_EQ(mapper.grid().at({x, y}), expected) << x << ' ' << y << " rho " << rho << " beam " << place;
    }
  }
  EXPECT_GT(compared, 60'000);
  EXPECT_GT(painted, 4'000);
  EXPECT_GT(hidden_cells, 2'000);
  EXPECT_EQ(mapper.counts().missing,
            std::count_if(scan.ranges_m.begin(), scan.ranges_m.end(), [](float r) { return std::isnan(r); }));
}

TEST(MapperLaser, EveryCellIsUpdatedOnceWhereTrustChangesAlongASurface) {
  const sensors::RangeFinder finder = panoramic();
  MapperParams params;
  params.blur.from_cells = std::numeric_limits<double>::infinity();
  Mapper mapper(rig_with(finder), params);
  const Pose2 pose{1.1, 0.9, 0.4};
  sensors::RangeScan scan = scan_of_room(finder, pose, 6.0, 3.0);
  for (int i = 0; i < finder.count; ++i)
    if (i % 29 == 5) scan.ranges_m[i] = i % 2 == 0 ? kNan : kInf;
  mapper.insert(with_sigma(pose, 0.0, 0.01), scan);  // trust falls with the range

  ASSERT_NO_FATAL_FAILURE(expect_every_cell_is_updated_once(mapper.grid()));
  std::vector<FixedLogCommonality> seen;
  const grids::CellBox box = mapper.grid().bounding_box();
  for (int y = box.min.y; y < box.min.y + box.height; ++y)
    for (int x = box.min.x; x < box.min.x + box.width; ++x) {
      const FixedLogCommonality cell = mapper.grid().at({x, y});
      if (std::ranges::find(seen, cell) == seen.end()) seen.push_back(cell);
    }
  EXPECT_GT(seen.size(), 20U);  // trust takes many levels
  EXPECT_GT(cells_in(mapper.grid()), 6000);
}

/// Poses, angles and ranges for which borders run through centres of cells and meet in them, where the last digit
/// decides on which side a cell is.
TEST(MapperLaser, EveryCellIsUpdatedOnceWhereBordersRunThroughCentresOfCells) {
  sensors::RangeFinder finder = panoramic();
  std::mt19937 random(23);
  for (int round = 0; round < 400; ++round) {
    finder.count = round % 2 == 0 ? 360 : 8;
    finder.angle_increment_rad = (round % 3 == 0 ? -2.0 : 2.0) * kPi / finder.count;
    finder.angle_min_rad = round % 5 < 2 ? 0.5 * finder.angle_increment_rad : -kPi;
    Mapper mapper(rig_with(finder));
    sensors::RangeScan scan;
    float range_m = 1.0F;
    for (int i = 0; i < finder.count; ++i) {
      if (random() % 4 == 0) range_m = 0.025F * static_cast<float>(random() % 120);
      scan.ranges_m.push_back(random() % 9 == 0 ? kInf : range_m);
    }
    const auto multiple = [&](double unit) { return unit * static_cast<double>(random() % 8); };
    const Pose2 pose{multiple(0.025), multiple(0.025), multiple(0.25 * kPi)};
    mapper.insert(certain(pose), scan);
    SCOPED_TRACE(round);
    ASSERT_NO_FATAL_FAILURE(expect_every_cell_is_updated_once(mapper.grid()));
  }
}

/// Increments that were written down with ten digits or so: behind there is a gap which rounding may close.
TEST(MapperLaser, EveryCellIsUpdatedOnceWhereTheLastBeamAllButMeetsTheFirst) {
  MapperParams params;
  params.scan.max_range_m = 60.0;
  for (int round = 0; round < 48; ++round) {
    sensors::RangeFinder finder = panoramic();
    finder.range_max_m = 60.0;
    finder.count = round % 2 == 0 ? 360 : 720;
    finder.angle_increment_rad = (2.0 * kPi - std::pow(10.0, -8.5 + 0.25 * (round % 12))) / finder.count;
    finder.angle_min_rad = 0.5 * finder.angle_increment_rad;
    Mapper mapper(rig_with(finder), params);
    sensors::RangeScan scan;
    scan.ranges_m.assign(static_cast<std::size_t>(finder.count), 25.0F);
    mapper.insert(certain({0.025, 0.025, 0.25 * kPi * (round % 8)}), scan);  // the gap runs through centres of cells
    SCOPED_TRACE(round);
    ASSERT_NO_FATAL_FAILURE(expect_every_cell_is_updated_once(mapper.grid()));
  }
}

TEST(MapperLaser, ARangeFinderWhoseIncrementIsInSinglePrecisionLooksAllRound) {
  sensors::RangeFinder exact = panoramic(), rounded = panoramic();
  rounded.angle_increment_rad = static_cast<float>(exact.angle_increment_rad);
  Mapper a(rig_with(exact)), b(rig_with(rounded));
  sensors::RangeScan scan;
  scan.ranges_m.assign(360, 5.0F);
  scan.ranges_m.back() = 1.0F;  // hides a half of the first beam
  const Pose2 pose{0.013, 0.021, 0.6};
  a.insert(certain(pose), scan);
  b.insert(certain(pose), scan);
  int different = 0;
  for (int y = -110; y < 110; ++y)
    for (int x = -110; x < 110; ++x) different += a.grid().at({x, y}) != b.grid().at({x, y});
  EXPECT_LE(different, 3);  // cell centres within rounding of a border
}

/// As far out as a scan may reach, where single precision is coarsest.
TEST(MapperLaser, EveryCellIsUpdatedOnceThousandsOfCellsAway) {
  sensors::RangeFinder finder = panoramic();
  finder.angle_min_rad = -0.04;
  finder.angle_increment_rad = 0.001;
  finder.count = 81;
  finder.range_max_m = 60.0;
  MapperParams params;
  params.georeference.resolution_m = 0.015;
  params.scan.max_range_m = 60.0;
  Mapper mapper(rig_with(finder), params);
  std::mt19937 random(31);
  std::normal_distribution<float> noise(0.0F, 0.01F);
  sensors::RangeScan scan;
  for (int i = 0; i < finder.count; ++i) scan.ranges_m.push_back((random() % 8 == 0 ? 30.0F : 55.0F) + noise(random));
  mapper.insert(certain({1234.5, -987.6, 0.7}), scan);
  expect_every_cell_is_updated_once(mapper.grid());
  EXPECT_GT(cells_in(mapper.grid()), 400'000);
}

/// Of a robot that moves regions may overlap: they are filled in another way.
TEST(MapperLaser, ARobotThatStandsMapsTheSameWithItsPathAsWithout) {
  sensors::RangeFinder finder = panoramic();
  finder.scan_time_s = 0.5;
  std::mt19937 random(29);
  std::uniform_real_distribution<double> place(0.5, 2.5), angle(-3.0, 3.0);
  std::normal_distribution<float> noise(0.0F, 0.02F);
  int different = 0, cells = 0;
  for (int round = 0; round < 20; ++round) {
    const Pose2 pose{2.0 * place(random), place(random), angle(random)};
    sensors::RangeScan scan = scan_of_room(finder, pose, 6.0, 3.0);
    for (float& range_m : scan.ranges_m) range_m = random() % 12 == 0 ? 0.5F * range_m : range_m + noise(random);
    const sensors::MotionPath path({{-1'000'000'000, pose}, {1'000'000'000, pose}});
    Mapper with(rig_with(finder)), without(rig_with(finder));
    with.insert(certain(pose), scan, path);
    without.insert(certain(pose), scan);
    const grids::CellBox box = without.grid().bounding_box();
    for (int y = box.min.y - 2; y < box.min.y + box.height + 2; ++y)
      for (int x = box.min.x - 2; x < box.min.x + box.width + 2; ++x)
        different += with.grid().at({x, y}) != without.grid().at({x, y});
    cells += cells_in(without.grid());
  }
  EXPECT_LE(different, 2);  // rounding
  EXPECT_GT(cells, 100'000);
}

/// Sparse beams lie so far apart that a jump from one thing to another looks like a surface met at an angle.
TEST(MapperLaser, NothingIsPaintedBetweenANearAndAFarThingBySparseBeams) {
  sensors::RangeFinder finder = panoramic();
  finder.count = 72;
  finder.angle_increment_rad = to_radians(5.0);
  Mapper mapper(rig_with(finder));
  sensors::RangeScan scan;
  for (int i = 0; i < finder.count; ++i) scan.ranges_m.push_back(i == 36 ? 2.0F : 4.0F);  // 36: straight ahead
  mapper.insert(certain({}), scan);
  const auto state_at = [&](double range_m, double degrees) {
    const double angle = to_radians(degrees);
    const Eigen::Vector2d there(range_m * std::cos(angle), range_m * std::sin(angle));
    return grids::decide(mapper.grid().at(mapper.grid().georeference().cell_at(there)));
  };
  EXPECT_EQ(state_at(2.0, 0.5), grids::CellState::kOccupied);
  EXPECT_EQ(state_at(3.99, 7.5), grids::CellState::kOccupied);  // between far beams
  for (const double share : {0.2, 0.35, 0.5, 0.65, 0.8}) {      // of the way from the near hit to the far one
    EXPECT_NE(state_at(2.0 + 2.0 * share, 5.0 * share), grids::CellState::kOccupied) << share;
    EXPECT_NE(state_at(2.0 + 2.0 * share, -5.0 * share), grids::CellState::kOccupied) << share;
  }
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

}  // namespace
}  // namespace credo::mapping
