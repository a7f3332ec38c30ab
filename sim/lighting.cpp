// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/lighting.hpp"

#include <algorithm>
#include <cmath>

#include "sim/random.hpp"

namespace credo::sim {
namespace {

constexpr double kLightCell_m = 0.25;
constexpr double kShelfBoard_m = 0.34;
constexpr double kWindowReach_m = 1.5;
constexpr double kWindowGain = 0.8;

double lamp_light(const CeilingLamps& lamps, double x, double y) {
  if (lamps.spacing_m <= 0.0) return 0.5;
  double light = 0.0;
  const double i0 = std::round(x / lamps.spacing_m), j0 = std::round(y / lamps.spacing_m);
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j) {
      const double dx = x - (i0 + i) * lamps.spacing_m, dy = y - (j0 + j) * lamps.spacing_m;
      light += 1.0 / (1.0 + (dx * dx + dy * dy) / 1.7);
    }
  return 0.5 * light * (lamps.spacing_m * lamps.spacing_m) / 14.0;
}

double window_light(const World& world, double x, double y) {
  double light = 0.0;
  for (const Panel& panel : world.panels) {
    if (world.materials[static_cast<std::size_t>(panel.material)].emission <= 0.0) continue;
    const double distance = (0.5 * (panel.a + panel.b) - Eigen::Vector2d(x, y)).norm() / kWindowReach_m;
    light += kWindowGain * std::min(1.0, (panel.b - panel.a).norm()) / (1.0 + distance * distance) * 0.5;
  }
  return light;
}

}  // namespace

LightMap::LightMap(const World& world) {
  Eigen::Vector2d low(0.0, 0.0), high(1.0, 1.0);
  if (!world.panels.empty()) low = high = world.panels.front().a;
  for (const Panel& panel : world.panels) {
    low = low.cwiseMin(panel.a).cwiseMin(panel.b);
    high = high.cwiseMax(panel.a).cwiseMax(panel.b);
  }
  origin_ = low.cast<float>();
  width_ = static_cast<int>((high.x() - low.x()) / kLightCell_m) + 2;
  height_ = static_cast<int>((high.y() - low.y()) / kLightCell_m) + 2;
  values_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int row = 0; row < height_; ++row)
    for (int column = 0; column < width_; ++column) {
      const double x = low.x() + column * kLightCell_m, y = low.y() + row * kLightCell_m;
      values_.push_back(static_cast<float>(0.5 + lamp_light(world.lamps, x, y) + window_light(world, x, y)));
    }
}

float LightMap::at(float x, float y) const {
  const float u =
      std::clamp((x - origin_.x()) * static_cast<float>(1.0 / kLightCell_m), 0.0F, static_cast<float>(width_ - 1));
  const float v =
      std::clamp((y - origin_.y()) * static_cast<float>(1.0 / kLightCell_m), 0.0F, static_cast<float>(height_ - 1));
  const int i = std::min(static_cast<int>(u), width_ - 2), j = std::min(static_cast<int>(v), height_ - 2);
  const float fu = u - static_cast<float>(i), fv = v - static_cast<float>(j);
  const float* row = values_.data() + j * width_ + i;
  const float* next = row + width_;
  return (row[0] * (1.0F - fu) + row[1] * fu) * (1.0F - fv) + (next[0] * (1.0F - fu) + next[1] * fu) * fv;
}

float albedo_at(const Material& material, int surface, float along, float z, float footprint_m, float skirting_m) {
  float albedo = static_cast<float>(material.albedo);
  if (material.skirting && z < skirting_m) albedo *= 0.6F;
  if (material.pattern == Pattern::kPlain) return albedo;
  const bool stripes = material.pattern == Pattern::kStripes;
  const float cell = static_cast<float>(stripes ? 0.5 * material.period_m : material.period_m);
  const auto index = static_cast<std::uint64_t>(along / cell);
  float dark = static_cast<float>(index % 2);
  if (!stripes) {
    const auto board = static_cast<std::uint64_t>(z / static_cast<float>(kShelfBoard_m));
    dark =
        static_cast<float>(mix_bits(index * 977 + board * 31 + static_cast<std::uint64_t>(surface) * 65537 + 1) >> 40) *
        0x1p-24F;
  }
  const float sharp = std::clamp(1.5F - footprint_m / cell, 0.0F, 1.0F);
  return albedo * (1.0F - static_cast<float>(material.contrast) * (0.5F + sharp * (dark - 0.5F)));
}

std::vector<double> pattern_edges(const Material& material, double length_m) {
  std::vector<double> edges;
  if (material.pattern == Pattern::kPlain) return edges;
  const double step = material.pattern == Pattern::kStripes ? 0.5 * material.period_m : material.period_m;
  for (int i = 1; i * step < length_m; ++i) edges.push_back(i * step);
  return edges;
}

float facing_light(const Eigen::Vector2d& along, double light_rad) {
  const Eigen::Vector2d direction = along.normalized();
  return static_cast<float>(std::abs(-direction.y() * std::cos(light_rad) + direction.x() * std::sin(light_rad)));
}

}  // namespace credo::sim
