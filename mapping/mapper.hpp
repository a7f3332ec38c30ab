// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "evidence/believed.hpp"
#include "grids/evidential_grid.hpp"
#include "mapping/freshness.hpp"
#include "mapping/laser_choice.hpp"
#include "mapping/placed_sweep.hpp"
#include "mapping/pose_blur.hpp"
#include "mapping/pose_reliability.hpp"
#include "mapping/scan_params.hpp"
#include "mapping/sensor_reliability.hpp"
#include "mapping/sonar_choice.hpp"
#include "sensors/acquisition.hpp"

namespace credo::mapping {

struct MapperParams {
  grids::Georeference georeference;
  SonarParams sonar;
  LaserParams laser;
  ScanParams scan;
  PoseReliabilityParams pose;
  PoseBlurParams blur;
  SensorReliabilityParams sensors;
  FreshnessParams freshness;  ///< for who maps a whole drive, in the order of time: a Mapper is told the shares
};

/// Ranges from believed poses -> evidential grid (Li X. 2007, sec. 5; Li X. 2006, sec. 4). Only the cells of the fan or
/// the beam's sector are touched ("restricted spreading"), each once per reading of a transducer and once per scan. An
/// unsure pose blurs what it maps: the mass of a cell is the mean over the poses that may be (EvidenceMean), all
/// readings of a sweep or scan being taken from one pose. A pose that is not believed discounts; a lost one maps
/// nothing.
class Mapper {
 public:
  /// Binds the rig's sonar rings and range finders by their index.
  /// \throws std::invalid_argument if a parameter is out of range, or a beam width or angle increment cannot be mapped.
  explicit Mapper(const sensors::Rig& rig, const MapperParams& params = {});
  ~Mapper();
  Mapper(Mapper&&) noexcept;
  Mapper& operator=(Mapper&&) noexcept;

  /// \param T_map_base  at the time of the reading
  /// \param path        carries the pose to when each beam, or each transducer, was fired; empty: all at once
  /// \param share       of the reading that is new, in (0, 1]: see Freshness
  /// \throws std::invalid_argument if the rig has no such sensor, the number of ranges is not that of the sensor, or
  ///         the pose is not finite; std::out_of_range if it is too far away to be addressed: the map is unchanged
  ///         then; std::length_error if the map may not grow as far: a part of the reading may be in it.
  void insert(const evidence::Believed<geometry::PoseEstimate>& T_map_base, const sensors::SonarSweep& sweep,
              const sensors::MotionPath& path = {}, double share = 1.0);
  void insert(const evidence::Believed<geometry::PoseEstimate>& T_map_base, const sensors::RangeScan& scan,
              const sensors::MotionPath& path = {}, double share = 1.0);

  [[nodiscard]] const grids::EvidentialGrid& grid() const;
  /// Hands the map over and starts a new one.
  [[nodiscard]] grids::EvidentialGrid take_grid();
  [[nodiscard]] const MappingCounts& counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

struct TrajectoryMappingParams {
  MapperParams mapper;
  double max_gap_s = 0.5;  ///< a reading further than this from the nearest pose is left out
  /// Covariance and belief of all poses of the trajectory: taken as true unless said otherwise.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  evidence::BinaryMass belief{.yes = 1.0, .no = 0.0, .unknown = 0.0};
};

/// Whether a trajectory has a pose within `max_gap_s` of a time, on the side or sides that it is interpolated from.
[[nodiscard]] bool covers(const sensors::MotionPath& trajectory, sensors::Timestamp time, double max_gap_s);

/// How much of each reading of a robot's drive is new (Freshness), in the order that they are given in; 1 of what has
/// no pose. Readings that are dealt out to several mappers make the same map to the bit, however they are dealt, if
/// their shares are of the whole drive.
[[nodiscard]] std::vector<double> new_shares(const sensors::MotionPath& T_map_base,
                                             std::span<const sensors::RangeScan> scans,
                                             const TrajectoryMappingParams& params);
[[nodiscard]] std::vector<double> new_shares(const sensors::MotionPath& T_map_base,
                                             std::span<const sensors::SonarSweep> sweeps,
                                             const TrajectoryMappingParams& params);

struct TrajectoryMap {
  grids::EvidentialGrid grid;
  MappingCounts counts;
  std::int64_t without_pose = 0;  ///< readings left out for want of a pose near in time
};

/// The map of a whole drive whose poses are given: `T_map_base` holds the trajectory, in the map frame, and carries
/// every beam to its own time. Runs on all cores; the result is the same to the last bit whatever their number.
/// \param progress  called on this thread now and then with the share done; what it throws ends the mapping
/// \throws std::invalid_argument and std::out_of_range as `Mapper`, or if the trajectory is empty.
[[nodiscard]] TrajectoryMap map_along(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                                      std::span<const sensors::RangeScan> scans,
                                      std::span<const sensors::SonarSweep> sweeps,
                                      const TrajectoryMappingParams& params = {},
                                      const std::function<void(double share)>& progress = {});

/// How much of each reading is new, in the order of the readings.
struct NewShares {
  std::vector<double> of_scans, of_sweeps;
};

/// The map of a part of a drive, whose shares are of the whole drive (new_shares): the maps of all parts, merged, are
/// that of the drive to the last bit, however it was dealt out.
/// \throws std::invalid_argument also if there is not one share in (0, 1] for each reading
[[nodiscard]] TrajectoryMap map_along(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                                      std::span<const sensors::RangeScan> scans,
                                      std::span<const sensors::SonarSweep> sweeps, const NewShares& shares,
                                      const TrajectoryMappingParams& params = {},
                                      const std::function<void(double share)>& progress = {});

}  // namespace credo::mapping
