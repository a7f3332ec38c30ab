// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <iosfwd>

#include "datasets/map_server.hpp"
#include "geometry/floor_plan.hpp"
#include "grids/evidential_grid.hpp"
#include "grids/readout.hpp"

namespace credo::evaluation {

/// A map against the truth, as a robot is given it: decisions and what is withheld, walls found (map_score compares
/// rules instead). A cell counts if it was observed at least once and the truth of its centre is known.
struct MapAccuracy {
  std::int64_t observed = 0;   ///< cells that count
  std::int64_t correct = 0;    ///< occupied iff m(occupied) > m(empty), as the truth, up to `tolerance_cells` at walls
  std::int64_t undecided = 0;  ///< neither mass is greater; never correct
  std::int64_t wrongly_empty = 0;     ///< said empty, a wall in truth, and no wall was found within the tolerance
  std::int64_t wrongly_occupied = 0;  ///< said occupied, and no wall within the tolerance
  std::int64_t withheld = 0;          ///< called unknown or contested by `DecisionParams`, whichever mass is greater
  std::int64_t surface = 0;           ///< true wall cells with something observed within the tolerance
  std::int64_t surface_found = 0;     ///< of them, said occupied within the tolerance

  [[nodiscard]] double accuracy() const { return observed > 0 ? double(correct) / double(observed) : 0.0; }
  [[nodiscard]] double undecided_share() const { return observed > 0 ? double(undecided) / double(observed) : 0.0; }
  [[nodiscard]] double withheld_share() const { return observed > 0 ? double(withheld) / double(observed) : 0.0; }
  [[nodiscard]] double surface_recall() const { return surface > 0 ? double(surface_found) / double(surface) : 0.0; }

  friend bool operator==(const MapAccuracy&, const MapAccuracy&) = default;
};

struct MapAccuracyParams {
  int tolerance_cells =
      1;  ///< at walls: what is said to be a wall may lie this far from a true one, diagonals included
  grids::DecisionParams decision;
};

/// Truth by cell centre from a true occupancy map (any resolution and origin, turned or not).
/// \throws std::invalid_argument if the truth holds no known cell that was observed: probably another map frame.
[[nodiscard]] MapAccuracy map_accuracy(const grids::EvidentialGrid& map, const datasets::OccupancyMap& truth,
                                       const MapAccuracyParams& params = {});

/// Truth from a floor plan: a cell is occupied if a wall passes through it, empty otherwise, within the plan's bounding
/// box widened by the tolerance.
/// \throws std::invalid_argument if the plan has no wall, or no cell within it was observed.
[[nodiscard]] MapAccuracy map_accuracy(const grids::EvidentialGrid& map, const geometry::FloorPlan& plan,
                                       const MapAccuracyParams& params = {});

std::ostream& operator<<(std::ostream& out, const MapAccuracy& accuracy);

}  // namespace credo::evaluation
