// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "sim/clutter.hpp"
#include "sim/crowd.hpp"
#include "sim/failures.hpp"
#include "sim/instruments.hpp"
#include "sim/odometry_simulator.hpp"
#include "sim/passage.hpp"
#include "sim/plan.hpp"
#include "sim/random.hpp"
#include "sim/rearrangement.hpp"
#include "sim/together.hpp"
#include "sim/trajectory.hpp"

namespace credo::sim {
namespace {

using sensors::Timestamp;

constexpr Timestamp kStart = 1'600'000'000'000'000'000;  // ns
constexpr double kSharpEnough_px = 1.0;                  // motion during the exposure between two rendered poses
constexpr int kMostExposures = 16;
constexpr double kNearestWall_m = 1.0;  // for judging motion blur
constexpr std::size_t kBatch = 16;      // images rendered before they are delivered

/// What happens when; the order of the kinds is the order of delivery.
struct Reading {
  enum class Kind { kEvent, kImage, kScan, kSonar, kOdometry };
  Timestamp time;
  Kind kind;
  int sensor;
  std::uint64_t index;  ///< of the sensor's readings, or of the events
  Timestamp taken;      ///< when what it says was so: earlier than its time where the sensor is frozen
};

std::string sensor_name(Reading::Kind kind, int sensor) {
  switch (kind) {
    case Reading::Kind::kImage: return "camera0";
    case Reading::Kind::kScan: return "range" + std::to_string(sensor);
    case Reading::Kind::kSonar: return "sonar" + std::to_string(sensor);
    default: return "odometry0";
  }
}

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
  for (std::size_t i = 0; i < times.size(); ++i)
    readings.push_back({stamp(times[i]), kind, sensor, i, stamp(times[i])});
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

const char* const kKidnapped = "kidnapped";

/// By time.
std::vector<Event> all_events(const World& world, const Trajectory& way) {
  std::vector<Event> events;
  if (world.people > 0) events.push_back({0.0, "people"});
  for (const double when : way.carried()) events.push_back({when, kKidnapped});
  for (const Change& change : world.changes) events.push_back({change.when_s, change.event});
  for (Event& event : failure_events(world))
    if (event.seconds < way.duration_s()) events.push_back(std::move(event));
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.seconds < b.seconds; });
  return events;
}

/// A frozen sensor says again what it said last, with the same noise.
void freeze(const World& world, std::vector<Reading>& readings) {
  std::map<std::string, Reading> last;
  for (Reading& reading : readings) {
    if (reading.kind == Reading::Kind::kEvent) continue;
    const std::string sensor = sensor_name(reading.kind, reading.sensor);
    const auto before = last.find(sensor);
    if (before != last.end() && condition_of(world, sensor, seconds_of(reading.time)).frozen) {
      reading.taken = before->second.taken;
      reading.index = before->second.index;
    } else {
      last.insert_or_assign(sensor, reading);
    }
  }
}

std::vector<Reading> schedule_all(const World& world, const Trajectory& way, const std::vector<Event>& events,
                                  std::uint64_t seed) {
  check_number_of_readings(world, way);
  std::vector<Reading> readings;
  Random random(seed, kStartStream, 1);
  using Kind = Reading::Kind;
  for (std::size_t i = 0; i < events.size(); ++i)
    readings.push_back({stamp(events[i].seconds), Kind::kEvent, 0, i, stamp(events[i].seconds)});
  if (world.camera) schedule(way, world.camera->rate_hz, random.uniform(), Kind::kImage, 0, readings);
  for (std::size_t i = 0; i < world.range_finders.size(); ++i)
    schedule(way, world.range_finders[i].rate_hz, random.uniform(), Kind::kScan, static_cast<int>(i), readings);
  for (std::size_t i = 0; i < world.sonars.size(); ++i)
    schedule(way, world.sonars[i].rate_hz, random.uniform(), Kind::kSonar, static_cast<int>(i), readings);
  if (world.odometry) schedule(way, world.odometry->rate_hz, random.uniform(), Kind::kOdometry, 0, readings);
  std::stable_sort(readings.begin(), readings.end(), [](const Reading& a, const Reading& b) {
    return a.time != b.time ? a.time < b.time : a.kind < b.kind;
  });
  if (!world.failures.empty()) freeze(world, readings);
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
  const auto &sigma = world.initial_pose_sigma, &offset = world.initial_pose_offset;
  geometry::PoseEstimate estimate;
  estimate.pose = {truth.x + offset[0] + random.normal(sigma[0]), truth.y + offset[1] + random.normal(sigma[1]),
                   geometry::wrap_angle(truth.theta + offset[2] + random.normal(sigma[2]))};
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
  check_failures(world);
  return world;
}

