// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "datasets/dataset.hpp"
#include "results/localization_table.hpp"

// The parts of `credo evaluate`.
namespace credo::apps {

void add_evaluate_trajectories(CLI::App& evaluate);  ///< ape, rpe, traj
void add_evaluate_localization(CLI::App& evaluate);  ///< score
void add_evaluate_integrity(CLI::App& evaluate);     ///< integrity, nees
void add_evaluate_map(CLI::App& evaluate);           ///< map

/// The localization.csv of a results folder, or the file itself.
[[nodiscard]] std::vector<results::LocalizationRow> read_rows(const std::filesystem::path& path);

/// True poses with what is known to have happened.
struct Truth {
  std::vector<datasets::TimedPose> poses;
  std::optional<std::vector<datasets::Event>> events;  ///< of a dataset that records them
};

/// The ground truth of a dataset, or any trajectory file. \throws std::runtime_error if there is none
[[nodiscard]] Truth read_truth(const std::filesystem::path& path);

}  // namespace credo::apps
