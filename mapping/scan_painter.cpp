// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/scan_painter.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace credo::mapping {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

int free_class(int level) { return level > 0 ? level - 1 : RegionFiller::kOutside; }
int hit_class(int level) { return level > 0 ? kLevels + level - 1 : RegionFiller::kOutside; }

}  // namespace

MappingCounts counts_of(const ScanBeams::Counts& seen) {
  return {.scans = 1,
          .echoes = seen.echoes,
          .no_returns = seen.no_returns,
          .missing = seen.missing,
          .out_of_range = seen.out_of_range};
}

ScanPainter::ScanPainter(const sensors::RangeFinder& range_finder, const grids::Georeference& georeference,
                         LaserTables tables, const ScanParams& params)
    : beams_(range_finder, georeference, std::move(tables), params) {
  for (int level = 1; level <= kLevels; ++level) {
    increments_[static_cast<std::size_t>(free_class(level))].increment = beams_.tables().free[level];
    increments_[static_cast<std::size_t>(hit_class(level))].increment = beams_.tables().hit[level];
  }
}

void ScanPainter::add_outline(const Outline& outline, std::size_t first, std::size_t last, RegionFiller::Sides sides) {
  filler_.add_corner(beams_.start(first, outline));
  filler_.add_corners(std::span(outline.x).subspan(first, last - first + 1),
                      std::span(outline.y).subspan(first, last - first + 1));
  filler_.add_corner(beams_.end(last, outline));
  filler_.end_chain(seen_outwards(sides));
}

/// Seen from the sensor the next beams are to the left, unless they are taken clockwise.
RegionFiller::Sides ScanPainter::seen_outwards(RegionFiller::Sides sides) const {
  return beams_.turn_left() ? sides : RegionFiller::Sides{.left = sides.right, .right = sides.left};
}

/// What lies along a side of a beam's sector, from the sensor outwards.
struct ScanPainter::Layers {
  int free = RegionFiller::kOutside, hit = RegionFiller::kOutside;
  float free_m = 0.0F, near_m = 0.0F, far_m = 0.0F;

  [[nodiscard]] int at(float length_m) const {
    if (length_m < free_m) return free;
    return near_m <= length_m && length_m < far_m ? hit : RegionFiller::kOutside;
  }
  /// The next border, infinite after the last.
  [[nodiscard]] float after(float length_m) const {
    for (const float border : {free_m, near_m, far_m})
      if (border > length_m) return border;
    return kInfinity;
  }
  [[nodiscard]] Layers up_to(float length_m) const {
    return {free, hit, std::min(free_m, length_m), std::min(near_m, length_m), std::min(far_m, length_m)};
  }
};

ScanPainter::Layers ScanPainter::layers(std::size_t beam) const {
  Layers result{.free = free_class(beams_.free_level(beam)), .hit = hit_class(beams_.hit_level(beam))};
  if (result.free != RegionFiller::kOutside) result.free_m = beams_.free().length_m[beam];
  if (result.hit == RegionFiller::kOutside) return result;
  result.near_m = beams_.near().length_m[beam];
  result.far_m = beams_.far().length_m[beam];
  return result;
}

/// The side between two sectors, or beside one: bounds what differs to either side of it.
/// \param start  of the side, so far from the sensor
/// \param place  of a length along it
template <typename Place>
void ScanPainter::add_side(const Point& start, float start_m, const Layers& before, const Layers& after,
                           const Place& place) {
  Point from = start;
  for (float length_m = start_m;;) {
    const float next_m = std::min(before.after(length_m), after.after(length_m));
    if (next_m == kInfinity) return;
    const Point to = place(next_m);
    const int left = after.at(length_m), right = before.at(length_m);
    if (left != right) filler_.add_edge(from, to, seen_outwards({.left = left, .right = right}));
    from = to;
    length_m = next_m;
  }
}

/// The rest of a side, from where that half of the sector is hidden.
/// \param edge  where the side came to so far
void ScanPainter::add_hidden_side(std::size_t beam, float turn, const Point& edge) {
  const float edge_m = beams_.hidden_from_m(beam, turn);
  const Layers own = layers(beam), before = turn > 0.0F ? own : Layers{}, after = turn > 0.0F ? Layers{} : own;
  const Point start = beams_.hidden_side(beam, edge_m, turn);
  const int left = after.at(edge_m), right = before.at(edge_m);
  if (left != right) filler_.add_edge(edge, start, seen_outwards({.left = left, .right = right}));
  add_side(start, edge_m, before, after, [&](float length_m) { return beams_.side(beam, length_m, turn); });
}

