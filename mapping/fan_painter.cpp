// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/fan_painter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "grids/instructions.hpp"
#include "mapping/resolution_fit.hpp"

namespace credo::mapping {
namespace {

constexpr std::size_t kReadings = 48;     // tables over the range, of equal steps in the root of the reading
constexpr double kMostRows = 400.0;       // of a table, those near the reading apart
constexpr double kFineCells = 6.0;        // how far before the reading rows are fine: models change steeply there
constexpr double kFineRowsPerCell = 4.0;  // at least
constexpr std::size_t kMostTableBytes = std::size_t{16} << 20;  // of the increments kept

}  // namespace

FanPainter::FanPainter(AnySonarModel model, const sensors::SonarRing& ring, const grids::Georeference& georeference)
    : model_(std::move(model)),
      georeference_(georeference),
      half_width_rad_(0.5 * ring.beam_width_rad),
      range_max_m_(ring.range_max_m) {
  if (!(ring.beam_width_rad > 0.0 && ring.beam_width_rad < std::numbers::pi))
    throw std::invalid_argument("sonar ring: beam_width must be between 0 and pi rad, not " +
                                std::to_string(ring.beam_width_rad));
  require_resolution_fits(georeference.resolution_m, ring.range_max_m, "sonar ring");
  row_m_ = std::max(georeference.resolution_m, ring.range_max_m / kMostRows);
  fine_row_m_ = std::min(georeference.resolution_m / kFineRowsPerCell, row_m_);
  tables_.resize((kReadings + 1) * kLevels);
  const double widest = std::sin(half_width_rad_);
  for (int a = 0; a < FanTable::kAngleBins; ++a)
    angles_rad_[a] = std::asin(std::sqrt((a + 0.5) / FanTable::kAngleBins) * widest);
}

const FanPainter::Table& FanPainter::table(double reading_m, int level) {
  const bool echo = std::isfinite(reading_m);
  const std::size_t bin =
      echo ? std::min(kReadings - 1, static_cast<std::size_t>(std::sqrt(reading_m / range_max_m_) * kReadings))
           : kReadings;
  Table& table = tables_[bin * kLevels + static_cast<std::size_t>(level - 1)];
  if (!table.entries.empty()) return table;

  const double share = (static_cast<double>(bin) + 0.5) / kReadings;
  const double reading = echo ? share * share * range_max_m_ : reading_m;
  const double reliability = reliability_of(level) * (echo ? model_.reliability() : model_.no_echo().reliability());
  const double reach_m = std::max(0.0, echo ? model_.reach(reading) : model_.no_echo().reach());
  const double wide_m =
      echo ? std::clamp(reading - kFineCells * georeference_.resolution_m, 0.0, reach_m) : reach_m + row_m_;
  const auto wide_rows = static_cast<std::size_t>(wide_m / row_m_);
  const double fine_from_m = static_cast<double>(wide_rows) * row_m_;
  const std::size_t fine_rows = echo ? static_cast<std::size_t>((reach_m - fine_from_m) / fine_row_m_) + 2 : 0;

  const std::size_t rows = wide_rows + fine_rows;
  forget_tables_before((rows * FanTable::kAngleBins + 1) * sizeof(PaddedIncrement));
  table.reading_row = echo ? static_cast<double>(wide_rows) + (reading - fine_from_m) / fine_row_m_ : 0.0;
  table.entries.reserve(rows * FanTable::kAngleBins + 1);
  for (std::size_t row = 0; row < rows; ++row) {
    const double rho = row < wide_rows ? (static_cast<double>(row) + 0.5) * row_m_
                                       : fine_from_m + (static_cast<double>(row - wide_rows) + 0.5) * fine_row_m_;
    for (const double theta : angles_rad_) {
      const evidence::GridMass mass = echo ? model_.mass(rho, theta, reading) : model_.no_echo().mass(rho, theta);
      table.entries.push_back({evidence::fixed_increment(mass, reliability)});
    }
  }
  table.entries.emplace_back();
  return table;
}

void FanPainter::forget_tables_before(std::size_t bytes) {
  if (table_bytes_ + bytes > kMostTableBytes) {
    for (Table& table : tables_) table = {};
    table_bytes_ = 0;
  }
  table_bytes_ += bytes;
}

void FanPainter::paint_rows(const Fan& fan, const Table& table, double reading_m) {
  blocks_.clear();
  const CellRun rows = fan.rows();
  runs_.resize(static_cast<std::size_t>(std::max(0, rows.end - rows.begin)));
  CellRun* const runs = runs_.data();
  grids::run_with(
      grids::best_instructions(), [ fan, rows, runs ]() __attribute__((always_inline)) {
        for (int row = rows.begin; row < rows.end; ++row) runs[row - rows.begin] = fan.run(row);
      });
  for (int row = rows.begin; row < rows.end; ++row) {
    const CellRun run = runs[row - rows.begin];
    const float y = static_cast<float>(row + 0.5 - fan.y());
    float x = static_cast<float>(run.begin + 0.5 - fan.x());
    window_.for_run(row, run.begin, run.end, [&](grids::Tile& tile, int place, int count) {
      for (const int end = place + count; place < end;) {
        const int cells = std::min(grids::kLanes, end - place);
        blocks_.push_back({&tile, static_cast<std::int16_t>(place), static_cast<std::int16_t>(cells), x, y});
        place += cells;
        x += static_cast<float>(cells);
      }
    });
  }
  const double widest = std::sin(half_width_rad_);
  add_from_table(blocks_, {.entries = table.entries,
                           .axis_x = static_cast<float>(fan.axis_x()),
                           .axis_y = static_cast<float>(fan.axis_y()),
                           .rows_per_cell = static_cast<float>(georeference_.resolution_m / row_m_),
                           .fine_rows_per_cell = static_cast<float>(georeference_.resolution_m / fine_row_m_),
                           .first_fine_row = static_cast<float>(table.reading_row - reading_m / fine_row_m_),
                           .angle_bins = static_cast<float>(FanTable::kAngleBins / (widest * widest))});
}

void FanPainter::paint(grids::EvidentialGrid& grid, const geometry::Pose2& pose, double reading_m, double reliability) {
  const int level = level_of(reliability);
  const double reach_m = std::isfinite(reading_m) ? model_.reach(reading_m) : model_.no_echo().reach();
  if (level == 0 || !(reach_m > 0.0)) return;
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(reach_m + 2.0 * georeference_.resolution_m);
  const grids::CellIndex least = georeference_.cell_at(pose.translation() - margin);
  const grids::CellIndex most = georeference_.cell_at(pose.translation() + margin);
  window_.open(grid, {least, most.x - least.x + 1, most.y - least.y + 1});

  const Table& increments = table(reading_m, level);
  paint_rows(Fan(georeference_, pose, half_width_rad_, reach_m), increments, reading_m);
}

}  // namespace credo::mapping
