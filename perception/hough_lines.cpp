// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/hough_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace credo::perception {
namespace {

using Eigen::Vector2d;
using sensors::ScanPoint;

/// Votes for the lines x cos(angle) + y sin(angle) = offset, angle in [0, pi).
class Accumulator {
 public:
  Accumulator(std::span<const ScanPoint> points, const HoughLineParams& params) : params_(params) {
    double farthest = 0.0;
    for (const ScanPoint& point : points) farthest = std::max(farthest, point.position.norm());
    middle_ = static_cast<int>(std::ceil(farthest / params.offset_step_m));
    const int angles = std::max(1, static_cast<int>(std::lround(std::numbers::pi / params.angle_step_rad)));
    for (int a = 0; a < angles; ++a) {
      const double angle = a * std::numbers::pi / angles;
      normals_.emplace_back(std::cos(angle), std::sin(angle));
    }
    votes_.assign(normals_.size() * static_cast<std::size_t>(2 * middle_ + 1), 0);
    for (const ScanPoint& point : points) vote(point, 1);
  }

  void vote(const ScanPoint& point, int votes) {
    for (std::size_t a = 0; a < normals_.size(); ++a) votes_[slot(a, normals_[a].dot(point.position))] += votes;
  }

  struct Peak {
    Vector2d normal;
    double offset_m = 0.0;
    int votes = 0;
  };
  /// The first one of those with most votes.
  [[nodiscard]] Peak highest() const {
    const auto most = std::max_element(votes_.begin(), votes_.end());
    const auto slot = static_cast<std::size_t>(most - votes_.begin()),
               offsets = static_cast<std::size_t>(2 * middle_ + 1);
    return {normals_[slot / offsets], (static_cast<int>(slot % offsets) - middle_) * params_.offset_step_m, *most};
  }

 private:
  [[nodiscard]] std::size_t slot(std::size_t angle, double offset) const {
    const int bin = static_cast<int>(std::lround(offset / params_.offset_step_m)) + middle_;
    return angle * static_cast<std::size_t>(2 * middle_ + 1) + static_cast<std::size_t>(bin);
  }

  HoughLineParams params_;
  int middle_ = 0;  ///< the bin of offset 0
  std::vector<Vector2d> normals_;
  std::vector<int> votes_;  ///< by angle, then offset
};

/// The longest run, by points, of those near a line without a gap between neighbours along it; counter-clockwise.
std::vector<std::size_t> longest_run(std::span<const ScanPoint> points, const std::vector<bool>& used,
                                     const Accumulator::Peak& peak, const HoughLineParams& params) {
  const Vector2d along(-peak.normal.y(), peak.normal.x());
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!used[i] && std::abs(peak.normal.dot(points[i].position) - peak.offset_m) <= params.offset_step_m)
      near.push_back(i);
  std::stable_sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) {
    return along.dot(points[a].position) < along.dot(points[b].position);
  });
  std::size_t best = 0, best_size = 0, begin = 0;
  for (std::size_t i = 1; i <= near.size(); ++i) {
    if (i < near.size() && along.dot(points[near[i]].position - points[near[i - 1]].position) <= params.gap_m) continue;
    if (i - begin > best_size) {
      best = begin;
      best_size = i - begin;
    }
    begin = i;
  }
  std::vector<std::size_t> run(near.begin() + static_cast<std::ptrdiff_t>(best),
                               near.begin() + static_cast<std::ptrdiff_t>(best + best_size));
  // Counter-clockwise, as seen from the robot, the line runs along its direction where the robot is on its left.
  if (peak.offset_m > 0.0) return run;
  std::reverse(run.begin(), run.end());
  return run;
}

}  // namespace

std::vector<ScanLine> hough_lines(std::span<const ScanPoint> points, const PointNoise& noise,
                                  const HoughLineParams& params) {
  if (!(params.angle_step_rad > 0.0) || !(params.offset_step_m > 0.0))
    throw std::invalid_argument("hough lines: found steps of " + std::to_string(params.angle_step_rad) + " rad and " +
                                std::to_string(params.offset_step_m) + " m, expected positive ones");
  std::vector<ScanLine> lines;
  std::vector<bool> used(points.size(), false);
  Accumulator accumulator(points, params);
  for (int tries = 0; tries < params.most_lines; ++tries) {
    const Accumulator::Peak peak = accumulator.highest();
    if (peak.votes < params.min_support) break;
    const std::vector<std::size_t> run = longest_run(points, used, peak, params);
    if (run.empty()) break;
    std::vector<ScanPoint> on_line;
    for (const std::size_t i : run) {
      on_line.push_back(points[i]);
      used[i] = true;
      accumulator.vote(points[i], -1);
    }
    const LineFit fit = fit_line(on_line, noise);
    if (fit.support < params.min_support) continue;
    ScanLine& line = lines.emplace_back();
    line.extent = {fit.line.foot_of(on_line.front().position), fit.line.foot_of(on_line.back().position)};
    line.line = directed_along(fit.line, line.extent);
    line.support = fit.support;
  }
  return lines;
}

}  // namespace credo::perception
