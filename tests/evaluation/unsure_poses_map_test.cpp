// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "evaluation/map_experiment.hpp"
#include "sim/world.hpp"

namespace credo::evaluation {
namespace {

constexpr double kSigmaM = 0.08, kSigmaRad = 0.02;

/// The map of a drive whose poses are off by independent errors, of which they know the covariance.
MapScore score_with_unsure_poses(const MapDrive& drive, const mapping::PoseBlurParams& blur) {
  mapping::MapperParams params;
  params.blur = blur;
  mapping::Mapper mapper(drive.rig, params);
  std::mt19937 generator(8);
  std::normal_distribution<double> normal;
  const Eigen::Vector3d sigmas(kSigmaM, kSigmaM, kSigmaRad);
  for (const sensors::RangeScan& scan : drive.scans) {
    geometry::PoseEstimate pose{drive.T_map_base.pose_at(scan.time), sigmas.cwiseAbs2().asDiagonal()};
    pose.pose.x += kSigmaM * normal(generator);
    pose.pose.y += kSigmaM * normal(generator);
    pose.pose.theta += kSigmaRad * normal(generator);
    mapper.insert({pose, {.yes = 1.0, .no = 0.0, .unknown = 0.0}}, scan, drive.T_map_base);
  }
  return map_score(grids::mass_map(mapper.grid(), grids::ReadOut::kDempster), drive.truth);
}

TEST(UnsurePoses, MakeABetterMapWhereTheyBlurThanWhereTheyOnlyDiscount) {
  const MapDrive drive =
      first_part(play_for_mapping(sim::load_world(CREDO_SOURCE_DIR "/sim/worlds/demo.yaml"), 1), 6.0);
  const MapScore blurred = score_with_unsure_poses(drive, {});
  const MapScore discounted = score_with_unsure_poses(drive, {.from_cells = std::numeric_limits<double>::infinity()});
  RecordProperty("blurred", std::to_string(blurred.brier) + " " + std::to_string(blurred.log_loss));
  RecordProperty("discounted", std::to_string(discounted.brier) + " " + std::to_string(discounted.log_loss));
  EXPECT_LT(blurred.brier, discounted.brier);
  EXPECT_LT(blurred.log_loss, discounted.log_loss);
}

}  // namespace
}  // namespace credo::evaluation
