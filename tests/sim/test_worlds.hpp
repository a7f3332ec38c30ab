// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <string>

#include "sim/building.hpp"
#include "sim/presets.hpp"
#include "sim/world.hpp"

namespace credo::sim {

inline int material_index(const World& world, const std::string& name) {
  for (std::size_t i = 0; i < world.materials.size(); ++i)
    if (world.materials[i].name == name) return static_cast<int>(i);
  return -1;
}

/// A square room of 8 m around the origin, an ideal camera of 640 x 480 in it, nothing else.
inline World ideal_room() {
  World world;
  world.name = "room";
  world.materials = common_materials();
  world.lamps.spacing_m = 0.0;
  world.path = {{{0.0, 0.0}, false}, {{1.0, 0.0}, false}};
  Builder(world).add_walls({{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, true, "plain", true);
  world.camera = camera_preset("conic-640");
  world.camera->struts_rad.clear();
  world.nuisances = {.noise_grey = 0.0,
                     .read_noise_grey = 0.0,
                     .pixel_gain = 0.0,
                     .blur_px = 0.0,
                     .center_px = 0.0,
                     .tilt_rad = 0.0,
                     .mounting_m = 0.0,
                     .mounting_rad = 0.0,
                     .dust = 0,
                     .glare = 0.0};
  return world;
}

/// The file of a world that is shipped.
inline std::string shipped(const std::string& name) { return CREDO_SOURCE_DIR "/sim/worlds/" + name + ".yaml"; }

}  // namespace credo::sim
