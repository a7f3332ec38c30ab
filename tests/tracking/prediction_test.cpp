// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/prediction.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "tests/tracking/scenes.hpp"

namespace credo::tracking {
namespace {

using namespace test;  // NOLINT: the helpers of these tests
using geometry::Pose2;
using geometry::PoseEstimate;

constexpr double kPi = 3.14159265358979323846;

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

Eigen::Matrix3d random_covariance(std::mt19937& random) {
  Eigen::Matrix3d root;
  for (int i = 0; i < 9; ++i) root(i / 3, i % 3) = uniform(random, -0.05, 0.05);
  return root * root.transpose();
}

// J P J^T of `map` at `x` by central differences, differences taken by `minus`.
template <int N, typename Map, typename Minus>
Eigen::Matrix2d carried_numerically(const Eigen::Matrix<double, N, 1>& x, const Eigen::Matrix<double, N, N>& P, Map map,
                                    Minus minus) {
  Eigen::Matrix<double, 2, N> J;
  for (int i = 0; i < N; ++i) {
    const double h = 1e-6;
    Eigen::Matrix<double, N, 1> up = x, down = x;
    up[i] += h, down[i] -= h;
    J.col(i) = minus(map(up), map(down)) / (2.0 * h);
  }
  return J * P * J.transpose();
}

Eigen::Vector2d angle_first(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return {geometry::angle_difference(a[0], b[0]), a[1] - b[1]};
}

// ---------------------------------------------------------------------------------------------- points

RC_GTEST_PROP(PolarPoint, IsCarriedLikeThePointThatItIs, (unsigned seed)) {
  std::mt19937 random(seed);
  const Eigen::Vector2d p(uniform(random, 1.0, 5.0), uniform(random, -3.0, 3.0));
  const PoseEstimate T{{uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5), uniform(random, -3.0, 3.0)},
                       Eigen::Matrix3d::Zero()};
  const PolarPoint carried = carry({std::atan2(p.y(), p.x()), 1.0 / p.norm(), Eigen::Matrix2d::Zero()}, T);
  RC_ASSERT((carried.position() - T.pose.inverse() * p).norm() < 1e-12);
}

RC_GTEST_PROP(PolarPoint, IsCarriedWithTheCovarianceOfTheFirstOrder, (unsigned seed)) {
  std::mt19937 random(seed);
  Eigen::Matrix<double, 5, 1> x;  // azimuth, inverse range, motion
  x << uniform(random, -kPi, kPi), uniform(random, 0.0, 0.8), uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5),
      uniform(random, -kPi, kPi);
  Eigen::Matrix<double, 5, 5> P = Eigen::Matrix<double, 5, 5>::Zero();
  P.topLeftCorner<2, 2>() << 0.01, 0.002, 0.002, 0.04;
  P.bottomRightCorner<3, 3>() = random_covariance(random);
  const auto map = [](const Eigen::Matrix<double, 5, 1>& v) -> Eigen::Vector2d {
    const PolarPoint carried =
        carry({v[0], v[1], Eigen::Matrix2d::Zero()}, {Pose2{v[2], v[3], v[4]}, Eigen::Matrix3d::Zero()});
    return {carried.azimuth, carried.inverse_range};
  };
  const PolarPoint carried =
      carry({x[0], x[1], P.topLeftCorner<2, 2>()}, {Pose2{x[2], x[3], x[4]}, P.bottomRightCorner<3, 3>()});
  const Eigen::Matrix2d expected = carried_numerically<5>(x, P, map, angle_first);
  RC_ASSERT((carried.covariance - expected).norm() < 1e-6 * (1.0 + expected.norm()));
}

TEST(PolarPoint, AtInfinityOnlyTurns) {
  PolarPoint far{0.3, 0.0, Eigen::Matrix2d::Zero()};
  const PolarPoint carried = carry(far, {Pose2{5.0, -3.0, 0.5}, Eigen::Matrix3d::Zero()});
  EXPECT_NEAR(carried.azimuth, -0.2, 1e-12);
  EXPECT_EQ(carried.inverse_range, 0.0);
}

