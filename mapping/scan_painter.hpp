// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>

#include "grids/evidential_grid.hpp"
#include "mapping/pending_regions.hpp"
#include "mapping/placed_sweep.hpp"
#include "mapping/region_filler.hpp"
#include "mapping/scan_beams.hpp"

namespace credo::mapping {

/// Of one scan.
[[nodiscard]] MappingCounts counts_of(const ScanBeams::Counts& seen);

/// Spreads the scans of one range finder over a grid. Keeps tables and working memory between scans.
class ScanPainter {
 public:
  /// \throws std::invalid_argument if the resolution does not fit the range finder, or its description cannot be used.
  ScanPainter(const sensors::RangeFinder& range_finder, const grids::Georeference& georeference, LaserTables tables,
              const ScanParams& params);

  /// The grid has the scan once `pending` is settled.
  /// \param T_map_base  at `time`; `path` carries it to when each beam was taken
  /// \param ranges_m    one for each beam
  /// \throws as ScanBeams::read and RegionFiller::fill; the grid is unchanged then
  ScanBeams::Counts paint(grids::EvidentialGrid& grid, PendingRegions& pending, const geometry::Pose2& T_map_base,
                          const PoseReliability& reliability, std::span<const float> ranges_m,
                          const sensors::MotionPath& path, sensors::Timestamp time);

 private:
  using Outline = ScanBeams::Outline;
  using Point = ScanBeams::Point;
  struct Layers;

  [[nodiscard]] RegionFiller::Sides seen_outwards(RegionFiller::Sides sides) const;
  [[nodiscard]] Layers layers(std::size_t beam) const;
  void add_outline(const Outline& outline, std::size_t first, std::size_t last, RegionFiller::Sides sides);
  template <typename Place>
  void add_side(const Point& start, float start_m, const Layers& before, const Layers& after, const Place& place);
  void add_hidden_side(std::size_t beam, float turn, const Point& edge);
  void add_joint(std::size_t beam);
  void add_sides_after(std::size_t beam);
  void add_ways_of_sensor();
  void add_contours();

  ScanBeams beams_;
  RegionFiller::Increments increments_;
  RegionFiller filler_;
};

}  // namespace credo::mapping
