// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "results/canvas.hpp"
#include "results/pictures.hpp"

namespace credo::results {
namespace {

using perception::Primitive;
using perception::PrimitiveType;
using Point = Canvas::Point;
constexpr Color kUnclaimed{235, 235, 235};  // a radial line that belongs to no primitive

/// Where directions of the base frame lie on the canvas.
struct Placement {
  const sensors::OmniCamera& camera;
  double scale = 1.0;
  Point origin;

  [[nodiscard]] Point at(double azimuth_base, double radius_px) const {
    const Eigen::Vector2d pixel =
        camera.center_px + radius_px * camera.image_direction(azimuth_base - camera.T_base_camera.theta);
    return origin + scale * (pixel + Eigen::Vector2d(0.5, 0.5));
  }
};

/// The primitive of each radial line; walls last, as a line in a wall belongs to what it marks.
std::vector<const Primitive*> owners(const perception::Scene& scene) {
  std::vector<const Primitive*> result(scene.radial_lines.size(), nullptr);
  for (const Primitive& p : scene.primitives) {
    if (p.radial_line < 0 || p.radial_line >= static_cast<int>(result.size())) continue;
    const Primitive*& owner = result[static_cast<std::size_t>(p.radial_line)];
    if (owner == nullptr || owner->type == PrimitiveType::kWall) owner = &p;
  }
  return result;
}

double bearing_from_camera(const perception::Scene& scene, const Eigen::Vector2d& point) {
  const Eigen::Vector2d ray = point - scene.camera_origin;
  return std::atan2(ray.y(), ray.x());
}

/// Walls as arcs around the annulus, in the colour of their belief.
void draw_walls(Canvas& canvas, const Placement& place, const perception::Scene& scene, double radius) {
  for (const Primitive& p : scene.primitives) {
    if (p.type != PrimitiveType::kWall || p.bearing_only) continue;
    const double from = bearing_from_camera(scene, p.extent.a);
    const double turn = geometry::angle_difference(bearing_from_camera(scene, p.extent.b), from);
    const int steps = std::max(2, static_cast<int>(std::abs(turn) * 40.0));
    std::vector<Point> arc;
    for (int i = 0; i <= steps; ++i) arc.push_back(place.at(from + turn * i / steps, radius));
    canvas.polyline(arc, color_of(p.existence), 4.5);
  }
}

void draw_lines(Canvas& canvas, const Placement& place, const perception::Scene& scene) {
  const auto owner = owners(scene);
  for (std::size_t i = 0; i < scene.radial_lines.size(); ++i) {
    const perception::RadialLine& line = scene.radial_lines[i];
    const Color color = owner[i] == nullptr ? kUnclaimed : color_of(owner[i]->type);
    const double inner = place.camera.inner_radius_px, outer = place.camera.outer_radius_px;
    canvas.line(place.at(line.azimuth, inner), place.at(line.azimuth, outer), color, 1.2);
    canvas.disc(place.at(line.azimuth, outer), 2.6, color);
  }
}

/// Primitives that no radial line carries: a short tick outside of the annulus.
void draw_range_only(Canvas& canvas, const Placement& place, const perception::Scene& scene) {
  for (const Primitive& p : scene.primitives) {
    if (p.type == PrimitiveType::kWall || p.radial_line >= 0 || p.bearing_only) continue;
    const double azimuth = bearing_from_camera(scene, p.position), outer = place.camera.outer_radius_px;
    canvas.line(place.at(azimuth, outer - 14.0), place.at(azimuth, outer), color_of(p.type), 2.6);
  }
}

void draw_foot(Canvas& canvas, const perception::Scene& scene, double y) {
  const double x = legend(canvas, {14.0, y},
                          std::vector<LegendEntry>{{color_of(PrimitiveType::kCorner), "corner"},
                                                   {color_of(PrimitiveType::kEdge), "edge"},
                                                   {color_of(PrimitiveType::kOther), "other"},
                                                   {kUnclaimed, "line without primitive"}});
  canvas.text({x + 6.0, y}, "walls around, by belief:", colors::kInk, 8.0);
  legend(canvas, {x + 6.0 + text_width("walls around, by belief:", 8.0) + 12.0, y},
         std::vector<LegendEntry>{{color_of(evidence::BinaryMass{1, 0, 0}), "YES"},
                                  {color_of(evidence::BinaryMass{0, 0, 1}), "unknown"},
                                  {color_of(evidence::BinaryMass{0, 1, 0}), "NO"}});
  char text[96];
  std::snprintf(text, sizeof text, "%zu radial lines, %zu primitives", scene.radial_lines.size(),
                scene.primitives.size());
  canvas.text({14.0, 22.0}, text, colors::kInk, 10.0, Anchor::kLeft, 1.2);
}

}  // namespace

cv::Mat omni_picture(const sensors::OmniImage& image, const sensors::OmniCamera& camera,
                     const perception::Scene& scene) {
  constexpr double kHead = 34.0, kFoot = 30.0, kSide = 880.0;
  // The square around the mirror; beyond it there is nothing to see.
  const double rim = std::max(camera.rim_radius_px.value_or(0.0), camera.outer_radius_px), reach = rim + 12.0;
  const double scale = kSide / (2.0 * reach);
  Canvas canvas(static_cast<int>(kSide), static_cast<int>(kSide + kHead + kFoot));
  const Point origin = Point(0.5 * kSide, kHead + 0.5 * kSide) - scale * (camera.center_px + Point(0.5, 0.5));
  const Placement place{camera, scale, origin};
  canvas.clip({0.0, kHead}, {kSide, kHead + kSide});
  canvas.box({0.0, kHead}, {kSide, kHead + kSide}, {0, 0, 0});
  canvas.image(image.pixels, origin, origin + scale * Point(camera.width_px, camera.height_px), false);
  draw_walls(canvas, place, scene, rim + 5.0);
  draw_lines(canvas, place, scene);
  draw_range_only(canvas, place, scene);
  canvas.clip();
  draw_foot(canvas, scene, kHead + kSide + 19.0);
  return canvas.finish();
}

}  // namespace credo::results
