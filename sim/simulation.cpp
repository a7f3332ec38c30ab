// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/odometry_simulator.hpp"
#include "sim/omni_renderer.hpp"
#include "sim/passage.hpp"
#include "sim/plan.hpp"
#include "sim/random.hpp"
#include "sim/range_simulator.hpp"
#include "sim/sonar_simulator.hpp"
#include "sim/together.hpp"
#include "sim/trajectory.hpp"

namespace credo::sim {
namespace {

using sensors::Timestamp;

constexpr Timestamp kStart = 1'600'000'000'000'000'000;  // ns
constexpr double kSharpEnough_px = 1.0;                  // motion during the exposure between two rendered poses
constexpr int kMostExposures = 4;
constexpr double kNearestWall_m = 1.0;  // for judging motion blur
constexpr std::size_t kBatch = 16;      // images rendered before they are delivered

/// What happens when; the order of the kinds is the order of delivery.
struct Reading {
  enum class Kind { kEvent, kImage, kScan, kSonar, kOdometry };
  Timestamp time;
  Kind kind;
  int sensor;
  std::uint64_t index;  ///< of the sensor's readings
};

Timestamp stamp(double seconds) { return kStart + sensors::from_seconds(seconds); }
double seconds_of(Timestamp time) { return sensors::seconds_between(kStart, time); }

/// An instrument's times: its own rate with its own phase, or the stops of the robot.
void schedule(const Trajectory& way, double rate_hz, double phase, Reading::Kind kind, int sensor,
              std::vector<Reading>& readings) {
  std::vector<double> times;
  if (rate_hz > 0.0)
    for (int i = 0; (i + phase) / rate_hz < way.duration_s(); ++i) times.push_back((i + phase) / rate_hz);
  else
    times = way.stops();
  for (std::size_t i = 0; i < times.size(); ++i) readings.push_back({stamp(times[i]), kind, sensor, i});
}

/// \throws std::invalid_argument where a simulation would go on for days
void check_number_of_readings(const World& world, const Trajectory& way) {
  constexpr double kMost = 5e6;
  const auto count = [&way](double rate_hz) {
    return rate_hz > 0.0 ? rate_hz * way.duration_s() : static_cast<double>(way.stops().size());
  };
  double readings = world.camera ? count(world.camera->rate_hz) : 0.0;
  for (const RangeFinderSetup& setup : world.range_finders) readings += count(setup.rate_hz);
  for (const SonarSetup& setup : world.sonars) readings += count(setup.rate_hz);
  if (world.odometry) readings += count(world.odometry->rate_hz);
  if (!(readings <= kMost))
    throw std::invalid_argument("the drive takes " + std::to_string(way.duration_s()) + " s with " +
                                std::to_string(readings) +
                                " readings; expected at most 5 million: shorten the path, or lower the rates");
}

/// \throws std::invalid_argument where the robot would drive through a wall
Trajectory drivable(const World& world) {
  Trajectory way(world.path, world.drive);
  if (const auto obstruction = find_obstruction(world, way)) throw std::invalid_argument(obstruction->what);
  return way;
}

std::vector<Reading> schedule_all(const World& world, const Trajectory& way, std::uint64_t seed) {
  check_number_of_readings(world, way);
  std::vector<Reading> readings;
  Random random(seed, kStartStream, 1);
  using Kind = Reading::Kind;
  for (std::size_t i = 0; i < way.carried().size(); ++i)
    readings.push_back({stamp(way.carried()[i]), Kind::kEvent, 0, i});
  if (world.camera) schedule(way, world.camera->rate_hz, random.uniform(), Kind::kImage, 0, readings);
  for (std::size_t i = 0; i < world.range_finders.size(); ++i)
    schedule(way, world.range_finders[i].rate_hz, random.uniform(), Kind::kScan, static_cast<int>(i), readings);
  for (std::size_t i = 0; i < world.sonars.size(); ++i)
    schedule(way, world.sonars[i].rate_hz, random.uniform(), Kind::kSonar, static_cast<int>(i), readings);
  if (world.odometry) schedule(way, world.odometry->rate_hz, random.uniform(), Kind::kOdometry, 0, readings);
  std::stable_sort(readings.begin(), readings.end(), [](const Reading& a, const Reading& b) {
    return a.time != b.time ? a.time < b.time : a.kind < b.kind;
  });
  return readings;
}

sensors::Rig calibrated_rig(const World& world) {
  sensors::Rig rig;
  if (world.camera) rig.camera = world.camera->camera;
  for (const RangeFinderSetup& setup : world.range_finders) rig.range_finders.push_back(setup.finder);
  for (const SonarSetup& setup : world.sonars) rig.sonar_rings.push_back(setup.ring);
  if (world.odometry) rig.odometry = world.odometry->noise;
  return rig;
}

std::optional<geometry::PoseEstimate> told_start(const World& world, const geometry::Pose2& truth, std::uint64_t seed) {
  if (!world.initial_pose_known) return std::nullopt;
  Random random(seed, kStartStream);
  const auto& sigma = world.initial_pose_sigma;
  geometry::PoseEstimate estimate;
  estimate.pose = {truth.x + random.normal(sigma[0]), truth.y + random.normal(sigma[1]),
                   geometry::wrap_angle(truth.theta + random.normal(sigma[2]))};
  for (int i = 0; i < 3; ++i)
    estimate.covariance(i, i) = sigma[static_cast<std::size_t>(i)] * sigma[static_cast<std::size_t>(i)];
  return estimate;
}

double plan_height(const World& world) {
  if (!world.range_finders.empty()) return world.range_finders.front().finder.height_m;
  if (!world.sonars.empty()) return world.sonars.front().ring.height_m;
  return world.camera->camera.height_m;
}

World checked(World world) {
  if (!world.camera && world.range_finders.empty() && world.sonars.empty())
    throw std::invalid_argument("the robot needs a camera, a range finder or a sonar ring");
  if (world.panels.empty()) throw std::invalid_argument("the world has no walls");
  return world;
}

}  // namespace

struct Simulation::Parts {
  World world;
  std::uint64_t seed;
  Trajectory way;
  sensors::Rig rig;
  geometry::FloorPlan plan;
  std::optional<geometry::PoseEstimate> start;
  std::vector<Reading> readings;
  std::optional<OmniRenderer> renderer;
  std::vector<RangeSimulator> ranges;
  std::vector<SonarSimulator> sonars;

