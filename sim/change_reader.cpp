// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/change_reader.hpp"

#include <array>
#include <string>

#include "sim/building_reader.hpp"
#include "sim/rearrangement.hpp"

namespace credo::sim {
namespace {

constexpr std::size_t kMostChanges = 100;  // each is a world of its own, with its instruments
constexpr double kSoonest_s = 1e-3;
constexpr std::array kChangeKinds{"put", "take", "move", "door"};

std::string kind_of(YamlMap& map) {
  std::string kind;
  for (const char* candidate : kChangeKinds) {
    if (!map.has(candidate)) continue;
    if (!kind.empty()) map.fail(candidate, "a change is one of 'put', 'take', 'move' and 'door', not two");
    kind = candidate;
  }
  if (kind.empty()) map.fail("when", "a change needs one of the keys 'put', 'take', 'move' and 'door'");
  return kind;
}

void read_change(YamlMap& map, double when_s, World& world) {
  const std::string kind = kind_of(map);
  placed(map, kind, [&] {
    if (kind == "put") {
      const std::size_t first = world.panels.size();
      Builder builder(world);
      YamlMap box = map.map("put");
      read_box(box, world, builder);
      appear(world, when_s, first);
    } else if (kind == "take") {
      take_away(world, when_s, map.point("take"));
    } else if (kind == "move") {
      const Eigen::Vector2d by = map.has("by") ? map.point("by") : Eigen::Vector2d::Zero();
      shift(world, when_s, map.point("move"), by, map.number("turn", 0.0));
    } else {
      turn_leaf(world, when_s, map.point("door"), map.number("leaf"));
    }
  });
}

}  // namespace

void read_changes(std::vector<YamlMap> changes, World& world) {
  double before_s = kSoonest_s;
  for (YamlMap& map : changes) {
    if (world.changes.size() == kMostChanges) map.fail("when", "expected at most 100 changes");
    const double when_s = map.number("when");
    if (when_s < before_s) map.fail("when", "'when' must be after the start, and not before the change above");
    before_s = when_s;
    read_change(map, when_s, world);
    map.close();
  }
}

}  // namespace credo::sim
