// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "geometry/pose.hpp"
#include "sensors/motion_path.hpp"
#include "sensors/odometry.hpp"
#include "sensors/omni_camera.hpp"
#include "sensors/range_finder.hpp"
#include "sensors/sonar_ring.hpp"
#include "sensors/time.hpp"

namespace credo::sensors {

/// What the camera saw.
struct OmniImage {
  Timestamp time = 0;
  cv::Mat pixels;  ///< CV_8UC1, height x width of the camera
};

/// One turn of a range finder. inf: nothing came back; nan: no measurement. [m]
struct RangeScan {
  Timestamp time = 0;
  int sensor = 0;  ///< index into Rig::range_finders
  std::vector<float> ranges_m;
};

/// One firing of a sonar ring. inf: no echo; nan: no measurement. [m]
struct SonarSweep {
  Timestamp time = 0;
  int sensor = 0;  ///< index into Rig::sonar_rings
  std::vector<float> ranges_m;
};

/// The instruments that a robot carries.
struct Rig {
  std::optional<OmniCamera> camera;
  std::vector<RangeFinder> range_finders;
  std::vector<SonarRing> sonar_rings;
  std::optional<OdometryNoise> odometry;
};

/// All that was measured for one moment: the image and the scan nearest to it, and everything that came in since the
/// acquisition before.
struct Acquisition {
  Timestamp time = 0;
  std::optional<OmniImage> image;         ///< absent: the camera is missing or blind
  std::optional<RangeScan> scan;          ///< of range finder 0, the one nearest to `time`; absent: missing or all nan
  std::vector<RangeScan> scans;           ///< all scans of all range finders since the acquisition before, by time
  std::vector<SonarSweep> sonar;          ///< all sweeps since the acquisition before, by time
  std::vector<OdometryReading> odometry;  ///< all rows since the acquisition before
  /// The motion from before the first to after the last reading above. Empty without odometry, until the localizer's
  /// own velocity fills it in (Localizer::with_path).
  MotionPath path;
  /// T_previous_current of the robot base with covariance, from odometry; absent for the first acquisition and without
  /// odometry.
  std::optional<geometry::PoseEstimate> motion;
};

/// A range reading as a point.
struct ScanPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< in the base frame at the moment asked for [m]
  Eigen::Vector2d ray = Eigen::Vector2d::UnitX();      ///< unit vector of the beam, in the same frame
  double range_m = 0.0;                                ///< as measured, from the sensor
  double sigma_m = 0.0;                                ///< 1-sigma along the ray
  int beam = 0;
};

/// The finite readings of a scan as points in the base frame at `time`, each carried there along `path` from when its
/// beam was taken; by beam. Appends nothing for nan, inf and what is outside of range_min .. range_max. `points` is
/// cleared first and keeps its memory.
void carry_scan(const RangeScan& scan, const RangeFinder& range_finder, const MotionPath& path, Timestamp time,
                std::vector<ScanPoint>& points);

}  // namespace credo::sensors
