// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "geometry/segment.hpp"

namespace credo::sim {
namespace {

constexpr double kAroundPanels_m = 0.2;  // of the grid around the panels
constexpr double kHalfDiagonal_m = 0.71 * FreeSpace::kCell_m;
constexpr double kComfortable_m = 0.55;  // nearer to a wall than this, a way costs more
constexpr double kCrowding = 6.0;        // how much more, per metre nearer

struct Neighbour {
  int dx, dy;
};
constexpr Neighbour kNeighbours[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

}  // namespace

FreeSpace::FreeSpace(const World& world, const Body& body, const Eigen::Vector2d& from)
    : radius_m_(body.radius_m), far_m_(std::max(kFar_m, body.radius_m + 2.0 * kHalfDiagonal_m)) {
  Eigen::Vector2d high = from;
  low_ = from;
  for (const Panel& panel : world.panels) {
    low_ = low_.cwiseMin(panel.a).cwiseMin(panel.b);
    high = high.cwiseMax(panel.a).cwiseMax(panel.b);
  }
  low_.array() -= kAroundPanels_m;
  width_ = static_cast<int>(std::ceil((high.x() + kAroundPanels_m - low_.x()) / kCell_m));
  height_ = static_cast<int>(std::ceil((high.y() + kAroundPanels_m - low_.y()) / kCell_m));
  const std::size_t cells = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  clearance_.assign(cells, static_cast<float>(far_m_));
  reached_.assign(cells, false);
  for (const Panel& panel : world.panels)
    if (panel.z0_m < body.height_m && panel.z1_m > 0.0) keep_off(panel);
  flood(cell_of(from));
}

void FreeSpace::keep_off(const Panel& panel) {
  const Eigen::Vector2d least = panel.a.cwiseMin(panel.b) - low_, most = panel.a.cwiseMax(panel.b) - low_;
  const auto cell = [](double v, int limit) { return std::clamp(static_cast<int>(v / kCell_m), 0, limit - 1); };
  for (int j = cell(least.y() - far_m_, height_); j <= cell(most.y() + far_m_, height_); ++j)
    for (int i = cell(least.x() - far_m_, width_); i <= cell(most.x() + far_m_, width_); ++i) {
      const int at = j * width_ + i;
      float& clearance = clearance_[static_cast<std::size_t>(at)];
      clearance = std::min(clearance, static_cast<float>(geometry::distance(centre_of(at), {panel.a, panel.b})));
    }
}

/// A reached cell is one anywhere in which the body touches nothing.
void FreeSpace::flood(int from) {
  std::vector<int> open{from};
  while (!open.empty()) {
    const int cell = open.back();
    open.pop_back();
    if (cell < 0) continue;
    const auto at = static_cast<std::size_t>(cell);
    if (reached_[at] || clearance_[at] < static_cast<float>(radius_m_ + kHalfDiagonal_m)) continue;
    reached_[at] = true;
    const int column = cell % width_, row = cell / width_;
    if (column > 0) open.push_back(cell - 1);
    if (column + 1 < width_) open.push_back(cell + 1);
    if (row > 0) open.push_back(cell - width_);
    if (row + 1 < height_) open.push_back(cell + width_);
  }
}

int FreeSpace::cell_of(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d p = (place - low_) / kCell_m;
  if (!(p.x() >= 0.0 && p.y() >= 0.0 && p.x() < width_ && p.y() < height_)) return -1;
  return static_cast<int>(p.y()) * width_ + static_cast<int>(p.x());
}

Eigen::Vector2d FreeSpace::centre_of(int cell) const {
  return low_ + kCell_m * Eigen::Vector2d(cell % width_ + 0.5, cell / width_ + 0.5);
}

bool FreeSpace::reaches(const Eigen::Vector2d& place) const {
  const int cell = cell_of(place);
  return cell >= 0 && reached_[static_cast<std::size_t>(cell)];
}

double FreeSpace::clearance(const Eigen::Vector2d& place) const {
  const int cell = cell_of(place);
  return cell < 0 ? 0.0 : static_cast<double>(clearance_[static_cast<std::size_t>(cell)]);
}

std::vector<Eigen::Vector2d> FreeSpace::places(double clearance_m) const {
  std::vector<Eigen::Vector2d> places;
  for (std::size_t cell = 0; cell < reached_.size(); ++cell)
    if (reached_[cell] && clearance_[cell] >= static_cast<float>(clearance_m))
      places.push_back(centre_of(static_cast<int>(cell)));
  return places;
}

bool FreeSpace::is_clear(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / (0.25 * kCell_m))));
  for (int i = 0; i <= steps; ++i)
    if (!reaches(from + (to - from) * (static_cast<double>(i) / steps))) return false;
  return true;
}

