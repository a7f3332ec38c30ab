// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/open_world.hpp"

#include <optional>

#include "evidence/plausible_relation.hpp"
#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::BinaryMass;
using evidence::MatchDecision;
using evidence::OpenWorldDecision;
using evidence::OpenWorldMasses;
using evidence::OpenWorldMatcher;
using evidence::OpenWorldValues;
using evidence::Relation;

// The masses of an array (..., 3) of so many dimensions: m(YES), m(NO), m(Θ) of each, one after the other.
// \throws std::invalid_argument, naming the one that is no mass, and for another shape
std::vector<BinaryMass> triplets_from(const Array& evidence, py::ssize_t dimensions, const char* shape) {
  if (evidence.ndim() != dimensions || evidence.shape(dimensions - 1) != 3) {
    throw std::invalid_argument(std::string("evidence must have the shape ") + shape +
                                ": what speaks for, against and for neither; got " + shape_text(evidence));
  }
  std::vector<BinaryMass> masses;
  const double* const values = evidence.data();
  for (py::ssize_t i = 0; i < evidence.size(); i += 3) {
    const BinaryMass mass{values[i], values[i + 1], values[i + 2]};
    const double sum = mass.yes + mass.no + mass.unknown;
    if (!(mass.yes >= 0.0 && mass.no >= 0.0 && mass.unknown >= 0.0 &&
          std::abs(sum - 1.0) <= evidence::kMassTolerance)) {
      throw std::invalid_argument(
          "mass " + std::to_string(i / 3) + " of the evidence is none: " + std::to_string(mass.yes) + ", " +
          std::to_string(mass.no) + ", " + std::to_string(mass.unknown) + " must be >= 0 and sum to 1");
    }
    masses.push_back(mass);
  }
  return masses;
}

// About one prediction; [] is no candidate.
std::vector<BinaryMass> candidates_from(const Array& evidence) {
  if (evidence.ndim() == 1 && evidence.size() == 0) return {};
  return triplets_from(evidence, 2, "(p, 3)");
}

std::optional<Relation> relation_of(const Array& evidence) {
  const std::vector<BinaryMass> masses = triplets_from(evidence, 3, "(rows, columns, 3)");
  const auto rows = static_cast<std::size_t>(evidence.shape(0)), columns = static_cast<std::size_t>(evidence.shape(1));
  return without_gil([&] { return evidence::most_plausible_relation(masses, rows, columns); });
}

py::list columns_of(const Relation& relation) {
  py::list columns;
  for (const int column : relation.column_of_row)
    columns.append(column < 0 ? py::object(py::none()) : py::cast(column));
  return columns;
}

OpenWorldMatcher matcher_of(const Array& evidence) {
  OpenWorldMatcher matcher;
  matcher.combine(candidates_from(evidence));
  return matcher;
}

// What there is but at total conflict.
template <typename Value, const Value& (OpenWorldMatcher::*kRead)()>
std::optional<Value> unless_conflict(OpenWorldMatcher& self) {
  if (self.total_conflict()) return std::nullopt;
  return (self.*kRead)();
}

const char* word_for(MatchDecision decision) {
  switch (decision) {
    case MatchDecision::kMatched: return "matched";
    case MatchDecision::kNone: return "none";
    case MatchDecision::kUndecided: break;
  }
  return "undecided";
}

std::optional<int> candidate_of(const OpenWorldDecision& decision) {
  return decision.kind == MatchDecision::kMatched ? std::optional(decision.candidate) : std::nullopt;
}

Array assignment_weights(const Array& evidence) {
  std::vector<double> weights;
  for (const BinaryMass& mass : candidates_from(evidence)) weights.push_back(evidence::assignment_weight(mass));
  return array(weights);
}

void bind_matching_results(py::module_& module) {
  py::class_<OpenWorldMasses>(module, "OpenWorldMasses", R"(Masses on the candidates and on none of them.

Disjunctions are lumped into `unknown`. All sum to 1; once normalised, without `conflict`.)")
      .def_property_readonly(
          "match", [](const OpenWorldMasses& self) { return array(self.match); }, "m(P_i), shape (p,).")
      .def_readonly("none", &OpenWorldMasses::none, "m(*): none of the candidates.")
      .def_readonly("unknown", &OpenWorldMasses::unknown, "All disjunctions.")
      .def_readonly("conflict", &OpenWorldMasses::conflict, "Of the open combination.")
      .def("__repr__", [](const OpenWorldMasses& self) {
        return record("OpenWorldMasses", {{"match", array(self.match)},
                                          {"none", py::cast(self.none)},
                                          {"unknown", py::cast(self.unknown)},
                                          {"conflict", py::cast(self.conflict)}});
      });
  py::class_<OpenWorldValues>(module, "OpenWorldValues", "One number for each candidate and for none of them.")
      .def_property_readonly(
          "match", [](const OpenWorldValues& self) { return array(self.match); }, "Of P_i, shape (p,).")
      .def_readonly("none", &OpenWorldValues::none, "Of *.")
      .def("__repr__", [](const OpenWorldValues& self) {
        return record("OpenWorldValues", {{"match", array(self.match)}, {"none", py::cast(self.none)}});
      });
  py::class_<OpenWorldDecision>(module, "OpenWorldDecision", "What a prediction matches.")
      .def_property_readonly(
          "kind", [](const OpenWorldDecision& self) { return word_for(self.kind); },
          "\"matched\", \"none\" (it matches no candidate) or \"undecided\".")
      .def_property_readonly("candidate", candidate_of, "Of the match; None otherwise.")
      .def_readonly("value", &OpenWorldDecision::value, "Mass or pignistic probability of what leads.")
      .def_readonly("margin", &OpenWorldDecision::margin, "To the second.")
      .def("__repr__", [](const OpenWorldDecision& self) {
        return record("OpenWorldDecision", {{"kind", py::cast(word_for(self.kind))},
                                            {"candidate", py::cast(candidate_of(self))},
                                            {"value", py::cast(self.value)},
                                            {"margin", py::cast(self.margin)}});
      });
}