  Parts(World the_world, std::uint64_t the_seed)
      : world(checked(std::move(the_world))),
        seed(seed_of_world(the_seed, world.name)),
        way(drivable(world)),
        rig(calibrated_rig(world)),
        plan(draw_floor_plan(world, plan_height(world), seed)),
        start(told_start(world, way.pose_at(0.0), seed)),
        readings(schedule_all(world, way, seed)) {
    if (world.camera) renderer.emplace(world, seed);
    for (std::size_t i = 0; i < world.range_finders.size(); ++i)
      ranges.emplace_back(world, world.range_finders[i], static_cast<int>(i), seed);
    for (std::size_t i = 0; i < world.sonars.size(); ++i)
      sonars.emplace_back(world, world.sonars[i], static_cast<int>(i), seed);
  }
  Parts(const Parts&) = delete;  // the simulators refer to the world
  Parts& operator=(const Parts&) = delete;

  struct Picture {
    cv::Mat pixels;
    std::vector<TrueVertical> verticals;
  };
  [[nodiscard]] std::vector<geometry::Pose2> exposures(double seconds) const;
  [[nodiscard]] std::vector<Picture> render(std::span<const Reading> images, int threads, bool verticals) const;
  void deliver(const Reading& reading, OdometrySimulator& odometry, geometry::Pose2& odometry_at,
               const Sink& sink) const;
};

/// The poses during the exposure: one at rest, more the more the image moves.
std::vector<geometry::Pose2> Simulation::Parts::exposures(double seconds) const {
  const sensors::OmniCamera& camera = world.camera->camera;
  const double half = 0.5 * camera.exposure_s;
  const geometry::Pose2 moved = way.pose_at(seconds - half).inverse() * way.pose_at(seconds + half);
  const double turn = std::abs(moved.theta) + std::hypot(moved.x, moved.y) / kNearestWall_m;
  const int count =
      std::clamp(static_cast<int>(std::ceil(turn * camera.outer_radius_px / kSharpEnough_px)), 1, kMostExposures);
  std::vector<geometry::Pose2> poses;
  poses.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) poses.push_back(way.pose_at(seconds + camera.exposure_s * ((i + 0.5) / count - 0.5)));
  return poses;
}

/// Threads take the next image that nobody has; every image is a function of its index alone. What a thread throws, the
/// caller gets.
std::vector<Simulation::Parts::Picture> Simulation::Parts::render(std::span<const Reading> images, int threads,
                                                                  bool verticals) const {
  std::vector<Picture> pictures(images.size());
  run_together(threads, images.size(), [&](NextIndex& next) {
    OmniRenderer::Workspace workspace(world);
    while (const auto i = next()) {
      const double seconds = seconds_of(images[*i].time);
      pictures[*i].pixels = renderer->render(exposures(seconds), images[*i].index, workspace);
      if (verticals) pictures[*i].verticals = renderer->true_verticals(way.pose_at(seconds), workspace);
    }
  });
  return pictures;
}

