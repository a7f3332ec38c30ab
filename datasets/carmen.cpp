// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/carmen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "datasets/carmen_message.hpp"
#include "datasets/format_error.hpp"
#include "datasets/gzip_file.hpp"
#include "datasets/sensor_yaml.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

namespace fs = std::filesystem;
using sensors::Timestamp;

constexpr std::size_t kLargestLog_bytes = std::size_t{2} << 30;
constexpr Timestamp kMadeUpPeriod = 100'000'000;  ///< between the rows of a log without usable times [ns]
constexpr double kRangeMin_m = 0.02;
constexpr double kReachMargin_m = 0.01;  ///< a laser that says it reaches 81.92 m writes 81.91 for no return
/// What lasers write where nothing came back; see CarmenParams.
constexpr std::array kNoReturnMarks_m{50.0, 51.2};

/// A row of the log with the time that it carries and the one that it gets where the log's times are of no use.
template <typename Value>
struct Logged {
  Timestamp log_time = 0;
  Timestamp made_up_time = 0;
  Value value;
};

struct LaserRow {
  std::vector<float> ranges_m;
  std::optional<geometry::Pose2> T_map_laser, T_odom_base;
};

struct Laser {
  std::string name;
  sensors::RangeFinder finder;
  std::vector<Logged<LaserRow>> rows;
};

/// FLASER and RLASER say how many readings there are and no more: the field of view is 180 degrees, from -90 on.
sensors::RangeFinder implied_finder(int count, double reach_m, double sigma_m) {
  sensors::RangeFinder finder;
  finder.count = count;
  finder.angle_min_rad = -std::numbers::pi / 2.0;
  finder.angle_increment_rad = std::numbers::pi / std::max(count % 2 == 0 ? count : count - 1, 1);
  finder.range_min_m = kRangeMin_m;
  finder.range_max_m = reach_m;
  finder.noise.sigma_0_m = sigma_m;
  return finder;
}

/// Gathers message after message, in the order of the log.
class Gatherer {
 public:
  Gatherer(const fs::path& file, const CarmenParams& params) : file_(file), params_(params) {}

  void read(std::string_view content) {
    int line = 0;
    while (!content.empty()) {
      const std::size_t end = std::min(content.find('\n'), content.size());
      const std::string_view text = trimmed(content.substr(0, end));
      content.remove_prefix(std::min(end + 1, content.size()));
      ++line;
      if (!text.empty() && text.front() != '#') read_message(line, text);
    }
  }

  std::vector<Laser> lasers;
  std::vector<Logged<geometry::Pose2>> odometry;
  std::optional<sensors::SonarRing> ring;
  std::vector<Logged<std::vector<float>>> sonar;

 private:
  void read_message(int line, std::string_view text) {
    const std::string_view name = text.substr(0, text.find_first_of(" \t"));
    if (name == "FLASER" || name == "RLASER")
      read_old_laser(Message(file_, line, text));
    else if (name.starts_with("ROBOTLASER"))
      read_new_laser(Message(file_, line, text), true);
    else if (name.starts_with("RAWLASER"))
      read_new_laser(Message(file_, line, text), false);
    else if (name == "ODOM")
      read_odometry(Message(file_, line, text));
    else if (name == "SONAR")
      read_sonar(Message(file_, line, text));
    else if (name == "PARAM")
      read_parameter(Message(file_, line, text));
    else
      return;
    row_time_ += kMadeUpPeriod;
  }

  void read_old_laser(Message message);
  void read_new_laser(Message message, bool with_poses);
  void read_sonar(Message message);

  void read_odometry(Message message) {
    const geometry::Pose2 pose = message.pose();
    message.skip(3);  // tv rv accel
    odometry.push_back({message.time(), row_time_, pose});
  }

  void read_parameter(Message message) {
    const std::string_view name = message.word();
    if (name == "robot_front_laser_max") front_reach_m_ = message.finite();
    if (name == "robot_rear_laser_max") rear_reach_m_ = message.finite();
  }

  Laser& laser(const Message& message, const sensors::RangeFinder& finder) {
    const auto found =
        std::find_if(lasers.begin(), lasers.end(), [&](const Laser& known) { return known.name == message.name(); });
    if (found == lasers.end())
      return lasers.emplace_back(Laser{.name = std::string(message.name()), .finder = finder, .rows = {}});
    if (found->finder.count != finder.count)
      message.fail("expected " + std::to_string(found->finder.count) + " readings, as before, found " +
                   std::to_string(finder.count));
    return *found;
  }

