// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>

#include "grids/readout.hpp"
#include "results/ground_view.hpp"
#include "results/pictures.hpp"

namespace credo::results {
namespace {

using grids::CellState;
using Point = Canvas::Point;
constexpr Color kUnknownCell{200, 203, 208}, kEmptyCell{255, 255, 255}, kOccupiedCell{28, 30, 36},
    kContestedCell{214, 60, 120};

Color cell_color(CellState state) {
  switch (state) {
    case CellState::kUnknown: return kUnknownCell;
    case CellState::kEmpty: return kEmptyCell;
    case CellState::kOccupied: return kOccupiedCell;
    case CellState::kContested: return kContestedCell;
  }
  return kUnknownCell;
}

/// Lowest row first becomes highest row first.
template <typename Values, typename ToColor>
cv::Mat colored(const Values& values, const grids::CellBox& box, const ToColor& to_color) {
  cv::Mat picture(box.height, box.width, CV_8UC3);
  for (int row = 0; row < box.height; ++row) {
    auto* pixels = picture.ptr<cv::Vec3b>(box.height - 1 - row);
    for (int column = 0; column < box.width; ++column) {
      const Color c = to_color(values[static_cast<std::size_t>(row) * static_cast<std::size_t>(box.width) +
                                      static_cast<std::size_t>(column)]);
      pixels[column] = {static_cast<uchar>(c.blue), static_cast<uchar>(c.green), static_cast<uchar>(c.red)};
    }
  }
  return picture;
}

Eigen::Vector2d corner_of(const grids::EvidentialGrid& grid, int x, int y) {
  const grids::Georeference& g = grid.georeference();
  return {g.origin_x_m + x * g.resolution_m, g.origin_y_m + y * g.resolution_m};
}

struct MapView {
  grids::CellBox box;
  Eigen::Vector2d low, high;

  explicit MapView(const grids::EvidentialGrid& grid) : box(grids::picture_box(grid)) {
    low = corner_of(grid, box.min.x, box.min.y);
    high = corner_of(grid, box.min.x + box.width, box.min.y + box.height);
  }
};

/// How a layer is called and coloured: white at 0, `full` at 1.
struct LayerStyle {
  grids::Layer layer;
  const char* name;   ///< of its picture
  const char* title;  ///< in a few letters
  const char* meaning;
  Color full;
};

constexpr std::array<LayerStyle, 8> kLayers{{
    {grids::Layer::kEmpty, "empty", "m(empty)", "mass, and belief, of \"empty\" (Dempster)", colors::kGreen},
    {grids::Layer::kOccupied, "occupied", "m(occupied)", "mass, and belief, of \"occupied\" (Dempster)", kOccupiedCell},
    {grids::Layer::kContested, "contested", "contested", "balance of the evidence for and against", kContestedCell},
    {grids::Layer::kUnknown, "unknown", "m(unknown)", "ignorance", colors::kMuted},
    {grids::Layer::kRawConflict, "conflict", "m(conflict)", "unnormalised: grows with every reading", colors::kRed},
    {grids::Layer::kPlausibilityOccupied, "plausibility", "Pl(occupied)", "plausibility of \"occupied\"",
     kOccupiedCell},
    {grids::Layer::kProbabilityOccupied, "pignistic", "BetP(occupied)", "ignorance shared equally", kOccupiedCell},
    {grids::Layer::kDsmpOccupied, "dsmp", "DSmP(occupied)", "ignorance shared as the masses", kOccupiedCell},
}};

/// Title, colour bar and the layer itself. \returns where the layer lies
GroundView draw_layer(Canvas& canvas, const grids::EvidentialGrid& grid, const MapView& map, const LayerStyle& style,
                      Point corner, Point opposite) {
  canvas.text({corner.x(), corner.y() + 14.0}, style.title, colors::kInk, 9.0, Anchor::kLeft, 1.2);
  color_bar(canvas, style.full, {opposite.x() - 106.0, corner.y() + 6.0}, 90.0);
  const GroundView view(map.low, map.high, corner + Point(0.0, 22.0), opposite);
  const Point top_left = view.at({map.low.x(), map.high.y()}), bottom_right = view.at({map.high.x(), map.low.y()});
  const std::vector<float> values = grids::layer(grid, map.box, style.layer);
  canvas.image(colored(values, map.box, [&](float v) { return mixed(colors::kPaper, style.full, v); }), top_left,
               bottom_right);
  canvas.frame(top_left, bottom_right, colors::kFaint, 0.8);
  return {map.low, map.high, top_left, bottom_right};
}

/// The first four layers, two by two.
void draw_layers(Canvas& canvas, const grids::EvidentialGrid& grid, const MapView& map, Point corner, double width,
                 double height) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Point at = corner + Point(i % 2 == 0 ? 0.0 : width + 18.0, i < 2 ? 0.0 : height + 12.0);
    draw_layer(canvas, grid, map, kLayers[i], at, at + Point(width, height));
  }
}

