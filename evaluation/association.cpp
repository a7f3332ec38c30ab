// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/association.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace credo::evaluation {
namespace {

using sensors::Timestamp;

struct Candidate {
  std::size_t index = 0;  // into the longer trajectory
  Timestamp difference = 0;
};

std::vector<std::size_t> by_time(const Trajectory& trajectory) {
  std::vector<std::size_t> order(trajectory.poses.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return trajectory.poses[a].time < trajectory.poses[b].time; });
  return order;
}

/// Stays where differences cannot overflow. Precondition: the time of a reader, and an offset of AssociationParams.
Timestamp shifted(Timestamp time, Timestamp offset) {
  return std::clamp(time + offset, -sensors::kLatestTime, sensors::kLatestTime);
}

void check(const AssociationParams& params) {
  constexpr double kLargest = AssociationParams::kLargest_s;
  if (!(std::abs(params.t_offset_s) <= kLargest && params.t_max_diff_s >= 0.0 && params.t_max_diff_s <= kLargest))
    throw std::invalid_argument(
        "the largest difference in time of a match must be from 0 to 4e9 s, and an offset within 4e9 s");
}

Candidate nearest(const Trajectory& trajectory, const std::vector<std::size_t>& order, Timestamp time) {
  const auto after = std::lower_bound(order.begin(), order.end(), time,
                                      [&](std::size_t i, Timestamp t) { return trajectory.poses[i].time < t; });
  Candidate best{.index = 0, .difference = std::numeric_limits<Timestamp>::max()};
  if (after != order.begin()) best = {*(after - 1), time - trajectory.poses[*(after - 1)].time};
  if (after != order.end() && trajectory.poses[*after].time - time < best.difference) {
    best = {*after, trajectory.poses[*after].time - time};
  }
  return best;
}

/// For each pose of `shorter` the index into `longer`, or -1.
std::vector<std::ptrdiff_t> match(const Trajectory& shorter, const Trajectory& longer, Timestamp offset,
                                  Timestamp limit) {
  const std::vector<std::size_t> order = by_time(longer);
  std::vector<std::ptrdiff_t> owner(longer.poses.size(), -1);
  std::vector<Candidate> candidates(shorter.poses.size());
  for (std::size_t i = 0; i < shorter.poses.size(); ++i) {
    candidates[i] = nearest(longer, order, shifted(shorter.poses[i].time, offset));
    if (candidates[i].difference > limit) continue;
    std::ptrdiff_t& current = owner[candidates[i].index];
    if (current < 0 || candidates[i].difference < candidates[static_cast<std::size_t>(current)].difference) {
      current = static_cast<std::ptrdiff_t>(i);
    }
  }
  std::vector<std::ptrdiff_t> matches(shorter.poses.size(), -1);
  for (std::size_t j = 0; j < owner.size(); ++j) {
    if (owner[j] >= 0) matches[static_cast<std::size_t>(owner[j])] = static_cast<std::ptrdiff_t>(j);
  }
  return matches;
}

StampedPose interpolated(const StampedPose& a, const StampedPose& b, Timestamp time) {
  const double share = sensors::seconds_between(a.time, time) / sensors::seconds_between(a.time, b.time);
  const Eigen::Quaterniond q = Eigen::Quaterniond(a.rotation).slerp(share, Eigen::Quaterniond(b.rotation));
  return {.time = time, .rotation = q.toRotationMatrix(), .position = a.position + share * (b.position - a.position)};
}

AssociatedPair interpolate_reference(const Trajectory& reference, const Trajectory& estimate, Timestamp offset,
                                     Timestamp limit) {
  const std::vector<std::size_t> order = by_time(reference);
  AssociatedPair pair{.reference = {.name = reference.name},
                      .estimate = {.name = estimate.name},
                      .possible = static_cast<int>(estimate.poses.size())};
  for (const StampedPose& pose : estimate.poses) {
    const Timestamp time = shifted(pose.time, offset);
    const auto after = std::lower_bound(order.begin(), order.end(), time,
                                        [&](std::size_t i, Timestamp t) { return reference.poses[i].time < t; });
    const Candidate close = nearest(reference, order, time);
    const bool between = after != order.begin() && after != order.end() && close.difference > 0;
    if (!between && close.difference > limit) continue;
    pair.reference.poses.push_back(between ? interpolated(reference.poses[*(after - 1)], reference.poses[*after], time)
                                           : reference.poses[close.index]);
    pair.estimate.poses.push_back(pose);
  }
  return pair;
}

AssociatedPair row_by_row(const Trajectory& reference, const Trajectory& estimate) {
  if (reference.poses.size() != estimate.poses.size()) {
    throw std::runtime_error("without times the trajectories must have the same number of poses: " + reference.name +
                             " has " + std::to_string(reference.poses.size()) + ", " + estimate.name + " has " +
                             std::to_string(estimate.poses.size()));
  }
  return {.reference = reference, .estimate = estimate, .possible = static_cast<int>(reference.poses.size())};
}

}  // namespace

AssociatedPair associate(const Trajectory& reference, const Trajectory& estimate, const AssociationParams& params) {
  check(params);
  if (!reference.timed || !estimate.timed) return row_by_row(reference, estimate);
  const Timestamp offset = sensors::from_seconds(params.t_offset_s);
  const Timestamp limit = sensors::from_seconds(params.t_max_diff_s);
  AssociatedPair pair;
  if (params.interpolate) {
    pair = interpolate_reference(reference, estimate, offset, limit);
  } else {
    const bool estimate_is_longer = estimate.poses.size() > reference.poses.size();
    const Trajectory& shorter = estimate_is_longer ? reference : estimate;
    const Trajectory& longer = estimate_is_longer ? estimate : reference;
    const auto matches = match(shorter, longer, estimate_is_longer ? -offset : offset, limit);
    pair = {.reference = {.name = reference.name},
            .estimate = {.name = estimate.name},
            .possible = static_cast<int>(shorter.poses.size())};
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (matches[i] < 0) continue;
      const StampedPose& other = longer.poses[static_cast<std::size_t>(matches[i])];
      pair.reference.poses.push_back(estimate_is_longer ? shorter.poses[i] : other);
      pair.estimate.poses.push_back(estimate_is_longer ? other : shorter.poses[i]);
    }
  }
  if (pair.estimate.poses.empty()) {
    std::ostringstream message;
    message << "no matching times between " << reference.name << " and " << estimate.name << " with --t_max_diff "
            << params.t_max_diff_s << " and --t_offset " << params.t_offset_s
            << ": check that both use the same clock, or give a larger --t_max_diff";
    throw std::runtime_error(message.str());
  }
  return pair;
}

}  // namespace credo::evaluation