  const fs::path& file_;
  CarmenParams params_;
  Timestamp row_time_ = 0;
  std::optional<double> front_reach_m_, rear_reach_m_;
};

/// inf for what did not come back, nan for what is no measurement.
std::vector<float> laser_ranges(Message& message, int count, double reach_m) {
  std::vector<float> ranges(static_cast<std::size_t>(count));
  for (float& range : ranges) {
    const double value = message.number();
    const bool marked = std::find(kNoReturnMarks_m.begin(), kNoReturnMarks_m.end(), value) != kNoReturnMarks_m.end();
    if (std::isnan(value) || value < kRangeMin_m)
      range = std::numeric_limits<float>::quiet_NaN();
    else
      range = value >= reach_m || marked ? std::numeric_limits<float>::infinity() : static_cast<float>(value);
  }
  return ranges;
}

/// FLASER n r1..rn x y theta odom_x odom_y odom_theta ipc_time host logger_time
void Gatherer::read_old_laser(Message message) {
  const int count = message.count();
  const std::optional<double>& told = message.name() == "FLASER" ? front_reach_m_ : rear_reach_m_;
  const double reach_m = std::min(told.value_or(params_.no_return_from_m), params_.no_return_from_m);
  LaserRow row{.ranges_m = laser_ranges(message, count, reach_m), .T_map_laser = {}, .T_odom_base = {}};
  row.T_map_laser = message.pose();
  row.T_odom_base = message.pose();
  Laser& into = laser(message, implied_finder(count, reach_m, params_.sigma_0_m));
  into.rows.push_back({message.time(), row_time_, std::move(row)});
}

/// ROBOTLASERk and RAWLASERk: type start_angle fov resolution max_range accuracy remission_mode n r1..rn [m rem1..remm]
/// and, of the first, laser x y theta, robot x y theta, tv rv forward side [turn_axis]; ipc_time host logger_time.
/// Old logs leave out what is in brackets, so that the poses are found by counting.
void Gatherer::read_new_laser(Message message, bool with_poses) {
  constexpr std::size_t kPoses = 6, kMotion = 4, kTimes = 3;
  message.skip(1);
  sensors::RangeFinder finder;
  finder.angle_min_rad = message.finite();
  message.skip(1);  // the field of view follows from resolution and count
  finder.angle_increment_rad = message.finite();
  const double declared_reach_m = message.finite();
  const double accuracy_m = message.finite();
  message.skip(1);
  finder.count = message.count();
  finder.range_min_m = kRangeMin_m;
  finder.range_max_m = declared_reach_m > kRangeMin_m ? declared_reach_m : params_.no_return_from_m;
  finder.noise.sigma_0_m = accuracy_m > 0.0 ? accuracy_m : params_.sigma_0_m;
  if (finder.angle_increment_rad == 0.0 ||
      std::abs(finder.angle_increment_rad) * (finder.count - 1) > 2.0 * std::numbers::pi + 0.01)
    message.fail("expected an angular resolution in radians, found " + std::to_string(finder.angle_increment_rad));
  LaserRow row{.ranges_m = laser_ranges(message, finder.count, finder.range_max_m - kReachMargin_m),
               .T_map_laser = {},
               .T_odom_base = {}};
  const std::size_t without_remissions = (with_poses ? kPoses + kMotion : 0) + kTimes;
  if (message.left() != without_remissions) message.skip(static_cast<std::size_t>(message.count_or_zero()));
  if (with_poses) {
    row.T_map_laser = message.pose();
    row.T_odom_base = message.pose();
    const std::size_t motion = message.left() > kMotion + kTimes ? kMotion + 1 : kMotion;
    message.skip(motion);
  }
  Laser& into = laser(message, finder);
  into.rows.push_back({message.time(), row_time_, std::move(row)});
}