TEST(PolarPoint, UnderTheRobotIsInAnyDirection) {
  const PolarPoint carried =
      carry({0.0, 0.5, Eigen::Matrix2d::Zero()}, {Pose2{2.0, 0.0, 0.0}, Eigen::Matrix3d::Zero()});
  EXPECT_NEAR(carried.sigma_azimuth(), kPi, 1e-12);
  EXPECT_TRUE(std::isfinite(carried.inverse_range));
}

TEST(PolarPoint, SeenFromThereAndBackIsTheSame) {
  const Eigen::Vector2d camera(0.3, -0.2);
  const PolarPoint point{0.7, 0.4, Eigen::Vector2d(0.01, 0.02).asDiagonal()};
  const PolarPoint back = seen_from(seen_from(point, camera), -camera);
  EXPECT_NEAR(back.azimuth, point.azimuth, 1e-12);
  EXPECT_NEAR(back.inverse_range, point.inverse_range, 1e-12);
  EXPECT_NEAR((back.covariance - point.covariance).norm(), 0.0, 1e-12);
}

TEST(PolarPoint, GetsItsRangeFromTwoBearings) {
  const Eigen::Vector2d landmark(2.0, 1.0);
  PredictionParams params;
  PolarPoint point = seen_point(bearing(std::atan2(1.0, 2.0) / kDegree), Eigen::Vector2d::Zero(), params);
  EXPECT_NEAR(point.inverse_range + 3.0 * std::sqrt(point.covariance(1, 1)), 1.0 / params.nearest_m, 1e-12);
  EXPECT_NEAR(point.inverse_range - std::sqrt(point.covariance(1, 1)), 0.0, 1e-12);
  for (int i = 1; i <= 4; ++i) {
    const Eigen::Vector2d from(0.4 * i, 0.0);
    const Eigen::Vector2d ray = landmark - from;
    point = with_bearing(point, from, std::atan2(ray.y(), ray.x()), 0.1 * kDegree);
  }
  EXPECT_NEAR(point.position().x(), landmark.x(), 0.05);
  EXPECT_NEAR(point.position().y(), landmark.y(), 0.05);
  EXPECT_LT(std::sqrt(point.covariance(1, 1)), 0.02);
}

TEST(PolarPoint, DistanceIsThatOfTheAzimuthWhereTheRangeSaysNothing) {
  const Eigen::Matrix2d P = Eigen::Vector2d(1e-4, 1e6).asDiagonal();
  EXPECT_NEAR(distance_in_sigmas({0.02, 0.5, P}, {0.0, 0.1, Eigen::Matrix2d::Zero()}, true), 2.0, 1e-6);
  EXPECT_NEAR(distance_in_sigmas({kPi - 0.01, 0.5, P}, {-kPi + 0.01, 0.1, Eigen::Matrix2d::Zero()}, false), 2.0, 1e-9);
}

// ---------------------------------------------------------------------------------------------- walls

RC_GTEST_PROP(WallLine, IsCarriedLikeItsEnds, (unsigned seed)) {
  std::mt19937 random(seed);
  const geometry::Segment extent{{uniform(random, -3, 3), uniform(random, 1, 3)},
                                 {uniform(random, -3, 3), uniform(random, -3, 0)}};
  const Pose2 T{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -3, 3)};
  const WallLine carried = carry(wall_line(line_through(extent), extent), {T, Eigen::Matrix3d::Zero()});
  const geometry::Segment there = T.inverse() * extent;
  for (const Eigen::Vector2d& end : {there.a, there.b}) {
    RC_ASSERT(std::abs(carried.normal().dot(end) - carried.distance) < 1e-12);
    const double along = carried.direction().dot(end);
    RC_ASSERT(std::min(std::abs(along - carried.begin), std::abs(along - carried.end)) < 1e-12);
  }
  RC_ASSERT((carried.middle() - there.centre()).norm() < 1e-12);
}

