// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/integrity_monitor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Pose2;

constexpr double kPointSigma = 0.02;
constexpr double kBearingSigma = 0.003;

Observation point_at(int landmark, const Vector2d& at) {
  Observation o;
  o.kind = ObservationKind::kPoint;
  o.landmark = landmark;
  o.map_point = o.base_point = at;
  o.noise = kPointSigma * kPointSigma * Matrix2d::Identity();
  return o;
}

Observation bearing_to(int landmark, const Vector2d& at) {
  Observation o;
  o.kind = ObservationKind::kBearing;
  o.landmark = landmark;
  o.map_point = at;
  o.base_angle = std::atan2(at.y(), at.x());
  o.noise(0, 0) = kBearingSigma * kBearingSigma;
  return o;
}

/// What is seen from the origin: points all around, and as many bearings; without noise.
std::vector<Observation> surroundings(int points, int bearings) {
  std::vector<Observation> seen;
  for (int i = 0; i < points; ++i) {
    const double angle = 0.3 + 2.0 * i;
    seen.push_back(point_at(i, 3.0 * Vector2d(std::cos(angle), std::sin(angle))));
  }
  for (int i = 0; i < bearings; ++i) {
    const double angle = 1.1 + 1.7 * i;
    seen.push_back(bearing_to(points + i, 2.5 * Vector2d(std::cos(angle), std::sin(angle))));
  }
  return seen;
}

/// A prediction at the origin.
CalibratedPose prediction(double sigma_m, double sigma_rad) {
  CalibratedPose prior = calibrated_pose({}, {});
  widen(prior, Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal());
  return prior;
}

class Monitor : public ::testing::Test {
 protected:
  Integrity assess(const std::vector<Observation>& seen, double belief = 0.9, std::span<const Alias> aliases = {}) {
    solution_ = PoseSolver().solve(prior_, seen);
    return IntegrityMonitor({}, params_).assess(solution_, std::vector<double>(seen.size(), belief), misfit_, aliases);
  }
  [[nodiscard]] double position_error() const { return solution_.pose.pose.translation().norm(); }

  IntegrityParams params_;
  VarianceFactors misfit_;
  CalibratedPose prior_ = prediction(0.1, 0.05);
  PoseSolution solution_;
};

TEST_F(Monitor, WithoutFaultsTheLevelIsTheGaussianOne) {
  params_.point_faults.fill({0.0, {0.0, 0.0}});
  params_.points_together = params_.instrument_fault = params_.prediction_fault = {0.0, 0.0};
  params_.sigma_overbound = 1.0;
  const Integrity integrity = assess(surroundings(6, 6));
  const double sigma = std::sqrt(solution_.pose.covariance()(0, 0));
  const double k = std::sqrt(-2.0 * std::log(0.5 * params_.risk));
  EXPECT_NEAR(integrity.protection.position_high_m, k * sigma, 0.05 * k * sigma);
  EXPECT_NEAR(integrity.protection.heading_high_rad, k * std::sqrt(solution_.pose.covariance()(2, 2)),
              0.05 * k * std::sqrt(solution_.pose.covariance()(2, 2)));
  EXPECT_EQ(integrity.protection.position_low_m, integrity.protection.position_high_m);
  EXPECT_EQ(integrity.landmarks, 12);
}

TEST_F(Monitor, TheLevelGrowsWithTheMisfitAndDoesNotShrinkWithIt) {
  params_.point_faults.fill({0.0, {0.0, 0.0}});
  params_.points_together = params_.instrument_fault = params_.prediction_fault = {0.0, 0.0};
  const double usual = assess(surroundings(6, 6)).protection.position_high_m;
  misfit_ = {.all = 4.0, .walls = 4.0};
  EXPECT_NEAR(assess(surroundings(6, 6)).protection.position_high_m, 2.0 * usual, 0.05 * usual);
  misfit_ = {.all = 0.25, .walls = 0.25};
  EXPECT_DOUBLE_EQ(assess(surroundings(6, 6)).protection.position_high_m, usual);
}

