// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "grids/readout.hpp"

namespace credo::datasets {

/// What the grey of a map's picture says of a cell.
enum class MapMode {
  kTrinary,  ///< empty, occupied or unknown
  kScale,    ///< a probability in percent; transparent where it is unknown
  kRaw,      ///< the value itself
};

/// Whose reading of a picture counts: the two map servers differ.
enum class MapRules { kNav2, kRos1 };

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
  std::vector<std::int8_t> cells;  ///< lowest row first; -1 unknown, else 0..100 (ROS 1 passes on any raw value)

  [[nodiscard]] std::int8_t at(int x, int y) const { return cells[static_cast<std::size_t>(y) * width + x]; }
  friend bool operator==(const OccupancyMap&, const OccupancyMap&) = default;
};

/// The grid's decisions over its bounding box: empty 0, occupied 100, contested and unknown -1. A vacuous grid gives a
/// map of one unknown cell.
[[nodiscard]] OccupancyMap to_occupancy(const grids::EvidentialGrid& grid, const grids::DecisionParams& params = {});

/// The pignistic probability of "occupied" over the grid's bounding box, in percent; -1 where more than
/// `params.unknown_above` of the mass is ignorance. For MapMode::kScale and kRaw, which tell contested from unknown.
[[nodiscard]] OccupancyMap to_probabilities(const grids::EvidentialGrid& grid,
                                            const grids::DecisionParams& params = {});

/// Reads a map_server YAML and its picture (PGM, PNG or whatever OpenCV reads). Both thresholds are strict
/// inequalities, and trinary mode averages the opacity in with the colours, under either rule. In scale mode nav2 takes
/// what is not opaque for unknown and rounds to 0..100; ROS 1 takes for unknown what lies between the thresholds and is
/// fully transparent (of a picture of three channels: has no blue), and cuts 1 + 98 ratio off. In raw mode nav2 keeps
/// 0..100 and takes the rest for unknown; ROS 1 applies `negate` and passes any byte on.
/// \throws FormatError with file and line: missing file, unknown key, a value that is none, a picture that cannot be
///   read.
[[nodiscard]] OccupancyMap read_map(const std::filesystem::path& yaml, MapRules rules = MapRules::kNav2);

/// Writes a YAML and a picture of the same stem, each beside its place first, then renamed.
///
/// Trinary (PGM): occupied 0, free 254, unknown 205, free_thresh 0.196, so that unknown stays unknown in nav2 and in
/// ROS 1; values from 65 on count as occupied, up to 20 as free. Scale (PNG with opacity): grey 1 - value / 100,
/// unknown transparent, thresholds just within 0 and 1; nav2 reads every value back as it was, ROS 1 unknown, 0 and 100
/// as they were and the others within one, as its formula has no way to 100 values. Raw (PGM): the value, unknown 255;
/// read back as it was by both.
/// \throws std::runtime_error if they cannot be written; std::invalid_argument if `cells` is not width x height, or the
///         resolution or the origin is none.
void write_map(const OccupancyMap& map, const std::filesystem::path& yaml, MapMode mode = MapMode::kTrinary);

}  // namespace credo::datasets
