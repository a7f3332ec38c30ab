// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/failures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/core.hpp>

#include "sim/simulation.hpp"
#include "tests/sim/test_worlds.hpp"

namespace credo::sim {
namespace {

using Kind = Failure::Kind;
using sensors::Timestamp;

/// The first 2 metres of the demo, with readings at every stop, and one failure from the 4th second to the 8th.
World failing_demo(const std::optional<Failure>& failure) {
  World world = load_world(shipped("demo"));
  world.path.resize(3);
  world.path[2].position = {2.2, 1.6};
  world.sonars.clear();
  if (failure) world.failures = {*failure};
  return world;
}

Failure during(const std::string& sensor, Kind kind) {
  return {.sensor = sensor, .kind = kind, .from_s = 4.0, .to_s = 8.0};
}

/// Readings by their time.
struct Log {
  std::map<Timestamp, cv::Mat> images;
  std::map<Timestamp, std::vector<float>> scans;
  std::map<Timestamp, geometry::Pose2> odometry;
};

constexpr Timestamp kStart = 1'600'000'000'000'000'000;

bool is_during(Timestamp time) {
  const double seconds = sensors::seconds_between(kStart, time);
  return seconds >= 4.0 && seconds < 8.0;
}

Log play(const std::optional<Failure>& failure) {
  Log log;
  Sink sink;
  sink.image = [&](const sensors::OmniImage& image) { log.images[image.time] = image.pixels; };
  sink.scan = [&](const sensors::RangeScan& scan) { log.scans[scan.time] = scan.ranges_m; };
  sink.odometry = [&](const sensors::OdometryReading& reading) { log.odometry[reading.time] = reading.T_odom_base; };
  Simulation(failing_demo(failure), 3).run(sink);
  return log;
}

const Log& usual() {
  static const Log log = play({});
  return log;
}

double mean_of(const cv::Mat& image) { return cv::mean(image)[0]; }

TEST(Failures, AreEventsOfTheSensorThatHasThem) {
  const auto events = [](const Failure& failure) {
    std::vector<std::pair<double, std::string>> all;
    Sink sink;
    sink.event = [&](Timestamp time, std::string_view name) {
      all.emplace_back(sensors::seconds_between(kStart, time), name);
    };
    Simulation(failing_demo(failure), 3).run(sink);
    return all;
  };
  EXPECT_THAT(events(during("range0", Kind::kBlind)),
              testing::ElementsAre(testing::Pair(4.0, "range0_failed"), testing::Pair(8.0, "range0_restored")));
  EXPECT_THAT(events(during("camera0", Kind::kDark)),
              testing::ElementsAre(testing::Pair(4.0, "camera0_degraded"), testing::Pair(8.0, "camera0_restored")));
}

TEST(Failures, ASensorIsRestoredWhenAllIsOver) {
  World world = failing_demo({});
  world.failures = {during("camera0", Kind::kDark),
                    {.sensor = "camera0", .kind = Kind::kBlind, .from_s = 6.0, .to_s = 9.0}};
  std::vector<std::string> names;
  for (const Event& event : failure_events(world)) names.push_back(event.name);
  EXPECT_THAT(names, testing::ElementsAre("camera0_degraded", "camera0_failed", "camera0_restored"));
}

TEST(Failures, OfAllConcernEverySensor) {
  World world = failing_demo(during("all", Kind::kBlind));
  std::vector<std::string> names;
  for (const Event& event : failure_events(world)) names.push_back(event.name);
  EXPECT_THAT(names, testing::UnorderedElementsAre("camera0_failed", "range0_failed", "odometry0_failed",
                                                   "camera0_restored", "range0_restored", "odometry0_restored"));
  EXPECT_TRUE(condition_of(world, "odometry0", 5.0).blind);
  EXPECT_FALSE(condition_of(world, "odometry0", 8.0).blind);
}

TEST(Failures, ABlindRangeFinderSaysNothingAndTheOthersSayWhatTheyAlwaysDid) {
  const Log log = play(during("range0", Kind::kBlind));
  for (const auto& [time, scan] : usual().scans) EXPECT_EQ(log.scans.contains(time), !is_during(time));
  ASSERT_EQ(log.images.size(), usual().images.size());
  for (const auto& [time, image] : usual().images) EXPECT_EQ(cv::norm(image, log.images.at(time)), 0.0);
}

TEST(Failures, ABlindCameraSeesBlackAndADarkOneAlmost) {
  const Log blind = play(during("camera0", Kind::kBlind)), dark = play(during("camera0", Kind::kDark)),
            saturated = play(during("camera0", Kind::kSaturated));
  int compared = 0;
  for (const auto& [time, image] : usual().images) {
    if (!is_during(time)) {
      EXPECT_EQ(cv::norm(image, blind.images.at(time)), 0.0);
      continue;
    }
    EXPECT_LT(mean_of(blind.images.at(time)), 6.0);
    EXPECT_LT(mean_of(dark.images.at(time)), 0.3 * mean_of(image));
    EXPECT_GT(mean_of(saturated.images.at(time)), 1.5 * mean_of(image));
    ++compared;
  }
  EXPECT_GE(compared, 2);
}

TEST(Failures, AFrozenSensorRepeatsItself) {
  const Log camera = play(during("camera0", Kind::kFrozen)), range = play(during("range0", Kind::kFrozen)),
            odometry = play(during("odometry0", Kind::kFrozen));
  cv::Mat last;
  for (const auto& [time, image] : camera.images) {
    if (is_during(time)) {
      EXPECT_EQ(cv::norm(image, last), 0.0);
    }
    last = image;
  }
  const std::vector<float>* before = nullptr;
  for (const auto& [time, scan] : range.scans) {
    for (std::size_t i = 0; i < scan.size() && is_during(time); ++i)
      EXPECT_TRUE(scan[i] == (*before)[i] || std::isnan(scan[i]));
    before = &scan;
  }
  geometry::Pose2 said;
  for (const auto& [time, pose] : odometry.odometry) {
    if (is_during(time)) {
      EXPECT_EQ(pose, said);
    }
    said = pose;
  }
  EXPECT_EQ(odometry.odometry.rbegin()->second, usual().odometry.rbegin()->second);  // the wheels counted on
}

TEST(Failures, ALyingRangeFinderLiesConsistently) {
  Failure lie = during("range0", Kind::kLying);
  lie.scale = 1.08;
  lie.offset_m = 0.1;
  const Log log = play(lie);
  int compared = 0;
  for (const auto& [time, scan] : usual().scans)
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const float said = log.scans.at(time)[i];
      if (!is_during(time) || !std::isfinite(scan[i]) || !std::isfinite(said)) continue;
      EXPECT_NEAR(said, 1.08F * scan[i] + 0.1F, 1e-4F);
      ++compared;
    }
  EXPECT_GT(compared, 100);
}

TEST(Failures, ATurnedScanShowsEverythingElsewhere) {
  World world = ideal_room();
  world.camera.reset();
  world.range_finders = {range_finder_preset("rplidar-a1")};
  Builder(world).add_pillar({2.0, 0.0}, 0.3, 16, 0.0, "plain", true);
  world.path = {{{0.0, 0.0}, false}, {{0.1, 0.0}, false}};
  const auto direction_of_pillar = [](const World& w) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    Sink sink;
    sink.scan = [&](const sensors::RangeScan& scan) {
      for (int i = 0; i < w.range_finders[0].finder.count; ++i) {
        const double beam = w.range_finders[0].finder.beam_angle(i);
        if (std::abs(scan.ranges_m[static_cast<std::size_t>(i)] - 1.8F) < 0.2F)
          sum += Eigen::Vector2d(std::cos(beam), std::sin(beam));
      }
    };
    Simulation(w, 1).run(sink);
    return std::atan2(sum.y(), sum.x());
  };
  EXPECT_NEAR(direction_of_pillar(world), 0.0, 0.02);
  world.failures = {{.sensor = "range0", .kind = Kind::kLying, .turn_rad = 0.2}};
  EXPECT_NEAR(direction_of_pillar(world), 0.2, 0.02);
}