/// SONAR cone_angle n r1..rn x1 y1 th1 .. xn yn thn ipc_time host logger_time
void Gatherer::read_sonar(Message message) {
  sensors::SonarRing found;
  found.beam_width_rad = message.finite();
  const int count = message.count();
  std::vector<float> ranges(static_cast<std::size_t>(count));
  for (float& range : ranges) range = static_cast<float>(message.finite());
  for (int i = 0; i < count; ++i) found.T_base_transducer.push_back(message.pose());
  if (!ring) ring = found;
  if (ring->T_base_transducer.size() != ranges.size())
    message.fail("expected " + std::to_string(ring->T_base_transducer.size()) + " readings, as before, found " +
                 std::to_string(count));
  sonar.push_back({message.time(), row_time_, std::move(ranges)});
}

/// Whether the times of the log tell its scans apart.
bool are_times_usable(const std::vector<Laser>& lasers) {
  for (const Laser& laser : lasers) {
    std::vector<Timestamp> times;
    for (const auto& row : laser.rows) times.push_back(row.log_time);
    std::sort(times.begin(), times.end());
    const auto different = std::unique(times.begin(), times.end()) - times.begin();
    if (2 * different <= static_cast<std::ptrdiff_t>(times.size()) && times.size() > 1) return false;
  }
  return true;
}

/// Orders rows by the time that they are to have.
/// \returns whether the log had another order
template <typename Value>
bool settle_times(std::vector<Logged<Value>>& rows, bool times_usable) {
  const auto earlier = [](const Logged<Value>& a, const Logged<Value>& b) { return a.log_time < b.log_time; };
  if (!times_usable)
    for (Logged<Value>& row : rows) row.log_time = row.made_up_time;
  const bool sorted = std::is_sorted(rows.begin(), rows.end(), earlier);
  if (!sorted) std::stable_sort(rows.begin(), rows.end(), earlier);
  return !sorted;
}

/// T_base_laser where it is the same throughout the log, which it is not where only the laser's poses were corrected.
std::optional<geometry::Pose2> mounting(const std::vector<Logged<LaserRow>>& rows) {
  std::optional<geometry::Pose2> first;
  for (const auto& [log_time, made_up_time, row] : rows) {
    if (!row.T_map_laser) return geometry::Pose2{};
    const geometry::Pose2 T_base_laser = row.T_odom_base->inverse() * *row.T_map_laser;
    if (!first) first = T_base_laser;
    const geometry::Pose2 off = first->inverse() * T_base_laser;
    if (std::hypot(off.x, off.y) > 0.01 || std::abs(off.theta) > 0.01) return std::nullopt;
  }
  return first;
}

void add_laser(Laser& laser, CarmenLog& log) {
  const int index = static_cast<int>(log.scans.size());
  const auto T_base_laser = mounting(laser.rows);
  if (T_base_laser)
    laser.finder.T_base_sensor = *T_base_laser;
  else
    log.remarks.push_back(laser.name +
                          ": the poses of laser and robot are not fixed to each other: the laser's were "
                          "corrected, the robot's are odometry");
  const bool clockwise = laser.finder.angle_increment_rad < 0.0;
  log.rig.range_finders.push_back(counter_clockwise(laser.finder));
  log.laser_names.push_back(laser.name);
  auto& scans = log.scans.emplace_back();
  auto& laser_poses = log.laser_poses.emplace_back();
  auto& base_poses = log.base_poses.emplace_back();
  for (auto& [time, made_up_time, row] : laser.rows) {
    if (clockwise) std::reverse(row.ranges_m.begin(), row.ranges_m.end());
    scans.push_back({.time = time, .sensor = index, .ranges_m = std::move(row.ranges_m)});
    if (row.T_map_laser) laser_poses.push_back({time, *row.T_map_laser});
    if (row.T_odom_base) base_poses.push_back({time, *row.T_odom_base});
  }
}

/// The ring's reach is its largest reading, which is what it says when it hears nothing.
void add_sonar(Gatherer& gathered, const CarmenParams& params, CarmenLog& log) {
  sensors::SonarRing ring = *gathered.ring;
  float largest = 0.0F;
  for (const auto& row : gathered.sonar)
    for (const float range : row.value) largest = std::max(largest, range);
  ring.range_min_m = kRangeMin_m;
  ring.range_max_m = std::max<double>(largest, 2.0 * kRangeMin_m);
  const double no_echo_from_m = params.sonar_no_echo_share * largest;
  auto& sweeps = log.sonar.emplace_back();
  for (auto& [time, made_up_time, ranges] : gathered.sonar) {
    for (float& range : ranges)
      if (range < kRangeMin_m)
        range = std::numeric_limits<float>::quiet_NaN();
      else if (range >= no_echo_from_m)
        range = std::numeric_limits<float>::infinity();
    sweeps.push_back({.time = time, .sensor = 0, .ranges_m = std::move(ranges)});
  }
  log.rig.sonar_rings.push_back(std::move(ring));
}

}  // namespace

