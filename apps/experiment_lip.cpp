// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "apps/map_report.hpp"
#include "apps/shipped.hpp"
#include "mapping/sequential_mapper.hpp"

// Li P., "Multi-robot map building with DSmT and PCR2": a room of 13 m x 8 m, robot I from (0, 0, 0), robot II from (6
// m, 0, 0), both into the map of the monitoring centre.
namespace credo::apps {
namespace {

using evaluation::MapDrive;
using mapping::MapperParams;

MapperParams params_with(const mapping::SonarParams& sonar) {
  MapperParams params;
  params.sonar = sonar;
  return params;
}

/// In which order the centre takes the readings of two robots in.
enum class Order { kByTime, kFirstThenSecond, kSecondThenFirst };

/// One map of several robots by a fold, whatever rig each has.
template <mapping::CellRule Rule>
class Centre {
 public:
  Centre(const MapperParams& params, const Rule& rule) : params_(params), rule_(rule), grid_(params.georeference) {}

  void take_in(const MapDrive& drive, const sensors::SonarSweep& sweep) {
    mapping::place_sweep(
        drive.rig, params_.georeference, params_.pose,
        {{drive.T_map_base.pose_at(sweep.time), Eigen::Matrix3d::Zero()}, {.yes = 1.0, .no = 0.0, .unknown = 0.0}},
        sweep, drive.T_map_base, counts_, placed_);
    const sensors::SonarRing& ring = drive.rig.sonar_rings[static_cast<std::size_t>(sweep.sensor)];
    const mapping::AnySonarModel model = mapping::sonar_model(ring, params_.sonar);
    for (const mapping::PlacedReading& reading : placed_)
      mapping::for_each_mass(params_.georeference, ring, model, reading,
                             [&](grids::CellIndex cell, const evidence::GridMass& mass) {
                               static_cast<void>(rule_.update(grid_.see(cell), mass, sweep.time));
                             });
  }
  [[nodiscard]] grids::MassMap masses() const {
    return grids::mass_map(grid_, [&](const typename Rule::Cell& cell) { return rule_.masses(cell); });
  }

