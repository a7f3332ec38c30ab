// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/failures.hpp"

#include <algorithm>
#include <stdexcept>

namespace credo::sim {
namespace {

constexpr double kNoisy = 5.0;
constexpr double kDark = 1.0 / 12.0;
constexpr double kSaturated = 8.0;

bool concerns(const Failure& failure, const std::string& sensor) {
  return failure.sensor == "all" || failure.sensor == sensor;
}

bool is_on(const Failure& failure, double seconds) { return failure.from_s <= seconds && seconds < failure.to_s; }

bool is_total(Failure::Kind kind) { return kind == Failure::Kind::kBlind || kind == Failure::Kind::kFrozen; }

}  // namespace

Condition condition_of(const World& world, const std::string& sensor, double seconds) {
  Condition condition;
  for (const Failure& failure : world.failures) {
    if (!concerns(failure, sensor) || !is_on(failure, seconds)) continue;
    switch (failure.kind) {
      case Failure::Kind::kBlind: condition.blind = true; break;
      case Failure::Kind::kFrozen: condition.frozen = true; break;
      case Failure::Kind::kNoisy: condition.noise *= kNoisy; break;
      case Failure::Kind::kDark: condition.light *= kDark; break;
      case Failure::Kind::kSaturated: condition.light *= kSaturated; break;
      case Failure::Kind::kLying:
        condition.scale *= failure.scale;
        condition.offset_m += failure.offset_m;
        condition.turn_rad += failure.turn_rad;
        break;
      case Failure::Kind::kSlipping: break;  // slipped_m
    }
  }
  return condition;
}

double slipped_m(const World& world, double seconds) {
  double slipped = 0.0;
  for (const Failure& failure : world.failures)
    if (failure.kind == Failure::Kind::kSlipping)
      slipped += failure.offset_m *
                 std::clamp((seconds - failure.from_s) / std::max(failure.to_s - failure.from_s, 1e-3), 0.0, 1.0);
  return slipped;
}

std::vector<std::string> sensor_names(const World& world) {
  std::vector<std::string> names;
  if (world.camera) names.emplace_back("camera0");
  for (std::size_t i = 0; i < world.range_finders.size(); ++i) names.push_back("range" + std::to_string(i));
  if (world.odometry) names.emplace_back("odometry0");
  return names;
}

std::vector<Event> failure_events(const World& world) {
  std::vector<Event> events;
  for (const std::string& sensor : sensor_names(world))
    for (const Failure& failure : world.failures) {
      if (!concerns(failure, sensor)) continue;
      events.push_back({failure.from_s, sensor + (is_total(failure.kind) ? "_failed" : "_degraded")});
      const bool still_ill = std::any_of(world.failures.begin(), world.failures.end(), [&](const Failure& other) {
        return concerns(other, sensor) && is_on(other, failure.to_s);
      });
      if (!still_ill && std::isfinite(failure.to_s)) events.push_back({failure.to_s, sensor + "_restored"});
    }
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.seconds < b.seconds; });
  return events;
}

void check_failures(const World& world) {
  const std::vector<std::string> names = sensor_names(world);
  for (const Failure& failure : world.failures) {
    const bool known = failure.sensor == "all" || std::find(names.begin(), names.end(), failure.sensor) != names.end();
    std::string all;
    for (const std::string& name : names) all += name + " ";
    if (!known)
      throw std::invalid_argument("there is no sensor '" + failure.sensor + "' that could fail: one of " + all + "all");
    if (!(failure.from_s >= 0.0 && failure.to_s > failure.from_s))
      throw std::invalid_argument("a failure must have 0 <= 'from' < 'to' (seconds from the start)");
    const bool light = failure.kind == Failure::Kind::kDark || failure.kind == Failure::Kind::kSaturated;
    if (light && failure.sensor != "camera0")
      throw std::invalid_argument("only camera0 can be dark or saturated, not " + failure.sensor);
    if (failure.kind != Failure::Kind::kSlipping) continue;
    if (failure.sensor != "odometry0")
      throw std::invalid_argument("only odometry0 can be slipping, not " + failure.sensor);
    if (!std::isfinite(failure.to_s))
      throw std::invalid_argument("slipping must have an end 'to' (seconds from the start)");
  }
}

}  // namespace credo::sim
