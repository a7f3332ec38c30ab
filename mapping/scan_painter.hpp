// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "mapping/evidence_levels.hpp"
#include "mapping/laser_model.hpp"
#include "mapping/pose_reliability.hpp"
#include "mapping/region_filler.hpp"
#include "mapping/scan_params.hpp"
#include "sensors/motion_path.hpp"
#include "sensors/range_finder.hpp"

namespace credo::mapping {

/// A laser model brought into tables.
struct LaserTables {
  std::array<evidence::FixedLogCommonality, kLevels + 1> free;
  std::array<evidence::FixedLogCommonality, kLevels + 1> hit;
  double bins_per_metre = 0.0;
  std::vector<float> free_margin_m;  ///< by range
  std::vector<float> half_width_m;   ///< by range
  std::vector<float> hit_share;      ///< by range
  double no_return_reliability = 0.0;
};

template <LaserModel Model>
[[nodiscard]] LaserTables laser_tables(const Model& model, const sensors::RangeFinder& range_finder,
                                       const ScanParams& params) {
  constexpr int kBins = 1024;
  LaserTables tables{.free = increments(model.free_mass(), model.reliability()),
                     .hit = increments(model.hit_mass(), model.reliability()),
                     .bins_per_metre = kBins / range_finder.range_max_m,
                     .free_margin_m = {},
                     .half_width_m = {},
                     .hit_share = {},
                     .no_return_reliability = params.no_return_reliability};
  for (int bin = 0; bin <= kBins; ++bin) {
    const double range_m = (bin + 0.5) / tables.bins_per_metre;
    tables.free_margin_m.push_back(static_cast<float>(model.free_margin(range_m, range_finder.noise)));
    tables.half_width_m.push_back(static_cast<float>(model.half_width(range_m, range_finder.noise)));
    tables.hit_share.push_back(static_cast<float>(model.hit_share(range_m, range_finder.noise)));
  }
  return tables;
}

/// Spreads the scans of one range finder over a grid. Keeps tables and working memory between scans.
class ScanPainter {
 public:
  /// \throws std::invalid_argument if the resolution does not fit the range finder, or its description cannot be used.
  ScanPainter(const sensors::RangeFinder& range_finder, const grids::Georeference& georeference, LaserTables tables,
              const ScanParams& params);

  /// Readings of a scan by what they are.
  struct Counts {
    int echoes = 0, no_returns = 0, missing = 0, out_of_range = 0;
  };

  /// The grid has the scan once `pending` is settled.
  /// \param T_map_base  at `time`; `path` carries it to when each beam was taken
  /// \param ranges_m    one for each beam
  /// \throws std::out_of_range if the pose is too far away to be addressed; the grid is unchanged then.
  Counts paint(grids::EvidentialGrid& grid, PendingRegions& pending, const geometry::Pose2& T_map_base,
               const PoseReliability& reliability, std::span<const float> ranges_m, const sensors::MotionPath& path,
               sensors::Timestamp time);

 private:
  /// A line over the ends of the beams: of their free part, or the near or the far side of the occupied one.
  struct Outline {
    std::vector<double> length_m;  ///< of each beam up to it
    std::vector<double> x, y;      ///< where the beams meet it, in cells
  };
  struct Layers;
  using Point = RegionFiller::Corner;

  Counts look_up(std::span<const float> ranges_m);
  Counts classify(std::span<const float> ranges_m, const PoseReliability& reliability);
  void classify_no_returns(std::span<const float> ranges_m, const PoseReliability& reliability);
  double place(const geometry::Pose2& T_map_base, const sensors::MotionPath& path, sensors::Timestamp time);
  void set_pose(std::size_t begin, std::size_t end, const geometry::Pose2& sensor);
  void join();
  void widen();
  void measure(Outline& outline) const;
  void compare_outlines();
  [[nodiscard]] const Outline& near() const { return near_is_end_of_free_ ? free_ : near_; }
  [[nodiscard]] Point origin(std::size_t beam) const { return {origin_x_[beam], origin_y_[beam]}; }
  [[nodiscard]] std::size_t before(std::size_t beam) const { return beam > 0 ? beam - 1 : range_m_.size() - 1; }
  [[nodiscard]] bool shares_first_side(std::size_t beam) const;
  [[nodiscard]] Point side(std::size_t beam, double length_m, double turn) const;
  [[nodiscard]] Point start(std::size_t beam, const Outline& outline) const;
  [[nodiscard]] Point end(std::size_t beam, const Outline& outline) const;
  [[nodiscard]] RegionFiller::Sides seen_outwards(RegionFiller::Sides sides) const;
  [[nodiscard]] Layers layers(std::size_t beam) const;
  void add_outline(const Outline& outline, std::size_t first, std::size_t last, RegionFiller::Sides sides);
  template <typename Place>
  void add_side(const Point& sensor, const Layers& before, const Layers& after, const Place& place);
  void add_joint(std::size_t beam);
  void add_sides_after(std::size_t beam);
  void add_ways_of_sensor();
  void add_contours();

  sensors::RangeFinder range_finder_;
  grids::Georeference georeference_;
  LaserTables tables_;
  ScanParams params_;
  double cells_per_metre_ = 0.0;
  double half_sector_cos_ = 1.0, half_sector_sin_ = 0.0;  ///< of half the angle between beams, at most
  bool touching_ = false;                                 ///< sectors reach half-way to their neighbours
  bool all_round_ = false;                                ///< so do the last one and the first
  std::vector<double> sensor_x_, sensor_y_;               ///< directions of the beams in the sensor frame
  RegionFiller::Increments increments_;

  // The scan at hand.
  bool moving_ = false;               ///< the sensor
  bool near_is_end_of_free_ = false;  ///< of every beam
  bool apart_ = false;                ///< regions do not overlap

  // The beams of the scan at hand, an array for each of their properties: most is worked out for many at a time.
  std::vector<double> origin_x_, origin_y_;                  ///< in cells
  std::vector<double> direction_x_, direction_y_;            ///< unit vectors
  std::vector<double> echo_;                                 ///< 1 with an echo, 0 without
  std::vector<double> range_m_;                              ///< 0 without an echo
  std::vector<double> margin_m_, half_width_m_, hit_share_;  ///< from the tables
  Outline free_, near_, far_;
  std::vector<int> free_class_, hit_class_;       ///< -1: none
  std::vector<double> sine_before_, sine_after_;  ///< of the incidence on the surface shared with a neighbour; 0: none
  RegionFiller filler_;
};

}  // namespace credo::mapping