RC_GTEST_PROP(WallLine, IsCarriedWithTheCovarianceOfTheFirstOrder, (unsigned seed)) {
  std::mt19937 random(seed);
  Eigen::Matrix<double, 5, 1> x;  // angle, distance, motion
  x << uniform(random, -kPi, kPi), uniform(random, -3.0, 3.0), uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0),
      uniform(random, -kPi, kPi);
  Eigen::Matrix<double, 5, 5> P = Eigen::Matrix<double, 5, 5>::Zero();
  P.topLeftCorner<2, 2>() << 0.01, 0.002, 0.002, 0.04;
  P.bottomRightCorner<3, 3>() = random_covariance(random);
  const auto carried_from = [&](const Eigen::Matrix<double, 5, 1>& v) {
    WallLine wall;
    wall.angle = v[0], wall.distance = v[1];
    wall.covariance = P.topLeftCorner<2, 2>();
    return carry(wall, {Pose2{v[2], v[3], v[4]}, P.bottomRightCorner<3, 3>()});
  };
  const auto map = [&](const Eigen::Matrix<double, 5, 1>& v) -> Eigen::Vector2d {
    const WallLine wall = carried_from(v);
    return {wall.angle, wall.distance};
  };
  const Eigen::Matrix2d expected = carried_numerically<5>(x, P, map, angle_first);
  RC_ASSERT((carried_from(x).covariance - expected).norm() < 1e-6 * (1.0 + expected.norm()));
}

TEST(WallLine, FarFromTheOriginIsAsCertainAsItsLine) {
  // Errors of angle and distance are large and correlated there; at the centroid they are the line's own.
  const geometry::Segment extent{{10.0, 2.0}, {12.0, 2.0}};
  const WallLine wall = wall_line(line_through(extent), extent);
  EXPECT_GT(std::sqrt(wall.covariance(1, 1)), 0.05);
  const double at = 11.0;
  EXPECT_NEAR(wall.covariance(1, 1) + 2.0 * at * wall.covariance(0, 1) + at * at * wall.covariance(0, 0), 0.005 * 0.005,
              1e-12);
}

TEST(WallLine, IsTheSameWhicheverWayItIsSeen) {
  const WallLine there = wall_line(line_through({{3.0, 1.0}, {-1.0, 1.2}}), {{3.0, 1.0}, {-1.0, 1.2}});
  const WallLine back =
      aligned_with(wall_line(line_through({{-1.0, 1.2}, {3.0, 1.0}}), {{-1.0, 1.2}, {3.0, 1.0}}), there);
  const WallDifference apart = difference(back, there);
  EXPECT_NEAR(apart.angle, 0.0, 1e-12);
  EXPECT_NEAR(apart.across, 0.0, 1e-12);
  EXPECT_NEAR(apart.overlap, (there.end - there.begin), 1e-12);
  EXPECT_NEAR((back.covariance - there.covariance).norm(), 0.0, 1e-12);
}

TEST(WallLine, DistanceAcrossIsTakenWhereBothWereSeen) {
  const WallLine expected = wall_line(line_through({{0.0, 2.0}, {10.0, 2.0}}), {{0.0, 2.0}, {10.0, 2.0}});
  // One degree off, crossing at x = 8, seen from 6 to 10: the same wall there, 14 cm off at the origin's foot.
  const double slope = std::tan(1.0 * kDegree);
  const geometry::Segment seen{{6.0, 2.0 - 2.0 * slope}, {10.0, 2.0 + 2.0 * slope}};
  const WallDifference apart = difference(aligned_with(wall_line(line_through(seen), seen), expected), expected);
  EXPECT_NEAR(apart.angle, 1.0 * kDegree, 1e-9);
  EXPECT_NEAR(apart.across, 0.0, 1e-3);
  EXPECT_NEAR(apart.overlap, 4.0, 1e-9);
}

