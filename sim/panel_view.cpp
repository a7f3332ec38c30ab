// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/panel_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace credo::sim {
namespace {

constexpr int kBins = 1024;
constexpr double kBinWidth = 2.0 * std::numbers::pi / kBins;
constexpr float kOverlap = 1e-4F;    // panels overlap by this share at their ends: no light through the seams [m]
constexpr float kNearest_m = 0.02F;  // a panel through the camera is not drawn
constexpr float kDirectedLight = 0.35F;

struct Directions {
  std::array<float, kBins> x, y;
};

/// Directions of the lower boundaries of the bins.
Directions bin_directions() {
  Directions directions{};
  for (std::size_t i = 0; i < kBins; ++i) {
    directions.x[i] = static_cast<float>(std::cos(static_cast<double>(i) * kBinWidth));
    directions.y[i] = static_cast<float>(std::sin(static_cast<double>(i) * kBinWidth));
  }
  return directions;
}

float cross(float ax, float ay, float bx, float by) { return ax * by - ay * bx; }

bool under_a_lamp(const CeilingLamps& lamps, double x, double y) {
  if (lamps.spacing_m <= 0.0) return false;
  const auto beside = [&](double v) { return std::abs(v - lamps.spacing_m * std::floor(v / lamps.spacing_m + 0.5)); };
  return beside(x) < 0.5 * lamps.length_m && beside(y) < 0.5 * lamps.width_m;
}

float floor_albedo(const World& world, double x, double y) {
  const float albedo = static_cast<float>(world.floor_albedo);
  if (world.floor_tile_m <= 0.0) return albedo;
  const auto tile = static_cast<std::int64_t>(std::floor(x / world.floor_tile_m) + std::floor(y / world.floor_tile_m));
  return tile % 2 == 0 ? albedo : 0.8F * albedo;
}

}  // namespace

std::uint16_t PanelView::bin_of(double azimuth) {
  const double turns = azimuth / (2.0 * std::numbers::pi);
  return static_cast<std::uint16_t>(std::min(static_cast<int>((turns - std::floor(turns)) * kBins), kBins - 1));
}

void PanelView::look_from(const geometry::Pose2& T_map_camera, double height_m, std::span<const Panel> passing) {
  x_ = static_cast<float>(T_map_camera.x);
  y_ = static_cast<float>(T_map_camera.y);
  cos_ = static_cast<float>(std::cos(T_map_camera.theta));
  sin_ = static_cast<float>(std::sin(T_map_camera.theta));
  height_ = static_cast<float>(height_m);
  placed_.clear();
  entries_.clear();
  const geometry::Pose2 T_camera_map = T_map_camera.inverse();
  for (const Panel& panel : world_->panels) place(panel, T_camera_map);
  for (const Panel& panel : passing) place(panel, T_camera_map);
  sort_bins();
}

void PanelView::place(const Panel& panel, const geometry::Pose2& T_camera_map) {
  const int index = static_cast<int>(placed_.size());
  const Eigen::Vector2f a = (T_camera_map * panel.a).cast<float>();
  const Eigen::Vector2f e = (T_camera_map.rotation() * (panel.b - panel.a)).cast<float>();
  const bool full = panel.z0_m <= 0.0 && panel.z1_m >= world_->ceiling_m;
  placed_.push_back({a.x(), a.y(), e.x(), e.y(), static_cast<float>(panel.z0_m), static_cast<float>(panel.z1_m),
                     e.norm(), facing_light(panel.b - panel.a, world_->light_rad), index, panel.material, full});
  enter(index);
}

/// Finds the bins, widened by the slack on either side, in which a panel can be met, and between which distances.
void PanelView::enter(int placed) {
  static const Directions directions = bin_directions();
  const Placed& p = placed_[static_cast<std::size_t>(placed)];
  const float twist = cross(p.ax, p.ay, p.ex, p.ey);  // distance of the panel's line times its length
  if (std::abs(twist) < 1e-6F * p.length) return;
  double from = std::atan2(p.ay, p.ax), to = std::atan2(p.ay + p.ey, p.ax + p.ex);
  float near_from = std::hypot(p.ax, p.ay), near_to = std::hypot(p.ax + p.ex, p.ay + p.ey);
  if (twist < 0.0F) {
    std::swap(from, to);
    std::swap(near_from, near_to);
  }
  if (to < from) to += 2.0 * std::numbers::pi;
  const auto distance = [&](int bin) {
    const auto k = static_cast<std::size_t>(((bin % kBins) + kBins) % kBins);
    return twist / cross(directions.x[k], directions.y[k], p.ex, p.ey);
  };
  const int slack = static_cast<int>(std::ceil(kSlack_rad / kBinWidth));
  const int first = static_cast<int>(std::floor(from / kBinWidth)) - slack;
  const int last = static_cast<int>(std::floor(to / kBinWidth)) + slack;
  for (int bin = first; bin <= std::min(last, first + kBins - 1); ++bin) {
    const int low = bin - slack, high = bin + 1 + slack;
    const bool low_inside = low * kBinWidth >= from, high_inside = high * kBinWidth <= to;
    const float at_low = low_inside ? distance(low) : near_from;
    const float at_high = high_inside ? distance(high) : near_to;
    entries_.push_back({((bin % kBins) + kBins) % kBins, placed, 0.99F * std::min(at_low, at_high) - 0.01F,
                        1.01F * std::max(at_low, at_high) + 0.01F, low_inside && high_inside && p.full_height});
  }
}

