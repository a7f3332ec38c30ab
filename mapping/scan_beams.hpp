// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "grids/georeference.hpp"
#include "mapping/laser_tables.hpp"
#include "mapping/pose_reliability.hpp"
#include "mapping/region_filler.hpp"
#include "mapping/scan_params.hpp"
#include "sensors/motion_path.hpp"
#include "sensors/range_finder.hpp"

namespace credo::mapping {

/// The beams of one scan: what each says, how strongly, and of which sector of the plane. An array for each of their
/// properties, as most is worked out for many beams at a time. Keeps tables and working memory between scans.
class ScanBeams {
 public:
  /// Readings of a scan by what they are.
  struct Counts {
    int echoes = 0, no_returns = 0, missing = 0, out_of_range = 0;
  };
  /// A line over the ends of the beams: of their free part, or the near or the far side of the occupied one.
  struct Outline {
    std::vector<float> length_m;  ///< of each beam up to it
    std::vector<float> x, y;      ///< where the beams meet it, in cells from base()
  };
  using Point = RegionFiller::Corner;

  /// \throws std::invalid_argument if the resolution does not fit the range finder, or its description cannot be used.
  ScanBeams(const sensors::RangeFinder& range_finder, const grids::Georeference& georeference, LaserTables tables,
            const ScanParams& params);

  /// Takes a scan in; all that follows is of the latest.
  /// \param T_map_base  at `time`; `path` carries it to when each beam was taken
  /// \param ranges_m    one for each beam
  /// \throws std::invalid_argument if they are not; std::out_of_range if the pose is too far away to be addressed
  Counts read(const geometry::Pose2& T_map_base, const PoseReliability& reliability, std::span<const float> ranges_m,
              const sensors::MotionPath& path, sensors::Timestamp time);

  [[nodiscard]] const LaserTables& tables() const { return tables_; }
  [[nodiscard]] std::size_t count() const { return range_m_.size(); }
  [[nodiscard]] std::size_t before(std::size_t beam) const { return beam > 0 ? beam - 1 : count() - 1; }
  [[nodiscard]] std::size_t after(std::size_t beam) const { return beam + 1 < count() ? beam + 1 : 0; }

  /// The level of evidence for what is free, and for what is occupied, from 1 to kLevels; 0: there is none.
  [[nodiscard]] int free_level(std::size_t beam) const { return free_level_[beam]; }
  [[nodiscard]] int hit_level(std::size_t beam) const { return hit_level_[beam]; }
  [[nodiscard]] const Outline& free() const { return free_; }
  [[nodiscard]] const Outline& near() const { return near_is_end_of_free_ ? free_ : near_; }
  [[nodiscard]] const Outline& far() const { return far_; }

  /// Whether what a beam hits is on one surface with what the next one does.
  [[nodiscard]] bool is_joined_with_next(std::size_t beam) const { return sine_after_[beam] > 0.0; }
  /// Whether a sector begins where the one before it ends. The first of a sensor that moves begins elsewhere.
  [[nodiscard]] bool shares_first_side(std::size_t beam) const;

  /// The cell that the sensor is in at `time`: places are given in cells from its lower left corner.
  [[nodiscard]] grids::CellIndex base() const { return base_; }
  /// Where the sensor was for a beam.
  [[nodiscard]] Point origin(std::size_t beam) const { return {origin_x_[beam], origin_y_[beam]}; }
  /// From where on what a neighbour hits hides a half of a beam's sector; infinity: it does not. Where the edge lies
  /// between the two beams nobody has seen: the sector is hardly wider than the beam from there on.
  /// \param turn  1: the last half in the order of the beams, -1: the first
  [[nodiscard]] float hidden_from_m(std::size_t beam, float turn) const;
  /// A place on a side of a beam's sector. \param turn  1: the last side in the order of the beams, -1: the first
  [[nodiscard]] Point side(std::size_t beam, float length_m, float turn) const;
  /// The same, of the sector where that half of it is hidden.
  [[nodiscard]] Point hidden_side(std::size_t beam, float length_m, float turn) const;
  /// Where an outline enters a beam's sector. Sectors that touch have their side in common, to the last digit.
  [[nodiscard]] Point start(std::size_t beam, const Outline& outline) const;
  /// Where it leaves it: half-way to the next beam where both hit one surface.
  [[nodiscard]] Point end(std::size_t beam, const Outline& outline) const;

  [[nodiscard]] bool turn_left() const { return half_sector_.sin > 0.0F; }
  [[nodiscard]] bool sensor_moves() const { return moving_; }
  /// The occupied part of every beam begins as the free one ends: one outline will do for both.
  [[nodiscard]] bool near_is_end_of_free() const { return near_is_end_of_free_; }
  /// All regions lie side by side around one place, with outlines that are the same or clearly apart.
  [[nodiscard]] bool are_apart() const { return apart_; }

 private:
  struct Turn {
    float cos = 1.0F, sin = 0.0F;
  };

