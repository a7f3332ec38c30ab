// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <cstdint>
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
#include "apps/output.hpp"
#include "apps/terminal.hpp"
#include "datasets/dataset.hpp"
#include "datasets/map_server.hpp"
#include "datasets/sensor_weights_file.hpp"
#include "evaluation/laser_calibration.hpp"
#include "evaluation/sonar_calibration.hpp"

namespace credo::apps {
namespace {

struct CalibrateOptions {
  std::vector<std::string> datasets;
  int worlds = 0;
  std::uint64_t seed = 1;
  OutputFile out;
};

/// Readings of one sensor and the true map.
struct Learned {
  MapPart part;
  datasets::OccupancyMap truth;
};

Learned read_learned(const std::string& path, const std::string& sensor) {
  const datasets::Dataset dataset = datasets::Dataset::open(path);
  if (!dataset.truth_map) throw std::runtime_error(path + ": has no truth_map.yaml, from which a model learns");
  MapParts read = read_map_parts({.source = path, .poses = {}, .sensors = {sensor}});
  return {std::move(read.parts.front()), datasets::read_map(*dataset.truth_map)};
}

void add_dataset(evaluation::SonarCalibration& calibration, const std::string& path,
                 const evaluation::CalibrationProgress& progress) {
  const Learned learned = read_learned(path, "sonar");
  const MapPart& part = learned.part;
  if (part.rig.sonar_rings.size() != 1 || part.sweeps.empty())
    throw std::runtime_error(path + ": expected readings of one sonar ring");
  about(path, [&] { calibration.add(part.path, part.rig.sonar_rings.front(), part.sweeps, learned.truth, progress); });
}

void add_dataset(evaluation::LaserCalibration& calibration, const std::string& path,
                 const evaluation::CalibrationProgress& progress) {
  const Learned learned = read_learned(path, "range");
  const MapPart& part = learned.part;
  if (part.rig.range_finders.size() != 1 || part.scans.empty())
    throw std::runtime_error(path + ": expected readings of one range finder");
  about(path, [&] { calibration.add(part.path, part.rig.range_finders.front(), part.scans, learned.truth, progress); });
}

void write(const std::string& file, const std::vector<double>& weights, const std::string& source) {
  datasets::write_sonar_weights(file, weights, source);
}

void write(const std::string& file, const mapping::CalibratedLaserParams& laser, const std::string& source) {
  datasets::write_laser_weights(file,
                                {.free_margin_m = laser.free_margin.least_m,
                                 .free_margin_sigmas = laser.free_margin.sigmas,
                                 .half_width_m = laser.half_width.least_m,
                                 .half_width_sigmas = laser.half_width.sigmas,
                                 .summed = {laser.summed.free_weight, laser.summed.hit_weights},
                                 .alone = {laser.alone.free_weight, laser.alone.hit_weights}},
                                source);
}

/// What was learned from, in one line.
std::string source_of(const CalibrateOptions& o, std::int64_t cells) {
  const auto counted = [](std::size_t n, const char* one) { return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s"); };
  std::string from = o.datasets.empty() ? "" : counted(o.datasets.size(), "dataset");
  if (o.worlds > 0) {
    if (!from.empty()) from += " and ";
    from += counted(static_cast<std::size_t>(o.worlds), "simulated building") + fmt::format(" from seed {}", o.seed);
  }
  return fmt::format("{} cells of {}", cells, from);
}

template <typename Calibration>
void execute(const CalibrateOptions& o) {
  if (o.datasets.empty() && o.worlds == 0)
    throw std::runtime_error("nothing to learn from: name datasets with their true maps, or give --worlds");
  require_writable(o.out);
  const Interruptible interruptible;
  Calibration calibration;
  Progress progress("calibrating");
  const double all = static_cast<double>(o.datasets.size()) + o.worlds + 1.0;  // the fit, too
  double done = 0.0;
  const auto report = [&](double share) {
    Interruptible::check();
    progress.update((done + share) / all);
  };
  for (const std::string& path : o.datasets) {
    add_dataset(calibration, path, report);
    ++done;
  }
  for (int i = 0; i < o.worlds; ++i) {
    evaluation::add_simulated_drive(calibration, o.seed + static_cast<std::uint64_t>(i), {}, report);
    ++done;
  }
  const std::string source = source_of(o, calibration.cells());
  const auto learned = about("calibration", [&] { return calibration.fit(report); });
  write(o.out.path, learned, source);
  std::printf("weights: %s, from %s\n", o.out.path.c_str(), source.c_str());
}

/// \param instrument  "a sonar ring"
template <typename Calibration>
CLI::App* add_calibration(CLI::App& calibrate, const std::string& name, const std::string& instrument) {
  CLI::App* command = calibrate.add_subcommand(name, "The weights of the " + name + " model 'calibrated'.");
  auto o = std::make_shared<CalibrateOptions>();
  command->add_option("DATASET", o->datasets, "folders with " + instrument + ", ground truth and a true map")
      ->check(a_path());
  command->add_option("--worlds", o->worlds, "how many buildings to simulate, each from a seed of its own")
      ->check(number_in(0, 10'000))
      ->capture_default_str();
  command->add_option("--seed", o->seed, "of the first building")->check(any_seed())->capture_default_str();
  command->add_option("-o,--out", o->out.path, "file for the weights")->check(a_path())->required();
  add_force_option(*command, o->out, "a file");
  command->callback([o] { execute<Calibration>(*o); });
  return command;
}

}  // namespace

void add_calibrate(CLI::App& app) {
  CLI::App* calibrate = app.add_subcommand("calibrate", "Learns a sensor model from readings whose truth is known.");
  calibrate->require_subcommand(1);
  calibrate->footer(
      "  credo calibrate sonar datasets/room datasets/hall --out my_sonar.yaml\n"
      "  credo calibrate laser datasets/office datasets/hall --out my_laser.yaml");
  add_calibration<evaluation::SonarCalibration>(*calibrate, "sonar", "a sonar ring")
      ->footer(
          "  credo calibrate sonar datasets/room datasets/hall --out my_sonar.yaml    own recordings with true maps\n"
          "  credo calibrate sonar --worlds 40 --out default.yaml                     simulated buildings\n"
          "  credo map datasets/office --sensors sonar --model calibrated --sonar-weights my_sonar.yaml");
  add_calibration<evaluation::LaserCalibration>(*calibrate, "laser", "a range finder")
      ->footer(
          "  credo calibrate laser datasets/office datasets/hall --out my_laser.yaml  own recordings with true maps\n"
          "  credo calibrate laser --worlds 40 --seed 5001 --out default.yaml         simulated buildings\n"
          "  credo map datasets/office --sensors range --laser-model calibrated --laser-weights my_laser.yaml");
}

}  // namespace credo::apps
