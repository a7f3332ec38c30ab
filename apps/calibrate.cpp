// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/about.hpp"
#include "apps/commands.hpp"
#include "apps/interrupt.hpp"
#include "apps/map_source.hpp"
#include "apps/option_checks.hpp"
#include "apps/terminal.hpp"
#include "datasets/dataset.hpp"
#include "datasets/map_server.hpp"
#include "datasets/sonar_weights_file.hpp"
#include "evaluation/sonar_calibration.hpp"

namespace credo::apps {
namespace {

struct SonarOptions {
  std::vector<std::string> datasets;
  int worlds = 0;
  std::uint64_t seed = 1;
  std::string out;
};

void add_dataset(evaluation::SonarCalibration& calibration, const std::string& path) {
  const datasets::Dataset dataset = datasets::Dataset::open(path);
  if (!dataset.truth_map) throw std::runtime_error(path + ": has no truth_map.yaml, from which the sonar learns");
  const MapParts read = read_map_parts({.source = path, .poses = {}, .sensors = {"sonar"}});
  const MapPart& part = read.parts.front();
  if (part.rig.sonar_rings.size() != 1 || part.sweeps.empty())
    throw std::runtime_error(path + ": expected readings of one sonar ring");
  about(path, [&] {
    calibration.add(part.path, part.rig.sonar_rings.front(), part.sweeps, datasets::read_map(*dataset.truth_map));
  });
}

void execute(const SonarOptions& o) {
  if (o.datasets.empty() && o.worlds == 0)
    throw std::runtime_error("nothing to learn from: name datasets with their true maps, or give --worlds");
  const Interruptible interruptible;
  evaluation::SonarCalibration calibration;
  Progress progress("calibrating");
  const double all = static_cast<double>(o.datasets.size()) + o.worlds;
  double done = 0.0;
  const auto report = [&] {
    Interruptible::check();
    progress.update(++done / all);
  };
  for (const std::string& path : o.datasets) {
    add_dataset(calibration, path);
    report();
  }
  for (int i = 0; i < o.worlds; ++i) {
    evaluation::add_simulated_drive(calibration, o.seed + static_cast<std::uint64_t>(i));
    report();
  }
  std::string source = fmt::format("{} cells of {} datasets", calibration.cells(), o.datasets.size());
  if (o.worlds > 0) source += fmt::format(" and {} simulated buildings from seed {}", o.worlds, o.seed);
  const std::vector<double> weights = about("calibration", [&] { return calibration.fit(); });
  datasets::write_sonar_weights(o.out, weights, source);
  std::printf("weights: %s, from %s\n", o.out.c_str(), source.c_str());
}

}  // namespace

void add_calibrate(CLI::App& app) {
  CLI::App* calibrate = app.add_subcommand("calibrate", "Learns a sensor model from readings whose truth is known.");
  calibrate->require_subcommand(1);
  calibrate->footer("  credo calibrate sonar datasets/room datasets/hall --out my_sonar.yaml");
  CLI::App* command = calibrate->add_subcommand("sonar", "The weights of the sonar model 'calibrated'.");
  command->footer(
      "  credo calibrate sonar datasets/room datasets/hall --out my_sonar.yaml    own recordings with true maps\n"
      "  credo calibrate sonar --worlds 40 --out default.yaml                     simulated buildings\n"
      "  credo map datasets/office --sensors sonar --model calibrated --sonar-weights my_sonar.yaml");
  auto o = std::make_shared<SonarOptions>();
  command->add_option("DATASET", o->datasets, "folders with a sonar ring, ground truth and a true map")
      ->check(a_path());
  command->add_option("--worlds", o->worlds, "how many buildings to simulate, each from a seed of its own")
      ->check(number_in(0, 10'000))
      ->capture_default_str();
  command->add_option("--seed", o->seed, "of the first building")->check(any_seed())->capture_default_str();
  command->add_option("-o,--out", o->out, "file for the weights")->check(a_path())->required();
  command->callback([o] { execute(*o); });
}

}  // namespace credo::apps
