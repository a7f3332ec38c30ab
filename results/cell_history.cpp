// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/cell_history.hpp"

#include <fmt/format.h>

#include <charconv>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include "datasets/csv_table.hpp"
#include "results/results_folder.hpp"

namespace credo::results {
namespace {

const std::vector<std::string> kHistoryColumns{"x [m]", "y [m]", "state", "since [ns]", "changes"};

}  // namespace

void write_cell_history(std::span<const mapping::CellHistory> history, const grids::Georeference& georeference,
                        const std::filesystem::path& file) {
  std::string text = "#" + fmt::format("{}", fmt::join(kHistoryColumns, ",")) + "\n";
  for (const mapping::CellHistory& row : history) {
    const Eigen::Vector2d centre = georeference.centre(row.cell);
    fmt::format_to(std::back_inserter(text), "{:.6f},{:.6f},{},{},{}\n", centre.x(), centre.y(),
                   row.occupied ? "occupied" : "empty", row.since, row.changes);
  }
  write_text(file, text);
}

std::vector<mapping::CellHistory> read_cell_history(const std::filesystem::path& file,
                                                    const grids::Georeference& georeference) {
  constexpr double kFar_m = 1e7, kMostChanges = std::numeric_limits<std::int32_t>::max();
  std::vector<mapping::CellHistory> history;
  for (datasets::CsvTable table(file, kHistoryColumns); table.next_row();) {
    const double x = table.finite(-kFar_m, kFar_m), y = table.finite(-kFar_m, kFar_m);
    const std::string_view state = table.text();
    if (state != "occupied" && state != "empty")
      table.fail("found the state '" + std::string(state) + "', expected empty or occupied");
    const std::string_view since_text = table.text();
    sensors::Timestamp since = 0;
    const auto [end, error] = std::from_chars(since_text.data(), since_text.data() + since_text.size(), since);
    if (error != std::errc{} || end != since_text.data() + since_text.size())
      table.fail("found the time '" + std::string(since_text) + "', expected whole nanoseconds");
    const auto changes = static_cast<std::int32_t>(table.finite(0.0, kMostChanges));
    history.push_back({georeference.cell_at({x, y}), state == "occupied", since, changes});
  }
  return history;
}

}  // namespace credo::results
