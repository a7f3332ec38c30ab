// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "datasets/acquisitions.hpp"
#include "datasets/carmen.hpp"
#include "localization/ego_motion.hpp"
#include "perception/observer.hpp"

namespace credo::localization {
namespace {

using geometry::Pose2;

/// Rows of `t x y theta` in seconds, metres and radians.
std::vector<Pose2> reference_poses(const std::filesystem::path& file) {
  std::vector<Pose2> poses;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream row(line);
    double time = 0.0;
    Pose2 pose;
    if (row >> time >> pose.x >> pose.y >> pose.theta) poses.push_back(pose);
  }
  return poses;
}

double distance(const Pose2& a, const Pose2& b) { return std::hypot(a.x - b.x, a.y - b.y); }

TEST(RealEgoMotion, TheIntelLabIsADriveOfHalfAKilometreWithBadOdometry) {
  const char* data = std::getenv("CREDO_DATA");
  if (data == nullptr || *data == '\0') GTEST_SKIP() << "CREDO_DATA is not set";
  const std::filesystem::path folder = std::filesystem::path(data) / "real" / "intel_lab";
  const std::filesystem::path log = folder / "DERIVED_intel_raw_odometry.clf.gz";
  if (!std::filesystem::exists(log)) GTEST_SKIP() << log << " is not there";
  const datasets::Dataset dataset = datasets::to_dataset(datasets::read_carmen(log), "intel_lab");
  const std::vector<Pose2> reference = reference_poses(folder / "DERIVED_intel_reference_poses.txt");
  const datasets::Acquisitions acquisitions(dataset);
  ASSERT_EQ(reference.size(), acquisitions.size());
  perception::Observer observer(dataset.header.rig);
  EgoMotion ego(geometry::PoseEstimate{.pose = reference.front()});
  Pose2 odometry = reference.front();
  double worst = 0.0, worst_odometry = 0.0;
  for (std::size_t i = 0; i < acquisitions.size(); ++i) {
    const sensors::Acquisition acquisition = acquisitions.read(i);
    ego.update(observer.observe(acquisition), acquisition.motion);
    if (acquisition.motion) odometry = odometry * acquisition.motion->pose;
    worst = std::max(worst, distance(ego.pose().value.pose, reference[i]));
    worst_odometry = std::max(worst_odometry, distance(odometry, reference[i]));
  }
  EXPECT_GT(worst_odometry, 50.0);
  EXPECT_LT(worst, 10.0);
}

}  // namespace
}  // namespace credo::localization
