// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <span>
#include <vector>

#include "perception/segmentation.hpp"

namespace credo::perception {

struct CooperationParams {
  double agree_sigmas =
      3.0;                 ///< camera and range finder saw one end: in expected standard deviations of their difference
  double agree_rad = 0.0;  ///< > 0: this angle instead (Clerentin et al.)
  double min_sine = 0.09;  ///< of the angle between the bearing and a line that it cuts
};

/// What became of a radial line.
struct RadialLineUse {
  int segment = -1;   ///< index of the range segment that it cuts or ends; -1: it meets none
  bool at_a = false;  ///< it is that segment's end a
  bool at_b = false;
  bool ends_something = false;  ///< it agrees with an end, if only a hidden one's: what hides it was not a segment
};

/// A radial line that cuts a range segment.
struct SegmentCut {
  int segment = 0;
  int radial_line = 0;
  int first_point = 0;  ///< first point counter-clockwise of it
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
};

/// An end of a range segment as the camera should see it, and the radial line that it has seen there.
struct SegmentEndView {
  double azimuth = 0.0;  ///< from the camera
  double sigma = 0.0;
  int radial_line = -1;  ///< -1: the range finder's alone
};

/// The cooperation of camera and range finder (Clerentin et al., sec. 3.1).
struct Cooperation {
  std::vector<RadialLineUse> uses;                  ///< by radial line
  std::vector<std::array<SegmentEndView, 2>> ends;  ///< a and b, by range segment
  std::vector<SegmentCut> cuts;                     ///< by segment, then counter-clockwise
};

/// Three cases. A bearing that passes through a segment cuts it; an end that the range finder alone has seen is kept;
/// where both saw one end, the camera's bearing places it: the segment's `extent` is moved there. Bearings start at the
/// camera, which need not be where the range finder is.
/// \param result  cleared first, keeps its memory
void cooperate(std::span<const RadialLine> radial_lines, const Eigen::Vector2d& camera_origin,
               std::span<const sensors::ScanPoint> points, double beam_increment, const CooperationParams& params,
               std::span<RangeSegment> segments, Cooperation& result);

/// The camera's share in a segment's ends: 1 + the sum over its ends of 0 (range finder only), 1 (camera only), 2
/// (both).
[[nodiscard]] int endpoint_case(EndpointSource a, EndpointSource b);

}  // namespace credo::perception
