// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/gates.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/option_checks.hpp"

namespace credo::apps {
namespace {

/// NAME=VALUE
struct Gate {
  std::string name;
  double limit = 0.0;
};

std::optional<Gate> parse_gate(const std::string& text, const std::vector<std::string>& names) {
  const std::size_t cut = text.find('=');
  if (cut == std::string::npos) return std::nullopt;
  Gate gate{.name = text.substr(0, cut)};
  if (std::find(names.begin(), names.end(), gate.name) == names.end()) return std::nullopt;
  if (!parse(text.substr(cut + 1), gate.limit) || !std::isfinite(gate.limit)) return std::nullopt;
  return gate;
}

CLI::Validator a_gate(const std::vector<std::string>& names) {
  return CLI::Validator(
      [names](const std::string& text) -> std::string {
        if (parse_gate(text, names)) return "";
        return fmt::format("expected STATISTIC=VALUE with one of {} and a finite number, found '{}'",
                           fmt::join(names, ", "), text);
      },
      "");
}

template <typename Passes>
void require_passed(const std::string& option, const std::vector<std::string>& gates,
                    const std::vector<GatedValue>& figures, const Passes& passes) {
  std::vector<std::string> names;
  for (const GatedValue& figure : figures) names.push_back(figure.name);
  for (const std::string& text : gates) {
    const Gate gate = parse_gate(text, names).value();
    const GatedValue& figure =
        *std::find_if(figures.begin(), figures.end(), [&](const GatedValue& f) { return f.name == gate.name; });
    if (figure.value && passes(*figure.value, gate.limit)) continue;
    throw std::runtime_error(fmt::format("{} {}: {} is {}", option, text, gate.name,
                                         figure.value ? fmt::format("{:.6f}", *figure.value) : "not known"));
  }
}

}  // namespace

void add_fail_above(CLI::App& command, Gates& gates, const std::vector<std::string>& names,
                    const std::string& example) {
  command
      .add_option("--fail_above", gates.above, "STATISTIC=VALUE: exit with an error if it is above, e.g. " + example)
      ->check(a_gate(names));
}

void add_fail_below(CLI::App& command, Gates& gates, const std::vector<std::string>& names,
                    const std::string& example) {
  command
      .add_option("--fail_below", gates.below, "STATISTIC=VALUE: exit with an error if it is below, e.g. " + example)
      ->check(a_gate(names));
}

void require_passed(const Gates& gates, const std::vector<GatedValue>& figures) {
  require_passed("--fail_above", gates.above, figures, [](double value, double limit) { return value <= limit; });
  require_passed("--fail_below", gates.below, figures, [](double value, double limit) { return value >= limit; });
}

}  // namespace credo::apps