  Counts look_up(std::span<const float> ranges_m);
  Counts classify(std::span<const float> ranges_m, const PoseReliability& reliability);
  void classify_no_returns(std::span<const float> ranges_m, const PoseReliability& reliability);
  double place(const geometry::Pose2& T_map_base, const sensors::MotionPath& path, sensors::Timestamp time);
  void set_pose(std::size_t begin, std::size_t end, const geometry::Pose2& sensor);
  void join();
  void widen();
  [[nodiscard]] float first_end_m(std::size_t beam) const;
  void measure(Outline& outline) const;
  [[nodiscard]] Point beside(std::size_t beam, float length_m, const Turn& sector, float turn) const;
  void compare_outlines();

  sensors::RangeFinder range_finder_;
  grids::Georeference georeference_;
  LaserTables tables_;
  ScanParams params_;
  float cells_per_metre_ = 0.0F;
  float min_sine_ = 0.0F;                   // of the incidence on a surface that neighbours share
  double reach_m_ = 0.0;                    // from the sensor: no beam says anything beyond
  float least_step_m_ = 0.0F;               // between ends of beams that are not the same
  Turn half_sector_;                        // of half the angle between beams, at most
  Turn hidden_sector_;                      // of what is left of it where it is hidden
  bool touching_ = false;                   // sectors reach half-way to their neighbours
  bool all_round_ = false;                  // so do the last one and the first
  bool sides_apart_ = false;                // of sectors: those that are not common are clearly apart
  std::vector<float> sensor_x_, sensor_y_;  // directions of the beams in the sensor frame

  // The scan at hand.
  bool moving_ = false, near_is_end_of_free_ = false, apart_ = false;
  grids::CellIndex base_;
  std::vector<float> origin_x_, origin_y_;                  // in cells from base_
  std::vector<float> direction_x_, direction_y_;            // unit vectors
  std::vector<float> echo_;                                 // 1 with an echo, 0 without
  std::vector<int> bin_;                                    // of the tables
  std::vector<float> range_m_;                              // 0 without an echo
  std::vector<float> margin_m_, half_width_m_, hit_share_;  // from the tables
  Outline free_, near_, far_;
  std::vector<int> free_level_, hit_level_;
  std::vector<float> sine_before_, sine_after_;  // of the incidence on the surface shared with a neighbour; 0: none
};

inline bool ScanBeams::shares_first_side(std::size_t beam) const {
  return sine_before_[beam] > 0.0F || (touching_ && (beam > 0 || (all_round_ && !moving_)));
}

/// Up to where all that a beam says begins: nothing of it is nearer.
inline float ScanBeams::first_end_m(std::size_t beam) const {
  const float free_m = free_.length_m[beam];
  return hit_level_[beam] > 0 ? std::min(free_m, near_.length_m[beam]) : free_m;
}

inline float ScanBeams::hidden_from_m(std::size_t beam, float turn) const {
  const std::size_t other = turn > 0.0F ? after(beam) : before(beam), first = turn > 0.0F ? beam : other;
  const bool are_neighbours = all_round_ || first + 1 < count();
  if (!are_neighbours || sine_after_[first] > 0.0F || hit_level_[other] == 0)
    return std::numeric_limits<float>::infinity();
  const float edge_m = far_.length_m[other];
  return first_end_m(beam) > edge_m + least_step_m_ ? edge_m : std::numeric_limits<float>::infinity();
}

inline ScanBeams::Point ScanBeams::beside(std::size_t beam, float length_m, const Turn& sector, float turn) const {
  const float length = length_m * cells_per_metre_, c = sector.cos, s = turn * sector.sin;
  return {origin_x_[beam] + length * (c * direction_x_[beam] - s * direction_y_[beam]),
          origin_y_[beam] + length * (s * direction_x_[beam] + c * direction_y_[beam])};
}

inline ScanBeams::Point ScanBeams::side(std::size_t beam, float length_m, float turn) const {
  return beside(beam, length_m, length_m > hidden_from_m(beam, turn) ? hidden_sector_ : half_sector_, turn);
}

inline ScanBeams::Point ScanBeams::hidden_side(std::size_t beam, float length_m, float turn) const {
  return beside(beam, length_m, hidden_sector_, turn);
}

inline ScanBeams::Point ScanBeams::end(std::size_t beam, const Outline& outline) const {
  if (sine_after_[beam] > 0.0F)
    return {0.5F * (outline.x[beam] + outline.x[beam + 1]), 0.5F * (outline.y[beam] + outline.y[beam + 1])};
  return side(beam, outline.length_m[beam], 1.0F);
}

inline ScanBeams::Point ScanBeams::start(std::size_t beam, const Outline& outline) const {
  if (sine_before_[beam] > 0.0F) return end(beam - 1, outline);
  const float length_m = outline.length_m[beam];
  const bool is_common = shares_first_side(beam) && length_m <= hidden_from_m(beam, -1.0F);
  return is_common ? side(before(beam), length_m, 1.0F) : side(beam, length_m, -1.0F);
}

}  // namespace credo::mapping
