// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <cstdio>
#include <memory>
#include <stdexcept>

#include "apps/commands.hpp"
#include "apps/demo_world.hpp"
#include "apps/option_checks.hpp"
#include "apps/run.hpp"
#include "apps/run_report.hpp"
#include "apps/simulate.hpp"
#include "apps/terminal.hpp"
#include "datasets/map_server.hpp"
#include "evaluation/map_accuracy.hpp"
#include "results/results_folder.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

struct DemoOptions {
  std::string out = "results/demo";
  std::uint64_t seed = 1;
};

void print_map_accuracy(const datasets::Dataset& dataset, const grids::EvidentialGrid& map) {
  if (!dataset.truth_map) return;
  const auto accuracy = evaluation::map_accuracy(map, datasets::read_map(*dataset.truth_map));
  std::printf(
      "\nMap against truth: %.1f %% of %lld observed cells are right, %.1f %% of the walls in sight were found\n",
      100.0 * accuracy.accuracy(), static_cast<long long>(accuracy.observed), 100.0 * accuracy.surface_recall());
}

/// Only what an earlier demo left is replaced.
void demo(const DemoOptions& options) {
  const Stopwatch watch;
  const fs::path out = options.out, world_file = out / "world.yaml";
  fs::create_directories(out);
  results::write_text(world_file, kDemoWorld);
  std::printf("1. simulate  %s: a building, a robot with camera, range finder, sonar and odometry\n",
              (out / "dataset").c_str());
  std::fflush(stdout);
  simulate_into(sim::load_world(world_file), options.seed, out / "dataset", true);
  const double simulated = watch.seconds();

  std::printf("2. run       %s: perception, tracking, localization, mapping\n", (out / "run").c_str());
  std::fflush(stdout);
  const datasets::Dataset dataset = datasets::Dataset::open(out / "dataset");
  fs::path results;
  const RunOptions run_options{.dataset = (out / "dataset").string(),
                               .out = (out / "run").string(),
                               .pictures = (out / "run" / "pictures").string(),
                               .picture_moments = 4,
                               .force = true};
  const Outcome outcome = run_and_write(dataset, run_options, results);

  std::printf("3. evaluate\n\n%s", to_text(outcome, dataset).c_str());
  print_map_accuracy(dataset, outcome.map);
  std::printf("\n4. look at   %s: errors.png, beliefs.png, map.png, plan_*.png, omni_*.png, scan_*.png\n",
              (results / "pictures").c_str());
  std::printf("             %.1f s, of which %.1f s to simulate\n", watch.seconds(), simulated);
}

}  // namespace

void add_demo(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("demo", "Simulates a building, localizes and maps in it, evaluates and draws.");
  command->footer(
      "  credo demo                       everything goes to results/demo\n"
      "  credo demo --out /tmp/demo --seed 2");
  auto options = std::make_shared<DemoOptions>();
  command->add_option("-o,--out", options->out, "folder for the dataset, the results and the pictures")
      ->check(a_path())
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of the simulation")->check(any_seed())->capture_default_str();
  command->callback([options] { demo(*options); });
}

}  // namespace credo::apps
