// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "evaluation/map_experiment.hpp"
#include "evaluation/reproduction.hpp"

// What the experiments of the mapping papers come to: tables, what explains them, and maps to look at.
namespace credo::apps {

/// A column of a table: its name, decimals, and the factor to its unit.
struct MapColumn {
  std::string name;
  int decimals = 2;
  double factor = 1.0;
};

struct MapRow {
  std::string name;
  std::string paper;                       ///< what the paper says of it; empty: nothing
  std::vector<evaluation::Spread> values;  ///< one for each column, over the seeds; count 0: none
};

struct MapTable {
  std::string title;
  std::vector<MapColumn> columns;
  std::vector<MapRow> rows;
};

struct ShownMap {
  std::string title, caption;
  grids::MassMap map;
};

struct MapReport {
  std::string heading;
  std::vector<MapTable> tables;
  std::vector<std::string> notes;  ///< paragraphs
  std::vector<ShownMap> maps;      ///< of the first seed
};

struct ExperimentParams {
  std::uint64_t seed = 1;  ///< the first
  int seeds = 5;           ///< one after the other

  [[nodiscard]] std::string seeds_text() const;  ///< "5 seeds from 1", "seed 7"
};

/// Is told that one more of so many maps is made.
using Report = std::function<void(int made, int of)>;

[[nodiscard]] MapReport reproduce_li2006(const ExperimentParams& params, const Report& report);
[[nodiscard]] MapReport reproduce_li2007(const ExperimentParams& params, const Report& report);
[[nodiscard]] MapReport reproduce_lip(const ExperimentParams& params, const Report& report);
[[nodiscard]] MapReport reproduce_zhu(const ExperimentParams& params, const Report& report);

[[nodiscard]] std::string to_text(const MapReport& report);
[[nodiscard]] nlohmann::ordered_json to_json(const MapReport& report);

/// The columns that most tables have: accuracy, decided, right of these [%], Brier score, walls missed [cm].
[[nodiscard]] std::vector<MapColumn> score_columns();
/// Adds a map's score to a row of these columns.
void add_score(MapRow& row, const evaluation::MapScore& score);
/// A row without values for so many columns.
[[nodiscard]] MapRow empty_row(const std::string& name, const std::string& paper, std::size_t columns);

}  // namespace credo::apps
