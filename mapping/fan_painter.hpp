// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "mapping/evidence_levels.hpp"
#include "mapping/fan.hpp"
#include "mapping/sonar_model.hpp"
#include "mapping/tile_window.hpp"

namespace credo::mapping {

/// Spreads single sonar readings over the fan of cells that they speak about ("restricted spreading", Li X. 2007, sec.
/// 5.2). Increments come from tables over reading, distance and angle, made when first needed.
class FanPainter {
 public:
  static constexpr int kAngleBins = 16;  ///< from the axis to the edge, of equal steps in the squared sine

  /// \throws std::invalid_argument if the resolution does not fit the ring.
  FanPainter(AnySonarModel model, const sensors::SonarRing& ring, const grids::Georeference& georeference);

  /// \param T_map_transducer  where it was when it fired; its x axis is the beam axis
  /// \param reading_m         at most the ring's range_max; inf: no echo
  /// \param reliability       of the pose, in [0, 1]
  /// \throws std::out_of_range if the pose is too far away to be addressed; the grid is unchanged then.
  void paint(grids::EvidentialGrid& grid, const geometry::Pose2& T_map_transducer, double reading_m,
             double reliability);

 private:
  /// Increments of one reading at one level, by distance (rows) and angle.
  struct Table {
    double reading_m = 0.0;  ///< that it was made for; distances are shifted so that a reading near to it fits
    std::vector<std::array<evidence::FixedLogCommonality, kAngleBins>> rows;
  };
  [[nodiscard]] const Table& table(double reading_m, int level);
  /// Makes room for another table: all are dropped where they would take too much memory, to be made again.
  void forget_tables_before(std::size_t bytes);
  /// \param shift_m  added to distances before they are looked up
  void paint_rows(const Fan& fan, const Table& table, double shift_m);

  AnySonarModel model_;
  grids::Georeference georeference_;
  double half_width_rad_ = 0.0;
  double reading_bin_m_ = 0.0;  ///< steps of the tables
  double rho_bin_m_ = 0.0;
  std::vector<Table> tables_;  ///< by reading, then level; the last reading is "no echo"
  std::size_t readings_ = 0;
  std::size_t table_bytes_ = 0;
  TileWindow window_;
};

}  // namespace credo::mapping
