// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "results/canvas.hpp"
#include "results/cell_history.hpp"
#include "results/pictures.hpp"

namespace credo::results {
namespace {

using mapping::CellHistory;

constexpr Color kInNoState{224, 227, 232};

/// A number of each cell in [0, 1], and how the picture is to be read.
struct HistoryLayer {
  std::string title;
  Color full;  ///< at 1; white at 0
  std::string low, high;
};

/// \param value  of a row
template <typename Value>
void draw_history(std::span<const CellHistory> history, const grids::CellBox& where, const HistoryLayer& layer,
                  const Value& value, const std::filesystem::path& file) {
  cv::Mat pixels(where.height, where.width, CV_8UC3, cv::Scalar(kInNoState.blue, kInNoState.green, kInNoState.red));
  for (const CellHistory& row : history) {
    if (!where.contains(row.cell)) continue;
    const Color c = mixed(colors::kPaper, layer.full, value(row));
    pixels.at<cv::Vec3b>(where.height - 1 - (row.cell.y - where.min.y), row.cell.x - where.min.x) = {
        static_cast<uchar>(c.blue), static_cast<uchar>(c.green), static_cast<uchar>(c.red)};
  }
  constexpr double kWidth = 720.0, kMargin = 16.0, kTop = 32.0;
  const double scale = std::min(kWidth / where.width, 900.0 / where.height);
  const Canvas::Point low{kMargin, kTop}, high = low + scale * Canvas::Point(where.width, where.height);
  Canvas canvas(static_cast<int>(kWidth + 2.0 * kMargin), static_cast<int>(high.y() + 40.0));
  canvas.text({kMargin, 22.0}, layer.title, colors::kInk, 9.0, Anchor::kLeft, 1.2);
  canvas.image(pixels, low, high);
  canvas.frame(low, high, colors::kMuted, 0.8);
  const Canvas::Point bar(kMargin + 5.0 + text_width(layer.low, 7.5), high.y() + 16.0);
  color_bar(canvas, layer.full, bar, 90.0, layer.low, layer.high);
  const double after = bar.x() + 95.0 + text_width(layer.high, 7.5) + 24.0;
  legend(canvas, {after, high.y() + 24.0}, std::vector<LegendEntry>{{kInNoState, "in no state, or not seen"}});
  write_png(file, canvas.finish());
}

}  // namespace

void write_cell_history_pictures(std::span<const CellHistory> history, const grids::CellBox& where,
                                 const std::filesystem::path& folder) {
  if (history.empty() || where.empty()) return;
  const auto [first, last] = std::ranges::minmax(history, {}, &CellHistory::since);
  const auto most = std::ranges::max(history, {}, &CellHistory::changes).changes;
  const sensors::Timestamp begin = first.since;
  const double duration_s = sensors::seconds_between(begin, last.since);
  draw_history(
      history, where,
      {"Since when a cell is what it is, in seconds after the first cell was settled", colors::kBlue, "0",
       fmt::format("{:.1f} s", duration_s)},
      [&](const CellHistory& row) {
        return duration_s > 0.0 ? sensors::seconds_between(begin, row.since) / duration_s : 0.0;
      },
      folder / "map_since.png");
  draw_history(
      history, where, {"How often a cell changed", colors::kRed, "0", std::to_string(std::max(most, 1))},
      [&](const CellHistory& row) { return static_cast<double>(row.changes) / std::max(most, 1); },
      folder / "map_changes.png");
}

}  // namespace credo::results