TEST_F(Monitor, LeavingALandmarkOutGivesThePoseThatTheOthersGive) {
  std::vector<Observation> seen = surroundings(5, 4);
  seen[2].base_point += Vector2d(0.03, -0.02);  // little enough for every robust weight to be near 1
  const Integrity integrity = assess(seen);
  const Pose2 with = solution_.pose.pose;
  seen.erase(seen.begin() + 2);
  const PoseSolution without = PoseSolver().solve(prior_, seen);
  const double separation = (without.pose.pose.translation() - with.translation()).norm();
  const double sigma = std::sqrt(without.pose.covariance()(0, 0) - solution_.pose.covariance()(0, 0));
  EXPECT_EQ(integrity.separated, 2);
  EXPECT_NEAR(integrity.separation, separation / sigma / std::sqrt(3.0), 0.35 * integrity.separation);
}

TEST_F(Monitor, AWrongMatchIsFoundAndTheLevelCoversWhatItDoes) {
  for (const double fault : {0.05, 0.1, 0.2, 0.4}) {
    std::vector<Observation> seen = surroundings(4, 3);
    seen[1].base_point += Vector2d(fault, fault);
    const Integrity integrity = assess(seen);
    EXPECT_EQ(integrity.separated, 1);
    EXPECT_GT(integrity.separation, 1.2);
    EXPECT_GT(integrity.protection.position_low_m, position_error());
  }
}

/// How often what is wrong, and how well the prediction is known.
struct Faults {
  const char* name;
  double landmark = 0.0, instrument = 0.0, slip = 0.0;  ///< probabilities; of each of them
  double prediction_sigma = 0.1;                        ///< [m, rad]
};

/// Acquisitions of a robot that is where its prediction says, but for the errors that the prediction states, and whose
/// readings err as they state; faults are as likely as the monitor is told.
class RandomFaults : public Monitor, public ::testing::WithParamInterface<Faults> {
 protected:
  static constexpr std::size_t kRuns = 6000;
  static constexpr double kRisk = 1e-2;                    ///< half of it for the position, half for the heading
  static constexpr double kAllowed = 0.5 * kRisk * kRuns;  ///< errors above their level

  RandomFaults() {
    params_.risk = kRisk;
    params_.sigma_overbound = 1.0;  // the errors are normal
    const Faults& faults = GetParam();
    params_.point_faults.fill({0.0, {faults.landmark, faults.landmark}});
    params_.instrument_fault = {faults.instrument, faults.instrument};
    params_.prediction_fault = {faults.slip, faults.slip};
    prior_ = prediction(faults.prediction_sigma, faults.prediction_sigma);
  }

  /// Of all acquisitions, each by size.
  struct Component {
    std::vector<double> errors, levels;
    int exceeded = 0;

    void add(double error, double level) {
      errors.push_back(error);
      levels.push_back(level);
      exceeded += error > level;
    }
  };
  struct Outcome {
    Component position, heading;
  };

  /// \param told  what the monitor is told; what happens is as params_ have it
  Outcome play(const IntegrityParams& told) {
    Outcome outcome;
    PoseSolver solver;
    IntegrityMonitor monitor({}, told);
    for (std::size_t run = 0; run < kRuns; ++run) {
      const Pose2 truth = draw_truth();
      const std::vector<Observation> seen = draw_readings(truth);
      const PoseSolution& solution = solver.solve(prior_, seen);
      const ProtectionLevels levels = monitor.assess(solution, std::vector<double>(seen.size(), 0.9)).protection;
      const Pose2& pose = solution.pose.pose;
      outcome.position.add((pose.translation() - truth.translation()).norm(), levels.position_high_m);
      outcome.heading.add(std::abs(geometry::angle_difference(pose.theta, truth.theta)), levels.heading_high_rad);
    }
    return outcome;
  }

  /// What nobody reckons with.
  [[nodiscard]] IntegrityParams without_faults() const {
    IntegrityParams params = params_;
    params.point_faults.fill({0.0, {0.0, 0.0}});
    params.points_together = params.instrument_fault = params.prediction_fault = {0.0, 0.0};
    return params;
  }

