// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>

namespace credo::grids {

/// A cell by its column and row; columns grow with x, rows with y.
struct CellIndex {
  std::int32_t x = 0;
  std::int32_t y = 0;

  friend auto operator<=>(const CellIndex&, const CellIndex&) = default;
};

/// A rectangle of cells: `width` columns from `min.x` and `height` rows from `min.y`.
struct CellBox {
  CellIndex min;
  std::int32_t width = 0;
  std::int32_t height = 0;

  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
  [[nodiscard]] bool contains(CellIndex cell) const {
    return cell.x >= min.x && cell.y >= min.y && cell.x - min.x < width && cell.y - min.y < height;
  }
  /// The smallest box that holds both; an empty box is neutral.
  [[nodiscard]] CellBox united(const CellBox& other) const;

  friend bool operator==(const CellBox&, const CellBox&) = default;
};

/// Where the cells of a grid lie in the map frame. The grid itself has no edge.
struct Georeference {
  double resolution_m = 0.05;  ///< side of a cell
  double origin_x_m = 0.0;     ///< lower left corner of cell (0, 0)
  double origin_y_m = 0.0;

  /// Cells are addressed up to this distance from cell (0, 0) along either axis.
  static constexpr std::int32_t kLargestIndex = 1 << 28;

  /// The cell that holds a point; a point on a border belongs to the cell above and to the right.
  /// \throws std::out_of_range if the point is not finite or beyond `kLargestIndex`.
  [[nodiscard]] CellIndex cell_at(const Eigen::Vector2d& point_m) const;
  /// Centre of a cell, in the map frame. [m]
  [[nodiscard]] Eigen::Vector2d centre(CellIndex cell) const {
    return {origin_x_m + (cell.x + 0.5) * resolution_m, origin_y_m + (cell.y + 0.5) * resolution_m};
  }

  friend bool operator==(const Georeference&, const Georeference&) = default;
};

}  // namespace credo::grids
