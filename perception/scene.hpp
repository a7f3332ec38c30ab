// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <iosfwd>
#include <optional>
#include <vector>

#include "evidence/binary_mass.hpp"
#include "geometry/segment.hpp"
#include "sensors/acquisition.hpp"

namespace credo::perception {

/// A vertical edge of the world in the omnidirectional image.
struct RadialLine {
  double azimuth = 0.0;        ///< bearing from the camera, in the directions of the base frame [rad]
  double sigma = 0.0;          ///< 1-sigma of the azimuth, the calibration's share included [rad]
  double contrast = 0.0;       ///< mean step across the line [grey levels], >= 0
  int polarity = 0;            ///< +1: brighter on the side of growing azimuth, -1: darker
  double visible_share = 0.0;  ///< share of the annulus' rows that support the line
  double slope = 0.0;          ///< change of the azimuth with 1/radius [rad px]; 0 for a well centred, upright mirror
};

/// Which sensor saw an end of a segment (Clerentin et al., sec. 3.1).
enum class EndpointSource { kRangeFinder, kCamera, kBoth };

/// What a segment's end is. Ends by occlusion or by the limit of sight are no places of the world: they move with the
/// robot.
enum class SegmentEnd {
  kJoined,    ///< meets the neighbouring segment
  kFree,      ///< something farther is seen beside it: a vertical edge of the world
  kOpen,      ///< several beams beside it came back empty: likely an edge, with nothing in reach behind it
  kOccluded,  ///< something nearer hides the rest
  kUnseen     ///< no readings beside it
};

/// How the mirror stands in front of the camera, as learned from the images so far.
struct MirrorEstimate {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  ///< from the rim, or as calibrated
  double center_sigma_px = 0.0;                         ///< per axis
  Eigen::Vector2d tilt_rad = Eigen::Vector2d::Zero();   ///< along the base frame's x and y: from the lines' slopes
  double tilt_sigma_rad = 0.0;                          ///< per axis
};

/// Mean grey level of five concentric circles, by azimuth (Clerentin et al., sec. 3.1, fifth criterion). Bin i holds
/// the azimuths around 2 pi i / values.size(), in the directions of the base frame, seen from the camera.
struct GrayCurve {
  std::vector<float> values;  ///< empty: no image
  double noise = 0.0;         ///< expected 1-sigma of a value [grey levels]
};

/// A segment of the range scan, cut and sharpened by the radial lines, with the belief that it exists.
struct FusedSegment {
  geometry::Segment extent{};     ///< in the base frame, a before b counter-clockwise
  geometry::LineEstimate line{};  ///< fitted to all its points
  int first_point = 0;            ///< into Scene::points, inclusive
  int last_point = 0;             ///< inclusive
  EndpointSource source_a = EndpointSource::kRangeFinder;
  EndpointSource source_b = EndpointSource::kRangeFinder;
  int radial_line_a = -1;  ///< index into Scene::radial_lines, -1 where the end is the range finder's
  int radial_line_b = -1;
  int endpoint_case = 1;                   ///< 1..5 (Clerentin et al., fig. 5)
  SegmentEnd end_a = SegmentEnd::kUnseen;  ///< kJoined where a radial line has cut it
  SegmentEnd end_b = SegmentEnd::kUnseen;
  int support = 0;  ///< points that agree with the line; the other ones between first and last are outliers
  std::array<evidence::BinaryMass, 5> criteria;  ///< m_1 .. m_5
  evidence::BinaryMass existence{};              ///< their fusion, conflict moved to ignorance once
  double conflict = 0.0;                         ///< what was moved
};

enum class PrimitiveType { kCorner, kEdge, kWall, kOther };

/// A typed landmark as seen in one acquisition, with the belief that it exists.
struct Primitive {
  PrimitiveType type = PrimitiveType::kOther;
  double azimuth = 0.0;  ///< of `position` from the base origin; of a bearing-only one, from the camera [rad]
  double sigma_azimuth = 0.0;
  bool bearing_only = false;  ///< a radial line without a segment: no range, no position
  double range_m = 0.0;       ///< of `position` from the base origin
  double sigma_range_m = 0.0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< base frame; a wall's is the middle of its extent
  Eigen::Matrix2d position_covariance = Eigen::Matrix2d::Zero();
  double interior_angle =
      0.0;               ///< of a junction, on the robot's side, (0, 2 pi) [rad]; 0: less than two faces are seen
  int radial_line = -1;  ///< index into Scene::radial_lines: its bearing is the camera's
  // Walls: the union of collinear touching segments.
  geometry::Segment extent{};
  geometry::LineEstimate line{};
  int first_segment = -1;  ///< into Scene::segments, inclusive; a junction's two segments are first and last
  int last_segment = -1;
  SegmentEnd end_a = SegmentEnd::kUnseen;  ///< of a wall's extent
  SegmentEnd end_b = SegmentEnd::kUnseen;
  int support = 0;  ///< points that a wall's line is fitted to
  evidence::BinaryMass existence{};
  double conflict = 0.0;  ///< met on the way to `existence`
  int endpoint_case = 0;  ///< the best of its segments, 1..5; 0 without a segment
};

/// Mean conflict of the criteria two by two, over the segments: pair[i][j] = m_i(YES) m_j(NO) + m_i(NO) m_j(YES), i !=
/// j.
struct ConflictReport {
  std::array<std::array<double, 5>, 5> pair{};
};

/// What one acquisition shows: the sensorial model of Clerentin et al., sec. 3.
struct Scene {
  sensors::Timestamp time = 0;
  Eigen::Vector2d camera_origin = Eigen::Vector2d::Zero();  ///< base frame; where the bearings of radial lines start
  std::vector<RadialLine> radial_lines;                     ///< by azimuth
  GrayCurve gray;
  std::vector<sensors::ScanPoint> points;  ///< base frame at `time`, counter-clockwise
  std::vector<FusedSegment> segments;      ///< counter-clockwise
  std::vector<Primitive> primitives;
  /// Of the motion (x, y, theta) over which the scan was carried to `time`: an error common to all its points.
  Eigen::Matrix3d carry_covariance = Eigen::Matrix3d::Zero();
  double mean_conflict = 0.0;  ///< of the five criteria over the segments
  ConflictReport conflicts;
  MirrorEstimate mirror = {};  ///< of the latest image that showed something
  bool camera_seen = false;    ///< an image was there and usable
  bool range_finder_seen = false;
  double saturated_share = 0.0;  ///< of the annulus
};

/// The polarity of its radial line; 0 without one.
[[nodiscard]] int polarity_of(const Primitive& primitive, const Scene& scene);

[[nodiscard]] const char* to_string(PrimitiveType type);
[[nodiscard]] const char* to_string(SegmentEnd end);
std::ostream& operator<<(std::ostream& out, const Primitive& primitive);

}  // namespace credo::perception
