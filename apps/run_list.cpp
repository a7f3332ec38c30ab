// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/run_list.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "apps/option_checks.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

void read_list(const fs::path& file, std::vector<RunFiles>& runs) {
  std::ifstream in(file);
  if (!in || fs::is_directory(file))
    throw std::runtime_error(file.string() + ": cannot be read: expected a list of runs");
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string reference, result, more;
    if (!(words >> reference)) continue;
    if (!(words >> result) || words >> more)
      throw std::runtime_error(
          fmt::format("{}:{}: expected a reference and a result, found '{}'", file.string(), number, line));
    runs.push_back({file.parent_path() / reference, file.parent_path() / result});
  }
}

}  // namespace

void add_run_options(CLI::App& command, RunPaths& paths) {
  command.add_option("REF RESULT ...", paths.pairs, "dataset (or trajectory) and results, once for each run")
      ->check(a_path());
  command.add_option("--runs", paths.list, "a file with REF RESULT in each line, relative to it; # begins a comment")
      ->check(a_path());
}

std::vector<RunFiles> run_files(const RunPaths& paths, const std::string& command) {
  if (paths.pairs.size() % 2 != 0)
    throw CLI::ValidationError(command, "expected REF RESULT pairs, found an odd number of paths");
  std::vector<RunFiles> runs;
  for (std::size_t i = 0; i < paths.pairs.size(); i += 2) runs.push_back({paths.pairs[i], paths.pairs[i + 1]});
  if (!paths.list.empty()) read_list(paths.list, runs);
  if (runs.empty()) {
    if (!paths.list.empty()) throw std::runtime_error(paths.list + ": lists no run");
    throw CLI::ValidationError(command, "expected REF RESULT pairs, or --runs LIST");
  }
  return runs;
}

}  // namespace credo::apps
