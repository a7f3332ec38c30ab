// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "apps/commands.hpp"
#include "apps/terminal.hpp"

namespace {

constexpr int kUserError = 1;
constexpr int kUsageError = 2;

/// Help that starts with the examples (kept in the footer).
class ExamplesFirst : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override {
    const std::string examples = app->get_footer().empty() ? "" : "Examples:\n" + app->get_footer() + "\n\n";
    return examples + CLI::Formatter::make_description(app);
  }
  std::string make_footer(const CLI::App*) const override { return ""; }
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Know where the robot is - and whether to believe it.", "credo");
  app.formatter(std::make_shared<ExamplesFirst>());
  app.set_version_flag("--version", "credo " CREDO_VERSION);
  app.require_subcommand(1);
  app.footer(
      "  credo demo                                   simulate, run, map, evaluate, draw: the whole job in one go\n"
      "  credo run DATASET --out results/first        localize and map a recorded drive\n"
      "  credo evaluate score DATASET results/first   compare with the truth\n"
      "  credo run --help                             more examples of a sub-command");
  try {
    credo::apps::add_demo(app);
    credo::apps::add_simulate(app);
    credo::apps::add_run(app);
    credo::apps::add_map(app);
    credo::apps::add_evaluate(app);
    credo::apps::add_info(app);
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    credo::apps::say_error(std::string(error.what()) + "\ncredo: `credo --help` and `credo SUBCOMMAND --help` show examples");
    return kUsageError;
  } catch (const std::exception& error) {
    credo::apps::say_error(error.what());
    return kUserError;
  }
}
