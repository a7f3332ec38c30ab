// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "grids/wall_extraction.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include "geometry/principal_axes.hpp"
#include "grids/surface_contours.hpp"

namespace credo::grids {
namespace {

using geometry::Segment;
using Point = Eigen::Vector2d;

/// Points of one straight surface, and the line through them.
struct Piece {
  std::vector<Point> points;
  double cell_m = 0.0;
  Segment line;  ///< by least squares of the distances, from the first to the last foot and a cell further: a point
                 ///< stands for half a face to either side, and one at either end is left out by split()

  Piece(std::vector<Point> on_it, double resolution_m) : points(std::move(on_it)), cell_m(resolution_m) { fit(); }

  void fit() {
    Point mean = Point::Zero();
    for (const Point& p : points) mean += p;
    mean /= static_cast<double>(points.size());
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (const Point& p : points) scatter += (p - mean) * (p - mean).transpose();
    const double angle = geometry::principal_axes(scatter).angle;
    const Point along(std::cos(angle), std::sin(angle));
    double low = 0.0, high = 0.0;
    for (const Point& p : points) {
      low = std::min(low, along.dot(p - mean));
      high = std::max(high, along.dot(p - mean));
    }
    line = {mean + (low - cell_m) * along, mean + (high + cell_m) * along};
  }
  void take(const Piece& other) {
    points.insert(points.end(), other.points.begin(), other.points.end());
    fit();
  }
};

double distance_from_line(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double length = along.norm();
  return length > 0.0 ? std::abs(geometry::cross(along, p - a)) / length : (p - a).norm();
}

/// Splits where a contour is farthest off the line between its ends, until nowhere by more than `tolerance_m`.
void split(std::span<const Point> contour, double tolerance_m, double resolution_m, std::vector<Piece>& pieces) {
  if (contour.size() < 2) return;
  std::size_t farthest = 0;
  double off_m = tolerance_m;
  for (std::size_t i = 1; i + 1 < contour.size(); ++i) {
    const double d = distance_from_line(contour[i], contour.front(), contour.back());
    if (d > off_m) std::tie(farthest, off_m) = std::tuple(i, d);
  }
  if (farthest == 0) {
    // The points at the ends are of a corner, and on either line or on none.
    const std::span<const Point> inner = contour.size() > 4 ? contour.subspan(1, contour.size() - 2) : contour;
    pieces.emplace_back(std::vector<Point>(inner.begin(), inner.end()), resolution_m);
    return;
  }
  split(contour.first(farthest + 1), tolerance_m, resolution_m, pieces);
  split(contour.subspan(farthest), tolerance_m, resolution_m, pieces);
}

/// From the longest; of equal lengths from the lowest, leftmost.
void sort(std::vector<Piece>& pieces) {
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& one, const Piece& other) {
    const auto key = [](const Piece& p) {
      return std::tuple(-p.line.length(), p.line.a.y(), p.line.a.x(), p.line.b.y(), p.line.b.x());
    };
    return key(one) < key(other);
  });
}

/// Whether the map saw free space between two points over more than WallParams::seen_through_cells, on both sides of
/// the line: beside the face of a solid there is free space on one.
bool seen_through(const Point& from, const Point& to, const WallCells& cells, const Georeference& georeference,
                  const WallParams& params) {
  const double length = (to - from).norm(), step = 0.5 * georeference.resolution_m;
  const Point along = (to - from) / length, aside = step * Point(-along.y(), along.x());
  double open_m = 0.0;
  for (double s = 0.0; s < length; s += step) {
    const Point p = from + s * along;
    const bool open = cells.free(georeference.cell_at(p + aside)) && cells.free(georeference.cell_at(p - aside));
    open_m = open ? open_m + step : 0.0;
    if (open_m > params.seen_through_cells * georeference.resolution_m) return true;
  }
  return false;
}

/// Whether `other` lies in the line of `piece` and is the same surface, or the next part of it.
bool continues(const Piece& piece, const Piece& other, const WallCells& cells, const Georeference& georeference,
               const WallParams& params) {
  const double tolerance_m = params.straight_cells * georeference.resolution_m;
  const Segment &a = piece.line, &b = other.line;
  for (const Point& end : {b.a, b.b})
    if (distance_from_line(end, a.a, a.b) > tolerance_m) return false;
  const Point along = a.direction();
  const double s = along.dot(b.a - a.a), t = along.dot(b.b - a.a);
  const double before = -std::max(s, t), behind = std::min(s, t) - a.length(), gap = std::max(before, behind);
  if (gap > params.bridged_m) return false;
  if (gap <= 0.0) return true;
  const Point from = before > 0.0 ? a.a : a.b;
  const Point to = (b.a - from).norm() < (b.b - from).norm() ? b.a : b.b;
  return !seen_through(from, to, cells, georeference, params);
}

/// Every piece takes in what continues it, the longest first.
std::vector<Piece> joined(std::vector<Piece> pieces, const WallCells& cells, const Georeference& georeference,
                          const WallParams& params) {
  sort(pieces);
  std::vector<Piece> result;
  std::vector<bool> gone(pieces.size(), false);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (gone[i]) continue;
    Piece piece = std::move(pieces[i]);
    for (std::size_t k = i + 1; k < pieces.size(); ++k) {
      if (gone[k] || !continues(piece, pieces[k], cells, georeference, params)) continue;
      piece.take(pieces[k]);
      gone[k] = true;
      k = i;  // it has grown: another may continue it now
    }
    result.push_back(std::move(piece));
  }
  return result;
}

/// An end of a wall. \returns its point, to be moved
Point& end_of(Segment& wall, int end) { return end == 0 ? wall.a : wall.b; }

/// Brings ends that nearly meet to where their lines cross; each end goes to the nearest crossing.
void close_corners(std::vector<Segment>& walls, const WallParams& params) {
  constexpr double kLeastSine = 0.25;  // lines within 15 degrees cross anywhere
  const std::vector<Segment> before = walls;
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (int end = 0; end < 2; ++end) {
      const Segment& wall = before[i];
      const Point from = end == 0 ? wall.a : wall.b;
      double nearest_m = params.corner_m;
      for (std::size_t k = 0; k < before.size(); ++k) {
        const double sine = geometry::cross(wall.direction(), before[k].direction());
        if (k == i || std::abs(sine) < kLeastSine) continue;
        const double way = geometry::cross(before[k].a - wall.a, before[k].direction()) / sine;
        const Point crossing = wall.a + way * wall.direction();
        const double off_m = (crossing - from).norm();
        if (off_m >= nearest_m || geometry::distance(crossing, before[k]) > params.corner_m) continue;
        nearest_m = off_m;
        end_of(walls[i], end) = crossing;
      }
    }
}

}  // namespace

geometry::FloorPlan extract_walls(const EvidentialGrid& grid, const WallParams& params) {
  const Georeference& georeference = grid.georeference();
  const WallCells cells(grid, params);
  std::vector<Piece> pieces;
  for (const Contour& contour : surface_contours(cells, georeference, params.ridge_cells))
    split(contour, params.straight_cells * georeference.resolution_m, georeference.resolution_m, pieces);
  pieces = joined(std::move(pieces), cells, georeference, params);
  std::erase_if(pieces, [&](const Piece& p) { return p.line.length() < params.shortest_m; });
  sort(pieces);
  geometry::FloorPlan plan;
  for (const Piece& piece : pieces) plan.walls.push_back(piece.line);
  close_corners(plan.walls, params);
  std::erase_if(plan.walls, [&](const Segment& wall) { return wall.length() < params.shortest_m; });
  return plan;
}

}  // namespace credo::grids