  static double quantile(std::vector<double> values, double share) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return *at;
  }

 private:
  double normal(double sigma) { return sigma * normal_(random_); }
  bool happens(double probability) { return std::bernoulli_distribution(probability)(random_); }

  Pose2 draw_truth() {
    const double sigma = GetParam().prediction_sigma;
    Pose2 truth{normal(sigma), normal(sigma), normal(sigma)};
    if (!happens(GetParam().slip)) return truth;
    truth.x += normal(params_.slip_m);
    truth.y += normal(params_.slip_m);
    truth.theta += normal(params_.slip_rad);
    return truth;
  }

  std::vector<Observation> draw_readings(const Pose2& truth) {
    const Faults& faults = GetParam();
    std::vector<Observation> seen = surroundings(3, 3);
    const Vector2d range_finder = happens(faults.instrument) ? Vector2d(normal(0.3), normal(0.3)) : Vector2d(0.0, 0.0);
    const double camera = happens(faults.instrument) ? normal(0.1) : 0.0;
    for (Observation& o : seen) {
      const Vector2d at = truth.inverse() * o.map_point;
      const double fault_m = happens(faults.landmark) ? 0.02 + std::abs(normal(0.3)) : 0.0;
      o.base_angle = std::atan2(at.y(), at.x()) + camera + normal(kBearingSigma) + fault_m * normal(0.3);
      if (o.kind != ObservationKind::kPoint) continue;
      o.base_point = at + range_finder + Vector2d(normal(kPointSigma), normal(kPointSigma)) +
                     fault_m * Vector2d(normal(1.0), normal(1.0));
    }
    return seen;
  }

  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};

TEST_P(RandomFaults, ExceedTheLevelNoMoreOftenThanTheRiskAllows) {
  const Outcome outcome = play(params_);
  EXPECT_LE(outcome.position.exceeded, kAllowed);
  EXPECT_LE(outcome.heading.exceeded, kAllowed);
}