TEST(WallLine, GapCountsAndOverlapDoesNot) {
  const WallFloors floors;
  const auto at = [](double from, double to) {
    return wall_line(line_through({{from, 2.0}, {to, 2.0}}), {{from, 2.0}, {to, 2.0}});
  };
  const auto sigmas = [&](const WallLine& a, const WallLine& b) {
    return distance_in_sigmas(a, b, difference(a, b), floors);
  };
  EXPECT_NEAR(sigmas(at(0.0, 1.0), at(0.5, 5.0)), 0.0, 1e-9);
  EXPECT_NEAR(sigmas(at(0.0, 1.0), at(1.3, 5.0)), 0.3 / floors.gap_m, 1e-9);
}

// ---------------------------------------------------------------------------------------------- extrapolation

TEST(History, OfThreeIsExtrapolatedAsInThePaper) {
  History history;
  history.add(0, 10.0, 0.1), history.add(1, 11.0, 0.1), history.add(2, 13.0, 0.1);
  EXPECT_NEAR(history.extrapolate(3, 3).value, (4.0 * 13.0 + 11.0 - 2.0 * 10.0) / 3.0, 1e-12);
  EXPECT_NEAR(history.extrapolate(2, 3).value, 2.0 * 13.0 - 11.0, 1e-12);
  EXPECT_NEAR(history.extrapolate(2, 3).variance, 5.0 * 0.01, 1e-12);
}

TEST(History, OfOneIsRepeated) {
  History history;
  history.add(4, 0.7, 0.1);
  EXPECT_EQ(history.extrapolate(3, 9).value, 0.7);
  EXPECT_EQ(history.extrapolate(3, 9).from, 1);
}

TEST(History, SpansGaps) {
  History history;
  history.add(0, 1.0, 0.1), history.add(3, 4.0, 0.1);
  EXPECT_NEAR(history.extrapolate(2, 6).value, 7.0, 1e-12);
}

TEST(History, UnwrapsAngles) {
  History history;
  history.add_angle(0, 3.1, 0.1, 2.0 * kPi), history.add_angle(1, 3.2 - 2.0 * kPi, 0.1, 2.0 * kPi);
  EXPECT_NEAR(history.last(), 3.2, 1e-12);
  EXPECT_NEAR(history.extrapolate(2, 2).value, 3.3, 1e-12);
}

TEST(History, KeepsItsSlopeWhenShifted) {
  History history;
  history.add(0, 1.0, 0.1), history.add(1, 1.5, 0.1);
  history.shift(10.0);
  EXPECT_NEAR(history.extrapolate(2, 2).value, 12.0, 1e-12);
}

TEST(History, ForgetsTheOldest) {
  History history;
  for (int i = 0; i < 20; ++i) history.add(i, i < 12 ? 100.0 : i, 0.1);
  EXPECT_EQ(history.size(), History::kCapacity);
  EXPECT_NEAR(history.extrapolate(8, 20).value, 20.0, 1e-9);
}

TEST(Prediction, WithoutOdometryCoversWhatALandmarkOneMetreAsideDoes) {
  // 30 cm steps: the line over the last two azimuths is up to 3.2 degrees off. Three expected sigmas have to cover it.
  PredictionParams params;
  Memory memory;
  double worst = 0.0;
  for (int t = 0; t < 20; ++t) {
    const Primitive seen = point(PrimitiveType::kEdge, {3.0 - 0.3 * t, 1.0});
    if (t >= 2) {
      predict(memory, seen, std::nullopt, t, perception::Method::kDefault, params);
      const double error = std::abs(geometry::angle_difference(memory.now.point.azimuth, seen.azimuth));
      EXPECT_LT(error, 3.0 * memory.now.point.sigma_azimuth());
      worst = std::max(worst, error);
    }
    observe(memory, seen, scene({}), t, t == 0, params);
  }
  EXPECT_GT(worst, 3.0 * kDegree);
  EXPECT_LT(worst, 3.3 * kDegree);
}

}  // namespace
}  // namespace credo::tracking
