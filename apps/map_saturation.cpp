// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/map_saturation.hpp"

#include <fmt/format.h>

#include "apps/terminal.hpp"

namespace credo::apps {

void warn_of_saturation(const grids::EvidentialGrid& grid) {
  const std::vector<grids::TileIndex> tiles = grid.saturated_tiles();
  if (tiles.empty()) return;
  const grids::Georeference& georeference = grid.georeference();
  const double side = grids::Tile::kSide * georeference.resolution_m;
  say_warning(
      fmt::format("{} of {} tiles of the map have a cell that has reached the end of its range and takes in no more, "
                  "the first at {:.1f} {:.1f} m: lower the reliability of the sensors, or map the drive in parts",
                  tiles.size(), grid.tiles().size(), georeference.origin_x_m + side * tiles.front().x,
                  georeference.origin_y_m + side * tiles.front().y));
}

}  // namespace credo::apps
