// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/pose_blur.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <numeric>

#include "evidence/log_commonality.hpp"
#include "mapping/sequential_mapper.hpp"
#include "tests/mapping/readings.hpp"

namespace credo::mapping {
namespace {

using namespace test;  // NOLINT: the helpers of these tests

constexpr double kResolution = 0.05;

std::vector<Believed<PoseEstimate>> poses_of(const Believed<PoseEstimate>& pose, float farthest_m,
                                             const PoseBlurParams& params = {}) {
  return poses_for_blur(pose, std::array{farthest_m, 99.0F, kNan}, 8.0, kResolution, params);
}

/// The map of one scan of a room of 6 m x 3 m.
grids::EvidentialGrid map_of_room(const Believed<PoseEstimate>& from, const PoseBlurParams& blur = {}) {
  MapperParams params;
  params.blur = blur;
  Mapper mapper(rig_with(panoramic()), params);
  mapper.insert(from, scan_of_room(panoramic(), from.value.pose, 6.025, 3.025));
  return mapper.take_grid();
}

/// Mass that speaks for a wall, across the far one: the surface is in the middle of cell 120.
std::vector<double> across_the_wall(const grids::EvidentialGrid& grid, int cells_aside) {
  std::vector<double> profile;
  for (int aside = -cells_aside; aside <= cells_aside; ++aside)
    profile.push_back(-std::expm1(grid.at({120 + aside, 24}).value().empty));
  return profile;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

const Pose2 kPose{1.025, 1.225, 0.3};

TEST(PoseBlur, ASurePoseNeedsNoOtherAndMapsAsEver) {
  const PoseBlurParams never{.from_cells = std::numeric_limits<double>::infinity()};
  for (const double sigma_m : {0.0, 0.002, 0.01}) {
    const auto pose = with_sigma(kPose, sigma_m, 0.1 * sigma_m);
    EXPECT_TRUE(poses_of(pose, 6.0F).empty());
    EXPECT_EQ(map_of_room(pose), map_of_room(pose, never));
  }
}

RC_GTEST_PROP(PoseBlur, ThePosesHaveTheMeanAndTheCovariance, ()) {
  const auto number = [](int low, int high) { return *rc::gen::inRange(low, high) * 1e-3; };
  Eigen::Matrix3d root;
  for (double& entry : root.reshaped()) entry = number(-60, 60);
  Believed<PoseEstimate> pose = certain({number(-9000, 9000), number(-9000, 9000), number(-3000, 3000)});
  pose.value.covariance = root * root.transpose();
  const auto poses = poses_of(pose, 3.0F, {.from_cells = 0.1, .most_cells = 100.0});
  RC_PRE(!poses.empty());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& one : poses) {
    const Pose2& p = one.value.pose;
    const Eigen::Vector3d error(p.x - pose.value.pose.x, p.y - pose.value.pose.y,
                                geometry::wrap_angle(p.theta - pose.value.pose.theta));
    mean += error / static_cast<double>(poses.size());
    covariance += error * error.transpose() / static_cast<double>(poses.size());
    RC_ASSERT(one.value.covariance.isZero());
    RC_ASSERT(one.belief == pose.belief);
  }
  RC_ASSERT(mean.norm() < 1e-9);
  RC_ASSERT((covariance - pose.value.covariance).norm() < 1e-9);
}

TEST(PoseBlur, WidensAWallToBothSidesAlikeAndKeepsItsMass) {
  const std::vector<double> sharp = across_the_wall(map_of_room(certain(kPose)), 12);
  auto pose = certain(kPose);
  pose.value.covariance(0, 0) = 0.1 * 0.1;  // two cells along x
  const std::vector<double> blurred = across_the_wall(map_of_room(pose), 12);
  double mass = 0.0;  // of a wall anywhere between cells
  for (int k = -5; k < 5; ++k) {
    const Pose2 aside{kPose.x + 0.1 * (k + 0.5) * kResolution, kPose.y, kPose.theta};
    Mapper mapper(rig_with(panoramic()));
    mapper.insert(certain(aside), scan_of_room(panoramic(), kPose, 6.025, 3.025));
    mass += 0.1 * sum(across_the_wall(mapper.grid(), 12));
  }
  EXPECT_NEAR(sum(blurred), mass, 0.1 * mass);
  EXPECT_LT(blurred[12], 0.5 * sharp[12]);
  EXPECT_GT(blurred[14], 0.2);
  EXPECT_LT(sharp[14], 0.01);
  const auto free = [](std::size_t cell) { return cell < 12 ? 0.04 : 0.0; };  // what free space leaves to a wall
  for (std::size_t aside = 1; aside <= 8; ++aside)
    EXPECT_NEAR(blurred[12 - aside] - free(12 - aside), blurred[12 + aside], 0.03) << aside;
}

TEST(PoseBlur, WhatIsSureFromAllPosesStaysSure) {
  const grids::CellIndex middle{60, 30};
  EXPECT_GT(weight(map_of_room(with_sigma(kPose, 0.1, 0.0)).at(middle)),
            0.9 * weight(map_of_room(certain(kPose)).at(middle)));
}

TEST(PoseBlur, AnAngleBlursWhatIsFarAndNotWhatIsNear) {
  const auto walls = [](const grids::EvidentialGrid& grid, grids::CellIndex cell) {
    return -std::expm1(grid.at(cell).value().empty);
  };
  const grids::EvidentialGrid sharp = map_of_room(certain(kPose)), turned = map_of_room(with_sigma(kPose, 0.0, 0.02));
  EXPECT_GT(walls(turned, {20, 60}),
            0.85 * walls(sharp, {20, 60}));  // straight ahead of the wall, 1.8 m: turning slides
  EXPECT_LT(walls(turned, {100, 60}), 0.75 * walls(sharp, {100, 60}));  // seen aslant, 4 m
}

TEST(PoseBlur, APoseThatKnowsNothingMapsNextToNothing) {
  const grids::EvidentialGrid sure = map_of_room(certain(kPose)), lost = map_of_room(with_sigma(kPose, 30.0, 3.0)),
                              vague = map_of_room(with_sigma(kPose, 1.0, 0.0));
  const grids::CellIndex middle{60, 30};
  EXPECT_LT(weight(lost.at(middle)), 0.01 * weight(sure.at(middle)));
  EXPECT_LT(weight(vague.at(middle)), 0.3 * weight(sure.at(middle)));
}

TEST(PoseBlur, BlursSonarToo) {
  const auto map = [](const Believed<PoseEstimate>& from) {
    Mapper mapper(rig_with(one_sonar()));
    mapper.insert(from, sensors::SonarSweep{0, 0, {1.0F}});
    return mapper.take_grid();
  };
  const grids::EvidentialGrid sharp = map(certain({})), blurred = map(with_sigma({}, 0.1, 0.0));
  EXPECT_GT(cells_in(blurred), cells_in(sharp));
  EXPECT_LT(blurred.at({20, 0}).value().empty, 0.0);
  EXPECT_GT(blurred.at({20, 0}).value().empty, 0.6 * sharp.at({20, 0}).value().empty);
  EXPECT_EQ(map(with_sigma({}, 0.1, 0.0)), blurred);
}

TEST(PoseBlur, FoldsBlurScansAsTheSumDoes) {
  const auto pose = with_sigma(kPose, 0.1, 0.01);
  SequentialMapper<DempsterFold> fold(rig_with(panoramic()), {});
  fold.insert(pose, scan_of_room(panoramic(), kPose, 6.025, 3.025));
  EXPECT_EQ(fold.counts(), (MappingCounts{.scans = 1, .echoes = 360}));
  const grids::EvidentialGrid sum = map_of_room(pose);
  int cells = 0;
  fold.grid().for_each([&](grids::CellIndex cell, const evidence::GridMass& mass) {
    const evidence::GridMass expected = evidence::normalised_masses(sum.at(cell).value());
    EXPECT_NEAR(mass.occupied, expected.occupied, 1e-9);
    EXPECT_NEAR(mass.empty, expected.empty, 1e-9);
    ++cells;
  });
  EXPECT_EQ(cells, cells_in(sum));
}

TEST(PoseBlur, FoldsBlurASonarsMasses) {
  const auto masses = [](const Believed<PoseEstimate>& from) {
    SequentialMapper<DsmcFold> mapper(rig_with(one_sonar()), {});
    mapper.insert(from, sensors::SonarSweep{0, 0, {1.0F}});
    EXPECT_EQ(mapper.counts(), (MappingCounts{.sweeps = 1, .echoes = 1}));
    return mapper.masses();
  };
  const auto unsure = with_sigma({}, 0.1, 0.0);
  const grids::MassMap blurred = masses(unsure);
  const std::vector<Believed<PoseEstimate>> poses = poses_of(unsure, 1.0F);
  std::vector<grids::MassMap> from_each;
  for (const auto& pose : poses) from_each.push_back(masses(certain(pose.value.pose)));
  for (const grids::CellIndex cell : {grids::CellIndex{6, 0}, {15, 1}, {20, 0}, {24, -3}}) {
    evidence::GridMass mean{.empty = 0.0, .occupied = 0.0, .conflict = 0.0, .unknown = 0.0};
    for (const grids::MassMap& map : from_each) {
      const evidence::GridMass mass = map.saw(cell) ? map.at(cell) : evidence::GridMass::vacuous();
      mean.empty += mass.empty / static_cast<double>(poses.size());
      mean.occupied += mass.occupied / static_cast<double>(poses.size());
      mean.unknown += mass.unknown / static_cast<double>(poses.size());
    }
    EXPECT_GT(mean.empty + mean.occupied, 0.01);
    EXPECT_NEAR(blurred.at(cell).empty, mean.empty, 1e-6);
    EXPECT_NEAR(blurred.at(cell).occupied, mean.occupied, 1e-6);
    EXPECT_NEAR(blurred.at(cell).unknown, mean.unknown, 1e-6);
  }
}

/// Printed masses may hold no ignorance, and their mean is no less a mass.
TEST(PoseBlur, MassesWithoutIgnoranceStayMasses) {
  MapperParams params;
  params.sonar = Li2007Params{.reliability = 1.0, .variant = Variant::kPrinted};
  SequentialMapper<DempsterFloatFold> floats(rig_with(one_sonar()), params);
  SequentialMapper<DsmcFold> linear(rig_with(one_sonar()), params);
  const auto unsure = with_sigma({}, 0.1, 0.01);
  for (const float range_m : {0.6F, 1.0F, 2.0F}) {
    floats.insert(unsure, sensors::SonarSweep{0, 0, {range_m}});
    linear.insert(unsure, sensors::SonarSweep{0, 0, {range_m}});
  }
  linear.grid().for_each([](grids::CellIndex, const evidence::GridMass& mass) { EXPECT_GE(mass.unknown, 0.0); });
}

TEST(PoseBlur, CountsReadingsOnce) {
  Mapper mapper(rig_with(panoramic()));
  mapper.insert(with_sigma(kPose, 0.1, 0.01), scan_of_room(panoramic(), kPose, 6.0, 3.0));
  EXPECT_EQ(mapper.counts(), (MappingCounts{.scans = 1, .echoes = 360}));
}

TEST(PoseBlur, RefusesParametersThatAreNone) {
  for (const PoseBlurParams& params : {PoseBlurParams{.from_cells = 0.0}, PoseBlurParams{.from_cells = std::nan("")},
                                       PoseBlurParams{.most_cells = -1.0}})
    EXPECT_THROW(static_cast<void>(poses_of(certain({}), 1.0F, params)), std::invalid_argument);
}

TEST(EvidenceMean, IsTheMeanOfMasses) {
  const evidence::GridMass wall{.empty = 0.0, .occupied = 0.6, .conflict = 0.0, .unknown = 0.4};
  const evidence::GridMass free{.empty = 0.5, .occupied = 0.1, .conflict = 0.0, .unknown = 0.4};
  grids::EvidentialGrid one, other, nothing, result;
  one.add({3, 4}, evidence::quantise(evidence::log_commonality(wall, 0.99)));
  other.add({3, 4}, evidence::quantise(evidence::log_commonality(free, 0.99)));
  EvidenceMean mean;
  for (const auto* grid : {&one, &other, &nothing, &nothing}) mean.add(*grid);
  mean.combine_into(result);
  const evidence::GridMass mass = evidence::masses(result.at({3, 4}).value());
  EXPECT_NEAR(mass.empty, 0.99 * 0.5 / 4, 1e-5);
  EXPECT_NEAR(mass.occupied, 0.99 * 0.7 / 4, 1e-5);
  EXPECT_NEAR(mass.conflict, 0.0, 1e-5);
  EXPECT_EQ(cells_in(result), 1);
}

}  // namespace
}  // namespace credo::mapping