/// The world with all in it that is drawn for one simulation.
World complete(World world, std::uint64_t seed) {
  const Trajectory way = drivable(world);
  const std::uint64_t seed_here = seed_of_world(seed, world.name);
  return with_clutter(std::move(world), way, seed_here);
}

/// The wheels, and what they were last heard to say.
struct Wheels {
  OdometrySimulator simulator;
  geometry::Pose2 at;  ///< where the robot was then
  double slipped_m = 0.0;
  geometry::Pose2 said = {};
};

}  // namespace

struct Simulation::Parts {
  World world;
  std::uint64_t seed;
  Trajectory way;
  sensors::Rig rig;
  geometry::FloorPlan plan;
  std::optional<geometry::PoseEstimate> start;
  Crowd crowd;
  std::vector<Event> events;
  std::vector<Reading> readings;
  InstrumentsOverTime instruments;

  Parts(World the_world, std::uint64_t the_seed)
      : world(complete(checked(std::move(the_world)), the_seed)),
        seed(seed_of_world(the_seed, world.name)),
        way(drivable(world)),
        rig(calibrated_rig(world)),
        plan(draw_floor_plan(world, plan_height(world), seed)),
        start(told_start(world, way.pose_at(0.0), seed)),
        crowd(world, way, seed),
        events(all_events(world, way)),
        readings(schedule_all(world, way, events, seed)),
        instruments(world, seed) {}

