// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <string>

#include "apps/commands.hpp"
#include "apps/interrupt.hpp"
#include "apps/terminal.hpp"
#include "apps/usage_hint.hpp"

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

// NOLINTNEXTLINE(bugprone-exception-escape): only a lack of memory passes what is caught below
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
    credo::apps::add_campaign(app);
    credo::apps::add_calibrate(app);
    credo::apps::add_compare(app);
    credo::apps::add_plan(app);
    credo::apps::add_cell(app);
    credo::apps::add_export(app);
    credo::apps::add_info(app);
    credo::apps::add_reproduce(app);
    app.parse(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return 0;
    credo::apps::say_error("standard output cannot be written: is the disk full?");
    return kUserError;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    const std::string hint = credo::apps::usage_hint(app, argc, argv);
    credo::apps::say_error((hint.empty() ? error.what() : hint) +
                           "\ncredo: `credo --help` and `credo SUBCOMMAND --help` show examples");
    return kUsageError;
  } catch (const credo::apps::Interrupted& interrupted) {
    credo::apps::say_error(interrupted.what());
    return 128 + interrupted.signal();
  } catch (const std::filesystem::filesystem_error& error) {
    credo::apps::say_error(error.path1().string() + ": cannot be read or written: " + error.code().message());
    return kUserError;
  } catch (const std::bad_alloc&) {
    credo::apps::say_error(
        "out of memory: a coarser --resolution or a shorter drive needs less, and credo map with --large, which judges "
        "no "
        "instruments");
    return kUserError;
  } catch (const std::exception& error) {
    credo::apps::say_error(error.what());
    return kUserError;
  }
}
