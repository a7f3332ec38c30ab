// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/usage_hint.hpp"

#include <algorithm>
#include <vector>

#include "datasets/nearest_word.hpp"

namespace credo::apps {
namespace {

std::vector<std::string> sub_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands(nullptr)) names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> long_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string listed(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return list;
}

/// Empty if `word` is one of `known`.
std::string hint(const char* what, const std::string& word, const std::vector<std::string>& known,
                 const CLI::App& app) {
  if (std::find(known.begin(), known.end(), word) != known.end()) return "";
  const auto nearest = datasets::nearest_word(word, known);
  return std::string("unknown ") + what + " '" + word + "' of " + app.get_display_name() +
         (nearest ? "; did you mean '" + *nearest + "'?" : "; there are: " + listed(known));
}

}  // namespace

std::string usage_hint(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* at = &app;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--") break;
    const std::vector<std::string> subs = sub_commands(*at);
    std::string found;
    if (word.starts_with("--"))
      found = hint("option", word.substr(0, word.find('=')), long_options(*at), *at);
    else if (!word.starts_with("-") && !subs.empty())
      found = hint("sub-command", word, subs, *at);
    if (!found.empty()) return found;
    if (!word.starts_with("-") && !subs.empty()) at = at->get_subcommand(word);
  }
  return "";
}

}  // namespace credo::apps
