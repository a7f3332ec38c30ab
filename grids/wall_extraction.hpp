// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "geometry/floor_plan.hpp"
#include "grids/evidential_grid.hpp"

namespace credo::grids {

/// How walls are told from what a map holds. Lengths in cells are of the map, lengths in metres of the building.
struct WallParams {
  double unknown_above = 0.5;     ///< a cell of more ignorance is no part of a wall and no free space
  double least_free_m2 = 1.0;     ///< smaller free space is none, nor is what is nowhere three cells wide: beams that
                                  ///< came through a wall by mistake
  int ridge_cells = 4;            ///< occupied cells up to this thick are the blur of one surface, which runs where the
                                  ///< evidence is greatest; a thicker plateau is a solid, whose surface is its face
  double straight_cells = 1.5;    ///< points off a line by less are on it: the steps of a slanted wall, and its blur
  double shortest_m = 0.3;        ///< what is shorter is clutter
  double bridged_m = 0.6;         ///< gaps up to this in one line are closed, unless the map saw through them
  double seen_through_cells = 2;  ///< seen empty over more than this: an opening
  double corner_m = 0.3;          ///< ends as near as this to where their lines meet are brought there
};

/// The walls of a map as straight pieces: the faces between occupied cells and seen free space, followed, split where
/// they bend, fitted by least squares, and joined where pieces continue each other or meet in a corner. Faces of both
/// sides of a thin wall give one piece. Ordered from the longest; the same map gives the same walls. No verticals, and
/// no uncertainty: how far the walls are off depends on the map (evaluation::plan_accuracy measures it).
/// \throws std::invalid_argument if the map is larger than a picture may be
[[nodiscard]] geometry::FloorPlan extract_walls(const EvidentialGrid& grid, const WallParams& params = {});

}  // namespace credo::grids