void bind_relation(py::module_& module) {
  py::class_<Relation>(module, "Relation", "Who is whom: at most one column for each row, one row for each column.")
      .def_property_readonly("column_of_row", columns_of, "The column of each row; None for a row alone.")
      .def_readonly("log_plausibility", &Relation::log_plausibility, R"(ln of its plausibility, before normalisation.

Π (1 - m(no)) of the pairs that are in it, Π (1 - m(yes)) of those that are not.)")
      .def("__repr__", [](const Relation& self) {
        return record("Relation",
                      {{"column_of_row", columns_of(self)}, {"log_plausibility", py::cast(self.log_plausibility)}});
      });
  module.def("most_plausible_relation", relation_of, py::arg("evidence"), R"(most_plausible_relation(evidence)
--

The Relation of largest plausibility (Denoeux, El Zoghby, Cherfaoui and Jouglet 2014): the assignment of the largest
sum of assignment_weight, in O(rows² (rows + columns)). Of equally plausible ones always the same.

evidence: shape (rows, columns, 3), for each pair m(the same), m(not the same), m(Θ), >= 0 with sum 1. None at total
conflict, where every relation contradicts a pair that is certain. ValueError for another shape, or what is no mass.

>>> most_plausible_relation([[[0.8, 0.1, 0.1], [0.9, 0.0, 0.1]], [[0.1, 0.8, 0.1], [0.7, 0.1, 0.2]]]).column_of_row
[0, 1])");
}

}  // namespace

void bind_open_world(py::module_& module) {
  bind_matching_results(module);
  bind_relation(module);
  using M = OpenWorldMatcher;
  py::class_<M>(module, "OpenWorldMatcher", R"(One prediction against p candidates, or none of them (*).

The extended open world of Clerentin et al., sec. 4.1, on the frame {P_1 .. P_p, *}, in closed form: O(p).

>>> matcher = OpenWorldMatcher([[0.8, 0.1, 0.1], [0.1, 0.7, 0.2]])
>>> matcher.decide_by_pignistic().kind, matcher.decide_by_pignistic().candidate
('matched', 0))")
      .def(py::init(&matcher_of), py::arg("evidence"), R"(__init__(self, evidence)
--

evidence: shape (p, 3), rows of m(P_i), m(not P_i), m(Θ), >= 0 with sum 1. Without candidates all mass is on *.

ValueError for another shape, or a row that is no mass.)")
      .def_property_readonly("total_conflict", &M::total_conflict, "Two candidates are certain, each for itself.")
      .def("open", &M::open, "open(self)\n--\n\nUnnormalised masses (TBM).")
      .def("normalised", unless_conflict<OpenWorldMasses, &M::normalised>,
           "normalised(self)\n--\n\nDivided by what is not in conflict. None at total conflict.")
      .def("plausibility", unless_conflict<OpenWorldValues, &M::plausibility>,
           "plausibility(self)\n--\n\nExact plausibilities, normalised. None at total conflict.")
      .def("pignistic", unless_conflict<OpenWorldValues, &M::pignistic>, R"(pignistic(self)
--

Exact pignistic probabilities, as if all disjunctions had been kept; O(p^2). None at total conflict.)")
      .def("decide_by_mass", &M::decide_by_mass, R"(decide_by_mass(self)
--

The paper's: the largest mass of {P_1 .. P_p, *}; none where the ignorance is larger; undecided at total conflict.)")
      .def("decide_by_pignistic", &M::decide_by_pignistic, py::arg("min_margin") = evidence::kMinPignisticMargin,
           R"(decide_by_pignistic(self, min_margin=0.05)
--

The largest pignistic probability; undecided where it does not lead by min_margin, and at total conflict.)");
  module.def("assignment_weight", assignment_weights, py::arg("evidence"), R"(assignment_weight(evidence)
--

ln((1 - b) / (1 - a)) of each row a, b, c, shape (p,): weight of giving that candidate to the prediction in a global
assignment where leaving it unassigned weighs 0. Evidence as OpenWorldMatcher; +inf for a = 1, -inf for b = 1.)");
}

}  // namespace credo::python
