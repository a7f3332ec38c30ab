// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/cooperation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/angles.hpp"
#include "geometry/segment.hpp"

namespace credo::perception {
namespace {

double azimuth_of(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }

/// The true end lies within a beam of where the range finder places it; its line's error counts where it is seen
/// sideways.
SegmentEndView view_of_end(const RangeSegment& segment, const Eigen::Vector2d& end, const Eigen::Vector2d& origin,
                           double increment) {
  const Eigen::Vector2d offset = end - origin;
  const double range = std::max(1e-3, offset.norm());
  const Eigen::Vector2d sideways = Eigen::Vector2d(-offset.y(), offset.x()) / range;
  const double by_line =
      sideways.dot(segment.fit.line.normal()) * std::sqrt(variance_at(segment.fit.line, end)) / range;
  return {.azimuth = azimuth_of(offset), .sigma = std::sqrt(by_line * by_line + increment * increment / 12.0)};
}

/// Difference of a radial line to an end's bearing, as a share of what is agreement.
double miss(const RadialLine& line, const SegmentEndView& end, const CooperationParams& params) {
  const double difference = std::abs(geometry::angle_difference(line.azimuth, end.azimuth));
  if (params.agree_rad > 0.0) return difference / params.agree_rad;
  return difference / (params.agree_sigmas * std::sqrt(line.sigma * line.sigma + end.sigma * end.sigma));
}

/// Each end takes the radial line that is closest to it, if it agrees.
void claim_ends(std::span<const RadialLine> radial_lines, const CooperationParams& params,
                std::array<SegmentEndView, 2>& ends) {
  for (SegmentEndView& end : ends) {
    double least = 1.0;
    for (std::size_t l = 0; l < radial_lines.size(); ++l) {
      const double share = miss(radial_lines[l], end, params);
      if (share > least) continue;
      least = share;
      end.radial_line = static_cast<int>(l);
    }
  }
}

/// Where both saw one end, the camera's bearing places it.
void move_end(const RadialLine& line, const Eigen::Vector2d& origin, double min_sine, bool at_b,
              RangeSegment& segment) {
  const auto point = intersect_ray(segment.fit.line, origin, line.azimuth, line.sigma, min_sine);
  if (!point) return;
  const geometry::Segment moved = at_b ? geometry::Segment{segment.extent.a, point->position}
                                       : geometry::Segment{point->position, segment.extent.b};
  if ((moved.b - moved.a).dot(segment.extent.b - segment.extent.a) > 0.0) segment.extent = moved;
}

/// The nearest segment that a bearing passes through.
struct Passage {
  int segment = -1;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
};

Passage pass(const RadialLine& line, const Eigen::Vector2d& origin, double min_sine,
             std::span<const RangeSegment> segments) {
  const Eigen::Vector2d ray(std::cos(line.azimuth), std::sin(line.azimuth));
  Passage nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const geometry::Segment& extent = segments[s].extent;
    const double side_a = geometry::cross(ray, extent.a - origin), side_b = geometry::cross(ray, extent.b - origin);
    if (side_a >= 0.0 || side_b <= 0.0) continue;  // a lies clockwise of the bearing, b counter-clockwise
    const Eigen::Vector2d position = extent.a + (side_a / (side_a - side_b)) * (extent.b - extent.a);
    const double range = ray.dot(position - origin);
    if (range <= 0.0 || range >= least) continue;
    if (side_b - side_a < min_sine * extent.length()) continue;
    least = range;
    nearest = {static_cast<int>(s), position};
  }
  return nearest;
}

int first_point_beyond(std::span<const sensors::ScanPoint> points, const RangeSegment& segment,
                       const Eigen::Vector2d& origin, double azimuth) {
  const Eigen::Vector2d ray(std::cos(azimuth), std::sin(azimuth));
  int k = segment.first;
  while (k <= segment.last && geometry::cross(ray, points[static_cast<std::size_t>(k)].position - origin) <= 0.0) ++k;
  return k;
}

}  // namespace

int endpoint_case(EndpointSource a, EndpointSource b) {
  const auto share = [](EndpointSource source) {
    return source == EndpointSource::kBoth ? 2 : source == EndpointSource::kCamera ? 1 : 0;
  };
  return 1 + share(a) + share(b);
}

void cooperate(std::span<const RadialLine> radial_lines, const Eigen::Vector2d& camera_origin,
               std::span<const sensors::ScanPoint> points, double beam_increment, const CooperationParams& params,
               std::span<RangeSegment> segments, Cooperation& result) {
  result.uses.assign(radial_lines.size(), {});
  result.ends.resize(segments.size());
  result.cuts.clear();
  // Both: the bearing places the end. An end that is only hidden belongs to what hides it.
  for (std::size_t s = 0; s < segments.size(); ++s) {
    RangeSegment& segment = segments[s];
    result.ends[s] = {view_of_end(segment, segment.extent.a, camera_origin, beam_increment),
                      view_of_end(segment, segment.extent.b, camera_origin, beam_increment)};
    claim_ends(radial_lines, params, result.ends[s]);
    for (const bool at_b : {false, true}) {
      const int l = result.ends[s][at_b].radial_line;
      if (l < 0) continue;
      move_end(radial_lines[static_cast<std::size_t>(l)], camera_origin, params.min_sine, at_b, segment);
      RadialLineUse& use = result.uses[static_cast<std::size_t>(l)];
      const bool hidden = (at_b ? segment.end_b : segment.end_a) == SegmentEnd::kOccluded;
      use.ends_something = true;
      if (!hidden && use.segment < 0) use = {static_cast<int>(s), !at_b, at_b, true};
    }
  }
  // The camera alone: the bearing cuts the segment.
  for (std::size_t l = 0; l < radial_lines.size(); ++l) {
    if (result.uses[l].ends_something) continue;
    const Passage passage = pass(radial_lines[l], camera_origin, params.min_sine, segments);
    if (passage.segment < 0) continue;
    result.uses[l].segment = passage.segment;
    result.cuts.push_back(
        {.segment = passage.segment,
         .radial_line = static_cast<int>(l),
         .first_point = first_point_beyond(points, segments[static_cast<std::size_t>(passage.segment)], camera_origin,
                                           radial_lines[l].azimuth),
         .position = passage.position});
  }
  std::sort(result.cuts.begin(), result.cuts.end(), [&](const SegmentCut& x, const SegmentCut& y) {
    if (x.segment != y.segment) return x.segment < y.segment;
    const Eigen::Vector2d& a = segments[static_cast<std::size_t>(x.segment)].extent.a;
    const double along_x = (x.position - a).squaredNorm(), along_y = (y.position - a).squaredNorm();
    return along_x != along_y ? along_x < along_y : x.radial_line < y.radial_line;
  });
}

}  // namespace credo::perception