TEST(Failures, ATurnedImageShowsEverythingElsewhere) {
  World world = ideal_room();
  Builder(world).add_pillar({2.0, 0.0}, 0.3, 16, 0.0, "dark", true);
  const auto direction_of_dark = [](const World& w) {
    double azimuth = 0.0;
    Sink sink;
    sink.image = [&](const sensors::OmniImage& image) {
      const sensors::OmniCamera& camera = w.camera->camera;
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      for (int i = 0; i < 720; ++i) {
        const double a = -3.14 + i * 0.00872;
        const Eigen::Vector2d p = camera.center_px + camera.horizon_radius_px * camera.image_direction(a);
        if (image.pixels.at<std::uint8_t>(static_cast<int>(p.y() + 0.5), static_cast<int>(p.x() + 0.5)) < 40)
          sum += Eigen::Vector2d(std::cos(a), std::sin(a));
      }
      azimuth = std::atan2(sum.y(), sum.x());
    };
    World still = w;
    still.path = {{{0.0, 0.0}, false}, {{0.1, 0.0}, false}};
    Simulation(still, 1).run(sink);
    return azimuth;
  };
  EXPECT_NEAR(direction_of_dark(world), 0.0, 0.02);
  world.failures = {{.sensor = "camera0", .kind = Kind::kLying, .turn_rad = 0.2}};
  EXPECT_NEAR(direction_of_dark(world), 0.2, 0.02);
}

