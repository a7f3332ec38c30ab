// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <vector>

#include "grids/evidential_grid.hpp"

namespace credo::grids {

enum class CellState { kUnknown, kEmpty, kOccupied, kContested };

/// When a cell is called what. Probabilities are pignistic.
struct DecisionParams {
  double unknown_above = 0.5;   ///< more ignorance than this: unknown
  double occupied_from = 0.65;  ///< probability of "occupied" from which a cell is occupied (that of map_server)
  double empty_until = 0.196;   ///< probability of "occupied" up to which a cell is empty (that of map_server)
  double contested_from = 0.8;  ///< from this balance of evidence for and against: contested, whatever the probability;
  double contested_between = 0.5;  ///< from this one where it is neither empty nor occupied; below, it is unknown
};

/// What to call a cell. The read-outs themselves are those of evidence::LogCommonality.
[[nodiscard]] CellState decide(const evidence::FixedLogCommonality& cell, const DecisionParams& params = {});

/// What one number per cell can be asked for.
enum class Layer {
  kEmpty,                ///< mass after Dempster's normalisation
  kOccupied,             ///< mass after Dempster's normalisation
  kUnknown,              ///< mass after Dempster's normalisation
  kContested,            ///< balance of evidence for and against
  kProbabilityOccupied,  ///< pignistic
  kRawEmpty,             ///< unnormalised masses
  kRawOccupied,
  kRawConflict,
  kRawUnknown,
};

/// The most cells that a picture may have: a square of 400 m with cells of 5 cm.
inline constexpr std::int64_t kLargestPicture = std::int64_t{1} << 26;

/// The rectangle to show of a whole map: that of all evidence, or a single cell where there is none.
/// \throws std::invalid_argument if it holds more than kLargestPicture cells
[[nodiscard]] CellBox picture_box(const EvidentialGrid& grid);

/// One layer of a rectangle of cells: `box.height` rows of `box.width` floats, lowest row first.
/// \throws std::invalid_argument if the box holds more than kLargestPicture cells
[[nodiscard]] std::vector<float> layer(const EvidentialGrid& grid, const CellBox& box, Layer which);

/// The decision for every cell of a rectangle, in the order of `layer`.
/// \throws std::invalid_argument as `layer`.
[[nodiscard]] std::vector<CellState> decisions(const EvidentialGrid& grid, const CellBox& box,
                                               const DecisionParams& params = {});

[[nodiscard]] const char* to_string(CellState state);

}  // namespace credo::grids
