// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/readout.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace credo::grids {
namespace {

using evidence::FixedLogCommonality;
using evidence::LogCommonality;

void require_picture(const CellBox& box) {
  if (!fits_a_picture(box))
    throw std::invalid_argument(
        "the map is " + std::to_string(box.width) + " x " + std::to_string(box.height) + " cells, more than the " +
        std::to_string(kLargestPicture) +
        " of the largest picture: choose a coarser resolution, or look for a pose that is far off");
}

double value(const LogCommonality& cell, Layer which) {
  switch (which) {
    case Layer::kEmpty: return evidence::normalised_masses(cell).empty;
    case Layer::kOccupied: return evidence::normalised_masses(cell).occupied;
    case Layer::kUnknown: return evidence::normalised_masses(cell).unknown;
    case Layer::kContested: return evidence::contested(cell);
    case Layer::kPlausibilityOccupied: return 1.0 - evidence::normalised_masses(cell).empty;
    case Layer::kDsmpOccupied:
      return evidence::dsmp(evidence::normalised_masses(cell), evidence::GridElement::kOccupied,
                            evidence::GridModel::kExclusive, kDsmpEpsilon);
    case Layer::kProbabilityOccupied: return evidence::pignistic_occupied(cell);
    case Layer::kRawEmpty: return evidence::masses(cell).empty;
    case Layer::kRawOccupied: return evidence::masses(cell).occupied;
    case Layer::kRawConflict: return evidence::masses(cell).conflict;
    case Layer::kRawUnknown: return evidence::masses(cell).unknown;
  }
  return 0.0;
}

/// Fills a rectangle with what `read` makes of each cell; cells of absent tiles get what it makes of the vacuous one.
template <typename Value, typename Read>
std::vector<Value> fill(const EvidentialGrid& grid, const CellBox& box, Read read) {
  if (box.empty()) return {};
  require_picture(box);
  std::vector<Value> values(static_cast<std::size_t>(box.width) * box.height, read(FixedLogCommonality{}));
  for (const auto& [index, tile] : grid.tiles()) {
    const CellIndex corner{index.x * Tile::kSide, index.y * Tile::kSide};
    const int x_begin = std::max(0, box.min.x - corner.x),
              x_end = std::min(Tile::kSide, box.min.x + box.width - corner.x);
    const int y_begin = std::max(0, box.min.y - corner.y),
              y_end = std::min(Tile::kSide, box.min.y + box.height - corner.y);
    for (int y = y_begin; y < y_end; ++y) {
      for (int x = x_begin; x < x_end; ++x) {
        const int i = y * Tile::kSide + x;
        const std::size_t place =
            static_cast<std::size_t>(corner.y + y - box.min.y) * box.width + (corner.x + x - box.min.x);
        values[place] = read(FixedLogCommonality{tile.empty[i], tile.occupied[i], tile.unknown[i]});
      }
    }
  }
  return values;
}

}  // namespace

CellBox picture_box(const EvidentialGrid& grid) {
  const CellBox box = grid.bounding_box();
  if (box.empty()) return {{0, 0}, 1, 1};
  require_picture(box);
  return box;
}

CellState decide(const FixedLogCommonality& cell, const DecisionParams& params) {
  const LogCommonality value = cell.value();
  const evidence::GridMass mass = evidence::normalised_masses(value);
  if (mass.unknown > params.unknown_above) return CellState::kUnknown;
  if (evidence::contested(value) >= params.contested_from) return CellState::kContested;
  const double occupied = mass.occupied + 0.5 * mass.unknown;  // pignistic
  if (occupied >= params.occupied_from) return CellState::kOccupied;
  if (occupied <= params.empty_until) return CellState::kEmpty;
  // Between the two: both are supported, or neither enough.
  return evidence::contested(value) >= params.contested_between ? CellState::kContested : CellState::kUnknown;
}

std::vector<float> layer(const EvidentialGrid& grid, const CellBox& box, Layer which) {
  return fill<float>(
      grid, box, [which](const FixedLogCommonality& cell) { return static_cast<float>(value(cell.value(), which)); });
}

std::vector<CellState> decisions(const EvidentialGrid& grid, const CellBox& box, const DecisionParams& params) {
  return fill<CellState>(grid, box, [&params](const FixedLogCommonality& cell) { return decide(cell, params); });
}

const char* to_string(CellState state) {
  switch (state) {
    case CellState::kUnknown: return "unknown";
    case CellState::kEmpty: return "empty";
    case CellState::kOccupied: return "occupied";
    case CellState::kContested: return "contested";
  }
  return "?";
}

}  // namespace credo::grids
