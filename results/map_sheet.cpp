// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/map_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "results/canvas.hpp"

namespace credo::results {
namespace {

using Point = Canvas::Point;
constexpr Color kUnseen{224, 227, 232}, kIgnorance{176, 196, 228}, kConflict{214, 60, 120};
constexpr double kGap = 18.0, kTitle = 34.0, kLegend = 30.0;

Color sheet_color(const evidence::GridMass& mass) {
  const auto normal = evidence::without_conflict(mass);
  if (!normal) return kConflict;
  const double known = 1.0 - normal->unknown;
  const double occupied = known > 0.0 ? normal->occupied / known : 0.5;
  return mixed(mixed(kIgnorance, mixed(colors::kPaper, colors::kInk, occupied), known), kConflict, 0.7 * mass.conflict);
}

/// A box of cells as a picture, highest row first.
cv::Mat sheet_picture(const grids::MassMap& map, const grids::CellBox& box) {
  cv::Mat picture(std::max(1, box.height), std::max(1, box.width), CV_8UC3,
                  cv::Scalar(kUnseen.blue, kUnseen.green, kUnseen.red));
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      const grids::CellIndex cell{box.min.x + x, box.min.y + y};
      if (!map.saw(cell)) continue;
      const Color c = sheet_color(map.at(cell));
      picture.at<cv::Vec3b>(box.height - 1 - y, x) = {static_cast<uchar>(c.blue), static_cast<uchar>(c.green),
                                                      static_cast<uchar>(c.red)};
    }
  return picture;
}

void draw_sheet_legend(Canvas& canvas, double baseline) {
  struct Entry {
    Color color;
    const char* text;
  };
  double x = kGap;
  for (const Entry& entry : {Entry{colors::kPaper, "empty"}, Entry{colors::kInk, "occupied"},
                             Entry{kIgnorance, "unknown"}, Entry{kConflict, "conflict"}, Entry{kUnseen, "not seen"}}) {
    canvas.box({x, baseline - 10.0}, {x + 14.0, baseline + 2.0}, entry.color);
    canvas.frame({x, baseline - 10.0}, {x + 14.0, baseline + 2.0}, colors::kMuted, 0.7);
    canvas.text({x + 20.0, baseline}, entry.text, colors::kInk, 8.5);
    x += 100.0;
  }
}

}  // namespace

cv::Mat map_sheet(std::span<const SheetMap> maps) {
  grids::CellBox box;
  for (const SheetMap& entry : maps) box = box.united(entry.map->box);
  const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(maps.size())))));
  const int rows = (static_cast<int>(maps.size()) + columns - 1) / columns;
  const double width = columns > 4 ? 230.0 : columns > 1 ? 320.0 : 520.0;  // the legend takes 500
  const double height = box.empty() ? width : width * box.height / box.width;
  Canvas canvas(static_cast<int>(columns * (width + kGap) + kGap),
                static_cast<int>(rows * (height + kTitle + kGap) + kGap + kLegend));
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    const Point corner(kGap + column * (width + kGap), kGap + row * (height + kTitle + kGap));
    canvas.text(corner + Point(0.0, 12.0), maps[i].title, colors::kInk, 9.5, Anchor::kLeft, 1.2);
    canvas.text(corner + Point(0.0, 27.0), maps[i].caption, colors::kMuted, 8.0);
    const Point low = corner + Point(0.0, kTitle), high = low + Point(width, height);
    canvas.image(sheet_picture(*maps[i].map, box), low, high);
    canvas.frame(low, high, colors::kMuted, 0.8);
  }
  draw_sheet_legend(canvas, canvas.height() - 12.0);
  return canvas.finish();
}

}  // namespace credo::results
