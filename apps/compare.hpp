// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "datasets/dataset.hpp"

// The parts of `credo compare`.
namespace credo::apps {

void add_compare_localizers(CLI::App& compare);
void add_compare_association(CLI::App& compare);
void add_compare_maps(CLI::App& compare);

/// A dataset with what every comparison needs. \throws std::runtime_error if it has no floor plan or no ground truth
[[nodiscard]] datasets::Dataset open_comparable(const std::string& path);

}  // namespace credo::apps
