// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

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

constexpr double kLabel = 7.5;  // height of the rings' labels

struct RingLabel {
  std::string text;
  Point at;  ///< of its middle
  [[nodiscard]] Point half_size() const { return {0.5 * text_width(text, kLabel) + 4.0, 7.0}; }
};

std::vector<RingLabel> ring_labels(const GroundView& view, double reach, double direction) {
  std::vector<RingLabel> labels;
  const double step = ring_step(reach);
  for (double r = step; r < reach; r += step) {
    char text[16];
    std::snprintf(text, sizeof text, "%g m", r);
    labels.push_back({text, view.at(r * Eigen::Vector2d(std::cos(direction), std::sin(direction)))});
  }
  return labels;
}

/// What the scan shows, as dots close to each other.
std::vector<Point> dots_of(const GroundView& view, const perception::Scene& scene) {
  constexpr double kSpacing_px = 5.0;
  std::vector<Point> dots;
  for (const sensors::ScanPoint& p : scene.points) dots.push_back(view.at(heading_up(p.position)));
  for (const perception::FusedSegment& s : scene.segments) {
    const Point a = view.at(heading_up(s.extent.a)), b = view.at(heading_up(s.extent.b));
    const int count = std::clamp(static_cast<int>((b - a).norm() / kSpacing_px), 1, 1000);
    for (int i = 0; i <= count; ++i) dots.push_back(a + i * (b - a) / count);
  }
  return dots;
}

/// In the direction in which they hide least, the lower right before others.
void label_rings(Canvas& canvas, const GroundView& view, const perception::Scene& scene, double reach) {
  constexpr int kDirections = 24;
  const std::vector<Point> dots = dots_of(view, scene);
  std::vector<RingLabel> best;
  std::ptrdiff_t least = std::numeric_limits<std::ptrdiff_t>::max();
  for (int k = 0; k < kDirections && least > 0; ++k) {
    const auto labels = ring_labels(view, reach, -0.25 * std::numbers::pi + 2.0 * std::numbers::pi * k / kDirections);
    std::ptrdiff_t hidden = 0;
    for (const RingLabel& label : labels) {
      const Point half = label.half_size() + Point(4.0, 4.0);
      hidden += std::count_if(dots.begin(), dots.end(), [&](const Point& dot) {
        return ((dot - label.at).cwiseAbs().array() < half.array()).all();
      });
    }
    if (hidden >= least) continue;
    least = hidden;
    best = labels;
  }
  for (const RingLabel& label : best) {
    canvas.box(label.at - label.half_size(), label.at + label.half_size(), colors::kPaper, 0.8);
    canvas.text(label.at + Point(0.0, 3.5), label.text, colors::kMuted, kLabel, Anchor::kCentre);
  }
}

void draw_bearings(Canvas& canvas, const GroundView& view, const perception::Scene& scene, double reach) {
  for (const perception::RadialLine& line : scene.radial_lines) {
    const Eigen::Vector2d end =
        scene.camera_origin + 1.5 * reach * Eigen::Vector2d(std::cos(line.azimuth), std::sin(line.azimuth));
    canvas.line(view.at(heading_up(scene.camera_origin)), view.at(heading_up(end)), {219, 226, 236}, 0.8);
  }
}

void draw_point(Canvas& canvas, const Point& at) { canvas.disc(at, 1.3, {70, 74, 82}); }

/// A ring around the end, wide enough to be seen around a mark.
void draw_sharpened(Canvas& canvas, const Point& at) { canvas.circle(at, 8.0, colors::kInk, 1.2); }

void draw_segments(Canvas& canvas, const GroundView& view, const perception::Scene& scene) {
  for (const perception::FusedSegment& s : scene.segments) {
    canvas.line(view.at(heading_up(s.extent.a)), view.at(heading_up(s.extent.b)), color_of(s.existence), 3.4);
  }
  for (const perception::FusedSegment& s : scene.segments) {
    if (s.source_a != EndpointSource::kRangeFinder) draw_sharpened(canvas, view.at(heading_up(s.extent.a)));
    if (s.source_b != EndpointSource::kRangeFinder) draw_sharpened(canvas, view.at(heading_up(s.extent.b)));
  }
}

void draw_primitives(Canvas& canvas, const GroundView& view, const perception::Scene& scene) {
  for (const Primitive& p : scene.primitives) {
    if (p.bearing_only || p.type == PrimitiveType::kWall) continue;
    draw_mark(canvas, view.at(heading_up(p.position)), p.type, 5.0);
  }
}

std::string title_of(const perception::Scene& scene) {
  if (scene.points.empty()) return "no scan at this moment, or one without any range";
  char text[128];
  std::snprintf(text, sizeof text, "%zu points, %zu segments, mean conflict of the five criteria %.3f",
                scene.points.size(), scene.segments.size(), scene.mean_conflict);
  return text;
}

void draw_legend(Canvas& canvas, double y) {
  legend(canvas, {14.0, y},
         std::vector<LegendEntry>{{color_of(evidence::BinaryMass{1, 0, 0}), "segment: YES"},
                                  {color_of(evidence::BinaryMass{0, 0, 1}), "unknown"},
                                  {color_of(evidence::BinaryMass{0, 1, 0}), "NO"},
                                  {{219, 226, 236}, "radial line of the camera"}});
  const double below = y + 20.0;
  double x = legend(canvas, {14.0, below},
                    std::vector<LegendEntry>{{color_of(PrimitiveType::kCorner), "corner"},
                                             {color_of(PrimitiveType::kEdge), "edge"},
                                             {color_of(PrimitiveType::kOther), "other"}});
  draw_point(canvas, {x + 4.0, below - 4.0});
  canvas.text({x + 12.0, below}, "range point", colors::kInk, 8.0);
  x += 12.0 + text_width("range point", 8.0) + 22.0;
  draw_sharpened(canvas, {x + 4.0, below - 4.0});
  canvas.text({x + 18.0, below}, "end sharpened by the camera", colors::kInk, 8.0);
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
  label_rings(canvas, view, scene, reach);
  draw_segments(canvas, view, scene);
  for (const sensors::ScanPoint& p : scene.points) draw_point(canvas, view.at(heading_up(p.position)));
  draw_primitives(canvas, view, scene);
  draw_robot(canvas, view, {0.0, 0.0, 0.5 * std::numbers::pi}, robot_radius_m, colors::kInk);
  canvas.clip();
  canvas.text({14.0, 22.0}, title_of(scene), colors::kInk, 10.0, Anchor::kLeft, 1.2);
  draw_legend(canvas, kHead + kSide + 20.0);
  return canvas.finish();
}

}  // namespace credo::results
