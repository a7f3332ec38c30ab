// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/segment.hpp"

namespace credo::sim {
namespace {

constexpr double kCell_m = 0.5;
constexpr double kSeam = 1e-9;
constexpr double kTooClose_m = 1e-6;

}  // namespace

RayCaster::RayCaster(const World& world, double height_m) : world_(&world) {
  Eigen::Vector2d high(0.0, 0.0);
  for (std::size_t i = 0; i < world.panels.size(); ++i) {
    const Panel& panel = world.panels[i];
    if (height_m < panel.z0_m || height_m > panel.z1_m) continue;
    if (panels_.empty()) low_ = high = panel.a;
    low_ = low_.cwiseMin(panel.a).cwiseMin(panel.b);
    high = high.cwiseMax(panel.a).cwiseMax(panel.b);
    panels_.push_back(static_cast<int>(i));
  }
  low_.array() -= 0.01;
  width_ = static_cast<int>((high.x() - low_.x()) / kCell_m) + 1;
  height_ = static_cast<int>((high.y() - low_.y()) / kCell_m) + 1;
  fill_cells();
}

/// Every panel into every cell that its bounding box and its line touch.
void RayCaster::fill_cells() {
  std::vector<std::vector<int>> cells(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (const int index : panels_) {
    const Panel& panel = world_->panels[static_cast<std::size_t>(index)];
    const Eigen::Vector2d e = panel.b - panel.a, least = panel.a.cwiseMin(panel.b), most = panel.a.cwiseMax(panel.b);
    const auto cell = [](double v) { return static_cast<int>(std::floor(v / kCell_m)); };
    for (int j = std::max(0, cell(least.y() - low_.y() - 1e-6));
         j <= std::min(height_ - 1, cell(most.y() - low_.y() + 1e-6)); ++j)
      for (int i = std::max(0, cell(least.x() - low_.x() - 1e-6));
           i <= std::min(width_ - 1, cell(most.x() - low_.x() + 1e-6)); ++i) {
        const Eigen::Vector2d centre = low_ + kCell_m * Eigen::Vector2d(i + 0.5, j + 0.5);
        const double reach = 0.5 * kCell_m * (std::abs(e.x()) + std::abs(e.y())) + 1e-6;
        if (std::abs(geometry::cross(e, centre - panel.a)) <= reach)
          cells[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i)].push_back(
              index);
      }
  }
  cell_start_.push_back(0);
  for (const std::vector<int>& cell : cells) {
    cell_panels_.insert(cell_panels_.end(), cell.begin(), cell.end());
    cell_start_.push_back(static_cast<int>(cell_panels_.size()));
  }
}

bool RayCaster::meets(int index, const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double& range,
                      double& cos_incidence) const {
  const Panel& panel = world_->panels[static_cast<std::size_t>(index)];
  const Eigen::Vector2d e = panel.b - panel.a, to_a = panel.a - origin;
  const double determinant = geometry::cross(direction, e);
  if (determinant == 0.0) return false;
  const double t = geometry::cross(to_a, e) / determinant, s = geometry::cross(to_a, direction) / determinant;
  if (t <= kTooClose_m || t >= range || s < -kSeam || s > 1.0 + kSeam) return false;
  range = t;
  cos_incidence = std::abs(determinant) / e.norm();
  return true;
}

/// Walks the grid cell by cell (Amanatides and Woo 1987).
std::optional<RayHit> RayCaster::cast(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                      double max_range_m, int ignore) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d start = (origin - low_) / kCell_m;
  const int cells[2] = {width_, height_};
  double enter = 0.0, leave = max_range_m / kCell_m;
  for (int k = 0; k < 2; ++k) {
    if (direction[k] == 0.0) {
      if (start[k] < 0.0 || start[k] > cells[k]) return std::nullopt;
      continue;
    }
    const double t0 = -start[k] / direction[k], t1 = (cells[k] - start[k]) / direction[k];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  if (enter > leave) return std::nullopt;
  int at[2], step[2];
  double next[2], every[2];
  for (int k = 0; k < 2; ++k) {
    at[k] = std::clamp(static_cast<int>(std::floor(start[k] + enter * direction[k])), 0, cells[k] - 1);
    step[k] = direction[k] > 0.0 ? 1 : -1;
    every[k] = direction[k] == 0.0 ? kFar : std::abs(1.0 / direction[k]);
    next[k] = direction[k] == 0.0 ? kFar : (at[k] + (step[k] > 0 ? 1 : 0) - start[k]) / direction[k];
  }
  double range = max_range_m;
  RayHit hit{max_range_m, -1, 1.0};
  while (enter * kCell_m < range && at[0] >= 0 && at[1] >= 0 && at[0] < width_ && at[1] < height_) {
    const int cell = at[1] * width_ + at[0];
    for (int i = cell_start_[cell]; i < cell_start_[cell + 1]; ++i) {
      const int panel = cell_panels_[static_cast<std::size_t>(i)];
      if (panel != ignore && meets(panel, origin, direction, range, hit.cos_incidence)) hit.panel = panel;
    }
    const int k = next[0] < next[1] ? 0 : 1;
    enter = next[k];
    next[k] += every[k];
    at[k] += step[k];
  }
  if (hit.panel < 0) return std::nullopt;
  hit.range_m = range;
  return hit;
}

}  // namespace credo::sim
