// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// What the ends of segments are, and where: the second half of Segmenter.

#include <algorithm>
#include <cmath>
#include <limits>

#include "perception/segmentation.hpp"

namespace credo::perception {
namespace {

using geometry::LineEstimate;
using sensors::ScanPoint;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Variance of an end's place: the wall may end anywhere up to the next beam, and the last reading is noisy along the
/// line.
double end_variance(const ScanPoint& point, const LineEstimate& line, double spacing) {
  const double along = line.direction().dot(point.ray) * point.sigma_m;
  return spacing * spacing / 3.0 + along * along + variance_at(line, point.position);
}

}  // namespace

/// Nothing came back beside an end whose wall, had it gone on, would have been in easy reach.
bool Segmenter::open_beside(std::span<const float> ranges_m, const ScanPoint& end, const LineEstimate& line,
                            int step) const {
  if (std::abs(line.normal().dot(end.ray)) < params_.open_sine) return false;
  if (range_max_ > 0.0 && end.range_m > params_.open_reach * range_max_) return false;
  const int count = static_cast<int>(ranges_m.size());
  for (int k = 1; k <= params_.open_beams; ++k) {
    int beam = end.beam + (clockwise_ ? -k : k) * step;
    if (turn_ > 0 && (beam < 0 || beam >= count)) beam = (beam % turn_ + turn_) % turn_;
    if (beam < 0 || beam >= count || !std::isinf(ranges_m[static_cast<std::size_t>(beam)])) return false;
  }
  return true;
}

/// What is beside an end that meets no neighbour. `step`: +1 beyond end b, -1 beyond end a.
Segmenter::Beside Segmenter::end_beside(std::span<const float> ranges_m, const Points& points,
                                        const RangeSegment& segment, int end, int step) const {
  if (open_beside(ranges_m, points[end], segment.fit.line, step)) return {SegmentEnd::kOpen, 0.0};
  const int n = static_cast<int>(points.size());
  const auto at = [&](int k) { return turn_ > 0 ? (k % n + n) % n : k; };
  const auto link = [&](int a, int b) {
    return step > 0 ? connected(points[a], points[b]) : connected(points[b], points[a]);
  };
  int next = at(end + step);
  const int after = at(end + 2 * step);
  if (next < 0 || next >= n || next == end) return {};
  if (after >= 0 && after < n && after != end && !link(next, after)) next = after;  // a stray reading
  const int beams = step > 0 ? beams_between(points[end], points[next]) : beams_between(points[next], points[end]);
  if (beams > allowed_beams_ + 1) return {};
  // Where the beam would meet the continued line.
  const LineEstimate& line = segment.fit.line;
  const ScanPoint &last = points[end], &other = points[next];
  const double sine = line.normal().dot(other.ray);
  const double sine_last = line.normal().dot(last.ray);
  const double farthest = 2.0 * last.range_m;
  const double growth = sine * sine_last > 0.0 ? sine_last / sine : kUnbounded;
  const double expected = std::min(farthest, predicted_range(last, line) * growth);
  const double noise = std::sqrt(last.sigma_m * last.sigma_m + other.sigma_m * other.sigma_m);
  const double jump = (other.range_m - expected) / std::max(1e-6, noise);
  if (jump > params_.break_sigmas) return {SegmentEnd::kFree, jump};
  return {jump < -params_.break_sigmas ? SegmentEnd::kOccluded : SegmentEnd::kUnseen, jump};
}

void Segmenter::judge_ends(std::span<const float> ranges_m, const Points& points,
                           std::vector<RangeSegment>& segments) const {
  const std::size_t n = segments.size();
  for (std::size_t i = 0; i < n; ++i) {
    RangeSegment &s = segments[i], &t = segments[(i + 1) % n];
    const ScanPoint &end = points[s.last], &begin = points[t.first];
    const Eigen::Vector2d gap = t.extent.a - s.extent.b;
    s.gap_to_next_m = gap.norm();
    s.gap_to_next_sigmas = s.gap_to_next_m / std::sqrt(end_variance(end, s.fit.line, s.spacing_b) +
                                                       end_variance(begin, t.fit.line, t.spacing_a));
    const bool neighbours = n > 1 && (i + 1 < n || turn_ > 0);
    const bool near = beams_between(end, begin) <= allowed_beams_ + params_.bridged_outliers;
    if (!neighbours) s.gap_to_next_sigmas = s.gap_to_next_m = kUnbounded;
    if (neighbours && near && s.gap_to_next_sigmas <= params_.joined_sigmas) {
      s.end_b = t.end_a = SegmentEnd::kJoined;
      continue;
    }
    const Beside beyond = end_beside(ranges_m, points, s, s.last, +1);
    const Beside before = end_beside(ranges_m, points, t, t.first, -1);
    s.end_b = beyond.end;
    s.jump_b_sigmas = beyond.jump_sigmas;
    t.end_a = before.end;
    t.jump_a_sigmas = before.jump_sigmas;
  }
}

/// Ends at junctions are where the lines meet, free ends half a beam beyond the last reading.
void Segmenter::place_ends(std::vector<RangeSegment>& segments) const {
  const std::size_t n = segments.size();
  for (RangeSegment& s : segments) {
    const Eigen::Vector2d along = s.extent.direction();
    const auto free = [](SegmentEnd end) { return end == SegmentEnd::kFree || end == SegmentEnd::kOpen; };
    if (free(s.end_a)) s.extent.a -= 0.5 * std::min(s.spacing_a, params_.merge_gap_m) * along;
    if (free(s.end_b)) s.extent.b += 0.5 * std::min(s.spacing_b, params_.merge_gap_m) * along;
  }
  for (std::size_t i = 0; i < n; ++i) {
    RangeSegment &s = segments[i], &t = segments[(i + 1) % n];
    if (s.end_b != SegmentEnd::kJoined) continue;
    const Eigen::Vector2d middle = 0.5 * (s.extent.b + t.extent.a);
    const auto corner = intersect(s.fit.line, t.fit.line, params_.corner_sine);
    const double reach = s.gap_to_next_m + s.spacing_b + t.spacing_a;
    const bool meets = corner && (corner->position - middle).squaredNorm() <= reach * reach;
    const Eigen::Vector2d end_s = meets ? corner->position : s.fit.line.foot_of(middle);
    const Eigen::Vector2d end_t = meets ? corner->position : t.fit.line.foot_of(middle);
    // Never so far that a segment turns round.
    if ((end_s - s.extent.a).dot(s.extent.b - s.extent.a) > 0.0) s.extent.b = end_s;
    if ((t.extent.b - end_t).dot(t.extent.b - t.extent.a) > 0.0) t.extent.a = end_t;
  }
}

}  // namespace credo::perception
