// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/reproduce.hpp"

#include "apps/commands.hpp"

namespace credo::apps {

void add_reproduce(CLI::App& app) {
  CLI::App* reproduce = app.add_subcommand("reproduce", "Repeats the experiment of a paper, its numbers beside ours.");
  reproduce->footer(
      "  credo reproduce clerentin              localization by tracked landmarks at the end of a corridor\n"
      "  credo reproduce sonar                  a map by DSmT against one by DST\n"
      "  credo reproduce clerentin --help       more examples");
  reproduce->require_subcommand(1);
  add_reproduce_clerentin(*reproduce);
  add_reproduce_maps(*reproduce);
}

}  // namespace credo::apps
