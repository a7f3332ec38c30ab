// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/mass_map.hpp"

#include <stdexcept>
#include <string>

#include "grids/readout.hpp"

namespace credo::grids {
namespace {

evidence::GridMass read(const evidence::FixedLogCommonality& cell, ReadOut read_out) {
  switch (read_out) {
    case ReadOut::kDsmc: return evidence::masses(cell.value());
    case ReadOut::kDempster: return evidence::normalised_masses(cell.value());
    case ReadOut::kBayes: break;
  }
  const double occupied = evidence::plausibility_probability_occupied(cell.value());
  return {.empty = 1.0 - occupied, .occupied = occupied, .conflict = 0.0, .unknown = 0.0};
}

}  // namespace

MassMap vacuous_map(const Georeference& georeference, const CellBox& box) {
  const std::int64_t cells = std::int64_t{box.width} * box.height;
  if (!fits_a_picture(box))
    throw std::invalid_argument("a map of " + std::to_string(box.width) + " x " + std::to_string(box.height) +
                                " cells is too large to be read out as a whole: choose a coarser resolution");
  return {.georeference = georeference,
          .box = box,
          .masses = std::vector<evidence::GridMass>(static_cast<std::size_t>(cells)),
          .seen = std::vector<std::uint8_t>(static_cast<std::size_t>(cells), 0)};
}

MassMap mass_map(const EvidentialGrid& grid, ReadOut read_out) {
  MassMap map = vacuous_map(grid.georeference(), grid.bounding_box());
  for (int y = 0; y < map.box.height; ++y)
    for (int x = 0; x < map.box.width; ++x) {
      const CellIndex cell{map.box.min.x + x, map.box.min.y + y};
      const evidence::FixedLogCommonality content = grid.at(cell);
      if (content == evidence::FixedLogCommonality{}) continue;
      map.masses[map.place(cell)] = read(content, read_out);
      map.seen[map.place(cell)] = 1;
    }
  return map;
}

}  // namespace credo::grids
