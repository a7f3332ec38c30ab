// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/simulate.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <thread>

#include "apps/about.hpp"
#include "apps/commands.hpp"
#include "apps/interrupt.hpp"
#include "apps/option_checks.hpp"
#include "apps/shipped.hpp"
#include "apps/terminal.hpp"
#include "datasets/dataset_writer.hpp"
#include "datasets/map_server.hpp"
#include "datasets/truth_states.hpp"
#include "evaluation/simulated_drive.hpp"
#include "sim/degradation.hpp"
#include "sim/random_world.hpp"
#include "sim/simulation.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
  std::string world;
  std::string out;
  std::string kind;
  std::string degradation = "nominal";
  std::uint64_t seed = 1;
  bool force = false;
};

sim::World world_of(const SimulateOptions& options) {
  if (options.world != kRandomWorld || fs::is_regular_file(options.world)) {
    if (!options.kind.empty()) throw std::runtime_error("--kind is for the world 'random', not for " + options.world);
    return sim::load_world(find_shipped(options.world, kWorlds));
  }
  sim::RandomWorldParams params;
  if (!options.kind.empty()) params.kind = sim::building_kind(options.kind);
  return sim::random_world(options.seed, params);
}

/// What is true at the end; and, where something changed, all that was true before.
void write_truth(const sim::Simulation& simulation, const fs::path& dataset) {
  datasets::write_map(evaluation::true_map_of(simulation), dataset / "truth_map.yaml");
  if (!simulation.world().changes.empty())
    datasets::write_truth_states(evaluation::true_states_of(simulation), dataset);
}

sim::Sink sink_into(datasets::DatasetWriter& writer, Progress& progress) {
  return {.image = [&](const sensors::OmniImage& image) { writer.add_image(image.time, image.pixels); },
          .scan = [&](const sensors::RangeScan& scan) { writer.add_scan(scan); },
          .sonar = [&](const sensors::SonarSweep& sweep) { writer.add_sonar(sweep); },
          .odometry = [&](const sensors::OdometryReading& reading) { writer.add_odometry(reading); },
          .truth =
              [&](sensors::Timestamp time, const geometry::Pose2& pose) {
                writer.add_truth({time, pose});
              },
          .verticals =
              [&](sensors::Timestamp time, std::span<const sim::TrueVertical> verticals) {
                for (const sim::TrueVertical& v : verticals) {
                  writer.add_true_vertical({time, v.azimuth_rad, v.visible_share, v.contrast});
                }
              },
          .event =
              [&](sensors::Timestamp time, std::string_view name) {
                writer.add_event({time, std::string(name)});
              },
          .progress =
              [&](double share) {
                Interruptible::check();
                progress.update(share);
              }};
}

void simulate(const sim::World& world, std::uint64_t seed, const fs::path& out, bool force) {
  const sim::Simulation simulation(world, seed);
  const Interruptible interruptible;
  datasets::DatasetWriter writer(out, evaluation::header_of(simulation), {.overwrite = force});
  writer.record_events();
  Progress progress("simulating " + world.name);
  simulation.run(sink_into(writer, progress), static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  write_truth(simulation, writer.working_folder());
  Interruptible::check();
  writer.finish();
}

}  // namespace

void simulate_into(const sim::World& world, std::uint64_t seed, const fs::path& out, bool force) {
  about("world " + world.name, [&] { simulate(world, seed, out, force); });
}

void add_simulate(CLI::App& app) {
  CLI::App* command = app.add_subcommand("simulate", "Plays a world into a dataset, with its ground truth.");
  command->footer(
      "  credo simulate office --out datasets/office              a world that comes with credo\n"
      "  credo simulate my_world.yaml --out datasets/mine --seed 7\n"
      "  credo simulate random --kind l_shape --seed 7 --out datasets/l7   a building drawn from the seed\n"
      "  credo simulate office --degraded worst --out datasets/worst      with a bad range finder, clutter and people");
  auto options = std::make_shared<SimulateOptions>();
  command
      ->add_option("WORLD", options->world,
                   "a world file (YAML), the name of a world that comes with credo, or 'random'")
      ->check(a_path())
      ->required();
  command->add_option("-o,--out", options->out, "folder for the dataset")->check(a_path())->required();
  command->add_option("--seed", options->seed, "of all that is random; the same seed gives the same bytes")
      ->check(any_seed())
      ->capture_default_str();
  std::vector<std::string> kinds;
  for (const sim::BuildingKind kind : sim::building_kinds()) kinds.emplace_back(sim::name_of(kind));
  command->add_option("--kind", options->kind, "of the building of 'random'")->check(CLI::IsMember(kinds));
  command->add_option("--degraded", options->degradation, "what is made worse")
      ->check(CLI::IsMember(sim::degradation_names()))
      ->capture_default_str();
  command->add_flag("-f,--force", options->force, "replace a dataset that is already there");
  command->callback([options] {
    simulate_into(sim::degraded(world_of(*options), options->degradation, options->seed), options->seed, options->out,
                  options->force);
    std::printf("dataset: %s\n", options->out.c_str());
  });
}

}  // namespace credo::apps
