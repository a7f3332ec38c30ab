// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/simulated_drive.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "datasets/acquisitions.hpp"
#include "datasets/dataset_writer.hpp"
#include "tests/evaluation/campaign_worlds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace credo::evaluation {
namespace {

std::vector<sensors::Acquisition> acquisitions_of(const sim::Simulation& simulation) {
  std::vector<sensors::Acquisition> all;
  const datasets::Dataset readings = readings_of(simulation);
  for_each_acquisition(simulation, readings, [&](sensors::Acquisition a) { all.push_back(std::move(a)); });
  return all;
}

void write(const sim::Simulation& simulation, const std::filesystem::path& folder) {
  datasets::DatasetWriter writer(folder, header_of(simulation));
  sim::Sink sink;
  sink.image = [&](const sensors::OmniImage& image) { writer.add_image(image.time, image.pixels); };
  sink.scan = [&](const sensors::RangeScan& scan) { writer.add_scan(scan); };
  sink.sonar = [&](const sensors::SonarSweep& sweep) { writer.add_sonar(sweep); };
  sink.odometry = [&](const sensors::OdometryReading& reading) { writer.add_odometry(reading); };
  simulation.run(sink);
  writer.finish();
}

void expect_same(const sensors::Acquisition& a, const sensors::Acquisition& b) {
  constexpr double kRounding = 1e-4;  // of the files
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.scans.size(), b.scans.size());
  EXPECT_EQ(a.sonar.size(), b.sonar.size());
  EXPECT_EQ(a.odometry.size(), b.odometry.size());
  ASSERT_EQ(a.image.has_value(), b.image.has_value());
  if (a.image) {
    EXPECT_EQ(cv::norm(a.image->pixels, b.image->pixels, cv::NORM_INF), 0.0);
  }
  ASSERT_TRUE(a.scan && b.scan);
  EXPECT_EQ(a.scan->time, b.scan->time);
  ASSERT_EQ(a.motion.has_value(), b.motion.has_value());
  if (a.motion) {
    EXPECT_NEAR(a.motion->pose.x, b.motion->pose.x, kRounding);
  }
  if (a.motion) {
    EXPECT_NEAR(a.motion->covariance(2, 2), b.motion->covariance(2, 2), kRounding);
  }
}

class SimulatedDrive : public testing::TestWithParam<bool> {
 protected:
  /// With or without a camera, and with it or the range finder in the lead.
  SimulatedDrive() {
    if (GetParam()) world_.camera = sim::camera_preset("conic-640");
    world_.sonars.push_back(sim::sonar_preset("pioneer-16"));
    world_.path.back().position.x() = 1.8;
  }
  sim::World world_ = tests::small_world();
  tests::TemporaryFolder temporary_;
};

TEST_P(SimulatedDrive, IsWhatIsReadFromTheDatasetOfIt) {
  const sim::Simulation simulation(world_, 3);
  write(simulation, temporary_ / "drive");
  const datasets::Dataset dataset = datasets::Dataset::open(temporary_ / "drive");
  const datasets::Acquisitions recorded(dataset);
  const std::vector<sensors::Acquisition> played = acquisitions_of(simulation);
  ASSERT_EQ(played.size(), recorded.size());
  ASSERT_GT(played.size(), 3U);
  for (std::size_t i = 0; i < played.size(); ++i) expect_same(played[i], recorded.read(i));
}

TEST_P(SimulatedDrive, KnowsTheTruthAtEveryAcquisition) {
  const sim::Simulation simulation(world_, 3);
  const datasets::Dataset readings = readings_of(simulation);
  for (const sensors::Acquisition& acquisition : acquisitions_of(simulation)) {
    const auto at = [&](const datasets::TimedPose& row) { return row.time == acquisition.time; };
    EXPECT_TRUE(std::any_of(readings.truth.begin(), readings.truth.end(), at)) << acquisition.time;
  }
}

TEST_P(SimulatedDrive, TellsHowFarItIs) {
  const sim::Simulation simulation(world_, 3);
  std::vector<double> shares;
  for_each_acquisition(simulation, readings_of(simulation), [](const sensors::Acquisition&) {},
                       {.progress = [&](double share) { shares.push_back(share); }});
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1.0);
}

INSTANTIATE_TEST_SUITE_P(, SimulatedDrive, testing::Bool(),
                         [](const auto& p) { return p.param ? "WithCamera" : "WithoutCamera"; });

}  // namespace
}  // namespace credo::evaluation
