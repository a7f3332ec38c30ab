// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/world.hpp"

namespace credo::sim {

enum class BuildingKind {
  kCorridor,      ///< rooms on both sides of a corridor
  kOffices,       ///< the same, smaller, with doors from room to room
  kHall,          ///< pillars and furniture, rooms on one side
  kTwoHalls,      ///< joined by a wide opening
  kLShape,        ///< a corridor that turns
  kTShape,        ///< a corridor that branches
  kModules,       ///< ambiguous: the same room again and again along a corridor
  kSymmetricRoom  ///< ambiguous: turned by half a turn it looks the same
};

struct RandomWorldParams {
  std::optional<BuildingKind> kind = std::nullopt;  ///< else drawn among those that are not ambiguous
  /// Else drawn among opensimple, rplidar-a1 and lds-neato, which are sold.
  std::optional<std::string> range_preset = std::nullopt;
  std::optional<Drive::Mode> mode = std::nullopt;  ///< else drawn
  double shortest_way_m = 10.0;                    ///< the length of the drive is drawn between these
  double longest_way_m = 25.0;
};

/// A building of 8 to 25 m with doors, windows, posters and furniture, some of it unmapped, a robot with a camera, a
/// range finder and odometry, and a way through several rooms that it can drive: the same for the same seed.
/// \throws std::invalid_argument  for an unknown range finder, or ways that no building has room for
[[nodiscard]] World random_world(std::uint64_t seed, const RandomWorldParams& params = {});

/// "corridor", "offices", ...
[[nodiscard]] std::string_view name_of(BuildingKind kind);
/// \throws std::invalid_argument  with the known names
[[nodiscard]] BuildingKind building_kind(std::string_view name);
[[nodiscard]] const std::vector<BuildingKind>& building_kinds();

}  // namespace credo::sim
