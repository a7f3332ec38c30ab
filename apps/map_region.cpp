// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/map_region.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "apps/option_checks.hpp"
#include "datasets/grid_file.hpp"
#include "results/map_folder.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

/// The cells of a region, those of its corners included.
grids::CellBox region_box(const grids::Georeference& georeference, const std::vector<double>& region) {
  const grids::CellIndex a = georeference.cell_at({region[0], region[1]});
  const grids::CellIndex b = georeference.cell_at({region[2], region[3]});
  const auto [low_x, high_x] = std::minmax(a.x, b.x);
  const auto [low_y, high_y] = std::minmax(a.y, b.y);
  return {{low_x, low_y}, high_x - low_x + 1, high_y - low_y + 1};
}

}  // namespace

void add_region_option(CLI::App& command, std::vector<double>& region) {
  command.add_option("--region", region, "X Y X Y of two corners: of a map.cgrid only the tiles that these touch [m]")
      ->expected(4)
      ->check(number_in(-1e6, 1e6));
}

grids::EvidentialGrid read_map_region(const std::string& source, const std::vector<double>& region) {
  const fs::path file = fs::is_directory(source) ? fs::path(source) / "map.cgrid" : fs::path(source);
  if (!fs::exists(source))
    throw std::runtime_error(source + ": is not there: expected a map.cgrid, or a folder with one");
  if (results::is_rule_map(source))
    throw std::runtime_error(source +
                             ": is a map by a rule, which is no sum and has no map.cgrid: expected one that was made "
                             "without --rule");
  if (file.extension() != ".cgrid" || !fs::exists(file))
    throw std::runtime_error(source + ": expected a map.cgrid, or a folder of credo map or credo run that holds one");
  const datasets::GridFile whole(file);
  return region.empty() ? whole.read() : whole.read(region_box(whole.georeference(), region));
}

grids::EvidentialGrid cut_out(const grids::EvidentialGrid& grid, const std::vector<double>& region) {
  const grids::CellBox box = region_box(grid.georeference(), region);
  grids::EvidentialGrid part(grid.georeference());
  for (const auto& [index, tile] : grid.tiles())
    for (int place = 0; place < grids::Tile::kCells; ++place) {
      const grids::CellIndex cell = grids::cell_of(index, place);
      const auto at = static_cast<std::size_t>(place);
      const evidence::FixedLogCommonality known{tile.empty[at], tile.occupied[at], tile.unknown[at]};
      if (box.contains(cell) && known != evidence::FixedLogCommonality{}) part.add(cell, known);
    }
  return part;
}

}  // namespace credo::apps
