// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mapping/batches.hpp"
#include "mapping/mapper.hpp"

namespace credo::mapping {
namespace {

/// Calls insert(i) for all i below `count`, on all cores, and says after each batch how many are done.
template <typename Insert, typename Done>
void insert_in_batches(std::size_t count, const Insert& insert, const Done& done) {
  in_batches(
      count, [&](std::size_t begin, std::size_t end) { tbb::parallel_for(begin, end, insert); }, done);
}

template <typename Reading>
std::vector<double> shares_by_time(const sensors::MotionPath& T_map_base, std::span<const Reading> readings,
                                   const TrajectoryMappingParams& params) {
  std::vector<std::size_t> by_time(readings.size());
  std::iota(by_time.begin(), by_time.end(), std::size_t{0});
  std::stable_sort(by_time.begin(), by_time.end(),
                   [&](std::size_t a, std::size_t b) { return readings[a].time < readings[b].time; });
  std::vector<double> shares(readings.size(), 1.0);
  Freshness freshness(params.mapper.freshness);
  for (const std::size_t i : by_time)
    if (covers(T_map_base, readings[i].time, params.max_gap_s))
      shares[i] = freshness.of_next(readings[i], T_map_base.pose_at(readings[i].time));
  return shares;
}

/// What one thread has mapped so far.
struct Worker {
  Mapper mapper;
  std::int64_t without_pose = 0;
};

}  // namespace

bool covers(const sensors::MotionPath& trajectory, sensors::Timestamp time, double max_gap_s) {
  const auto& rows = trajectory.rows();
  const auto after =
      std::lower_bound(rows.begin(), rows.end(), time,
                       [](const sensors::OdometryReading& row, sensors::Timestamp t) { return row.time < t; });
  const auto near = [&](const sensors::OdometryReading& row) {
    return sensors::seconds_between(std::min(row.time, time), std::max(row.time, time)) <= max_gap_s;
  };
  const bool before_is_near = after != rows.begin() && near(*(after - 1));
  const bool after_is_near = after != rows.end() && near(*after);
  return before_is_near || after_is_near;
}

std::vector<double> new_shares(const sensors::MotionPath& T_map_base, std::span<const sensors::RangeScan> scans,
                               const TrajectoryMappingParams& params) {
  return shares_by_time(T_map_base, scans, params);
}

std::vector<double> new_shares(const sensors::MotionPath& T_map_base, std::span<const sensors::SonarSweep> sweeps,
                               const TrajectoryMappingParams& params) {
  return shares_by_time(T_map_base, sweeps, params);
}

TrajectoryMap map_along(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                        std::span<const sensors::RangeScan> scans, std::span<const sensors::SonarSweep> sweeps,
                        const TrajectoryMappingParams& params, const std::function<void(double share)>& progress) {
  const NewShares shares{.of_scans = new_shares(T_map_base, scans, params),
                         .of_sweeps = new_shares(T_map_base, sweeps, params)};
  return map_along(T_map_base, rig, scans, sweeps, shares, params, progress);
}

TrajectoryMap map_along(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                        std::span<const sensors::RangeScan> scans, std::span<const sensors::SonarSweep> sweeps,
                        const NewShares& shares, const TrajectoryMappingParams& params,
                        const std::function<void(double share)>& progress) {
  if (T_map_base.empty()) throw std::invalid_argument("the trajectory has no pose: nothing can be mapped along it");
  if (shares.of_scans.size() != scans.size() || shares.of_sweeps.size() != sweeps.size())
    throw std::invalid_argument("expected one share for each reading: " + std::to_string(shares.of_scans.size()) +
                                " for " + std::to_string(scans.size()) + " scans, " +
                                std::to_string(shares.of_sweeps.size()) + " for " + std::to_string(sweeps.size()) +
                                " sweeps");
  // Sums of evidence do not depend on their order, so every thread maps what it gets into a grid of its own.
  tbb::enumerable_thread_specific<Worker> workers([&] { return Worker{Mapper(rig, params.mapper), 0}; });
  const auto insert = [&](const auto& reading, double share) {
    Worker& worker = workers.local();
    if (!covers(T_map_base, reading.time, params.max_gap_s)) {
      ++worker.without_pose;
      return;
    }
    worker.mapper.insert({{T_map_base.pose_at(reading.time), params.covariance}, params.belief}, reading, T_map_base,
                         share);
  };
  const auto report = [&](std::size_t done) {
    if (progress) progress(static_cast<double>(done) / static_cast<double>(scans.size() + sweeps.size()));
  };
  insert_in_batches(
      scans.size(), [&](std::size_t i) { insert(scans[i], shares.of_scans[i]); }, report);
  insert_in_batches(
      sweeps.size(), [&](std::size_t i) { insert(sweeps[i], shares.of_sweeps[i]); },
      [&](std::size_t done) { report(scans.size() + done); });

  TrajectoryMap map{Mapper(rig, params.mapper).take_grid(), {}, 0};
  for (Worker& worker : workers) {
    grids::EvidentialGrid part = worker.mapper.take_grid();  // dies when it is merged
    if (map.grid.tiles().empty())
      map.grid = std::move(part);
    else
      map.grid.merge(part);
    map.counts += worker.mapper.counts();
    map.without_pose += worker.without_pose;
  }
  return map;
}

}  // namespace credo::mapping
