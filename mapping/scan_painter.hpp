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

  /// \param T_map_base  at `time`; `path` carries it to when each beam was taken
  /// \param ranges_m    one for each beam
  /// \throws std::out_of_range if the pose is too far away to be addressed; the grid is unchanged then.
  Counts paint(grids::EvidentialGrid& grid, const geometry::Pose2& T_map_base, const PoseReliability& reliability,
               std::span<const float> ranges_m, const sensors::MotionPath& path, sensors::Timestamp time);

 private:
  struct Beam {
    Eigen::Vector2d origin, direction;  ///< in cells; a unit vector
    double range_m = 0.0, free_m = 0.0, near_m = 0.0, far_m = 0.0;
    int free_class = -1, hit_class = -1;  ///< -1: none
    bool joined = false;                  ///< with the next beam: both hit one surface
  };
  /// An outline over the beams: the end of its free part, or the near or the far side of the occupied one.
  using Outline = double Beam::*;

  Counts classify(std::span<const float> ranges_m, const PoseReliability& reliability);
  void place(const geometry::Pose2& T_map_base, const sensors::MotionPath& path, sensors::Timestamp time);
  void join();
  [[nodiscard]] Eigen::Vector2d tip(std::size_t beam, Outline outline) const;
  [[nodiscard]] Eigen::Vector2d start(std::size_t beam, Outline outline) const;
  [[nodiscard]] Eigen::Vector2d end(std::size_t beam, Outline outline) const;
  void add_free_contours();
  void add_hit_contours();

  sensors::RangeFinder range_finder_;
  grids::Georeference georeference_;
  LaserTables tables_;
  ScanParams params_;
  double cells_per_metre_ = 0.0;
  Eigen::Vector2d half_sector_;              ///< cosine and sine of half the angle between beams, at most
  bool touching_ = false;                    ///< sectors reach half-way to their neighbours
  std::vector<Eigen::Vector2d> directions_;  ///< of the beams, in the sensor frame
  std::array<evidence::FixedLogCommonality, RegionFiller::kClasses> increments_;
  std::vector<Beam> beams_;
  std::vector<Eigen::Vector2d> corners_;  ///< of the contour at hand
  RegionFiller filler_;
};

}  // namespace credo::mapping
