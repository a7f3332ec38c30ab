// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/evaluate.hpp"

#include <algorithm>
#include <stdexcept>

#include "apps/commands.hpp"
#include "evaluation/trajectory.hpp"

namespace credo::apps {

namespace fs = std::filesystem;

std::vector<results::LocalizationRow> read_rows(const fs::path& path) {
  return results::read_localization(fs::is_directory(path) ? path / "localization.csv" : path);
}

Truth read_truth(const fs::path& path) {
  if (datasets::Dataset::is_dataset(path)) {
    datasets::Dataset dataset = datasets::Dataset::open(path);
    if (dataset.truth.empty())
      throw std::runtime_error(path.string() + ": the dataset has no ground truth (groundtruth0)");
    Truth truth{std::move(dataset.truth), {}};
    if (dataset.events_recorded) truth.events = std::move(dataset.events);
    return truth;
  }
  const evaluation::Trajectory trajectory = evaluation::read_trajectory(path);
  if (!trajectory.timed) {
    throw std::runtime_error(path.string() + ": these poses have no times: nothing can be compared with them");
  }
  Truth truth;
  for (const evaluation::StampedPose& pose : trajectory.poses) {
    truth.poses.push_back({pose.time, evaluation::flatten(pose)});
  }
  std::stable_sort(truth.poses.begin(), truth.poses.end(),
                   [](const datasets::TimedPose& a, const datasets::TimedPose& b) { return a.time < b.time; });
  return truth;
}

void add_evaluate(CLI::App& app) {
  CLI::App* evaluate = app.add_subcommand("evaluate", "Compares results with the truth; names and numbers as evo's.");
  evaluate->footer(
      "  credo evaluate score datasets/office results/office            position, heading, belief: one table\n"
      "  credo evaluate ape datasets/office results/office              absolute pose error\n"
      "  credo evaluate rpe groundtruth.tum trajectory.tum -d 1 -u m    relative pose error over metres\n"
      "  credo evaluate integrity --runs runs.txt                       does it know when it is lost? many runs\n"
      "  credo evaluate nees datasets/a results/a datasets/b results/b  consistency over independent runs\n"
      "  credo evaluate map datasets/office results/office              map accuracy");
  evaluate->require_subcommand(1);
  add_evaluate_localization(*evaluate);
  add_evaluate_integrity(*evaluate);
  add_evaluate_trajectories(*evaluate);
  add_evaluate_map(*evaluate);
}

}  // namespace credo::apps
