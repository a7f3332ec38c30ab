// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>

// One function for each paper whose experiment can be repeated, in a file of its own: it adds the paper's name to
// `credo reproduce`.
namespace credo::apps {

void add_reproduce_clerentin(CLI::App& reproduce);
/// The experiments of the four mapping papers.
void add_reproduce_maps(CLI::App& reproduce);

}  // namespace credo::apps