/// Without it they are above the level too often. One level for all acquisitions would have to be the quantile of the
/// errors.
TEST_P(RandomFaults, AreReckonedWithAtAModestPrice) {
  const Outcome with = play(params_), without = play(without_faults());
  for (const auto component : {&Outcome::position, &Outcome::heading}) {
    const Component &of = with.*component, &naive = without.*component;
    EXPECT_GT(naive.exceeded, 2 * kAllowed);
    EXPECT_LT(quantile(of.levels, 0.5), 2.0 * quantile(naive.levels, 0.5));
    EXPECT_LT(quantile(of.levels, 0.9), quantile(of.errors, 1.0 - 0.5 * kRisk));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, RandomFaults,
    ::testing::Values(Faults{.name = "Everything", .landmark = 0.03, .instrument = 1e-3, .slip = 5e-3},
                      Faults{.name = "Instruments", .instrument = 0.02},
                      Faults{.name = "Wheels", .slip = 0.03, .prediction_sigma = 0.02}),
    [](const auto& tested) { return tested.param.name; });

TEST(FaultClass, PointsGoByTheBeliefInTheirTracksAndWallsByNone) {
  IntegrityParams params;
  params.point_faults = {{{0.0, {}}, {0.5, {}}, {0.8, {}}}};
  EXPECT_EQ(fault_class(false, 0.0, params), 0U);
  EXPECT_EQ(fault_class(false, 0.49, params), 0U);
  EXPECT_EQ(fault_class(false, 0.5, params), 1U);
  EXPECT_EQ(fault_class(false, 0.8, params), 2U);
  EXPECT_EQ(fault_class(false, 1.0, params), 2U);
  EXPECT_EQ(fault_class(true, 0.0, params), kWallFaultClass);
  EXPECT_EQ(fault_class(true, 1.0, params), kWallFaultClass);
}

TEST_F(Monitor, MatchesOfLessBelievedTracksGiveWiderLevels) {
  params_.point_faults = {{{0.0, {1e-3, 1e-2}}, {0.7, {1e-3, 5e-3}}, {0.9, {1e-8, 1e-7}}}};
  params_.points_together = {0.0, 0.0};
  const double sure = assess(surroundings(4, 2), 0.95).protection.position_high_m;
  const double unsure = assess(surroundings(4, 2), 0.75).protection.position_high_m;
  EXPECT_GT(unsure, 1.05 * sure);
}

TEST_F(Monitor, ManyMatchesThatAreOftenWrongAreWorthNoMoreThanThePrediction) {
  params_.point_faults.fill({0.0, {1e-6, 0.05}});
  params_.points_together = {0.0, 0.0};
  const Integrity integrity = assess(surroundings(12, 12));
  EXPECT_LT(integrity.protection.position_low_m, 0.1);
  EXPECT_GT(integrity.protection.position_high_m, 3.0 * 0.1);
}

TEST_F(Monitor, PointsThatAreWrongTogetherAreWorthNoMoreEither) {
  params_.point_faults.fill({0.0, {0.0, 0.0}});
  params_.points_together = {0.0, 1e-3};
  const Integrity integrity = assess(surroundings(12, 12));
  EXPECT_LT(integrity.protection.position_low_m, 0.1);
  EXPECT_GT(integrity.protection.position_high_m, 3.0 * 0.1);
}

TEST_F(Monitor, OfPointsThatAreWrongTheMisfitSaysNothingOfTheRest) {
  params_.point_faults.fill({0.0, {0.0, 0.0}});
  params_.points_together = {1e-3, 1e-3};
  const double usual = assess(surroundings(12, 12)).protection.position_high_m;
  misfit_ = {.all = 4.0, .walls = 1.0};
  EXPECT_NEAR(assess(surroundings(12, 12)).protection.position_high_m, usual, 0.02 * usual);
}

TEST_F(Monitor, WithoutAPredictionTheyAreWorthNothing) {
  params_.point_faults.fill({0.0, {1e-6, 0.05}});
  prior_ = prediction(1e3, 1e3);
  EXPECT_TRUE(std::isinf(assess(surroundings(12, 12)).protection.position_high_m));
}

TEST_F(Monitor, OneLandmarkAloneIsWorthWhatThePredictionIs) {
  params_.prediction_fault = {0.0, 0.0};
  prior_ = prediction(0.05, 0.02);
  const Integrity integrity = assess({point_at(0, {2, 0})});
  EXPECT_GT(integrity.protection.position_high_m, 3.0 * 0.05);
  EXPECT_LT(integrity.protection.position_high_m, 6.0 * 0.05 * params_.sigma_overbound);
}

TEST_F(Monitor, CameraAndRangeFinderThatDisagreeAreTold) {
  std::vector<Observation> seen = surroundings(6, 6);
  EXPECT_LT(assess(seen).instrument_separation, 0.2);
  for (Observation& o : seen)
    if (o.kind == ObservationKind::kPoint) o.base_point += Vector2d(0.06, 0.0);
  EXPECT_GT(assess(seen).instrument_separation, 2.0);
}

TEST_F(Monitor, WheelsThatSlippedAreToldByTheLandmarks) {
  prior_.pose = {0.5, 0.0, 0.0};
  prior_.joint.topLeftCorner<3, 3>() *= 0.2;
  EXPECT_GT(assess(surroundings(8, 8)).instrument_separation, 2.0);
}

TEST_F(Monitor, AnAliasThatIsLikelyEnoughWidensTheLevelToItself) {
  const std::array likely{Alias{.distance_m = 2.0, .turn_rad = 0.0, .probability = {1e-6, 1e-3}}};
  const Integrity integrity = assess(surroundings(8, 8), 0.9, likely);
  EXPECT_LT(integrity.protection.position_low_m, 1.0);
  EXPECT_GE(integrity.protection.position_high_m, 2.0);
  const double heading = assess(surroundings(8, 8)).protection.heading_high_rad;
  EXPECT_NEAR(integrity.protection.heading_high_rad, heading, 0.1 * heading) << "it is not turned";
}

TEST_F(Monitor, LessRiskAsksForWiderLevels) {
  double before = 0.0;
  for (const double risk : {1e-3, 1e-4, 1e-5, 1e-6}) {
    params_.risk = risk;
    const double level = assess(surroundings(8, 8)).protection.position_low_m;
    EXPECT_GT(level, before);
    before = level;
  }
}

TEST_F(Monitor, WithoutObservationsThePredictionAloneSpeaks) {
  const Integrity integrity = assess({});
  EXPECT_EQ(integrity.landmarks, 0);
  EXPECT_GT(integrity.protection.position_high_m, 0.4);
}

}  // namespace
}  // namespace credo::localization
