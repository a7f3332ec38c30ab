// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "apps/compare.hpp"
#include "apps/interrupt.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/pipeline.hpp"
#include "apps/terminal.hpp"
#include "datasets/acquisitions.hpp"
#include "evaluation/baseline_association_table.hpp"
#include "evaluation/localization_score.hpp"

namespace credo::apps {
namespace {

using evaluation::AssociationCounts;
using nlohmann::ordered_json;

struct AssociationOptions {
  std::vector<std::string> datasets;
  OutputFormat format;
};

/// Scene after scene of one drive.
std::vector<AssociationCounts> associate(const datasets::Dataset& dataset) {
  const PipelineParams params = PipelineParams::of(perception::Method::kDefault);
  const localization::LandmarkMap map(*dataset.header.floor_plan, params.localizer.map);
  perception::Observer observer(dataset.header.rig, params.observer);
  evaluation::AssociationComparison comparison(map);
  const datasets::Acquisitions acquisitions(dataset);
  Progress progress("associating on " + dataset.header.name);
  perception::Scene before;
  std::optional<geometry::Pose2> truth_before;
  for (std::size_t i = 0; i < acquisitions.size(); ++i) {
    Interruptible::check();
    const sensors::Acquisition acquisition = acquisitions.read(i);
    const perception::Scene& now = observer.observe(acquisition);
    const auto truth = evaluation::truth_at(dataset.truth, now.time);
    if (truth_before && truth && acquisition.motion)
      comparison.add(before, *truth_before, now, *truth, *acquisition.motion);
    before = now;
    truth_before = truth;
    progress.update(static_cast<double>(i + 1) / static_cast<double>(acquisitions.size()));
  }
  return comparison.counts();
}

ordered_json json_of(const AssociationCounts& c) {
  const auto or_null = [](const std::optional<double>& value) { return value ? ordered_json(*value) : ordered_json(); };
  return {{"method", c.name},
          {"right", c.right},
          {"wrong", c.wrong},
          {"missed", c.missed},
          {"absent", c.absent},
          {"wrong_share", or_null(c.wrong_share())},
          {"recall", or_null(c.recall())}};
}

void execute(const AssociationOptions& options) {
  const Interruptible interruptible;
  std::vector<std::pair<std::string, std::vector<AssociationCounts>>> tables;
  std::vector<AssociationCounts> total;
  for (const std::string& path : options.datasets) {
    const datasets::Dataset dataset = open_comparable(path);
    if (dataset.odometry.empty()) throw std::runtime_error(path + ": the dataset has no odometry, which predicts here");
    tables.emplace_back(dataset.header.name, associate(dataset));
    if (total.empty())
      total = tables.back().second;
    else
      for (std::size_t k = 0; k < total.size(); ++k) total[k] += tables.back().second[k];
  }
  if (tables.size() > 1) tables.emplace_back("all together", total);
  if (options.format.json()) {
    ordered_json report = ordered_json::array();
    for (const auto& [name, counts] : tables) {
      ordered_json methods = ordered_json::array();
      for (const AssociationCounts& c : counts) methods.push_back(json_of(c));
      report.push_back({{"dataset", name}, {"methods", methods}});
    }
    print(report);
    return;
  }
  for (const auto& [name, counts] : tables) std::printf("%s\n%s\n", name.c_str(), evaluation::to_text(counts).c_str());
  std::printf("%s", evaluation::association_table_terms().c_str());
}

}  // namespace

void add_compare_association(CLI::App& compare) {
  CLI::App* command = compare.add_subcommand(
      "association", "Who is who: nearest neighbours, JPDA and Credo on the same predictions and azimuths.");
  command->footer(
      "  credo compare association datasets/office\n"
      "  credo compare association datasets/office datasets/hall --format json");
  auto options = std::make_shared<AssociationOptions>();
  command->add_option("DATASET", options->datasets, "folders with a floor plan, odometry and a ground truth")
      ->check(a_path())
      ->required();
  add_format_option(*command, options->format);
  command->callback([options] { execute(*options); });
}

}  // namespace credo::apps
