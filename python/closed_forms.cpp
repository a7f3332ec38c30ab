// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>

#include "evidence/binary_rules.hpp"
#include "evidence/grid_rules.hpp"
#include "evidence/rules.hpp"
#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::BinaryMass;
using evidence::FusedBinaryMass;
using evidence::GridMass;
using evidence::OpenBinaryMass;
namespace rule = evidence::rule;

// A rule on masses of one type.
template <typename Mass>
struct ClosedForm {
  std::string_view rule;
  py::object (*combine)(const std::vector<Mass>& sources);
};

using Binary = const std::vector<BinaryMass>&;
constexpr std::array<ClosedForm<BinaryMass>, 12> kBinaryForms{{
    {rule::Conjunctive::kName, [](Binary s) { return py::cast(evidence::conjunctive(s)); }},
    {rule::Dempster::kName, [](Binary s) { return py::cast(evidence::dempster(s)); }},
    {rule::Disjunctive::kName,
     [](Binary s) {
       return py::cast(FusedBinaryMass{evidence::disjunctive(s), 0.0});
     }},
    {rule::ConflictToIgnorance::kName, [](Binary s) { return py::cast(evidence::conflict_to_ignorance(s)); }},
    {rule::DuboisPrade::kName, [](Binary s) { return py::cast(evidence::conflict_to_ignorance(s)); }},
    {rule::Dsmh::kName, [](Binary s) { return py::cast(evidence::conflict_to_ignorance(s)); }},
    {rule::Pcr2::kName, [](Binary s) { return py::cast(evidence::pcr2(s)); }},
    {rule::Pcr5::kName, [](Binary s) { return py::cast(without_gil([&] { return evidence::pcr5(s); })); }},
    {rule::Pcr6::kName, [](Binary s) { return py::cast(evidence::pcr6(s)); }},
    {rule::Cautious::kName, [](Binary s) { return py::cast(evidence::cautious(s)); }},
    {rule::Average::kName,
     [](Binary s) {
       return py::cast(FusedBinaryMass{evidence::average(s), 0.0});
     }},
    {rule::Murphy::kName, [](Binary s) { return py::cast(evidence::murphy(s)); }},
}};

using Open = const std::vector<OpenBinaryMass>&;
constexpr std::array<ClosedForm<OpenBinaryMass>, 2> kOpenForms{{
    {rule::Cautious::kName, [](Open s) { return py::cast(evidence::cautious(std::span<const OpenBinaryMass>(s))); }},
    {rule::Bold::kName, [](Open s) { return py::cast(evidence::bold(s)); }},
}};

using Grid = const std::vector<GridMass>&;
py::object pcr_of_cells(Grid sources) {
  if (sources.size() == 2) return py::cast(evidence::pcr5(sources[0], sources[1]));
  throw std::invalid_argument("PCR5 and PCR6 of grid masses are of two sources; got " + std::to_string(sources.size()) +
                              ": fold them, and mind the order");
}
constexpr std::array<ClosedForm<GridMass>, 9> kGridForms{{
    {rule::Conjunctive::kName, [](Grid s) { return py::cast(evidence::dsmc(s)); }},
    {rule::Dempster::kName, [](Grid s) { return py::cast(evidence::dempster(s)); }},
    {rule::Disjunctive::kName, [](Grid s) { return py::cast(evidence::disjunctive(s)); }},
    {rule::ConflictToIgnorance::kName, [](Grid s) { return py::cast(evidence::conflict_to_ignorance(s)); }},
    {rule::Dsmh::kName, [](Grid s) { return py::cast(evidence::dsmh(s)); }},
    {rule::Pcr2::kName, [](Grid s) { return py::cast(evidence::pcr2(s)); }},
    {rule::Pcr5::kName, pcr_of_cells},
    {rule::Pcr6::kName, pcr_of_cells},
    {rule::Average::kName, [](Grid s) { return py::cast(evidence::average(s)); }},
}};

template <typename Mass, std::size_t N>
py::object combined_by(const std::array<ClosedForm<Mass>, N>& forms, std::string_view rule,
                       const std::vector<Mass>& sources, const char* kind) {
  const auto found = std::ranges::find(forms, rule, &ClosedForm<Mass>::rule);
  if (found == forms.end()) throw py::type_error(std::string(rule) + " is not defined for " + kind);
  return found->combine(sources);
}

template <typename Mass>
bool any_is(const py::list& sources) {
  return std::any_of(sources.begin(), sources.end(),
                     [](const py::handle source) { return py::isinstance<Mass>(source); });
}

// A mass without conflict is one with none.
std::vector<OpenBinaryMass> open_masses(const py::list& sources) {
  py::list open;
  for (const py::handle source : sources) {
    if (py::isinstance<BinaryMass>(source)) {
      open.append(opened(source.cast<BinaryMass>()));
    } else {
      open.append(source);
    }
  }
  return sources_of<OpenBinaryMass>(open, "OpenBinaryMass or BinaryMass, as one is");
}

}  // namespace

OpenBinaryMass opened(const BinaryMass& mass) { return {mass.yes, mass.no, mass.unknown, 0.0}; }

std::vector<BinaryMass> binary_masses(const py::list& sources) {
  return sources_of<BinaryMass>(sources, "BinaryMass, as the first is");
}

bool are_binary(const py::list& sources) { return !sources.empty() && py::isinstance<BinaryMass>(sources[0]); }

std::optional<py::object> in_closed_form(std::string_view rule, const py::list& sources) {
  if (any_is<OpenBinaryMass>(sources)) {
    return combined_by(kOpenForms, rule, open_masses(sources), "masses that hold conflict");
  }
  if (are_binary(sources)) {
    return combined_by(kBinaryForms, rule, binary_masses(sources), "binary masses: they have no mass on ∅");
  }
  if (any_is<GridMass>(sources)) {
    return combined_by(kGridForms, rule, sources_of<GridMass>(sources, "GridMass, as one is"), "grid masses");
  }
  return std::nullopt;
}

}  // namespace credo::python
