// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/mass_map_files.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace credo::results {
namespace {

using datasets::OccupancyMap;

/// Pignistic, the conflict divided out; nothing where more than `unknown_above` is ignorance, or all is conflict.
std::optional<double> probability(const evidence::GridMass& mass, const grids::DecisionParams& params) {
  const auto normal = evidence::without_conflict(mass);
  if (!normal || normal->unknown > params.unknown_above) return std::nullopt;
  return normal->occupied + 0.5 * normal->unknown;
}

std::int8_t called(const evidence::GridMass& mass, const grids::DecisionParams& params) {
  const std::optional<double> occupied = probability(mass, params);
  if (!occupied) return OccupancyMap::kUnknown;
  if (*occupied >= params.occupied_from) return OccupancyMap::kOccupied;
  return *occupied <= params.empty_until ? OccupancyMap::kFree : OccupancyMap::kUnknown;
}

std::int8_t percent(const evidence::GridMass& mass, const grids::DecisionParams& params) {
  const std::optional<double> occupied = probability(mass, params);
  return occupied ? static_cast<std::int8_t>(std::lround(100.0 * *occupied)) : OccupancyMap::kUnknown;
}

template <typename ValueOf>
OccupancyMap map_of(const grids::MassMap& map, const ValueOf& value_of) {
  const grids::Georeference& reference = map.georeference;
  OccupancyMap occupancy{.width = std::max(1, map.box.width),
                         .height = std::max(1, map.box.height),
                         .resolution_m = reference.resolution_m,
                         .origin_x_m = reference.origin_x_m + map.box.min.x * reference.resolution_m,
                         .origin_y_m = reference.origin_y_m + map.box.min.y * reference.resolution_m,
                         .cells = {OccupancyMap::kUnknown}};
  if (map.masses.empty()) return occupancy;
  occupancy.cells.clear();
  for (const evidence::GridMass& mass : map.masses) occupancy.cells.push_back(value_of(mass));
  return occupancy;
}

}  // namespace

OccupancyMap to_occupancy(const grids::MassMap& map, const grids::DecisionParams& params) {
  return map_of(map, [&](const evidence::GridMass& mass) { return called(mass, params); });
}

OccupancyMap to_probabilities(const grids::MassMap& map, const grids::DecisionParams& params) {
  return map_of(map, [&](const evidence::GridMass& mass) { return percent(mass, params); });
}

BeliefImage belief_image(const grids::MassMap& map) {
  BeliefImage image{std::max(1, map.box.width), std::max(1, map.box.height), {{0.0F, 0.0F, 0.0F, 1.0F}}};
  if (map.masses.empty()) return image;
  image.pixels.clear();
  for (int row = map.box.height - 1; row >= 0; --row)
    for (int column = 0; column < map.box.width; ++column) {
      const evidence::GridMass mass = map.at({map.box.min.x + column, map.box.min.y + row});
      image.pixels.push_back({static_cast<float>(mass.empty), static_cast<float>(mass.occupied),
                              static_cast<float>(mass.conflict), static_cast<float>(mass.unknown)});
    }
  return image;
}

}  // namespace credo::results
