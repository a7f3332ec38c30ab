// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>

// One function for each sub-command, in a file of its own: it adds the sub-command and what it does to `app`. What goes
// wrong is thrown; main says it and sets the exit status.
namespace credo::apps {

void add_demo(CLI::App& app);
void add_simulate(CLI::App& app);
void add_run(CLI::App& app);
void add_map(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_campaign(CLI::App& app);
void add_calibrate(CLI::App& app);
void add_compare(CLI::App& app);
void add_plan(CLI::App& app);
void add_cell(CLI::App& app);
void add_export(CLI::App& app);
void add_info(CLI::App& app);
void add_reproduce(CLI::App& app);

}  // namespace credo::apps
