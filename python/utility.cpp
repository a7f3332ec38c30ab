// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/utility.hpp"

#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::MassFunction;

// evidence::Decision among acts, of which none is rejected.
struct ActDecision {
  std::size_t choice;
  double value;
  double margin;

  friend bool operator==(const ActDecision&, const ActDecision&) = default;
};

ActDecision act_decision(const evidence::Decision& made) { return {made.choice, made.value, made.margin}; }

// \throws std::invalid_argument unless it has a row for each act and a column for each element
std::span<const double> utilities_of(const MassFunction& mass, const Array& utilities) {
  const std::size_t elements = mass.frame().size();
  if (utilities.ndim() != 2 || static_cast<std::size_t>(utilities.shape(1)) != elements) {
    throw std::invalid_argument("utilities must have the shape (acts, " + std::to_string(elements) + "); got " +
                                shape_text(utilities));
  }
  return {utilities.data(), static_cast<std::size_t>(utilities.size())};
}

template <double (*kExpectation)(const MassFunction&, std::span<const double>)>
double expectation(const MassFunction& self, const Array& values) {
  return kExpectation(self, numbers(values, "values"));
}

void bind_act_decision(py::module_& module) {
  py::class_<ActDecision>(module, "ActDecision", "The choice among acts.")
      .def_readonly("choice", &ActDecision::choice, "Row of the utilities; the first of equal ones.")
      .def_readonly("value", &ActDecision::value, "What is expected of it.")
      .def_readonly("margin", &ActDecision::margin, "Lead over the second; inf where there is none.")
      .def(py::self == py::self)
      .def("__repr__",
           [](const ActDecision& self) {
             return record("ActDecision", {{"choice", py::cast(self.choice)},
                                           {"value", py::cast(self.value)},
                                           {"margin", py::cast(self.margin)}});
           })
      .def(py::pickle(
          [](const ActDecision& self) { return py::make_tuple(self.choice, self.value, self.margin); },
          [](const py::tuple& state) {
            return ActDecision{state[0].cast<std::size_t>(), state[1].cast<double>(), state[2].cast<double>()};
          }));
}

void bind_expectations(py::class_<MassFunction>& mass_function) {
  mass_function
      .def("lower_expectation", expectation<evidence::lower_expectation>, py::arg("values"),
           R"(lower_expectation(self, values)
--

Σ m(A) min over A: the expectation under the worst of the probabilities that the masses allow (Dempster 1967). Power
sets only; m(∅) is divided out.

values: of each element, shape (n,), finite. ValueError for others, and at m(∅) = 1.

>>> m = MassFunction(Frame.shafer(["rain", "sun"]), {"rain": 0.25, "Θ": 0.75})
>>> m.lower_expectation([0.0, 4.0]), m.pignistic_expectation([0.0, 4.0]), m.upper_expectation([0.0, 4.0])
(0.0, 1.5, 3.0))")
      .def("upper_expectation", expectation<evidence::upper_expectation>, py::arg("values"),
           "upper_expectation(self, values)\n--\n\nΣ m(A) max over A: as lower_expectation, under the best of them.")
      .def("pignistic_expectation", expectation<evidence::pignistic_expectation>, py::arg("values"),
           "pignistic_expectation(self, values)\n--\n\nΣ m(A) mean over A: as lower_expectation, under BetP.");
}

void bind_acts(py::class_<MassFunction>& mass_function) {
  mass_function
      .def(
          "best_act",
          [](const MassFunction& self, const Array& utilities, double pessimism) {
            return act_decision(evidence::best_act(self, utilities_of(self, utilities), pessimism));
          },
          py::arg("utilities"), py::arg("pessimism"), R"(best_act(self, utilities, pessimism)
--

The act of the largest pessimism · lower + (1 - pessimism) · upper expectation (Hurwicz; Jaffray 1988): 1 is maximin,
0 maximax. An ActDecision.

utilities: shape (acts, n), what an act is worth where the truth is that element. pessimism: in [0, 1].
ValueError for others, for no act, and as lower_expectation.

>>> m = MassFunction(Frame.shafer(["rain", "sun"]), {"rain": 0.25, "Θ": 0.75})
>>> walk, stay = [0.0, 4.0], [1.0, 1.0]
>>> m.best_act([walk, stay], pessimism=1.0).choice, m.best_act([walk, stay], pessimism=0.0).choice
(1, 0))")
      .def(
          "best_act_pignistic",
          [](const MassFunction& self, const Array& utilities) {
            return act_decision(evidence::best_act_pignistic(self, utilities_of(self, utilities)));
          },
          py::arg("utilities"), R"(best_act_pignistic(self, utilities)
--

The act of the largest pignistic expectation (Smets and Kennes 1994). Utilities and errors as best_act.)")
      .def(
          "undominated_acts",
          [](const MassFunction& self, const Array& utilities) {
            return evidence::undominated_acts(self, utilities_of(self, utilities));
          },
          py::arg("utilities"), R"(undominated_acts(self, utilities)
--

The acts that no other beats for certain: whose upper expectation reaches the largest lower one. Their rows, ascending;
at least one. Utilities and errors as best_act.)");
}

}  // namespace

void bind_utility(py::class_<MassFunction>& mass_function, py::module_& module) {
  bind_act_decision(module);
  bind_expectations(mass_function);
  bind_acts(mass_function);
}

}  // namespace credo::python
