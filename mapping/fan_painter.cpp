// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/fan_painter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "mapping/resolution_fit.hpp"

namespace credo::mapping {
namespace {

constexpr double kTableBins = 400.0;                            // at most, over the range
constexpr std::size_t kMostTableBytes = std::size_t{64} << 20;  // of the increments kept

}  // namespace

FanPainter::FanPainter(AnySonarModel model, const sensors::SonarRing& ring, const grids::Georeference& georeference)
    : model_(std::move(model)), georeference_(georeference), half_width_rad_(0.5 * ring.beam_width_rad) {
  if (!(ring.beam_width_rad > 0.0 && ring.beam_width_rad < std::numbers::pi))
    throw std::invalid_argument("sonar ring: beam_width must be between 0 and pi rad, not " +
                                std::to_string(ring.beam_width_rad));
  require_resolution_fits(georeference.resolution_m, ring.range_max_m, "sonar ring");
  // Distances are shifted so that the reading is exact: its own step may be the coarser one.
  reading_bin_m_ = std::max(0.5 * georeference.resolution_m, ring.range_max_m / kTableBins);
  rho_bin_m_ = 0.5 * reading_bin_m_;
  readings_ = static_cast<std::size_t>(ring.range_max_m / reading_bin_m_) + 2;
  tables_.resize(readings_ * kLevels);
}

const FanPainter::Table& FanPainter::table(double reading_m, int level) {
  const bool echo = std::isfinite(reading_m);
  const std::size_t bin = echo ? static_cast<std::size_t>(reading_m / reading_bin_m_) : readings_ - 1;
  Table& table = tables_[bin * kLevels + static_cast<std::size_t>(level - 1)];
  if (!table.rows.empty()) return table;

  const double reading = echo ? (static_cast<double>(bin) + 0.5) * reading_bin_m_ : reading_m;
  const double reliability = reliability_of(level) * (echo ? model_.reliability() : model_.no_echo().reliability());
  const double widest = std::sin(half_width_rad_);
  const std::size_t rows =
      static_cast<std::size_t>((echo ? model_.reach(reading) : model_.no_echo().reach()) / rho_bin_m_) + 3;
  forget_tables_before(rows * sizeof(table.rows.front()));
  table.reading_m = reading;
  table.rows.resize(rows);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double rho = (static_cast<double>(row) + 0.5) * rho_bin_m_;
    for (int a = 0; a < kAngleBins; ++a) {
      const double theta = std::asin(std::sqrt((a + 0.5) / kAngleBins) * widest);
      const evidence::GridMass mass = echo ? model_.mass(rho, theta, reading) : model_.no_echo().mass(rho, theta);
      table.rows[row][a] = evidence::fixed_increment(mass, reliability);
    }
  }
  return table;
}

void FanPainter::forget_tables_before(std::size_t bytes) {
  if (table_bytes_ + bytes > kMostTableBytes) {
    for (Table& table : tables_) table = {};
    table_bytes_ = 0;
  }
  table_bytes_ += bytes;
}

void FanPainter::paint_rows(const Fan& fan, const Table& table, double shift_m) {
  const float axis_x = static_cast<float>(fan.axis_x()), axis_y = static_cast<float>(fan.axis_y());
  const float rho_bins = static_cast<float>(georeference_.resolution_m / rho_bin_m_);
  const float widest = static_cast<float>(std::sin(half_width_rad_));
  const float angle_bins = static_cast<float>(kAngleBins) / (widest * widest);
  const float shift = static_cast<float>(shift_m / rho_bin_m_);
  const float last_rho = static_cast<float>(table.rows.size() - 1);
  std::array<std::int32_t, grids::Tile::kSide> entry{};
  const evidence::FixedLogCommonality* const entries = table.rows.front().data();

  const CellRun rows = fan.rows();
  for (int row = rows.begin; row < rows.end; ++row) {
    const CellRun run = fan.run(row);
    if (run.begin >= run.end) continue;
    const double dy = row + 0.5 - fan.y();
    int column = run.begin;
    window_.for_run(row, run.begin, run.end, [&](grids::Tile& tile, int place, int count) {
      const float y = static_cast<float>(dy), first_x = static_cast<float>(column + 0.5 - fan.x());
      for (int i = 0; i < count; ++i) {
        const float x = first_x + static_cast<float>(i);
        const float square = std::max(x * x + y * y, 1e-12F);
        const float across = axis_x * y - axis_y * x;
        const float rho = std::clamp(std::sqrt(square) * rho_bins + shift, 0.0F, last_rho);
        const float angle = std::min(across * across / square * angle_bins, static_cast<float>(kAngleBins - 1));
        entry[i] = static_cast<std::int32_t>(rho) * kAngleBins + static_cast<std::int32_t>(angle);
      }
      for (int i = 0; i < count; ++i) {
        const evidence::FixedLogCommonality& increment = entries[entry[i]];
        evidence::FixedLogCommonality::accumulate(tile.empty[place + i], increment.empty);
        evidence::FixedLogCommonality::accumulate(tile.occupied[place + i], increment.occupied);
        evidence::FixedLogCommonality::accumulate(tile.unknown[place + i], increment.unknown);
      }
      column += count;
    });
  }
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
  paint_rows(Fan(georeference_, pose, half_width_rad_, reach_m), increments,
             std::isfinite(reading_m) ? increments.reading_m - reading_m : 0.0);
}

}  // namespace credo::mapping
