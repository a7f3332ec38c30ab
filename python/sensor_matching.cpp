// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/sensor_matching.hpp"

#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::BinaryMass;
using evidence::GridMass;
using evidence::Matching;

constexpr std::array<std::pair<std::string_view, Matching>, 2> kMatchings{
    {{"pignistic", Matching::kPignistic}, {"plausibility", Matching::kPlausibility}}};

Matching matching_of(const std::string& word) { return chosen(word, "matching", kMatchings); }

using AnyMass = std::variant<BinaryMass, GridMass>;

double probability_of(const AnyMass& mass, const std::string& matching) {
  return std::visit([&](const auto& m) { return evidence::matched_probability(m, matching_of(matching)); }, mass);
}

double log_odds_of(const AnyMass& mass, const std::string& matching) {
  return std::visit([&](const auto& m) { return evidence::matched_log_odds(m, matching_of(matching)); }, mass);
}

void bind_grid_masses_with(py::module_& module) {
  module.def(
      "grid_mass_with",
      [](double probability, double unknown, double conflict, const std::string& matching) {
        return evidence::grid_mass_with(probability, unknown, conflict, matching_of(matching));
      },
      py::arg("probability"), py::arg("unknown"), py::arg("conflict"), py::arg("matching"),
      R"(grid_mass_with(probability, unknown, conflict, matching)
--

The GridMass with this probability of occupied and these masses. ValueError as mass_with, and unless the conflict is in
[0, 1).)");
  module.def(
      "most_unknown_grid_mass_with",
      [](double probability, double conflict, const std::string& matching) {
        return evidence::most_unknown_grid_mass_with(probability, conflict, matching_of(matching));
      },
      py::arg("probability"), py::arg("conflict"), py::arg("matching"),
      "most_unknown_grid_mass_with(probability, conflict, matching)\n--\n\nThe least committed GridMass with these.");
}

}  // namespace

void bind_sensor_matching(py::module_& module) {
  module.def("matched_probability", probability_of, py::arg("mass"), py::arg("matching"),
             R"(matched_probability(mass, matching)
--

The probability of YES, or of occupied, that stands for a BinaryMass or a GridMass: what a Bayes filter is told, so that
rules are compared on readings that say the same.

matching: "pignistic" (BetP) or "plausibility" (the plausibilities divided by their sum, on which Dempster's and Bayes'
rule agree after any number of readings; Cobb and Shenoy 2006). ValueError at total conflict.)");
  module.def("matched_log_odds", log_odds_of, py::arg("mass"), py::arg("matching"),
             R"(matched_log_odds(mass, matching)
--

ln(p / (1 - p)) of that probability, exact also near certainty; infinite if all mass is on one side.

>>> round(matched_log_odds(BinaryMass(0.5, 0.1), "plausibility"), 4)
0.5878)");
  module.def(
      "largest_unknown_with",
      [](double probability, const std::string& matching) {
        return evidence::largest_unknown_with(probability, matching_of(matching));
      },
      py::arg("probability"), py::arg("matching"), R"(largest_unknown_with(probability, matching)
--

The largest mass of Θ that a mass with this probability can have. ValueError unless the probability is in [0, 1].)");
  module.def(
      "mass_with",
      [](double probability, double unknown, const std::string& matching) {
        return evidence::mass_with(probability, unknown, matching_of(matching));
      },
      py::arg("probability"), py::arg("unknown"), py::arg("matching"), R"(mass_with(probability, unknown, matching)
--

The BinaryMass with this probability of YES and this mass of Θ. ValueError unless `unknown` is in
[0, largest_unknown_with(probability, matching)].)");
  module.def(
      "most_unknown_with",
      [](double probability, const std::string& matching) {
        return evidence::most_unknown_with(probability, matching_of(matching));
      },
      py::arg("probability"), py::arg("matching"),
      "most_unknown_with(probability, matching)\n--\n\nThe least committed BinaryMass with this probability of YES.");
  bind_grid_masses_with(module);
}

}  // namespace credo::python
