// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>

#include "sim/omni_renderer.hpp"

namespace credo::sim {
namespace {

constexpr double kBeside_rad = 0.0017;  // how far to either side of an edge its contrast is taken
constexpr double kOne_rad = 0.0026;     // edges closer than this are one
constexpr double kLeastShare = 0.05;

/// A vertical line of the world.
struct Line {
  Eigen::Vector2d foot;
  double z0, z1;
};

std::vector<Line> vertical_lines(const World& world, std::span<const Panel> passing) {
  std::vector<Line> lines;
  const auto add = [&](const Panel& panel) {
    const double length = (panel.b - panel.a).norm();
    const Eigen::Vector2d along = (panel.b - panel.a) / length;
    lines.push_back({panel.a, panel.z0_m, panel.z1_m});
    lines.push_back({panel.b, panel.z0_m, panel.z1_m});
    for (const double s : pattern_edges(world.materials[static_cast<std::size_t>(panel.material)], length))
      lines.push_back({panel.a + s * along, panel.z0_m, panel.z1_m});
  };
  std::for_each(world.panels.begin(), world.panels.end(), add);
  std::for_each(passing.begin(), passing.end(), add);
  return lines;
}

/// Keeps the stronger of edges that nobody can tell apart. By azimuth.
void merge_close(std::vector<TrueVertical>& edges) {
  std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.azimuth_rad < b.azimuth_rad; });
  std::vector<TrueVertical> kept;
  for (const TrueVertical& edge : edges) {
    const auto strength = [](const TrueVertical& e) { return e.visible_share * e.contrast; };
    if (kept.empty() || edge.azimuth_rad - kept.back().azimuth_rad > kOne_rad)
      kept.push_back(edge);
    else if (strength(edge) > strength(kept.back()))
      kept.back() = edge;
  }
  edges = std::move(kept);
}

}  // namespace

std::vector<TrueVertical> OmniRenderer::true_verticals(const geometry::Pose2& T_map_base, Workspace& workspace,
                                                       std::span<const Panel> passing) const {
  const sensors::OmniCamera& camera = setup_->camera;
  PanelView& view = workspace.view;
  const geometry::Pose2 T_map_camera = T_map_base * T_base_camera_;
  view.look_from(T_map_camera, camera.height_m, passing);
  const geometry::Pose2 T_camera_map = T_map_camera.inverse();
  const double step = (camera.outer_radius_px - camera.inner_radius_px) / kRows;
  // The grey levels seen at an azimuth on a circle of the image, and how far away.
  const auto look = [&](double azimuth, double radius, float& range) {
    const double slope = optics_.tan_elevation(radius);
    const float origin[3] = {0.0F, 0.0F, static_cast<float>(optics_.viewpoint_radius() * slope)};
    const float direction[3] = {static_cast<float>(radius * std::cos(azimuth)),
                                static_cast<float>(radius * std::sin(azimuth)), static_cast<float>(radius * slope)};
    const SurfaceHit hit = view.trace(PanelView::bin_of(azimuth), origin, direction);
    range = hit.t * static_cast<float>(radius);
    return std::min(255.0,
                    world_->exposure_gain * fall_off(camera, radius) * view.radiance(hit, light_, origin, direction));
  };
  std::vector<TrueVertical> edges;
  for (const Line& line : vertical_lines(*world_, passing)) {
    const Eigen::Vector2d foot = T_camera_map * line.foot;
    const double range = foot.norm(), azimuth = std::atan2(foot.y(), foot.x());
    const Eigen::Vector2d bar = camera.image_direction(azimuth);
    int rows = 0;
    double contrast = 0.0;
    for (int row = 0; row < kRows; ++row) {
      const double radius = camera.inner_radius_px + (row + 0.5) * step;
      const double z = camera.height_m + (range + optics_.viewpoint_radius()) * optics_.tan_elevation(radius);
      if (z < line.z0 || z > line.z1 || strut_transmission(*setup_, radius * bar) < 0.5) continue;
      float left = 0.0F, right = 0.0F;
      const double difference = look(azimuth + kBeside_rad, radius, left) - look(azimuth - kBeside_rad, radius, right);
      if (std::min(left, right) < 0.95 * range - 0.02 || std::min(left, right) > 1.05 * range + 0.02) continue;
      if (std::abs(difference) < kFaintest_grey) continue;
      ++rows;
      contrast += std::abs(difference);
    }
    if (rows >= kLeastShare * kRows) edges.push_back({azimuth, static_cast<double>(rows) / kRows, contrast / rows});
  }
  merge_close(edges);
  return edges;
}

}  // namespace credo::sim
