// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/floor_plan.hpp"
#include "geometry/pose.hpp"
#include "sensors/acquisition.hpp"
#include "sim/world.hpp"

namespace credo::sim {

/// A vertical edge that the camera really has in view.
struct TrueVertical {
  double azimuth_rad = 0.0;    ///< in the frame of the camera as it is really mounted, (-pi, pi]
  double visible_share = 0.0;  ///< of the rows (radii) of the usable annulus on which the edge can be seen
  double contrast = 0.0;       ///< mean difference across the edge over these rows, before blur and noise [grey levels]
};

/// Who receives what a simulation produces. Calls come from one thread, in the order of time; at equal times: event,
/// truth, image, verticals, scan, sonar, odometry. An empty function is not called.
struct Sink {
  std::function<void(const sensors::OmniImage&)> image;
  std::function<void(const sensors::RangeScan&)> scan;
  std::function<void(const sensors::SonarSweep&)> sonar;
  std::function<void(const sensors::OdometryReading&)> odometry;
  /// The true T_map_base, at the time of every reading (once per time).
  std::function<void(sensors::Timestamp, const geometry::Pose2&)> truth;
  /// The true vertical edges of the image just delivered, by azimuth.
  std::function<void(sensors::Timestamp, std::span<const TrueVertical>)> verticals;
  std::function<void(sensors::Timestamp, std::string_view)> event;
  /// Share of the work done, 0..1, not decreasing.
  std::function<void(double)> progress;
};

/// The true occupancy at the heights of the range and sonar sensors: surfaces are occupied. What lies behind them is
/// unknown, be it the outside or the inside of what is solid. Cells begin at whole multiples of the resolution.
struct TruthMap {
  enum class Cell : std::uint8_t { kFree, kOccupied, kUnknown };

  double resolution_m = 0.05;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< the lower left corner of cell (0, 0), in the map frame
  int width = 0;
  int height = 0;
  std::vector<Cell> cells;  ///< row by row, y growing

  [[nodiscard]] Cell at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)];
  }
};

/// What is true from a moment on, until the next change.
struct TruthState {
  sensors::Timestamp since = 0;
  TruthMap map;
};

/// A world played once. All randomness comes from the seed: the same world and seed give the same bytes, whatever the
/// number of threads. The constructor draws what holds for the whole drive (calibration errors, floor plan errors).
class Simulation {
 public:
  /// \throws std::invalid_argument  for a world without a path or without a sensor, or a path that the robot cannot
  ///   drive.
  Simulation(World world, std::uint64_t seed);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  [[nodiscard]] const World& world() const;
  /// The instruments as calibrated: what the robot believes of them.
  [[nodiscard]] const sensors::Rig& rig() const;
  /// The floor plan as given to the robot: without the clutter, and with its errors.
  [[nodiscard]] const geometry::FloorPlan& floor_plan() const;
  /// T_map_base at the start as told to the robot; nothing if it has to find it itself.
  [[nodiscard]] const std::optional<geometry::PoseEstimate>& initial_pose() const;
  /// The sensor whose timestamps define the acquisitions: `camera0`, `range0` or `sonar0`.
  [[nodiscard]] std::string acquisition_sensor() const;
  /// At the end of the drive.
  [[nodiscard]] TruthMap truth_map(double resolution_m = 0.05) const;
  /// From the start on, and from each change on; all of the same cells.
  [[nodiscard]] std::vector<TruthState> truth_states(double resolution_m = 0.05) const;

  /// Plays the world from the start into the sink. Repeated calls give the same again.
  /// \param threads  for rendering images, at least 1.
  void run(const Sink& sink, int threads = 1) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace credo::sim