bool is_carmen(const fs::path& file) {
  constexpr std::size_t kHead_bytes = 1 << 16;
  static constexpr std::array<std::string_view, 9> kNames{"PARAM ",     "SYNC ",    "ODOM ",    "FLASER ", "RLASER ",
                                                          "ROBOTLASER", "RAWLASER", "TRUEPOS ", "NEFF "};
  try {
    const std::string content = read_unpacked(file, kHead_bytes);
    for (std::string_view left = content; !left.empty();) {
      const std::size_t end = std::min(left.find('\n'), left.size());
      const std::string_view line = trimmed(left.substr(0, end));
      left.remove_prefix(std::min(end + 1, left.size()));
      if (line.empty() || line.front() == '#') continue;
      return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) { return line.starts_with(name); });
    }
  } catch (const FormatError&) {
    return false;
  }
  return false;
}

CarmenLog read_carmen(const fs::path& file, const CarmenParams& params) {
  const std::string content = read_unpacked(file, kLargestLog_bytes);
  Gatherer gathered(file, params);
  gathered.read(content);
  if (gathered.lasers.empty() && gathered.sonar.empty())
    throw FormatError(file, 0,
                      "holds no scan; expected a CARMEN log with FLASER, ROBOTLASER1, RAWLASER1 or SONAR rows");
  std::sort(gathered.lasers.begin(), gathered.lasers.end(),
            [](const Laser& a, const Laser& b) { return a.name < b.name; });
  CarmenLog log;
  log.times_usable = are_times_usable(gathered.lasers);
  if (!log.times_usable)
    log.remarks.push_back("the times of the log do not tell its scans apart: row k is taken to be at k/10 s");
  for (Laser& laser : gathered.lasers) {
    if (settle_times(laser.rows, log.times_usable))
      log.remarks.push_back(laser.name + ": the rows were not in order of time and were sorted");
    add_laser(laser, log);
  }
  if (settle_times(gathered.odometry, log.times_usable))
    log.remarks.push_back("ODOM: the rows were not in order of time and were sorted");
  for (const auto& [time, made_up_time, pose] : gathered.odometry) log.odometry.push_back({time, pose});
  if (log.odometry.empty() && !log.base_poses.empty())
    for (const TimedPose& row : log.base_poses.front()) log.odometry.push_back({row.time, row.pose});
  if (gathered.ring) {
    if (settle_times(gathered.sonar, log.times_usable))
      log.remarks.push_back("SONAR: the rows were not in order of time and were sorted");
    add_sonar(gathered, params, log);
  }
  log.rig.odometry = sensors::OdometryNoise{};
  return log;
}

Dataset to_dataset(CarmenLog log, std::string name) {
  Dataset dataset;
  dataset.header.name = std::move(name);
  dataset.header.description = "CARMEN log";
  for (std::size_t i = 0; i < log.scans.size(); ++i) dataset.range_finder_names.push_back("range" + std::to_string(i));
  for (std::size_t i = 0; i < log.sonar.size(); ++i) dataset.sonar_ring_names.push_back("sonar" + std::to_string(i));
  dataset.header.acquisition_sensor = log.scans.empty() ? "sonar0" : "range0";
  if (!log.laser_poses.empty()) {
    const geometry::Pose2 T_laser_base = log.rig.range_finders.front().T_base_sensor.inverse();
    for (const TimedPose& row : log.laser_poses.front()) dataset.truth.push_back({row.time, row.pose * T_laser_base});
  }
  dataset.header.rig = std::move(log.rig);
  dataset.scans = std::move(log.scans);
  dataset.sonar = std::move(log.sonar);
  dataset.odometry = std::move(log.odometry);
  dataset.remarks = std::move(log.remarks);
  return dataset;
}

}  // namespace credo::datasets
