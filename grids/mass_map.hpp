// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <vector>

#include "evidence/grid_mass.hpp"
#include "grids/cell_grid.hpp"
#include "grids/evidential_grid.hpp"

namespace credo::grids {

/// What a map of any rule says of a rectangle of cells, row after row from the lowest: to be looked at and scored.
struct MassMap {
  Georeference georeference;
  CellBox box;
  std::vector<evidence::GridMass> masses;  ///< vacuous where nothing was seen
  std::vector<std::uint8_t> seen;

  [[nodiscard]] std::size_t place(CellIndex cell) const {
    return static_cast<std::size_t>(cell.y - box.min.y) * static_cast<std::size_t>(box.width) +
           static_cast<std::size_t>(cell.x - box.min.x);
  }
  [[nodiscard]] bool saw(CellIndex cell) const { return box.contains(cell) && seen[place(cell)] != 0; }
  [[nodiscard]] evidence::GridMass at(CellIndex cell) const {
    return box.contains(cell) ? masses[place(cell)] : evidence::GridMass::vacuous();
  }
};

/// How a cell of log-commonalities is read: the rules that are the same sum.
enum class ReadOut {
  kDsmc,      ///< with the mass of the conflict; TBM's masses, too
  kDempster,  ///< the conflict divided out
  kBayes      ///< Bayesian masses: the plausibility transform, a log-odds filter's probability
};

/// \throws std::invalid_argument if the map holds more cells than kLargestPicture
[[nodiscard]] MassMap mass_map(const EvidentialGrid& grid, ReadOut read_out);

/// An empty map of a rectangle. \throws std::invalid_argument if it holds more cells than kLargestPicture
[[nodiscard]] MassMap vacuous_map(const Georeference& georeference, const CellBox& box);

/// \param masses  of a cell
template <typename Cell, typename Masses>
[[nodiscard]] MassMap mass_map(const CellGrid<Cell>& grid, Masses masses) {
  CellBox box;
  grid.for_each([&](CellIndex cell, const Cell&) { box = box.united({cell, 1, 1}); });
  MassMap map = vacuous_map(grid.georeference(), box);
  grid.for_each([&](CellIndex cell, const Cell& content) {
    map.masses[map.place(cell)] = masses(content);
    map.seen[map.place(cell)] = 1;
  });
  return map;
}

}  // namespace credo::grids