TEST(Failures, NoisySensorsAreNoisier) {
  const Log camera = play(during("camera0", Kind::kNoisy)), range = play(during("range0", Kind::kNoisy)),
            odometry = play(during("odometry0", Kind::kNoisy));
  for (const auto& [time, image] : usual().images)
    if (is_during(time)) {
      EXPECT_GT(cv::norm(image, camera.images.at(time), cv::NORM_L1), 1.0 * image.rows * image.cols);
    }
  double sum = 0.0;
  int count = 0;
  for (const auto& [time, scan] : usual().scans)
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const float said = range.scans.at(time)[i];
      if (!is_during(time) || !std::isfinite(scan[i]) || !std::isfinite(said)) continue;
      const double sigma = range_finder_preset("opensimple").finder.noise.sigma(scan[i]);
      sum += std::pow((said - scan[i]) / sigma, 2);
      ++count;
    }
  EXPECT_NEAR(std::sqrt(sum / count), std::sqrt(24.0), 1.0);
  EXPECT_NE(odometry.odometry.rbegin()->second, usual().odometry.rbegin()->second);
}

TEST(Failures, SlippingWheelsCountMoreThanTheWay) {
  Failure slip = during("odometry0", Kind::kSlipping);
  slip.offset_m = 0.7;
  const auto end = play(slip).odometry.rbegin()->second, should = usual().odometry.rbegin()->second;
  EXPECT_NEAR((end.translation() - should.translation()).norm(), 0.7, 0.05);
  EXPECT_NEAR(end.theta, should.theta, 1e-9);
}

TEST(Failures, OfASensorThatIsNotThereAreRefused) {
  const auto complaint = [](const Failure& failure) -> std::string {
    try {
      check_failures(failing_demo(failure));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint(during("camera0", Kind::kBlind)), "");
  EXPECT_THAT(complaint(during("camera1", Kind::kBlind)), testing::HasSubstr("no sensor 'camera1'"));
  EXPECT_THAT(complaint(during("range0", Kind::kDark)), testing::HasSubstr("only camera0"));
  EXPECT_THAT(complaint(during("range0", Kind::kSlipping)), testing::HasSubstr("only odometry0"));
  EXPECT_THAT(complaint({.sensor = "odometry0", .kind = Kind::kSlipping}), testing::HasSubstr("must have an end"));
  EXPECT_THAT(complaint({.sensor = "camera0", .from_s = 5.0, .to_s = 5.0}), testing::HasSubstr("'from' < 'to'"));
}

}  // namespace
}  // namespace credo::sim
