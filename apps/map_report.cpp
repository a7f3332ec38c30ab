// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/map_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace credo::apps {
namespace {

using evaluation::Spread;
using nlohmann::ordered_json;

std::string cell_text(const Spread& spread, const MapColumn& column) {
  if (spread.count == 0) return "-";
  const double mean = column.factor * spread.mean();
  if (spread.count == 1 || spread.lowest == spread.highest) return fmt::format("{:.{}f}", mean, column.decimals);
  return fmt::format("{:.{}f} ({:.{}f}..{:.{}f})", mean, column.decimals, column.factor * spread.lowest,
                     column.decimals, column.factor * spread.highest, column.decimals);
}

/// Words broken into lines of at most 110 characters.
std::string wrapped(const std::string& paragraph) {
  constexpr std::size_t kWidth = 110;
  std::string text, line;
  for (std::size_t begin = 0; begin < paragraph.size();) {
    const std::size_t end = std::min(paragraph.find(' ', begin), paragraph.size());
    const std::string word = paragraph.substr(begin, end - begin);
    if (!line.empty() && line.size() + 1 + word.size() > kWidth) {
      text += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return text + line + "\n";
}

std::string table_text(const MapTable& table) {
  std::vector<std::vector<std::string>> lines{{"", "paper"}};
  for (const MapColumn& column : table.columns) lines.front().push_back(column.name);
  for (const MapRow& row : table.rows) {
    std::vector<std::string>& line = lines.emplace_back(std::vector{row.name, row.paper});
    for (std::size_t i = 0; i < table.columns.size(); ++i) line.push_back(cell_text(row.values[i], table.columns[i]));
  }
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  const bool from_paper =
      widths[1] > std::string("paper").size() ||
      std::any_of(table.rows.begin(), table.rows.end(), [](const MapRow& r) { return !r.paper.empty(); });
  std::string text = table.title + "\n";
  for (const auto& line : lines) {
    std::string row = fmt::format("  {:<{}}", line[0], widths[0]);
    for (std::size_t i = from_paper ? 1 : 2; i < line.size(); ++i) row += fmt::format("  {:>{}}", line[i], widths[i]);
    text += row + "\n";
  }
  return text;
}

ordered_json json_of(const Spread& spread, const MapColumn& column) {
  if (spread.count == 0) return nullptr;
  return {{"mean", column.factor * spread.mean()},
          {"lowest", column.factor * spread.lowest},
          {"highest", column.factor * spread.highest},
          {"n", spread.count}};
}

}  // namespace

std::string ExperimentParams::seeds_text() const {
  return seeds == 1 ? fmt::format("seed {}", seed) : fmt::format("{} seeds from {}", seeds, seed);
}

std::string to_text(const MapReport& report) {
  std::string text = report.heading + "\n\n";
  for (const MapTable& table : report.tables) text += table_text(table) + "\n";
  for (const std::string& note : report.notes) text += wrapped(note) + "\n";
  return text;
}

ordered_json to_json(const MapReport& report) {
  ordered_json tables = ordered_json::array();
  for (const MapTable& table : report.tables) {
    ordered_json rows = ordered_json::array();
    for (const MapRow& row : table.rows) {
      ordered_json json{{"name", row.name}};
      if (!row.paper.empty()) json["paper"] = row.paper;
      for (std::size_t i = 0; i < table.columns.size(); ++i)
        json[table.columns[i].name] = json_of(row.values[i], table.columns[i]);
      rows.push_back(json);
    }
    tables.push_back({{"title", table.title}, {"rows", rows}});
  }
  return {{"heading", report.heading}, {"tables", tables}, {"notes", report.notes}};
}

std::vector<MapColumn> score_columns() {
  return {{"accuracy %", 2, 100.0},
          {"decided %", 2, 100.0},
          {"of these %", 2, 100.0},
          {"Brier", 4, 1.0},
          {"missed cm", 1, 100.0}};
}

void add_score(MapRow& row, const evaluation::MapScore& score) {
  row.values[0].add(score.accuracy());
  row.values[1].add(score.decided_share());
  if (score.decided > 0) row.values[2].add(score.accuracy_of_decided());
  row.values[3].add(score.brier);
  if (std::isfinite(score.missed_m)) row.values[4].add(score.missed_m);
}

MapRow empty_row(const std::string& name, const std::string& paper, std::size_t columns) {
  return {name, paper, std::vector<evaluation::Spread>(columns)};
}

}  // namespace credo::apps