/// Bins in a row, each nearest first, without what lies behind a wall that covers the whole bin.
void PanelView::sort_bins() {
  bin_start_.assign(kBins + 1, 0);
  std::array<float, kBins> wall{};
  wall.fill(std::numeric_limits<float>::infinity());
  for (const Entry& entry : entries_)
    if (float& nearest = wall[static_cast<std::size_t>(entry.bin)]; entry.covers)
      nearest = std::min(nearest, entry.farthest);
  const auto hidden = [&](const Entry& entry) { return entry.nearest > wall[static_cast<std::size_t>(entry.bin)]; };
  std::erase_if(entries_, hidden);
  for (const Entry& entry : entries_) ++bin_start_[static_cast<std::size_t>(entry.bin) + 1];
  for (std::size_t bin = 0; bin < kBins; ++bin) bin_start_[bin + 1] += bin_start_[bin];
  sorted_.resize(entries_.size());
  std::vector<int>& next = bin_start_;
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry)
    sorted_[static_cast<std::size_t>(--next[static_cast<std::size_t>(entry->bin) + 1])] = *entry;
  // Filling from the back moved the start of every bin one place to the right in `bin_start_`.
  for (std::size_t bin = 0; bin < kBins; ++bin) bin_start_[bin] = bin_start_[bin + 1];
  bin_start_[kBins] = static_cast<int>(entries_.size());
  for (std::size_t bin = 0; bin < kBins; ++bin)
    std::sort(sorted_.begin() + bin_start_[bin], sorted_.begin() + bin_start_[bin + 1],
              [](const Entry& a, const Entry& b) {
                return a.nearest != b.nearest ? a.nearest < b.nearest : a.placed < b.placed;
              });
}

SurfaceHit PanelView::trace(std::uint16_t bin, const float origin[3], const float direction[3]) const {
  SurfaceHit hit;
  const float z = height_ + origin[2];
  if (direction[2] != 0.0F) {
    const bool up = direction[2] > 0.0F;
    hit.panel = up ? SurfaceHit::kCeiling : SurfaceHit::kFloor;
    hit.t = ((up ? static_cast<float>(world_->ceiling_m) : 0.0F) - z) / direction[2];
  }
  const float length = std::sqrt(direction[0] * direction[0] + direction[1] * direction[1]);
  const Entry* entry = sorted_.data() + bin_start_[bin];
  const Entry* const end = sorted_.data() + bin_start_[bin + 1U];
  for (; entry != end && entry->nearest < hit.t * length; ++entry) {
    const Placed& p = placed_[static_cast<std::size_t>(entry->placed)];
    const float ax = p.ax - origin[0], ay = p.ay - origin[1];
    const float determinant = cross(direction[0], direction[1], p.ex, p.ey);
    const float t = cross(ax, ay, p.ex, p.ey) / determinant;
    if (!(t * length > kNearest_m) || t >= hit.t) continue;
    const float along = cross(ax, ay, direction[0], direction[1]) / determinant * p.length;
    if (along < -kOverlap || along > p.length + kOverlap) continue;
    const float height = z + t * direction[2];
    if (height < p.z0 || height > p.z1) continue;
    hit = {p.panel, t, std::clamp(along, 0.0F, p.length), height};
  }
  return hit;
}

float PanelView::radiance(const SurfaceHit& hit, const LightMap& light, const float origin[3],
                          const float direction[3]) const {
  if (hit.panel == SurfaceHit::kNothing) return 0.0F;
  const float forward = origin[0] + hit.t * direction[0], left = origin[1] + hit.t * direction[1];
  const float x = x_ + cos_ * forward - sin_ * left, y = y_ + sin_ * forward + cos_ * left;
  const float brightness = light.at(x, y);
  if (hit.panel == SurfaceHit::kCeiling)
    return under_a_lamp(world_->lamps, x, y) ? static_cast<float>(world_->lamps.emission) : 0.62F * brightness;
  if (hit.panel == SurfaceHit::kFloor) return 0.6F * floor_albedo(*world_, x, y) * brightness;
  const Placed& p = placed_[static_cast<std::size_t>(hit.panel)];
  const Material& material = world_->materials[static_cast<std::size_t>(p.material)];
  // A pixel is as wide as the ray's direction is long for its radius: t wide at the hit, and wider on a slanting wall.
  const float slant = std::abs(cross(direction[0], direction[1], p.ex, p.ey));
  const float length = std::sqrt(direction[0] * direction[0] + direction[1] * direction[1]);
  const float footprint = hit.t * length * p.length / std::max(slant, 1e-6F);
  const float albedo =
      albedo_at(material, hit.panel, hit.along_m, hit.z_m, footprint, static_cast<float>(world_->skirting_m));
  const float shade = 0.5F + kDirectedLight * p.facing + 0.2F * hit.z_m / static_cast<float>(world_->ceiling_m);
  return albedo * shade * brightness + static_cast<float>(material.emission);
}

}  // namespace credo::sim