/// One layer with its legend and a scale bar.
cv::Mat layer_picture(const grids::EvidentialGrid& grid, const LayerStyle& style) {
  const MapView map(grid);
  const double aspect = (map.high.y() - map.low.y()) / std::max(1e-9, map.high.x() - map.low.x());
  const double width = 720.0, height = std::clamp(width * aspect, 160.0, 900.0);
  Canvas canvas(static_cast<int>(width + 32.0), static_cast<int>(height + 74.0));
  draw_layer(canvas, grid, map, style, {16.0, 10.0}, {16.0 + width, 32.0 + height}).scale_bar(canvas);
  canvas.text({16.0, height + 58.0}, std::string(style.title) + ": " + style.meaning, colors::kInk, 8.5);
  return canvas.finish();
}

}  // namespace

cv::Mat map_picture(const grids::EvidentialGrid& grid, std::span<const geometry::Pose2> way) {
  const MapView map(grid);
  const double aspect = (map.high.y() - map.low.y()) / std::max(1e-9, map.high.x() - map.low.x());
  const double width = 720.0, height = std::clamp(width * aspect, 420.0, 900.0);
  const double layer_height = 0.5 * height + 5.0,
               layer_width = std::clamp((layer_height - 22.0) / aspect, 250.0, 380.0);
  Canvas canvas(static_cast<int>(width + 2.0 * layer_width + 75.0), static_cast<int>(height + 70.0));
  const Point corner{16.0, 34.0}, opposite{16.0 + width, 34.0 + height};
  const GroundView view(map.low, map.high, corner, opposite);
  const Point top_left = view.at({map.low.x(), map.high.y()}), bottom_right = view.at({map.high.x(), map.low.y()});
  canvas.text({16.0, 22.0}, "Evidential map", colors::kInk, 11.0, Anchor::kLeft, 1.25);
  canvas.image(colored(grids::decisions(grid, map.box), map.box, [](CellState s) { return cell_color(s); }), top_left,
               bottom_right);
  std::vector<Point> trail;
  for (const geometry::Pose2& pose : way) trail.push_back(view.at(pose.translation()));
  const bool leaves = std::any_of(way.begin(), way.end(), [&](const geometry::Pose2& pose) {
    return (pose.translation().array() < map.low.array()).any() ||
           (pose.translation().array() > map.high.array()).any();
  });
  canvas.clip(top_left, bottom_right);
  canvas.polyline(trail, colors::kBlue, 1.4);
  canvas.clip();
  canvas.frame(top_left, bottom_right, colors::kMuted, 0.8);
  GroundView(map.low, map.high, top_left, bottom_right).scale_bar(canvas);
  legend(canvas, {16.0, 34.0 + height + 22.0},
         std::vector<LegendEntry>{
             {kOccupiedCell, "occupied"},
             {{236, 238, 241}, "empty (white)"},
             {kUnknownCell, "unknown"},
             {kContestedCell, "contested"},
             {colors::kBlue, leaves ? "way of the robot (leads out of the map)" : "way of the robot"}},
         8.5);
  draw_layers(canvas, grid, map, {16.0 + width + 22.0, 12.0}, layer_width, layer_height);
  return canvas.finish();
}

void write_map_pictures(const std::filesystem::path& folder, const grids::EvidentialGrid& grid,
                        std::span<const geometry::Pose2> way) {
  write_png(folder / "map.png", map_picture(grid, way));
  for (const LayerStyle& style : kLayers)
    write_png(folder / ("map_" + std::string(style.name) + ".png"), layer_picture(grid, style));
  write_png(folder / "map_relief.png", belief_relief(grid));
}

void write_png(const std::filesystem::path& file, const cv::Mat& picture) {
  bool written = false;
  try {
    written = cv::imwrite(file.string(), picture, {cv::IMWRITE_PNG_COMPRESSION, 4});
  } catch (const cv::Exception&) {
    written = false;
  }
  if (!written) throw std::runtime_error(file.string() + ": the picture cannot be written");
}

}  // namespace credo::results
