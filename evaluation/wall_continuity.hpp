// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "datasets/map_server.hpp"
#include "grids/mass_map.hpp"

namespace credo::evaluation {

/// Whether the walls of a map hold together where they do in truth, and nowhere else: what a robot that plans its way
/// takes for a passage, and for a dead end. Accuracy by cells hardly notices either.
struct WallContinuity {
  int torn = 0;            ///< stretches of true wall that the map's beams reached and that it leaves open
  double torn_m = 0.0;     ///< their length together, by the longer side of the box around each
  int joined = 0;          ///< passages that are open in truth and closed by the map
  double surface_m = 0.0;  ///< true wall that was reached: what could have been torn, as cells times their side

  friend bool operator==(const WallContinuity&, const WallContinuity&) = default;
};

struct WallContinuityParams {
  int tolerance_cells = 1;   ///< how far off, diagonals included, a wall may lie and still be that wall
  int torn_above_cells = 3;  ///< a gap of more: a beam or two may miss a wall, and three cells let no robot through
  int around_cells = 4;  ///< so far around a blockage its two sides are told apart; what is smaller than that is a nook
};

/// A cell is said to be wall where m(occupied) > m(empty).
///
/// Torn: true wall cells beside true free space, of which the map holds evidence within the tolerance, and where it
/// says wall nowhere within the tolerance, are connected by their corners to stretches; those longer than
/// `torn_above_cells` count, once each.
///
/// Joined: cells that are free in truth, with no true wall within the tolerance, and said to be wall, are connected by
/// their corners to blockages. One counts if within a window of `around_cells` around it what is free falls apart: at
/// least two regions, connected by sides, touch the blockage and reach the rim of the window. A blot in the open has
/// one region around it, a blot on a wall too.
/// \throws std::invalid_argument if no true wall was reached: probably another map frame
[[nodiscard]] WallContinuity wall_continuity(const grids::MassMap& map, const datasets::OccupancyMap& truth,
                                             const WallContinuityParams& params = {});

}  // namespace credo::evaluation
