// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "grids/readout.hpp"

namespace credo::datasets {

/// An occupancy grid as ROS map_server has it.
struct OccupancyMap {
  static constexpr std::int8_t kUnknown = -1;
  static constexpr std::int8_t kFree = 0;
  static constexpr std::int8_t kOccupied = 100;

  int width = 0;
  int height = 0;
  double resolution_m = 0.05;
  double origin_x_m = 0.0;  ///< lower left corner of the lower left cell
  double origin_y_m = 0.0;
  double origin_yaw_rad = 0.0;
  std::vector<std::int8_t> cells;  ///< lowest row first; -1 unknown, else 0..100

  [[nodiscard]] std::int8_t at(int x, int y) const { return cells[static_cast<std::size_t>(y) * width + x]; }
  friend bool operator==(const OccupancyMap&, const OccupancyMap&) = default;
};

/// The grid's decisions over its bounding box: empty 0, occupied 100, contested and unknown -1. A vacuous grid gives a
/// map of one unknown cell.
[[nodiscard]] OccupancyMap to_occupancy(const grids::EvidentialGrid& grid, const grids::DecisionParams& params = {});

/// Reads a map_server YAML and its picture (PGM, PNG or whatever OpenCV reads) as nav2's map_server does: trinary,
/// scale and raw mode, negate, thresholds with strict inequalities, transparency.
/// \throws FormatError with file and line: missing file, unknown key, a value that is none, a picture that cannot be
///   read.
[[nodiscard]] OccupancyMap read_map(const std::filesystem::path& yaml);

/// Writes YAML and PGM (same stem) in trinary mode: occupied 0, free 254, unknown 205, free_thresh 0.196, so that
/// unknown stays unknown in nav2 and in ROS 1. Values from 65 on count as occupied, up to 20 as free. Both are written
/// beside their place first, then renamed.
/// \throws std::runtime_error if they cannot be written; std::invalid_argument if `cells` is not width x height, or the
///         resolution or the origin is none.
void write_map(const OccupancyMap& map, const std::filesystem::path& yaml);

}  // namespace credo::datasets
