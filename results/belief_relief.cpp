// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "grids/readout.hpp"
#include "results/pictures.hpp"
#include "results/plot.hpp"

namespace credo::results {
namespace {

using Point = Canvas::Point;

constexpr Color kUnknownGround{206, 208, 212};
constexpr int kMostPosts = 240;         // of the relief along its longer side: more would be finer than a pixel
constexpr double kHighest = 0.16;       // a belief of 1, in longer sides of the map
constexpr double kTurn_rad = 0.5;       // of the map under the eye, clockwise from above: two of its sides are seen
constexpr double kElevation_rad = 0.7;  // of the eye above the ground: walls are high, and rooms are seen into

/// Belief 0 is pale, then blue, yellow, orange and dark red: heights are told apart in flat parts, too.
Color height_color(double belief) {
  constexpr std::array<Color, 5> kStops{
      {{236, 242, 247}, {163, 203, 228}, {250, 218, 120}, {232, 130, 40}, {150, 24, 30}}};
  const double place = std::clamp(belief, 0.0, 1.0) * (kStops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  return mixed(kStops[stop], kStops[stop + 1], place - static_cast<double>(stop));
}

/// The map as posts on a lattice, each the greatest belief of a square of cells, so that thin walls are not lost.
struct Relief {
  int columns = 0, rows = 0;
  double spacing_m = 0.0;
  std::vector<float> belief, ignorance;  ///< lowest row first

  explicit Relief(const grids::EvidentialGrid& grid) {
    const grids::CellBox box = grids::picture_box(grid);
    const std::vector<float> occupied = grids::layer(grid, box, grids::Layer::kOccupied);
    const std::vector<float> unknown = grids::layer(grid, box, grids::Layer::kUnknown);
    const int side = (std::max(box.width, box.height) + kMostPosts - 1) / kMostPosts;
    columns = (box.width + side - 1) / side;
    rows = (box.height + side - 1) / side;
    spacing_m = side * grid.georeference().resolution_m;
    belief.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0.0F);
    ignorance.assign(belief.size(), 1.0F);
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x) {
        const std::size_t cell =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(box.width) + static_cast<std::size_t>(x);
        const std::size_t post = place(x / side, y / side);
        belief[post] = std::max(belief[post], occupied[cell]);
        ignorance[post] = std::min(ignorance[post], unknown[cell]);
      }
  }
  [[nodiscard]] std::size_t place(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  [[nodiscard]] double width_m() const { return spacing_m * (columns - 1); }
  [[nodiscard]] double depth_m() const { return spacing_m * (rows - 1); }
};

/// Parallel projection of a relief into a box.
class Eye {
 public:
  Eye(const Relief& relief, Point corner, Point opposite)
      : highest_m_(kHighest * std::max({relief.width_m(), relief.depth_m(), 1e-6})) {
    Eigen::AlignedBox2d seen;
    for (const double x : {0.0, relief.width_m()})
      for (const double y : {0.0, relief.depth_m()})
        for (const double height : {0.0, 1.0}) seen.extend(flat({x, y}, height));
    scale_ = ((opposite - corner).array() / seen.sizes().array().max(1e-6)).minCoeff();
    shift_ = 0.5 * (corner + opposite) - scale_ * seen.center();
  }

  [[nodiscard]] Point at(const Eigen::Vector2d& ground_m, double belief) const {
    return shift_ + scale_ * flat(ground_m, belief);
  }

 private:
  [[nodiscard]] Point flat(const Eigen::Vector2d& ground_m, double belief) const {
    const double right = std::cos(kTurn_rad) * ground_m.x() + std::sin(kTurn_rad) * ground_m.y();
    const double away = std::cos(kTurn_rad) * ground_m.y() - std::sin(kTurn_rad) * ground_m.x();
    return {right, -away * std::sin(kElevation_rad) - belief * highest_m_ * std::cos(kElevation_rad)};
  }

