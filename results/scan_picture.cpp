// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "results/ground_view.hpp"
#include "results/pictures.hpp"

namespace credo::results {
namespace {

using perception::EndpointSource;
using perception::Primitive;
using perception::PrimitiveType;
using Point = Canvas::Point;

/// The base frame turned so that the robot looks up.
Eigen::Vector2d heading_up(const Eigen::Vector2d& base) { return {-base.y(), base.x()}; }

double farthest(const perception::Scene& scene) {
  double reach = 1.0;
  std::vector<double> ranges;
  for (const sensors::ScanPoint& p : scene.points) ranges.push_back(p.position.norm());
  if (!ranges.empty()) {
    const auto most = ranges.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(ranges.size() - 1));
    std::nth_element(ranges.begin(), most, ranges.end());
    reach = std::max(reach, 1.08 * *most);
  }
  return reach;
}

/// Metres between the rings; of at most 20 rings.
double ring_step(double reach) {
  double step = reach > 12.0 ? 5.0 : reach > 5.0 ? 2.0 : 1.0;
  while (reach > 20.0 * step) step *= 10.0;
  return step;
}

void draw_rings(Canvas& canvas, const GroundView& view, double reach) {
  const double step = ring_step(reach);
  for (double r = step; r < 1.45 * reach; r += step) {
    canvas.circle(view.at({0, 0}), view.pixels(r), {226, 229, 234}, 0.8);
  }
}

/// On top of everything, to the lower right.
void label_rings(Canvas& canvas, const GroundView& view, double reach) {
  const double step = ring_step(reach);
  for (double r = step; r < reach; r += step) {
    char text[16];
    std::snprintf(text, sizeof text, "%g m", r);
    const Point at = view.at(r * Eigen::Vector2d(std::sqrt(0.5), -std::sqrt(0.5)));
    const double half = 0.5 * text_width(text, 7.5);
    canvas.box(at + Point(-half - 3.0, -8.0), at + Point(half + 3.0, 5.0), colors::kPaper, 0.8);
    canvas.text(at + Point(0.0, 3.0), text, colors::kMuted, 7.5, Anchor::kCentre);
  }
}

void draw_bearings(Canvas& canvas, const GroundView& view, const perception::Scene& scene, double reach) {
  for (const perception::RadialLine& line : scene.radial_lines) {
    const Eigen::Vector2d end =
        scene.camera_origin + 1.5 * reach * Eigen::Vector2d(std::cos(line.azimuth), std::sin(line.azimuth));
    canvas.line(view.at(heading_up(scene.camera_origin)), view.at(heading_up(end)), {219, 226, 236}, 0.8);
  }
}

void draw_segments(Canvas& canvas, const GroundView& view, const perception::Scene& scene) {
  for (const perception::FusedSegment& s : scene.segments) {
    canvas.line(view.at(heading_up(s.extent.a)), view.at(heading_up(s.extent.b)), color_of(s.existence), 3.4);
  }
  for (const perception::FusedSegment& s : scene.segments) {
    if (s.source_a != EndpointSource::kRangeFinder) canvas.disc(view.at(heading_up(s.extent.a)), 2.2, colors::kInk);
    if (s.source_b != EndpointSource::kRangeFinder) canvas.disc(view.at(heading_up(s.extent.b)), 2.2, colors::kInk);
  }
}

void draw_primitives(Canvas& canvas, const GroundView& view, const perception::Scene& scene) {
  for (const Primitive& p : scene.primitives) {
    if (p.bearing_only || p.type == PrimitiveType::kWall) continue;
    draw_mark(canvas, view.at(heading_up(p.position)), p.type, 5.0);
  }
}

}  // namespace

cv::Mat scan_picture(const perception::Scene& scene, double robot_radius_m) {
  constexpr int kSide = 860;
  constexpr double kHead = 34.0, kFoot = 50.0;
  Canvas canvas(kSide, kSide + static_cast<int>(kHead + kFoot));
  const double reach = farthest(scene);
  const GroundView view({-reach, -reach}, {reach, reach}, {0.0, kHead}, {kSide, kHead + kSide});
  canvas.clip({0.0, kHead}, {kSide, kHead + kSide});
  draw_bearings(canvas, view, scene, reach);
  draw_rings(canvas, view, reach);
  draw_segments(canvas, view, scene);
  for (const sensors::ScanPoint& p : scene.points) canvas.disc(view.at(heading_up(p.position)), 1.3, {70, 74, 82});
  label_rings(canvas, view, reach);
  draw_primitives(canvas, view, scene);
  draw_robot(canvas, view, {0.0, 0.0, 0.5 * std::numbers::pi}, robot_radius_m, colors::kInk);
  canvas.clip();
  char text[128];
  std::snprintf(text, sizeof text, "%zu points, %zu segments, mean conflict of the five criteria %.3f",
                scene.points.size(), scene.segments.size(), scene.mean_conflict);
  canvas.text({14.0, 22.0}, text, colors::kInk, 10.0, Anchor::kLeft, 1.2);
  const double y = kHead + kSide + 20.0;
  legend(canvas, {14.0, y},
         std::vector<LegendEntry>{{color_of(evidence::BinaryMass{1, 0, 0}), "segment: YES"},
                                  {color_of(evidence::BinaryMass{0, 0, 1}), "unknown"},
                                  {color_of(evidence::BinaryMass{0, 1, 0}), "NO"},
                                  {{219, 226, 236}, "radial line of the camera"}});
  const double x = legend(canvas, {14.0, y + 20.0},
                          std::vector<LegendEntry>{{color_of(PrimitiveType::kCorner), "corner"},
                                                   {color_of(PrimitiveType::kEdge), "edge"},
                                                   {color_of(PrimitiveType::kOther), "other"}});
  canvas.disc({x + 4.0, y + 16.0}, 2.2, colors::kInk);
  canvas.text({x + 12.0, y + 20.0}, "end sharpened by the camera", colors::kInk, 8.0);
  return canvas.finish();
}

}  // namespace credo::results