/// Everything but images.
void Simulation::Parts::deliver(const Reading& reading, OdometrySimulator& odometry, geometry::Pose2& odometry_at,
                                const Sink& sink) const {
  const double seconds = seconds_of(reading.time);
  const auto pose = [&](double later) { return way.pose_at(seconds + later); };
  const auto sensor = static_cast<std::size_t>(reading.sensor);
  switch (reading.kind) {
    case Reading::Kind::kEvent: {
      // Being lifted turns no wheel.
      const double when = way.carried()[reading.index];
      odometry.advance(odometry_at.inverse() * way.pose_at(when - 1e-6));
      odometry_at = way.pose_at(when);
      if (sink.event) sink.event(reading.time, "kidnapped");
      break;
    }
    case Reading::Kind::kScan:
      if (sink.scan) sink.scan(ranges[sensor].scan(reading.time, pose, reading.index));
      break;
    case Reading::Kind::kSonar:
      if (sink.sonar) sink.sonar(sonars[sensor].sweep(reading.time, pose, reading.index));
      break;
    case Reading::Kind::kOdometry: {
      const geometry::Pose2 T_odom_base = odometry.advance(odometry_at.inverse() * pose(0.0));
      odometry_at = pose(0.0);
      if (sink.odometry) sink.odometry({reading.time, T_odom_base});
      break;
    }
    case Reading::Kind::kImage: break;
  }
}

Simulation::Simulation(World world, std::uint64_t seed)
    : parts_(std::make_unique<const Parts>(std::move(world), seed)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

const World& Simulation::world() const { return parts_->world; }
const sensors::Rig& Simulation::rig() const { return parts_->rig; }
const geometry::FloorPlan& Simulation::floor_plan() const { return parts_->plan; }
const std::optional<geometry::PoseEstimate>& Simulation::initial_pose() const { return parts_->start; }

std::string Simulation::acquisition_sensor() const {
  return parts_->renderer ? "camera0" : parts_->ranges.empty() ? "sonar0" : "range0";
}

TruthMap Simulation::truth_map(double resolution_m) const {
  std::vector<double> heights;
  for (const RangeFinderSetup& setup : parts_->world.range_finders) heights.push_back(setup.finder.height_m);
  for (const SonarSetup& setup : parts_->world.sonars) heights.push_back(setup.ring.height_m);
  if (heights.empty()) heights.push_back(parts_->world.camera->camera.height_m);
  return draw_truth_map(parts_->world, heights, resolution_m);
}

void Simulation::run(const Sink& sink, int threads) const {
  const Parts& parts = *parts_;
  OdometrySimulator odometry(parts.world.odometry ? parts.world.odometry->noise : sensors::OdometryNoise{}, parts.seed);
  geometry::Pose2 odometry_at = parts.way.pose_at(0.0);
  std::vector<Reading> images;
  for (const Reading& reading : parts.readings)
    if (reading.kind == Reading::Kind::kImage) images.push_back(reading);
  const bool picturing = sink.image || sink.verticals;
  std::vector<Parts::Picture> batch;
  std::size_t done = 0, image = 0;
  std::optional<Timestamp> told;
  for (const Reading& reading : parts.readings) {
    if (reading.kind == Reading::Kind::kImage && picturing && image % kBatch == 0)
      batch = parts.render(std::span(images).subspan(image, std::min(kBatch, images.size() - image)),
                           std::max(threads, 1), static_cast<bool>(sink.verticals));
    if (reading.kind == Reading::Kind::kEvent) parts.deliver(reading, odometry, odometry_at, sink);
    if (sink.truth && told != reading.time) sink.truth(reading.time, parts.way.pose_at(seconds_of(reading.time)));
    told = reading.time;
    if (reading.kind == Reading::Kind::kImage) {
      if (sink.image) sink.image({reading.time, batch[image % kBatch].pixels});
      if (sink.verticals) sink.verticals(reading.time, batch[image % kBatch].verticals);
      ++image;
    } else if (reading.kind != Reading::Kind::kEvent) {
      parts.deliver(reading, odometry, odometry_at, sink);
    }
    if (sink.progress) sink.progress(static_cast<double>(++done) / static_cast<double>(parts.readings.size()));
  }
}

}  // namespace credo::sim