/// Dijkstra 1959 over the reached cells; the cells from `from` to the first goal, empty where there is no way.
std::vector<int> FreeSpace::cheapest_cells(int from, const std::vector<bool>& is_goal) const {
  std::vector<double> cost(clearance_.size(), std::numeric_limits<double>::infinity());
  std::vector<int> before(clearance_.size(), -1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[static_cast<std::size_t>(from)] = 0.0;
  open.emplace(0.0, from);
  int goal = -1;
  while (!open.empty()) {
    const auto [so_far, cell] = open.top();
    open.pop();
    if (is_goal[static_cast<std::size_t>(cell)]) {
      goal = cell;
      break;
    }
    if (so_far > cost[static_cast<std::size_t>(cell)]) continue;
    const int column = cell % width_, row = cell / width_;
    for (const Neighbour& step : kNeighbours) {
      if (column + step.dx < 0 || column + step.dx >= width_ || row + step.dy < 0 || row + step.dy >= height_) continue;
      const int next = cell + step.dy * width_ + step.dx;
      const auto at = static_cast<std::size_t>(next);
      if (!reached_[at]) continue;
      const double crowding = std::max(0.0, kComfortable_m - static_cast<double>(clearance_[at]));
      const double reached_at = so_far + kCell_m * std::hypot(step.dx, step.dy) * (1.0 + kCrowding * crowding);
      if (reached_at >= cost[at]) continue;
      cost[at] = reached_at;
      before[at] = cell;
      open.emplace(reached_at, next);
    }
  }
  std::vector<int> cells;
  for (int cell = goal; cell >= 0; cell = before[static_cast<std::size_t>(cell)]) cells.push_back(cell);
  std::reverse(cells.begin(), cells.end());
  return cells;
}

/// From each corner straight on to the farthest place in sight.
std::vector<Eigen::Vector2d> FreeSpace::straightened(const Eigen::Vector2d& from, const std::vector<int>& cells,
                                                     const Eigen::Vector2d& to) const {
  std::vector<Eigen::Vector2d> way{from};
  for (std::size_t i = 1; i + 1 < cells.size(); ++i) way.push_back(centre_of(cells[i]));
  way.push_back(to);
  std::vector<Eigen::Vector2d> legs{from};
  for (std::size_t at = 0; at + 1 < way.size();) {
    std::size_t next = at + 1;
    while (next + 1 < way.size() && is_clear(way[at], way[next + 1])) ++next;
    legs.push_back(way[next]);
    at = next;
  }
  return legs;
}

std::optional<FreeSpace::Goal> FreeSpace::nearest(const Eigen::Vector2d& from,
                                                  const std::vector<Eigen::Vector2d>& places) const {
  if (!reaches(from)) return std::nullopt;
  std::vector<bool> is_goal(reached_.size(), false);
  for (const Eigen::Vector2d& place : places)
    if (reaches(place)) is_goal[static_cast<std::size_t>(cell_of(place))] = true;
  const std::vector<int> cells = cheapest_cells(cell_of(from), is_goal);
  if (cells.empty()) return std::nullopt;
  const auto place =
      std::find_if(places.begin(), places.end(), [&](const Eigen::Vector2d& p) { return cell_of(p) == cells.back(); });
  return Goal{static_cast<std::size_t>(place - places.begin()), straightened(from, cells, *place)};
}

std::vector<Eigen::Vector2d> FreeSpace::route(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const std::optional<Goal> goal = nearest(from, {to});
  return goal ? goal->way : std::vector<Eigen::Vector2d>{};
}

}  // namespace credo::sim
