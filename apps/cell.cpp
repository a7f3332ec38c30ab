// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "apps/about.hpp"
#include "apps/commands.hpp"
#include "apps/map_region.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "datasets/trajectory.hpp"
#include "evidence/grid_mass.hpp"
#include "grids/readout.hpp"
#include "results/cell_history.hpp"
#include "results/map_folder.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;
using evidence::GridElement;
using evidence::GridMass;
using nlohmann::ordered_json;

struct CellOptions {
  std::string map;
  double x_m = 0.0, y_m = 0.0;
  OutputFormat format;
};

/// What a map knows of a place.
struct CellAnswer {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  GridMass mass;  ///< the conflict not divided out
  std::optional<mapping::CellHistory> history;
};

[[noreturn]] void fail_unseen(const CellOptions& o) {
  throw std::runtime_error(
      fmt::format("{}: nothing was seen at ({:g}, {:g}): expected a place inside of the map", o.map, o.x_m, o.y_m));
}

CellAnswer ask_sum(const CellOptions& o) {
  const grids::EvidentialGrid grid = read_map_region(o.map, {o.x_m, o.y_m, o.x_m, o.y_m});
  const grids::CellIndex cell = grid.georeference().cell_at({o.x_m, o.y_m});
  const evidence::FixedLogCommonality known = grid.at(cell);
  if (known == evidence::FixedLogCommonality{}) fail_unseen(o);
  return {grid.georeference().centre(cell), evidence::masses(known.value()), std::nullopt};
}

CellAnswer ask_rule(const CellOptions& o) {
  const fs::path folder = o.map;
  const auto [georeference, image] = results::read_belief_picture(folder);
  const grids::CellIndex cell = georeference.cell_at({o.x_m, o.y_m});
  if (cell.x < 0 || cell.y < 0 || cell.x >= image.width || cell.y >= image.height) fail_unseen(o);
  const auto& pixel =
      image.pixels[static_cast<std::size_t>(image.height - 1 - cell.y) * static_cast<std::size_t>(image.width) +
                   static_cast<std::size_t>(cell.x)];
  if (pixel[3] == 1.0F) fail_unseen(o);
  CellAnswer answer{georeference.centre(cell), {pixel[0], pixel[1], pixel[2], pixel[3]}, std::nullopt};
  if (!fs::exists(folder / "history.csv")) return answer;
  for (const mapping::CellHistory& row : results::read_cell_history(folder / "history.csv", georeference))
    if (row.cell == cell) answer.history = row;
  return answer;
}

/// One number of "empty" and of "occupied" each.
struct CellMeasure {
  const char* name;
  double empty, occupied;
};

/// Of the masses with the conflict divided out; none at total conflict.
std::vector<CellMeasure> cell_measures(const GridMass& mass) {
  const auto normal = evidence::without_conflict(mass);
  if (!normal) return {};
  const auto both = [&](const char* name, const auto& measure) {
    return CellMeasure{name, measure(GridElement::kEmpty), measure(GridElement::kOccupied)};
  };
  constexpr auto kModel = evidence::GridModel::kExclusive;
  return {both("Bel", [&](GridElement e) { return evidence::belief(*normal, e, kModel); }),
          both("Pl", [&](GridElement e) { return evidence::plausibility(*normal, e, kModel); }),
          both("BetP", [&](GridElement e) { return evidence::pignistic(*normal, e, kModel); }),
          both("DSmP", [&](GridElement e) { return evidence::dsmp(*normal, e, kModel, grids::kDsmpEpsilon); })};
}

const char* cell_state(const GridMass& mass) {
  if (mass.occupied == mass.empty) return "undecided";
  return mass.occupied > mass.empty ? "occupied" : "empty";
}

void print_cell_json(const CellAnswer& answer) {
  const GridMass& mass = answer.mass;
  ordered_json out{
      {"x_m", answer.centre.x()},
      {"y_m", answer.centre.y()},
      {"state", cell_state(mass)},
      {"masses",
       {{"empty", mass.empty}, {"occupied", mass.occupied}, {"conflict", mass.conflict}, {"unknown", mass.unknown}}}};
  for (const CellMeasure& m : cell_measures(mass)) out[m.name] = {{"empty", m.empty}, {"occupied", m.occupied}};
  if (answer.history)
    out["since"] = {{"state", answer.history->occupied ? "occupied" : "empty"},
                    {"s", datasets::to_seconds(answer.history->since)},
                    {"changes", answer.history->changes}};
  print(out);
}

void print_cell_text(const CellAnswer& answer) {
  const GridMass& mass = answer.mass;
  std::printf("cell with centre (%.3f, %.3f) m: %s\n", answer.centre.x(), answer.centre.y(), cell_state(mass));
  std::printf("  masses    empty %.4f  occupied %.4f  conflict %.4f  unknown %.4f\n", mass.empty, mass.occupied,
              mass.conflict, mass.unknown);
  for (const CellMeasure& m : cell_measures(mass))
    std::printf("  %-8s  empty %.4f  occupied %.4f\n", m.name, m.empty, m.occupied);
  if (!answer.history) return;
  std::printf("  %s since %s s; changes seen: %d\n", answer.history->occupied ? "occupied" : "empty",
              datasets::to_seconds(answer.history->since).c_str(), answer.history->changes);
}

void execute(const CellOptions& o) {
  const CellAnswer answer = about(o.map, [&] { return results::is_rule_map(o.map) ? ask_rule(o) : ask_sum(o); });
  o.format.json() ? print_cell_json(answer) : print_cell_text(answer);
}

}  // namespace

void add_cell(CLI::App& app) {
  CLI::App* command = app.add_subcommand("cell", "What a map knows of a place, and since when.");
  command->footer(
      "  credo cell results/office_map 3.2 1.5    masses, Bel, Pl, BetP, DSmP\n"
      "  credo cell results/changing 3.2 1.5      of a map by --rule changing, also since when it is so");
  auto o = std::make_shared<CellOptions>();
  command->add_option("MAP", o->map, "a results folder of credo map or credo run, or a map.cgrid")
      ->check(a_path())
      ->required();
  command->add_option("X", o->x_m, "in the map's frame [m]")->check(number_in(-1e6, 1e6))->required();
  command->add_option("Y", o->y_m, "in the map's frame [m]")->check(number_in(-1e6, 1e6))->required();
  add_format_option(*command, o->format);
  command->callback([o] { execute(*o); });
}

}  // namespace credo::apps
