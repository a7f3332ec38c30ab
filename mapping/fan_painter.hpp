// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "mapping/cell_kernels.hpp"
#include "mapping/evidence_levels.hpp"
#include "mapping/fan.hpp"
#include "mapping/sonar_model.hpp"
#include "mapping/tile_window.hpp"

namespace credo::mapping {

/// Spreads single sonar readings over the fan of cells that they speak about ("restricted spreading", Li X. 2007, sec.
/// 5.2). Increments come from tables over reading, distance and angle, made when first needed.
class FanPainter {
 public:
  /// \throws std::invalid_argument if the resolution does not fit the ring.
  FanPainter(AnySonarModel model, const sensors::SonarRing& ring, const grids::Georeference& georeference);

  /// \param T_map_transducer  where it was when it fired; its x axis is the beam axis
  /// \param reading_m         at most the ring's range_max; inf: no echo
  /// \param reliability       of the pose, in [0, 1]
  /// \throws std::out_of_range if the pose is too far away to be addressed; the grid is unchanged then.
  void paint(grids::EvidentialGrid& grid, const geometry::Pose2& T_map_transducer, double reading_m,
             double reliability);

 private:
  /// Increments of one reading at one level.
  struct Table {
    std::vector<PaddedIncrement> entries;  ///< FanTable::kAngleBins to a row; the last is vacuous
    double reading_row = 0.0;              ///< where the reading itself is among the fine rows
  };
  [[nodiscard]] const Table& table(double reading_m, int level);
  /// Makes room for another table: all are dropped where they would take too much memory, to be made again.
  void forget_tables_before(std::size_t bytes);
  void paint_rows(const Fan& fan, const Table& table, double reading_m);

  AnySonarModel model_;
  grids::Georeference georeference_;
  double half_width_rad_ = 0.0;
  double range_max_m_ = 0.0;
  double row_m_ = 0.0;  ///< length of a row of the tables
  double fine_row_m_ = 0.0;
  std::vector<Table> tables_;  ///< by reading, then level; the last reading is "no echo"
  std::size_t table_bytes_ = 0;
  std::array<double, FanTable::kAngleBins> angles_rad_{};  ///< from the axis, in the middle of the bins
  TileWindow window_;
  std::vector<CellRun> runs_;  ///< of the rows of the fan at hand
  std::vector<FanBlock> blocks_;
};

}  // namespace credo::mapping
