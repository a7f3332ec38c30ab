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

/// What one number in [0, 1] per cell can be asked for.
enum class Layer {
  kEmpty,                 ///< mass after Dempster's normalisation, which is the belief in it
  kOccupied,              ///< mass after Dempster's normalisation, which is the belief in it
  kUnknown,               ///< mass after Dempster's normalisation: the ignorance
  kContested,             ///< balance of evidence for and against
  kPlausibilityOccupied,  ///< 1 - m(empty), after Dempster's normalisation
  kProbabilityOccupied,   ///< pignistic
  kDsmpOccupied,          ///< DSmP of the normalised masses, epsilon kDsmpEpsilon
  kRawEmpty,              ///< unnormalised masses
  kRawOccupied,
  kRawConflict,
  kRawUnknown,
};

/// Small, so that DSmP shares the ignorance nearly in proportion to the masses, and not zero, so that a cell of one
/// mass alone is given the pignistic share in the limit (Dezert, Smarandache 2008).
inline constexpr double kDsmpEpsilon = 1e-3;

/// The most cells that a picture may have: a square of 400 m with cells of 5 cm. A map itself may be larger
/// (EvidentialGrid::kMostTiles counts what was seen, a picture what lies around it); it is read out in parts.
inline constexpr std::int64_t kLargestPicture = std::int64_t{1} << 26;
[[nodiscard]] constexpr bool fits_a_picture(const CellBox& box) {
  return std::int64_t{box.width} * box.height <= kLargestPicture;
}

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