/// The side between beams that hit one surface but are trusted differently.
void ScanPainter::add_joint(std::size_t beam) {
  const Layers before = layers(beam), after = layers(beam + 1);
  const auto end = [&](const Outline& outline) { return beams_.end(beam, outline); };
  if (before.free != after.free)
    filler_.add_edge(beams_.origin(beam), end(beams_.free()),
                     seen_outwards({.left = after.free, .right = before.free}));
  if (before.hit != after.hit)
    filler_.add_edge(end(beams_.near()), end(beams_.far()), seen_outwards({.left = after.hit, .right = before.hit}));
}

/// The sides after a beam: its own and that of the next, which may be one.
void ScanPainter::add_sides_after(std::size_t beam) {
  const std::size_t next = beams_.after(beam);
  const auto on_last_side = [&](float length_m) { return beams_.side(beam, length_m, 1.0F); };
  const auto on_first_side = [&](float length_m) { return beams_.side(next, length_m, -1.0F); };
  if (beams_.is_joined_with_next(beam)) return add_joint(beam);
  const float edge_m = beams_.hidden_from_m(beam, 1.0F), next_edge_m = beams_.hidden_from_m(next, -1.0F);
  const Layers seen = layers(beam).up_to(edge_m), next_seen = layers(next).up_to(next_edge_m);
  const bool is_common = beams_.shares_first_side(next);
  if (is_common) {
    add_side(beams_.origin(beam), 0.0F, seen, next_seen, on_last_side);
  } else {
    add_side(beams_.origin(beam), 0.0F, seen, {}, on_last_side);
    add_side(beams_.origin(next), 0.0F, {}, next_seen, on_first_side);
  }
  if (edge_m < kInfinity) add_hidden_side(beam, 1.0F, on_last_side(edge_m));
  if (next_edge_m < kInfinity)
    add_hidden_side(next, -1.0F, is_common ? on_last_side(next_edge_m) : on_first_side(next_edge_m));
}

/// Common sides begin where the sensor was for the first of the two: between its places free regions are open.
void ScanPainter::add_ways_of_sensor() {
  for (std::size_t beam = 0; beam < beams_.count(); ++beam)
    if (beams_.free_level(beam) > 0 && beams_.shares_first_side(beam))
      filler_.add_edge(beams_.origin(beam), beams_.origin(beams_.before(beam)),
                       seen_outwards({.left = free_class(beams_.free_level(beam))}));
}

/// What is free and what is occupied, surface by surface: the beams that hit one, or a single one.
void ScanPainter::add_contours() {
  for (std::size_t first = 0, last = 0; first < beams_.count(); first = last + 1) {
    const int free_level = beams_.free_level(first), hit_level = beams_.hit_level(first);
    last = first;
    while (beams_.is_joined_with_next(last) && beams_.free_level(last + 1) == free_level &&
           beams_.hit_level(last + 1) == hit_level)
      ++last;
    const int free = free_class(free_level), hit = hit_class(hit_level);
    const bool one_outline = free_level > 0 && hit_level > 0 && beams_.near_is_end_of_free();
    if (free_level > 0)
      add_outline(beams_.free(), first, last, {.left = free, .right = one_outline ? hit : RegionFiller::kOutside});
    if (hit_level > 0) {
      if (!one_outline) add_outline(beams_.near(), first, last, {.right = hit});
      add_outline(beams_.far(), first, last, {.left = hit});
    }
    add_sides_after(last);
  }
  if (beams_.sensor_moves()) add_ways_of_sensor();
}

ScanBeams::Counts ScanPainter::paint(grids::EvidentialGrid& grid, PendingRegions& pending,
                                     const geometry::Pose2& T_map_base, const PoseReliability& reliability,
                                     std::span<const float> ranges_m, const sensors::MotionPath& path,
                                     sensors::Timestamp time) {
  const ScanBeams::Counts counts = beams_.read(T_map_base, reliability, ranges_m, path, time);
  filler_.clear(beams_.base());
  add_contours();
  filler_.fill(grid, pending, increments_,
               beams_.are_apart() ? RegionFiller::Regions::kApart : RegionFiller::Regions::kMayOverlap);
  return counts;
}

}  // namespace credo::mapping