  struct Picture {
    cv::Mat pixels;
    std::vector<TrueVertical> verticals;
  };
  [[nodiscard]] std::vector<geometry::Pose2> exposures(double seconds) const;
  [[nodiscard]] Picture picture(const Reading& reading, bool verticals, const OmniRenderer& renderer,
                                OmniRenderer::Workspace& workspace) const;
  [[nodiscard]] std::vector<Picture> render(std::span<const Reading> images, int threads, bool verticals) const;
  [[nodiscard]] std::function<std::vector<Disc>(double)> people_at(double height_m, double seconds) const;
  void carry(double when_s, Wheels& wheels) const;
  void deliver(const Reading& reading, Wheels& wheels, const Sink& sink) const;
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

/// What the camera has in view, in the condition that it is in.
Simulation::Parts::Picture Simulation::Parts::picture(const Reading& reading, bool verticals,
                                                      const OmniRenderer& renderer,
                                                      OmniRenderer::Workspace& workspace) const {
  const double seconds = seconds_of(reading.taken);
  const Condition condition = condition_of(world, "camera0", seconds);
  const std::vector<Panel> passing = crowd.panels(seconds);
  std::vector<geometry::Pose2> poses = exposures(seconds);
  if (condition.turn_rad != 0.0) {
    // An image that is turned one way is that of a camera turned the other way.
    const geometry::Pose2& T_base_camera = renderer.T_base_camera();
    const geometry::Pose2 turned =
        T_base_camera * geometry::Pose2{0.0, 0.0, -condition.turn_rad} * T_base_camera.inverse();
    for (geometry::Pose2& pose : poses) pose = pose * turned;
  }
  Picture picture;
  picture.pixels =
      renderer.render(poses, reading.index, workspace,
                      {.light = condition.blind ? 0.0 : condition.light, .noise = condition.noise, .passing = passing});
  if (verticals) picture.verticals = renderer.true_verticals(way.pose_at(seconds), workspace, passing);
  return picture;
}

/// Threads take the next image that nobody has; every image is a function of its index alone. What a thread throws, the
/// caller gets.
std::vector<Simulation::Parts::Picture> Simulation::Parts::render(std::span<const Reading> images, int threads,
                                                                  bool verticals) const {
  std::vector<Picture> pictures(images.size());
  run_together(threads, images.size(), [&](NextIndex& next) {
    const Instruments* before = nullptr;
    std::optional<OmniRenderer::Workspace> workspace;
    while (const auto i = next()) {
      const Instruments& now = instruments.at(seconds_of(images[*i].taken));
      if (&now != before) workspace.emplace(now.world);
      before = &now;
      pictures[*i] = picture(images[*i], verticals, *now.renderer, *workspace);
    }
  });
  return pictures;
}

/// Who stands where at a number of seconds after `seconds`, cut at a height.
std::function<std::vector<Disc>(double)> Simulation::Parts::people_at(double height_m, double seconds) const {
  if (crowd.empty()) return {};
  return [this, height_m, seconds](double later_s) { return crowd.cut(height_m, seconds + later_s); };
}

/// Being lifted turns no wheel.
void Simulation::Parts::carry(double when_s, Wheels& wheels) const {
  const Condition condition = condition_of(world, "odometry0", when_s);
  (void)wheels.simulator.advance(wheels.at.inverse() * way.pose_at(when_s - 1e-6), condition);
  wheels.at = way.pose_at(when_s);
}

/// Everything but images.
void Simulation::Parts::deliver(const Reading& reading, Wheels& wheels, const Sink& sink) const {
  const double seconds = seconds_of(reading.taken);
  const auto pose = [&](double later) { return way.pose_at(seconds + later); };
  const auto sensor = static_cast<std::size_t>(reading.sensor);
  const Condition condition = condition_of(world, sensor_name(reading.kind, reading.sensor), seconds_of(reading.time));
  const Instruments& now = instruments.at(seconds);
  switch (reading.kind) {
    case Reading::Kind::kEvent:
      if (events[reading.index].name == kKidnapped) carry(events[reading.index].seconds, wheels);
      if (sink.event) sink.event(reading.time, events[reading.index].name);
      break;
    case Reading::Kind::kScan:
      if (sink.scan && !condition.blind)
        sink.scan(now.ranges[sensor].scan(reading.time, pose, reading.index,
                                          people_at(world.range_finders[sensor].finder.height_m, seconds), condition));
      break;
    case Reading::Kind::kSonar:
      if (sink.sonar)
        sink.sonar(now.sonars[sensor].sweep(reading.time, pose, reading.index,
                                            people_at(world.sonars[sensor].ring.height_m, seconds)));
      break;
    case Reading::Kind::kOdometry: {
      const geometry::Pose2 here = way.pose_at(seconds_of(reading.time));
      const double slipped = slipped_m(world, seconds_of(reading.time));
      const geometry::Pose2 T_odom_base =
          wheels.simulator.advance(wheels.at.inverse() * here, condition, slipped - wheels.slipped_m);
      wheels.at = here;
      wheels.slipped_m = slipped;
      if (!condition.frozen) wheels.said = T_odom_base;
      if (sink.odometry && !condition.blind) sink.odometry({reading.time, wheels.said});
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
  return parts_->world.camera ? "camera0" : parts_->world.range_finders.empty() ? "sonar0" : "range0";
}

TruthMap Simulation::truth_map(double resolution_m) const {
  return draw_truth_map(world_at(parts_->world, parts_->way.duration_s()), resolution_m);
}

std::vector<TruthState> Simulation::truth_states(double resolution_m) const {
  std::vector<TruthState> states;
  for (const double seconds : state_times(parts_->world))
    states.push_back({stamp(seconds), draw_truth_map(world_at(parts_->world, seconds), resolution_m)});
  return states;
}

void Simulation::run(const Sink& sink, int threads) const {
  const Parts& parts = *parts_;
  Wheels wheels{
      OdometrySimulator(parts.world.odometry ? parts.world.odometry->noise : sensors::OdometryNoise{}, parts.seed),
      parts.way.pose_at(0.0)};
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
    if (reading.kind == Reading::Kind::kEvent) parts.deliver(reading, wheels, sink);
    if (sink.truth && told != reading.time) sink.truth(reading.time, parts.way.pose_at(seconds_of(reading.time)));
    told = reading.time;
    if (reading.kind == Reading::Kind::kImage) {
      if (sink.image) sink.image({reading.time, batch[image % kBatch].pixels});
      if (sink.verticals) sink.verticals(reading.time, batch[image % kBatch].verticals);
      ++image;
    } else if (reading.kind != Reading::Kind::kEvent) {
      parts.deliver(reading, wheels, sink);
    }
    if (sink.progress) sink.progress(static_cast<double>(++done) / static_cast<double>(parts.readings.size()));
  }
}

}  // namespace credo::sim
