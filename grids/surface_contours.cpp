// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/surface_contours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "grids/readout.hpp"

namespace credo::grids {
namespace {

/// East, north, west and south, each a turn to the left of the one before.
constexpr std::array<CellIndex, 4> kDirections{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

CellIndex step(CellIndex from, int direction, int times = 1) {
  const CellIndex d = kDirections[static_cast<std::size_t>(direction & 3)];
  return {from.x + times * d.x, from.y + times * d.y};
}

/// Whether holds() is true of a cell and of all eight around it.
template <typename Holds>
bool all_around(CellIndex cell, Holds holds) {
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (!holds(CellIndex{cell.x + dx, cell.y + dy})) return false;
  return true;
}

/// A face of an occupied cell towards a free one; one walks along it with the solid on the left hand.
struct Face {
  CellIndex cell;
  int towards = 0;  ///< direction of the free cell

  [[nodiscard]] int heading() const { return (towards + 1) & 3; }
  /// The corner where the walk along it starts, as the cell of which it is the lower left corner.
  [[nodiscard]] CellIndex start() const {
    constexpr std::array<CellIndex, 4> kCorner{{{1, 0}, {1, 1}, {0, 1}, {0, 0}}};
    const CellIndex d = kCorner[static_cast<std::size_t>(towards)];
    return {cell.x + d.x, cell.y + d.y};
  }
  [[nodiscard]] CellIndex end() const { return step(start(), heading()); }
};

/// Faces by where they start; at most two start at one corner.
class FaceTable {
 public:
  explicit FaceTable(const WallCells& cells) {
    cells.for_each_cell([&](CellIndex cell) {
      for (int towards = 0; towards < 4 && cells.occupied(cell); ++towards)
        if (cells.free(step(cell, towards))) add({cell, towards});
    });
  }

  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  [[nodiscard]] bool has_predecessor(const Face& face) const { return ends_.contains(face.start()); }
  /// The face that goes on where one ends, the rightmost of those not taken yet, so that cells that touch at a corner
  /// stay together; -1 without any.
  [[nodiscard]] int next(const Face& face, const std::vector<bool>& taken) const {
    const auto [first, last] = starts_.equal_range(face.end());
    int best = -1, best_turn = 4;
    for (auto it = first; it != last; ++it) {
      const int turn = (faces_[static_cast<std::size_t>(it->second)].heading() - face.heading() + 5) & 3;  // right: 0
      if (!taken[static_cast<std::size_t>(it->second)] && turn < best_turn) {
        best = it->second;
        best_turn = turn;
      }
    }
    return best;
  }

 private:
  void add(const Face& face) {
    starts_.emplace(face.start(), static_cast<int>(faces_.size()));
    ends_.emplace(face.end(), static_cast<int>(faces_.size()));
    faces_.push_back(face);
  }

  std::vector<Face> faces_;
  std::multimap<CellIndex, int> starts_, ends_;
};

/// Occupied cells in a row from a cell on, itself included; at most `most`.
int run_length(CellIndex from, int direction, const WallCells& cells, int most) {
  int length = 0;
  while (length < most && cells.occupied(step(from, direction, length))) ++length;
  return length;
}

/// How far behind a face the ridge is, in cells from the centre of the first one; -0.5, the face itself, for a solid.
double ridge_depth(const Face& face, const WallCells& cells, int ridge_cells) {
  constexpr float kBeyond = 0.7F, kOnRidge = 0.5F;  // of the greatest evidence
  const int inwards = face.towards + 2, most = 4 * ridge_cells;
  const auto evidence = [&](int depth) { return cells.at(step(face.cell, inwards, depth)); };
  float greatest = 0.0F;
  int deep = 0;  // up to where the evidence falls off again, as another surface may be behind
  for (; deep < most && cells.occupied(step(face.cell, inwards, deep)) && evidence(deep) >= kBeyond * greatest; ++deep)
    greatest = std::max(greatest, evidence(deep));
  const int wide =
      run_length(face.cell, face.towards + 1, cells, most) + run_length(face.cell, face.towards + 3, cells, most) - 1;
  double weight = 0.0, depth = 0.0;
  int on_ridge = 0;
  for (int i = 0; i < deep; ++i) {
    if (evidence(i) < kOnRidge * greatest) continue;
    weight += evidence(i);
    depth += double{evidence(i)} * i;
    ++on_ridge;
  }
  // Across a slanted ridge: its two runs are the legs of a right-angled triangle, its thickness the height.
  const double thickness = on_ridge * wide / std::hypot(on_ridge, wide);
  return deep < most && thickness <= ridge_cells ? depth / weight : -0.5;
}

/// Where the surface runs behind a face.
Eigen::Vector2d surface_point(const Face& face, const WallCells& cells, const Georeference& georeference,
                              int ridge_cells) {
  const CellIndex d = kDirections[static_cast<std::size_t>(face.towards)];
  return georeference.centre(face.cell) -
         ridge_depth(face, cells, ridge_cells) * georeference.resolution_m * Eigen::Vector2d(d.x, d.y);
}

}  // namespace

WallCells::WallCells(const EvidentialGrid& grid, const WallParams& params) : box_(picture_box(grid)) {
  balance_.assign(static_cast<std::size_t>(box_.width) * static_cast<std::size_t>(box_.height), 0.0F);
  for (const auto& [index, tile] : grid.tiles())
    for (int i = 0; i < Tile::kCells; ++i) {
      const evidence::FixedLogCommonality content{tile.empty[i], tile.occupied[i], tile.unknown[i]};
      const CellIndex cell = cell_of(index, i);
      if (content == evidence::FixedLogCommonality{} || !box_.contains(cell)) continue;
      const evidence::LogCommonality value = content.value();
      if (evidence::normalised_masses(value).unknown <= params.unknown_above)
        balance_[place(cell)] =
            static_cast<float>(evidence::evidence_for_occupied(value) - evidence::evidence_for_empty(value));
    }
  const double cell_m2 = grid.georeference().resolution_m * grid.georeference().resolution_m;
  drop_small_free_regions(static_cast<std::size_t>(std::ceil(params.least_free_m2 / cell_m2)));
  close_seams();
}

void WallCells::close_seams() {
  constexpr float kBarely = -1e-3F;
  std::vector<CellIndex> seams;
  for_each_cell([&](CellIndex cell) {
    bool beside_free = false, beside_occupied = false;
    for (int direction = 0; direction < 4 && at(cell) == 0.0F; ++direction) {
      beside_free = beside_free || free(step(cell, direction));
      beside_occupied = beside_occupied || occupied(step(cell, direction));
    }
    if (beside_free && beside_occupied) seams.push_back(cell);
  });
  for (const CellIndex cell : seams) balance_[place(cell)] = kBarely;
}

void WallCells::drop_small_free_regions(std::size_t least_cells) {
  std::vector<bool> core(balance_.size(), false), visited(balance_.size(), false), kept(balance_.size(), false);
  for_each_cell([&](CellIndex cell) { core[place(cell)] = all_around(cell, [&](CellIndex c) { return free(c); }); });
  std::vector<CellIndex> region;
  const auto visit = [&](CellIndex cell) {
    if (!box_.contains(cell) || !core[place(cell)] || visited[place(cell)]) return;
    visited[place(cell)] = true;
    region.push_back(cell);
  };
  for_each_cell([&](CellIndex seed) {
    region.clear();
    visit(seed);
    for (std::size_t i = 0; i < region.size(); ++i)
      for (int direction = 0; direction < 4; ++direction) visit(step(region[i], direction));
    if (region.size() < least_cells) return;
    for (const CellIndex cell : region) all_around(cell, [&](CellIndex c) { return kept[place(c)] = true; });
  });
  for (std::size_t i = 0; i < balance_.size(); ++i)
    if (balance_[i] < 0.0F && !kept[i]) balance_[i] = 0.0F;
}

std::vector<Contour> surface_contours(const WallCells& cells, const Georeference& georeference, int ridge_cells) {
  const FaceTable table(cells);
  std::vector<bool> taken(table.faces().size(), false);
  std::vector<Contour> contours;
  const auto follow = [&](std::size_t first) {
    Contour contour;
    for (int i = static_cast<int>(first); i >= 0; i = table.next(table.faces()[static_cast<std::size_t>(i)], taken)) {
      taken[static_cast<std::size_t>(i)] = true;
      contour.push_back(surface_point(table.faces()[static_cast<std::size_t>(i)], cells, georeference, ridge_cells));
    }
    contours.push_back(std::move(contour));
  };
  for (std::size_t i = 0; i < taken.size(); ++i)  // first those that have an end, then the closed ones
    if (!taken[i] && !table.has_predecessor(table.faces()[i])) follow(i);
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (!taken[i]) follow(i);
  return contours;
}

}  // namespace credo::grids