  double highest_m_, scale_ = 1.0;
  Point shift_{0.0, 0.0};
};

void draw_facet(Canvas& canvas, const Eye& eye, const Relief& relief, int column, int row) {
  const std::array<std::pair<int, int>, 4> posts{
      {{column, row}, {column + 1, row}, {column + 1, row + 1}, {column, row + 1}}};
  std::array<Point, 5> outline;
  double belief = 0.0, ignorance = 0.0;
  for (std::size_t i = 0; i < posts.size(); ++i) {
    const auto [x, y] = posts[i];
    const double height = relief.belief[relief.place(x, y)];
    outline[i] = eye.at({x * relief.spacing_m, y * relief.spacing_m}, height);
    belief += 0.25 * height;
    ignorance += 0.25 * relief.ignorance[relief.place(x, y)];
  }
  outline[4] = outline[0];
  // Light from the left: what rises to the right is lit, what falls is in the shade.
  const double rise = relief.belief[relief.place(column + 1, row)] - relief.belief[relief.place(column, row)];
  const Color ground = mixed(height_color(belief), kUnknownGround, ignorance);
  const Color lit = rise > 0.0 ? mixed(ground, colors::kPaper, 0.35 * rise) : mixed(ground, colors::kInk, -0.35 * rise);
  canvas.polygon(std::span(outline).first(4), lit);
  canvas.polyline(outline, mixed(lit, colors::kInk, 0.10 + 0.25 * belief), 0.3);  // closes the seams, and is the mesh
}

/// From the farthest to the nearest, so that what is in front hides what is behind.
void draw_relief(Canvas& canvas, const Eye& eye, const Relief& relief) {
  for (int row = relief.rows - 2; row >= 0; --row)
    for (int column = 0; column + 1 < relief.columns; ++column) draw_facet(canvas, eye, relief, column, row);
}

/// The height of the belief at the left corner, and the lengths of the two sides in front.
void draw_axes(Canvas& canvas, const Eye& eye, const Relief& relief) {
  const Eigen::Vector2d left(0.0, 0.0), front(relief.width_m(), 0.0), right(relief.width_m(), relief.depth_m());
  canvas.line(eye.at(left, 0.0), eye.at(left, 1.0), colors::kMuted, 0.9);
  for (const double belief : {0.0, 0.5, 1.0}) {
    const Point at = eye.at(left, belief);
    canvas.line(at, at - Point(5.0, 0.0), colors::kMuted, 0.9);
    canvas.text(at + Point(-9.0, 4.0), tick_label(belief, 0.5), colors::kInk, 8.0, Anchor::kRight);
  }
  for (const auto& [from, to, length_m, anchor] :
       {std::tuple(left, front, relief.width_m(), Anchor::kRight), {front, right, relief.depth_m(), Anchor::kLeft}}) {
    const Point below(0.0, 7.0), a = eye.at(from, 0.0) + below, b = eye.at(to, 0.0) + below;
    canvas.line(a, b, colors::kMuted, 0.9);
    const double aside = anchor == Anchor::kRight ? -4.0 : 6.0;
    canvas.text(0.5 * (a + b) + Point(aside, 16.0), length_text(length_m), colors::kInk, 8.5, anchor);
  }
}

void draw_legend(Canvas& canvas, Point low) {
  constexpr int kSteps = 60;
  constexpr double kHeight = 150.0, kWidth = 12.0;
  for (int i = 0; i < kSteps; ++i)
    canvas.box(low - Point(0.0, kHeight * i / kSteps), low + Point(kWidth, -kHeight * (i + 1) / kSteps),
               height_color((i + 0.5) / kSteps));
  canvas.frame(low, low + Point(kWidth, -kHeight), colors::kMuted, 0.7);
  for (const double belief : {0.0, 0.5, 1.0})
    canvas.text(low + Point(kWidth + 6.0, 4.0 - kHeight * belief), tick_label(belief, 0.5), colors::kInk, 8.0);
  canvas.box(low + Point(0.0, 16.0), low + Point(kWidth, 28.0), kUnknownGround);
  canvas.text(low + Point(kWidth + 6.0, 26.0), "unknown", colors::kInk, 8.0);
}

}  // namespace

cv::Mat belief_relief(const grids::EvidentialGrid& grid) {
  const Relief relief(grid);
  Canvas canvas(1000, 680);
  canvas.text({18.0, 26.0}, "Belief in \"occupied\" over the ground", colors::kInk, 11.0, Anchor::kLeft, 1.25);
  const Eye eye(relief, {60.0, 60.0}, {880.0, 630.0});
  draw_relief(canvas, eye, relief);
  draw_axes(canvas, eye, relief);
  draw_legend(canvas, {910.0, 220.0});
  return canvas.finish();
}

}  // namespace credo::results
