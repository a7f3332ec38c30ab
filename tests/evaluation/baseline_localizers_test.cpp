// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <functional>
#include <memory>

#include "evaluation/baseline_ekf.hpp"
#include "evaluation/baseline_icp.hpp"
#include "evaluation/baseline_mcl.hpp"
#include "evaluation/consistency.hpp"
#include "tests/evaluation/simulated_room.hpp"

namespace credo::evaluation {
namespace {

using localization::Localization;
using test::believed;
using test::Moment;
using test::Pose2;
using test::PoseEstimate;
using test::position_error;
using Update = std::function<Localization(const Moment&)>;

template <Localizer L>
Update updating(L localizer) {
  const auto shared = std::make_shared<L>(std::move(localizer));
  return [shared](const Moment& moment) { return shared->update(moment.scene, moment.motion); };
}

EkfParams by(EkfAssociation association) {
  EkfParams params;
  params.association = association;
  return params;
}

MclParams particles(int count, std::uint64_t seed = 1) {
  MclParams params;
  params.particles = count;
  params.seed = seed;
  return params;
}

struct Baseline {
  const char* name;
  std::function<Update(const PoseEstimate&)> start;
};

void PrintTo(const Baseline& baseline, std::ostream* out) { *out << baseline.name; }

class Baselines : public testing::TestWithParam<Baseline> {
 protected:
  static std::vector<Localization> follow(const Update& update, const std::vector<Moment>& moments) {
    std::vector<Localization> fixes;
    for (const Moment& moment : moments) fixes.push_back(update(moment));
    return fixes;
  }
};

TEST_P(Baselines, FollowADriveFromAnInitialPoseThatIsSomewhatWrong) {
  const auto moments = test::drive(12, 3);
  const auto fixes = follow(GetParam().start(believed({1.04, 1.47, 0.02})), moments);
  double mean_nees = 0.0;
  for (std::size_t k = 0; k < fixes.size(); ++k) {
    EXPECT_LT(position_error(fixes[k].estimate.pose, moments[k].truth), 0.05) << k;
    EXPECT_LT(std::abs(geometry::angle_difference(fixes[k].estimate.pose.theta, moments[k].truth.theta)), 0.012) << k;
    EXPECT_EQ(fixes[k].time, moments[k].scene.time);
    mean_nees += nees(fixes[k].estimate, moments[k].truth) / static_cast<double>(fixes.size());
  }
  EXPECT_LT(mean_nees, 9.0);
}

TEST_P(Baselines, TrustThemselvesLessInTheWrongPlaceThanInTheRightOne) {
  const auto moments = test::drive(3, 4);
  const auto right = follow(GetParam().start(believed({1.0, 1.5, 0.0})), moments);
  const auto wrong = follow(GetParam().start(believed({3.1, 2.6, 0.8}, 0.02, 0.01)), moments);
  ASSERT_GT(position_error(wrong.back().estimate.pose, moments.back().truth), 0.25);
  EXPECT_GT(right.back().belief.pignistic(), wrong.back().belief.pignistic() + 0.2);
  EXPECT_EQ(right.back().status, localization::Status::kLocalized);
}

TEST_P(Baselines, FollowOdometryWhereNothingIsSeen) {
  const auto moments = test::drive(8, 5, 4);
  const auto fixes = follow(GetParam().start(believed({1.0, 1.5, 0.0})), moments);
  EXPECT_LT(position_error(fixes.back().estimate.pose, moments.back().truth), 0.15);
  EXPECT_GT(fixes.back().estimate.covariance(0, 0), fixes[3].estimate.covariance(0, 0));
  EXPECT_GT(fixes.back().estimate.covariance.determinant(), 0.0);
}

TEST_P(Baselines, FollowTheirLatestVelocityWhereThereIsNoOdometry) {
  auto moments = test::drive(10, 6);
  for (Moment& moment : moments) moment.motion.reset();
  const auto fixes = follow(GetParam().start(believed({1.0, 1.5, 0.0})), moments);
  EXPECT_LT(position_error(fixes.back().estimate.pose, moments.back().truth), 0.10);
}

INSTANTIATE_TEST_SUITE_P(
    , Baselines,
    testing::Values(Baseline{"EkfNearestNeighbour",
                             [](const PoseEstimate& initial) {
                               return updating(EkfLocalizer(test::room(), test::rig(), initial,
                                                            by(EkfAssociation::kNearestNeighbour)));
                             }},
                    Baseline{"EkfJointCompatibility",
                             [](const PoseEstimate& initial) {
                               return updating(EkfLocalizer(test::room(), test::rig(), initial,
                                                            by(EkfAssociation::kJointCompatibility)));
                             }},
                    Baseline{"Mcl",
                             [](const PoseEstimate& initial) {
                               return updating(MclLocalizer(test::room(), test::rig(), initial, particles(500)));
                             }},
                    Baseline{"Icp",
                             [](const PoseEstimate& initial) {
                               return updating(IcpLocalizer(test::room(), test::rig(), initial));
                             }}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(Mcl, IsAFunctionOfItsSeed) {
  const auto moments = test::drive(5, 7);
  const auto run = [&](std::uint64_t seed) {
    MclLocalizer localizer(test::room(), test::rig(), believed({1.0, 1.5, 0.0}), particles(200, seed));
    Localization fix;
    for (const Moment& moment : moments) fix = localizer.update(moment.scene, moment.motion);
    return fix.estimate;
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

TEST(Icp, ComesFromAnOraclesStartToTheTruthWhateverItDidBefore) {
  const auto moments = test::drive(2, 8);
  IcpLocalizer localizer(test::room(), test::rig(), believed({5.0, 3.0, 2.0}));
  const Pose2& truth = moments[1].truth;
  const Localization fix =
      localizer.update_from(believed({truth.x + 0.02, truth.y, truth.theta + 0.009}, 0.02, 0.009), moments[1].scene);
  EXPECT_LT(position_error(fix.estimate.pose, truth), 0.01);
  EXPECT_GT(fix.belief.yes, 0.95);
}

TEST(EkfWithJointCompatibility, RecognisesARoomThatTheNearestNeighboursShift) {
  // Ten marks 30 cm apart, seen as bearings from a pose whose error is about half of that: the nearest mark is as
  // often the neighbour.
  geometry::FloorPlan plan = test::room();
  for (int i = 0; i < 10; ++i) plan.verticals.emplace_back(1.0 + 0.3 * i + 0.04 * (i % 3), 4.0 - 1e-6);
  const Pose2 truth{2.5, 2.0, 1.5707963};
  perception::Scene scene;
  scene.camera_seen = true;
  for (const Eigen::Vector2d& mark : plan.verticals) {
    if (mark.x() > 1.9 && mark.x() < 3.6) continue;  // the recess
    const Eigen::Vector2d way = truth.inverse() * mark;
    perception::Primitive& seen = scene.primitives.emplace_back();
    seen.bearing_only = true;
    seen.radial_line = static_cast<int>(scene.radial_lines.size());
    seen.azimuth = std::atan2(way.y(), way.x());
    seen.sigma_azimuth = 0.002;
    scene.radial_lines.push_back({.azimuth = seen.azimuth, .sigma = 0.002});
  }
  ASSERT_GE(scene.primitives.size(), 4u);
  const PoseEstimate initial = believed({2.5, 2.0, 1.5707963 + 0.065}, 0.01, 0.04);
  const auto error = [&](EkfAssociation association) {
    EkfLocalizer localizer(plan, {}, initial, by(association));
    return std::abs(geometry::angle_difference(localizer.update(scene, std::nullopt).estimate.pose.theta, truth.theta));
  };
  EXPECT_LT(error(EkfAssociation::kJointCompatibility), 0.005);
  EXPECT_GT(error(EkfAssociation::kNearestNeighbour), 0.01);
}

}  // namespace
}  // namespace credo::evaluation
