// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/truth_states.hpp"

#include <cstdio>
#include <string>

#include "datasets/csv_table.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

namespace fs = std::filesystem;

bool same_cells(const OccupancyMap& a, const OccupancyMap& b) {
  return a.width == b.width && a.height == b.height && a.resolution_m == b.resolution_m &&
         a.origin_x_m == b.origin_x_m && a.origin_y_m == b.origin_y_m && a.origin_yaw_rad == b.origin_yaw_rad;
}

}  // namespace

std::vector<TruthState> read_truth_states(const fs::path& dataset) {
  const fs::path folder = dataset / "truth_maps";
  std::vector<TruthState> states;
  if (!fs::exists(folder / "data.csv")) return states;
  CsvTable table(folder / "data.csv", {"timestamp [ns]", "filename"});
  while (table.next_row()) {
    const sensors::Timestamp since = table.time();
    const std::string name(table.text());
    if (name.empty() || name.find('/') != std::string::npos)
      table.fail("filename: expected that of a map beside this table, found '" + name + "'");
    states.push_back({since, read_map(folder / name)});
    if (!same_cells(states.front().map, states.back().map))
      table.fail("filename: expected a map of the same cells as the first one, found others in " + name);
  }
  return states;
}

void write_truth_states(const std::vector<TruthState>& states, const fs::path& dataset) {
  const fs::path folder = dataset / "truth_maps";
  fs::create_directories(folder);
  std::string table = "#timestamp [ns],filename\n";
  for (std::size_t i = 0; i < states.size(); ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "%04zu.yaml", i);
    write_map(states[i].map, folder / name);
    table += std::to_string(states[i].since) + ',' + name + '\n';
  }
  write_file_whole(folder / "data.csv", table);
}

}  // namespace credo::datasets
