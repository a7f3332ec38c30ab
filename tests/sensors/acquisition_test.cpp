// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sensors/acquisition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/sensors/second.hpp"

namespace credo::sensors {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();

RangeFinder panoramic(int count) {
  RangeFinder finder;
  finder.count = count;
  finder.angle_min_rad = -std::numbers::pi;
  finder.angle_increment_rad = 2.0 * std::numbers::pi / count;
  finder.range_max_m = 20.0;
  finder.noise = {0.01, 0.002};
  return finder;
}

TEST(CarryScan, PutsAPointAtTheEndOfEachFiniteReading) {
  RangeFinder finder = panoramic(4);
  finder.T_base_sensor = {0.1, 0.0, std::numbers::pi / 2.0};
  std::vector<ScanPoint> points{{}, {}, {}};
  carry_scan({0, 0, {1.0F, kInf, 2.0F, kNan}}, finder, {}, 0, points);
  ASSERT_EQ(points.size(), 2U);
  // Beam 0 points along -pi in the sensor, that is along -y of the base; beam 2 along +y.
  EXPECT_NEAR((points[0].position - Eigen::Vector2d(0.1, -1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((points[1].position - Eigen::Vector2d(0.1, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((points[1].ray - Eigen::Vector2d(0.0, 1.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(points[1].beam, 2);
  EXPECT_EQ(points[1].range_m, 2.0);
  EXPECT_NEAR(points[1].sigma_m, std::hypot(0.01, 0.002 * 4.0), 1e-12);
}

/// A robot that drives and turns in a square room while its scanner turns once a second sees straight walls again.
TEST(CarryScan, StraightensAScanTakenInMotion) {
  constexpr double kHalfRoom = 3.0;
  RangeFinder finder = panoramic(360);
  finder.scan_time_s = 1.0;
  finder.T_base_sensor = {0.2, -0.1, 0.4};
  std::vector<OdometryReading> rows;
  for (int i = -60; i <= 60; ++i)
    rows.push_back({kSecond / 2 + i * kSecond / 50, {0.6 * i / 50.0, 0.3 * i / 50.0, 0.5 * i / 50.0}});
  const MotionPath path(rows);  // T_room_base
  RangeScan scan{kSecond / 2, 0, {}};
  for (int beam = 0; beam < finder.count; ++beam) {
    const geometry::Pose2 T_room_sensor =
        path.pose_at(scan.time + from_seconds(finder.beam_time(beam))) * finder.T_base_sensor;
    const double angle = T_room_sensor.theta + finder.beam_angle(beam);
    const double to_x = ((std::cos(angle) > 0 ? kHalfRoom : -kHalfRoom) - T_room_sensor.x) / std::cos(angle);
    const double to_y = ((std::sin(angle) > 0 ? kHalfRoom : -kHalfRoom) - T_room_sensor.y) / std::sin(angle);
    scan.ranges_m.push_back(static_cast<float>(std::min(to_x, to_y)));
  }
  const auto worst = [&](const MotionPath& carried_along) {
    std::vector<ScanPoint> points;
    carry_scan(scan, finder, carried_along, scan.time, points);
    double off = 0.0;
    for (const ScanPoint& point : points) {
      const Eigen::Vector2d in_room = path.pose_at(scan.time) * point.position;
      off = std::max(off, std::abs(in_room.cwiseAbs().maxCoeff() - kHalfRoom));
    }
    return off;
  };
  EXPECT_LT(worst(path), 1e-5);
  EXPECT_GT(worst({}), 0.2);
}

TEST(CarryScan, CarriesToAnotherMoment) {
  const RangeFinder finder = panoramic(4);
  const MotionPath path({{0, {}}, {kSecond, {1.0, 0.0, 0.0}}});
  std::vector<ScanPoint> points;
  carry_scan({0, 0, {kNan, kNan, 5.0F, kNan}}, finder, path, kSecond, points);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0].position.x(), 4.0, 1e-12);
}

TEST(RangeFinder, MiddleBeamIsTakenAtTheTimestamp) {
  RangeFinder finder = panoramic(5);
  finder.scan_time_s = 0.1;
  EXPECT_NEAR(finder.beam_time(2), 0.0, 1e-15);
  EXPECT_NEAR(finder.beam_time(0), -0.04, 1e-15);
  EXPECT_NEAR(finder.beam_time(4), 0.04, 1e-15);
}

TEST(OmniCamera, AzimuthAndImageDirectionUndoEachOther) {
  for (const int sign : {-1, 1})
    for (const double zero : {0.0, 0.5, -3.0}) {
      OmniCamera camera;
      camera.center_px = {320.5, 239.25};
      camera.azimuth_sign = sign, camera.azimuth_zero_rad = zero;
      for (double azimuth = -3.1; azimuth < 3.1; azimuth += 0.37) {
        const Eigen::Vector2d pixel = camera.center_px + 100.0 * camera.image_direction(azimuth);
        EXPECT_NEAR(geometry::angle_difference(camera.azimuth_of(pixel.x(), pixel.y()), azimuth), 0.0, 1e-12);
      }
    }
}

TEST(OmniCamera, SignMinusOneGrowsCounterClockwiseOnTheImageAsShown) {
  OmniCamera camera;
  camera.azimuth_sign = -1;
  EXPECT_NEAR(camera.azimuth_of(0.0, -10.0), std::numbers::pi / 2.0, 1e-12);  // up on the screen
}

TEST(Time, SecondsAreExactToTheNanosecond) {
  EXPECT_EQ(from_seconds(0.008), 8'000'000);
  EXPECT_EQ(from_seconds(-0.035), -35'000'000);
  EXPECT_DOUBLE_EQ(seconds_between(1'600'000'000'000'000'001, 1'600'000'000'000'000'002), 1e-9);
}

}  // namespace
}  // namespace credo::sensors
