// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <array>

#include "apps/map_report.hpp"
#include "apps/shipped.hpp"
#include "evaluation/settings_sweep.hpp"

// Zhu, "Map building method based on improved D-S evidence theory for mobile robot": 9 m x 7 m in cells of 5 cm, five
// sonars.
namespace credo::apps {
namespace {

using evaluation::MapDrive;
using evaluation::MapMethod;
using mapping::Approximation;

/// The parameters that the paper does not give.
struct ZhuSetting {
  double e = 0.0, rho = 0.0, n = 0.0;
};

std::vector<ZhuSetting> zhu_settings() {
  std::vector<ZhuSetting> all;
  for (const double e : {0.01, 0.05, 0.1})
    for (const double rho : {0.1, 0.3, 0.5, 0.9})
      for (const double n : {10.0, 20.0, 40.0}) all.push_back({e, rho, n});
  return all;
}

MapMethod method_of(const ZhuSetting& s, Approximation approximation) {
  return {"", evaluation::as_in_papers(mapping::ZhuParams{.rho = s.rho, .cells_of_arc = s.n}),
          mapping::ApproximatedDempsterFold{{.e1 = s.e, .e2 = s.e, .e3 = s.e, .approximation = approximation}}};
}

std::string setting_words(const ZhuSetting& s) { return fmt::format("e {:g}, rho {:g}, n {:g}", s.e, s.rho, s.n); }

/// How cells are decided, and so which are wrong: the undecided are.
enum Criterion { kByRule, kByLargerMass };
constexpr std::array kCriteria{kByRule, kByLargerMass};
constexpr std::array kCriterionNames{"decided by eq. (10)", "the larger mass"};

double wrong_count(const grids::MassMap& map, const datasets::OccupancyMap& truth, Criterion criterion) {
  const evaluation::MapScore score =
      evaluation::map_score(criterion == kByRule ? evaluation::decided_by_zhu(map) : map, truth);
  return static_cast<double>(score.cells - score.right);
}

constexpr std::array kApproximations{Approximation::kFixed, Approximation::kAdaptive, Approximation::kFaceValue};
constexpr std::array kApproximationNames{"fixed", "adaptive", "at face value"};

/// Wrong cells by one criterion, by approximation.
using WrongByAll = std::array<evaluation::SweptErrors, kApproximations.size()>;

MapTable equal_parameters(const WrongByAll& wrong_cells, const std::vector<ZhuSetting>& all, Criterion criterion) {
  MapTable table{
      fmt::format("at equal parameters, {}: wrong cells, undecided ones included", kCriterionNames[criterion]),
      {{"fixed", 0}, {"adaptive", 0}, {"fewer %", 1, 100.0}, {"at face value", 0}},
      {}};
  for (std::size_t s = 0; s < all.size(); ++s) {
    MapRow& row = table.rows.emplace_back(empty_row(setting_words(all[s]), "", table.columns.size()));
    for (std::size_t i = 0; i < wrong_cells[0][s].size(); ++i) {
      const double fixed = wrong_cells[0][s][i], adaptive = wrong_cells[1][s][i];
      row.values[0].add(fixed);
      row.values[1].add(adaptive);
      if (fixed > 0.0) row.values[2].add(1.0 - adaptive / fixed);
      row.values[3].add(wrong_cells[2][s][i]);
    }
  }
  return table;
}

const char* const kLostByZhu =
    "The paper says \"more accurate by 20 percent\" and defines neither accuracy nor e, rho and n, the cells of the "
    "arc. "
    "Every reading counts in full, as in the paper. The accumulators are taken as the sentence has them that names "
    "them: k1 counts \"empty\". At face value, k1 "
    "counting \"full\", evidence against the history is hardly weakened, and evidence with it by all of e.";
const char* const kWhyZhu =
    "What explains it: a cell of the arc gets 1/n, and the fixed approximation takes 2 e of that, up to a half, away "
    "from "
    "every reading and gives it to the opposite and to ignorance; adaptive, what agrees with the history is hardly "
    "weakened, so that cells become decided. Where both decide, by the larger mass, they differ little: most wrong "
    "cells "
    "are walls that no echo came back from. Table 1 of the paper, that Dempster's rule never leaves m(empty) = 1, "
    "holds "
    "for every m2 but the one of n = 1, which is total conflict.";

using WrongByCriterion = std::array<WrongByAll, kCriteria.size()>;

/// Plays all seeds, and maps each by every setting and approximation. \param shown  of the first seed
WrongByCriterion sweep_settings(const ExperimentParams& params, const std::vector<ZhuSetting>& all,
                                std::vector<ShownMap>& shown, const Report& report) {
  const sim::World world = sim::load_world(find_shipped("zhu", kWorlds));
  const int maps = params.seeds * static_cast<int>(all.size() * kApproximations.size());
  const std::size_t seeds = static_cast<std::size_t>(params.seeds);
  WrongByCriterion wrong_cells;
  for (WrongByAll& by_approximation : wrong_cells) by_approximation.fill({all.size(), std::vector<double>(seeds)});
  int done = 0;
  for (std::size_t i = 0; i < seeds; ++i) {
    const MapDrive drive = evaluation::play_for_mapping(world, params.seed + i);
    for (std::size_t s = 0; s < all.size(); ++s)
      for (std::size_t a = 0; a < kApproximations.size(); ++a) {
        const mapping::RuleMap map = evaluation::map_by(method_of(all[s], kApproximations[a]), drive);
        for (const Criterion criterion : kCriteria)
          wrong_cells[criterion][a][s][i] = wrong_count(map.map, drive.truth, criterion);
        if (i == 0 && all[s].e == 0.1 && all[s].rho == 0.3 && all[s].n == 20.0)
          shown.push_back({kApproximationNames[a],
                           fmt::format("{}: {:.0f} wrong cells", setting_words(all[s]), wrong_cells[kByRule][a][s][i]),
                           evaluation::decided_by_zhu(map.map)});
        report(++done, maps);
      }
  }
  return wrong_cells;
}

MapTable claim_table(const WrongByCriterion& wrong_cells) {
  MapTable table{"fewer wrong cells than with the fixed approximation, median over all settings and seeds",
                 {{"median %", 1, 100.0}},
                 {}};
  for (const Criterion criterion : kCriteria) {
    MapRow& row = table.rows.emplace_back(empty_row(kCriterionNames[criterion], "20", 1));
    const std::vector<double> shares = evaluation::reductions(wrong_cells[criterion][0], wrong_cells[criterion][1]);
    if (!shares.empty()) row.values[0].add(evaluation::median_of(shares));
  }
  return table;
}

MapTable own_best_table(const WrongByCriterion& wrong_cells, const std::vector<ZhuSetting>& all) {
  MapTable table{
      "each at its own best, chosen on the other seeds (none with one seed): wrong cells", {{"wrong", 1}}, {}};
  for (const Criterion criterion : kCriteria)
    for (const std::size_t a : {0U, 1U}) {
      const evaluation::OwnBest best = evaluation::best_on_other_seeds(wrong_cells[criterion][a]);
      std::string name = fmt::format("{}, {}", kCriterionNames[criterion], kApproximationNames[a]);
      for (std::size_t i = 0; i < best.settings.size(); ++i)
        name += (i == 0 ? " (" : "; ") + setting_words(all[best.settings[i]]);
      table.rows.push_back({best.settings.empty() ? name : name + ")", "", {best.error}});
    }
  return table;
}

}  // namespace

MapReport reproduce_zhu(const ExperimentParams& params, const Report& report) {
  const std::vector<ZhuSetting> all = zhu_settings();
  MapReport result;
  const WrongByCriterion wrong_cells = sweep_settings(params, all, result.maps, report);
  result.heading = fmt::format("Zhu: 9 m x 7 m, five sonars in two groups, cells of 5 cm; {}", params.seeds_text());
  result.tables = {claim_table(wrong_cells), own_best_table(wrong_cells, all)};
  for (const Criterion criterion : kCriteria)
    result.tables.push_back(equal_parameters(wrong_cells[criterion], all, criterion));
  result.notes = {kLostByZhu, kWhyZhu};
  return result;
}

}  // namespace credo::apps
