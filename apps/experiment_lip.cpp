// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include "apps/map_report.hpp"
#include "apps/shipped.hpp"
#include "evaluation/fleet_map.hpp"

// Li P., "Multi-robot map building with DSmT and PCR2": a room of 13 m x 8 m, robot I from (0, 0, 0), robot II from (6
// m, 0, 0), both into the map of the monitoring centre.
namespace credo::apps {
namespace {

using evaluation::MapDrive;
using evaluation::Order;
using mapping::MapperParams;

MapperParams params_with(const mapping::SonarParams& sonar) {
  MapperParams params;
  params.sonar = sonar;
  return params;
}

struct FleetScenario {
  std::string name;
  mapping::SonarParams sonar;
};

constexpr std::size_t kResolved = 1;  // of the scenarios: the one whose order of arrival is changed

std::vector<FleetScenario> fleet_scenarios() {
  const mapping::LiPParams printed{
      .reliability = 1.0, .no_echo = {.reliability = 0.0}, .variant = mapping::Variant::kPrinted};
  mapping::LiPParams resolved = printed;
  resolved.variant = mapping::Variant::kResolved;
  return {{"PCR2, the paper's sonar, printed", printed},
          {"PCR2, the paper's sonar, resolved", resolved},
          {"PCR2, Li X. 2007 with rho_v 100", mapping::Li2007Params{}}};
}

MapTable empty_table(const std::vector<FleetScenario>& all) {
  MapTable table{"one robot and two, in the same time", score_columns(), {}};
  table.columns.push_back({"cells seen", 0});
  const auto add = [&](const std::string& name, const char* paper) {
    table.rows.push_back(empty_row(name + ", robot I alone", "", table.columns.size()));
    table.rows.push_back(empty_row(name + ", robots I and II", paper, table.columns.size()));
  };
  for (const FleetScenario& scenario : all) add(scenario.name, "sees more");
  add("Credo, calibrated", "");
  return table;
}

/// What two robots of a seed saw, and the tables that it goes into.
struct Fleet {
  MapDrive first, second;
  MapTable& table;
  MapTable& orders;
  std::vector<ShownMap>* shown;  ///< nothing after the first seed
};

void add_map(const Fleet& fleet, std::size_t row, const std::string& title, const grids::MassMap& map) {
  const evaluation::MapScore score = evaluation::map_score(map, fleet.first.truth);
  add_score(fleet.table.rows[row], score);
  fleet.table.rows[row].values.back().add(static_cast<double>(score.cells));
  if (fleet.shown != nullptr)
    fleet.shown->push_back(
        {title, fmt::format("accuracy {:.2f} % of {} cells", 100.0 * score.accuracy(), score.cells), map});
}

void add_pcr2(const Fleet& fleet, std::size_t k, const FleetScenario& scenario) {
  const MapperParams params = params_with(scenario.sonar);
  const MapDrive nobody{
      .T_map_base = fleet.second.T_map_base, .rig = fleet.second.rig, .scans = {}, .sweeps = {}, .truth = {}};
  const grids::MassMap two = evaluation::fused_by_pcr2(fleet.first, fleet.second, params, Order::kByTime);
  add_map(fleet, 2 * k, scenario.name + ": I", evaluation::fused_by_pcr2(fleet.first, nobody, params, Order::kByTime));
  add_map(fleet, 2 * k + 1, scenario.name + ": I, II", two);
  if (k != kResolved) return;
  for (const auto& [column, order] : {std::pair{0, Order::kFirstThenSecond}, std::pair{1, Order::kSecondThenFirst}}) {
    const grids::MassMap other = evaluation::fused_by_pcr2(fleet.first, fleet.second, params, order);
    fleet.orders.rows[0].values[static_cast<std::size_t>(column)].add(
        static_cast<double>(evaluation::decided_differently(two, other).cells));
  }
}

void add_calibrated(const Fleet& fleet, std::size_t k) {
  const MapperParams params = params_with(mapping::CalibratedSonarParams{});
  const grids::EvidentialGrid mine = evaluation::summed(fleet.first, params),
                              others = evaluation::summed(fleet.second, params);
  grids::EvidentialGrid together = mine, reversed = others;
  together.merge(others);
  reversed.merge(mine);
  for (evaluation::Spread& spread : fleet.orders.rows[1].values) spread.add(together == reversed ? 0.0 : 1.0);
  add_map(fleet, 2 * k, "Credo, calibrated: I", grids::mass_map(mine, grids::ReadOut::kDempster));
  add_map(fleet, 2 * k + 1, "Credo, calibrated: I, II", grids::mass_map(together, grids::ReadOut::kDempster));
}

std::vector<std::string> fleet_notes() {
  return {
      "The paper shows that two robots see more of the room in the same time, and an outline that is right; it has no "
      "numbers. Both robots' readings go into one map, in the frame of robot I.",
      "The rows of PCR2 count every reading in full, as the paper does. Credo's own row counts readings from one place "
      "as fewer (docs/mapping.md).",
      "PCR2 forgets: two or three readings turn a cell, whatever it held before. So what the centre's map says of a "
      "cell depends on which robot was heard last, and on the latest readings of it. The sum of log-commonalities does "
      "not: it is the same to the last bit in any order.",
      "In print the masses are divided by their sum, which makes weak evidence at the edge of the cone certain; on the "
      "axis, 0.9 of the evidence around 0.8 of the reading is conflict, which PCR2 shares by the columns. The paper "
      "says that the fusion avoids division: PCR2 has one for each update."};
}

}  // namespace

MapReport reproduce_lip(const ExperimentParams& params, const Report& report) {
  const sim::World first_world = sim::load_world(find_shipped("lip_1", kWorlds));
  const sim::World second_world = sim::load_world(find_shipped("lip_2", kWorlds));
  const std::vector<FleetScenario> all = fleet_scenarios();
  const int steps = params.seeds * static_cast<int>(all.size() + 1);
  int done = 0;
  MapReport result;
  result.heading = fmt::format("Li P.: a room of 13 m x 8 m, two robots with 16 sonars each, 70 s, cells of 5 cm; {}",
                               params.seeds_text());
  MapTable table = empty_table(all);
  MapTable orders{"the centre's map in another order of arrival: cells decided differently than by time",
                  {{"I, then II", 0}, {"II, then I", 0}},
                  {empty_row("PCR2, resolved", "", 2), empty_row("sum of log-commonalities, any bit", "", 2)}};
  for (int i = 0; i < params.seeds; ++i) {
    const std::uint64_t seed = params.seed + static_cast<std::uint64_t>(i);
    const Fleet fleet{evaluation::play_for_mapping(first_world, seed),
                      evaluation::play_for_mapping(second_world, seed + 1'000'000), table, orders,
                      i == 0 ? &result.maps : nullptr};
    for (std::size_t k = 0; k < all.size(); ++k) {
      add_pcr2(fleet, k, all[k]);
      report(++done, steps);
    }
    add_calibrated(fleet, all.size());
    report(++done, steps);
  }
  result.tables = {table, orders};
  result.notes = fleet_notes();
  return result;
}

}  // namespace credo::apps