 private:
  MapperParams params_;
  Rule rule_;
  grids::CellGrid<typename Rule::Cell> grid_;
  mapping::MappingCounts counts_;
  std::vector<mapping::PlacedReading> placed_;
};

/// The map of PCR2 of what both robots send.
grids::MassMap fused(const MapDrive& first, const MapDrive& second, const MapperParams& params, Order order) {
  Centre<mapping::Pcr2Fold> centre(params, {});
  const auto all = [&](const MapDrive& drive) {
    for (const sensors::SonarSweep& sweep : drive.sweeps) centre.take_in(drive, sweep);
  };
  switch (order) {
    case Order::kFirstThenSecond:
      all(first);
      all(second);
      break;
    case Order::kSecondThenFirst:
      all(second);
      all(first);
      break;
    case Order::kByTime: {
      std::size_t i = 0, j = 0;
      while (i < first.sweeps.size() || j < second.sweeps.size()) {
        const bool take_first =
            j >= second.sweeps.size() || (i < first.sweeps.size() && first.sweeps[i].time <= second.sweeps[j].time);
        take_first ? centre.take_in(first, first.sweeps[i++]) : centre.take_in(second, second.sweeps[j++]);
      }
      break;
    }
  }
  return centre.masses();
}

/// The map that no order changes, of one robot.
grids::EvidentialGrid summed(const MapDrive& drive, const MapperParams& params) {
  mapping::TrajectoryMappingParams along;
  along.mapper = params;
  return mapping::map_along(drive.T_map_base, drive.rig, {}, drive.sweeps, along).grid;
}

struct FleetScenario {
  std::string name;
  mapping::SonarParams sonar;
};

std::vector<FleetScenario> fleet_scenarios() {
  const mapping::LiPParams printed{
      .reliability = 1.0, .no_echo = {.reliability = 0.0}, .variant = mapping::Variant::kPrinted};
  mapping::LiPParams resolved = printed;
  resolved.variant = mapping::Variant::kResolved;
  return {{"PCR2, the paper's sonar, printed", printed},
          {"PCR2, the paper's sonar, resolved", resolved},
          {"PCR2, Li X. 2007 with rho_v 100", mapping::Li2007Params{}}};
}

std::string accuracy_words(const evaluation::MapScore& score) {
  return fmt::format("accuracy {:.2f} % of {} cells", 100.0 * score.accuracy(), score.cells);
}

void add_seen(MapRow& row, const grids::MassMap& map, const datasets::OccupancyMap& truth) {
  const evaluation::MapScore score = evaluation::map_score(map, truth);
  add_score(row, score);
  row.values.back().add(static_cast<double>(score.cells));
}

}  // namespace

MapReport reproduce_lip(const ExperimentParams& params, const Report& report) {
  const sim::World first_world = sim::load_world(find_shipped("lip_1", kWorlds));
  const sim::World second_world = sim::load_world(find_shipped("lip_2", kWorlds));
  const std::vector<FleetScenario> all = fleet_scenarios();
  const int maps = params.seeds * static_cast<int>(2 * all.size() + 4);
  int done = 0;
  MapTable table{"one robot and two, in the same time", score_columns(), {}};
  table.columns.push_back({"cells seen", 0});
  for (const FleetScenario& scenario : all)
    for (const char* robots : {", robot I alone", ", robots I and II"})
      table.rows.push_back(empty_row(
          scenario.name + robots, std::string(robots) == ", robot I alone" ? "" : "sees more", table.columns.size()));
  for (const char* robots : {"Credo, calibrated, robot I alone", "Credo, calibrated, robots I and II"})
    table.rows.push_back(empty_row(robots, "", table.columns.size()));
  MapTable orders{"the centre's map in another order of arrival: cells decided differently than by time",
                  {{"I, then II", 0}, {"II, then I", 0}},
                  {}};
  orders.rows = {empty_row("PCR2, resolved", "", 2), empty_row("sum of log-commonalities, any bit", "", 2)};
  MapReport result;
  for (int i = 0; i < params.seeds; ++i) {
    const std::uint64_t seed = params.seed + static_cast<std::uint64_t>(i);
    const MapDrive first = evaluation::play_for_mapping(first_world, seed);
    const MapDrive second = evaluation::play_for_mapping(second_world, seed + 1'000'000);
    const MapDrive nobody{.T_map_base = second.T_map_base, .rig = second.rig, .scans = {}, .sweeps = {}, .truth = {}};
    for (std::size_t k = 0; k < all.size(); ++k) {
      const MapperParams with = params_with(all[k].sonar);
      const grids::MassMap one = fused(first, nobody, with, Order::kByTime);
      const grids::MassMap two = fused(first, second, with, Order::kByTime);
      add_seen(table.rows[2 * k], one, first.truth);
      add_seen(table.rows[2 * k + 1], two, first.truth);
      report(done += 2, maps);
      if (i == 0) {
        result.maps.push_back({all[k].name + ": I", accuracy_words(evaluation::map_score(one, first.truth)), one});
        result.maps.push_back({all[k].name + ": I, II", accuracy_words(evaluation::map_score(two, first.truth)), two});
      }
      if (k != 1) continue;
      orders.rows[0].values[0].add(static_cast<double>(
          evaluation::decided_differently(two, fused(first, second, with, Order::kFirstThenSecond))));
      orders.rows[0].values[1].add(static_cast<double>(
          evaluation::decided_differently(two, fused(first, second, with, Order::kSecondThenFirst))));
      report(done += 2, maps);
    }
    const MapperParams calibrated = params_with(mapping::CalibratedSonarParams{});
    const grids::EvidentialGrid mine = summed(first, calibrated), others = summed(second, calibrated);
    grids::EvidentialGrid together = mine, reversed = others;
    together.merge(others);
    reversed.merge(mine);
    for (evaluation::Spread& spread : orders.rows[1].values) spread.add(together == reversed ? 0.0 : 1.0);
    add_seen(table.rows[2 * all.size()], grids::mass_map(mine, grids::ReadOut::kDempster), first.truth);
    const grids::MassMap both = grids::mass_map(together, grids::ReadOut::kDempster);
    add_seen(table.rows[2 * all.size() + 1], both, first.truth);
    if (i == 0)
      result.maps.push_back(
          {"Credo, calibrated: I, II", accuracy_words(evaluation::map_score(both, first.truth)), both});
    report(done += 2, maps);
  }
  result.heading =
      fmt::format("Li P.: a room of 13 m x 8 m, two robots with 16 sonars each, 70 s, cells of 5 cm; {} seeds from {}",
                  params.seeds, params.seed);
  result.tables = {table, orders};
  result.notes = {
      "The paper shows that two robots see more of the room in the same time, and an outline that is right; it has no "
      "numbers. Both robots' readings go into one map, in the frame of robot I.",
      "PCR2 forgets: two or three readings turn a cell, whatever it held before. So what the centre's map says of a "
      "cell "
      "depends on which robot was heard last, and on the latest readings of it. The sum of log-commonalities does not: "
      "it "
      "is the same to the last bit in any order.",
      "In print the masses are divided by their sum, which makes weak evidence at the edge of the cone certain; on the "
      "axis, 0.9 of the evidence around 0.8 of the reading is conflict, which PCR2 shares by the columns. The paper "
      "says "
      "that the fusion avoids division: PCR2 has one for each update."};
  return result;
}

}  // namespace credo::apps
