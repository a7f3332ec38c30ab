// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/mass_function.hpp"

#include <sstream>

#include "evidence/generalized_bayes.hpp"
#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::Focal;
using evidence::FocalSum;
using evidence::Frame;
using evidence::Fused;
using evidence::MassFunction;
using evidence::Proposition;

// From a mapping, or from pairs as its items().
std::vector<Focal> focals_from(const Frame& frame, const py::object& masses) {
  std::vector<Focal> focals;
  for (const py::handle item : py::hasattr(masses, "items") ? masses.attr("items")() : masses) {
    std::pair<SetLike, double> pair;
    try {
      pair = item.cast<std::pair<SetLike, double>>();
    } catch (const py::cast_error&) {
      throw py::type_error("masses are given as {proposition or its text: number}; got " + std::string(py::repr(item)));
    }
    focals.push_back({resolved(frame, pair.first), pair.second});
  }
  return focals;
}

// The focal elements as they are in the model: all that constraints empty is ∅.
std::vector<std::pair<NamedProposition, double>> items_of(const MassFunction& mass) {
  FocalSum sum;
  for (const Focal& focal : mass.focals()) {
    const bool nothing = mass.frame().existing(focal.set).empty();
    sum.add(nothing ? Proposition() : focal.set, focal.mass);
  }
  std::vector<std::pair<NamedProposition, double>> items;
  for (const Focal& term : sum.terms()) items.push_back({{mass.frame(), term.set}, term.mass});
  return items;
}

py::list keys_of(const MassFunction& mass) {
  py::list keys;
  for (const auto& [set, value] : items_of(mass)) keys.append(set);
  return keys;
}

py::list values_of(const MassFunction& mass) {
  py::list values;
  for (const auto& [set, value] : items_of(mass)) values.append(value);
  return values;
}

std::vector<std::pair<NamedProposition, double>> focals_of(const MassFunction& mass) {
  std::vector<std::pair<NamedProposition, double>> focals;
  for (const Focal& focal : mass.focals()) focals.push_back({{mass.frame(), focal.set}, focal.mass});
  return focals;
}

std::string mass_repr(const MassFunction& mass) {
  py::dict masses;
  for (const auto& [set, value] : items_of(mass)) masses[py::str(set.frame.to_string(set.set))] = value;
  return "MassFunction(" + std::string(py::repr(masses)) + ")";
}

void bind_mass_making(py::class_<MassFunction>& mass_function) {
  mass_function
      .def(py::init([](const Frame& frame, const py::object& masses) {
             return MassFunction(frame, std::span<const Focal>(focals_from(frame, masses)));
           }),
           py::arg("frame"), py::arg("masses"), R"(__init__(self, frame, masses)
--

From a mapping of propositions (or their text) to masses, or from such pairs; what is named twice is added up, zeros
are left out. Sums that differ from 1 by no more than 1e-9 are divided out.

ValueError for a mass that is nan, negative or over 1, a sum other than 1, a proposition of another frame.)")
      .def_static(
          "with_rest_unknown",
          [](const Frame& frame, const py::object& masses) {
            return MassFunction::with_rest_unknown(frame, std::span<const Focal>(focals_from(frame, masses)));
          },
          py::arg("frame"), py::arg("masses"),
          "with_rest_unknown(frame, masses)\n--\n\nThe rest to 1 goes to Θ. ValueError as the constructor, but for a "
          "sum below 1.");
}

void bind_special_kinds(py::class_<MassFunction>& mass_function) {
  mass_function
      .def_static("vacuous", &MassFunction::vacuous, py::arg("frame"),
                  "vacuous(frame)\n--\n\nAll mass on Θ: total ignorance.")
      .def_static(
          "categorical",
          [](const Frame& frame, const SetLike& set) { return MassFunction::categorical(frame, resolved(frame, set)); },
          py::arg("frame"), py::arg("set"), "categorical(frame, set)\n--\n\nAll mass on one proposition.")
      .def_static(
          "simple_support",
          [](const Frame& frame, const SetLike& set, double mass) {
            return MassFunction::simple_support(frame, resolved(frame, set), mass);
          },
          py::arg("frame"), py::arg("set"), py::arg("mass"),
          "simple_support(frame, set, mass)\n--\n\n`mass` in [0, 1] on one proposition, the rest on Θ.");
}

void bind_masses_of_elements(py::class_<MassFunction>& mass_function) {
  mass_function
      .def_static(
          "bayesian",
          [](const Frame& frame, const Array& probabilities) {
            return MassFunction::bayesian(frame, numbers(probabilities, "probabilities"));
          },
          py::arg("frame"), py::arg("probabilities"),
          "bayesian(frame, probabilities)\n--\n\nOne mass for each element. Power sets only; shape (n,), sum 1.")
      .def_static(
          "consonant",
          [](const Frame& frame, const Array& contour) {
            return MassFunction::consonant(frame, numbers(contour, "contour"));
          },
          py::arg("frame"), py::arg("contour"), R"(consonant(frame, contour)
--

Nested focal elements whose plausibilities of the elements are these, a possibility distribution. Power sets only.

contour: shape (n,), each in [0, 1], the largest 1.)")
      .def_static(
          "generalized_bayes",
          [](const Frame& frame, const Array& plausibilities) {
            const std::span<const double> given = numbers(plausibilities, "plausibilities");
            return without_gil([&] { return evidence::generalized_bayes(frame, given); });
          },
          py::arg("frame"), py::arg("plausibilities"), R"(generalized_bayes(frame, plausibilities)
--

What an observation says about the elements, given how plausible it is where each of them is the truth; no prior is
needed (generalized Bayesian theorem; Smets 1993). m(∅) says how little it fits any of them; Dempster's rule with a
Bayesian prior makes it Bayes' theorem. Power sets of up to 20 elements.

plausibilities: shape (n,), each in [0, 1]. ValueError for others.

>>> weather = Frame.shafer(["rain", "sun"])
>>> wet_street = MassFunction.generalized_bayes(weather, [1.0, 0.25])
>>> dict(zip(map(str, wet_street), wet_street.values()))
{'rain': 0.75, 'Θ': 0.25})");
}

void bind_mass_mapping(py::class_<MassFunction>& mass_function) {
  mass_function
      .def("__getitem__",
           [](const MassFunction& self, const SetLike& set) { return self.mass(resolved(self.frame(), set)); })
      .def("__contains__",
           [](const MassFunction& self, const SetLike& set) { return self.mass(resolved(self.frame(), set)) > 0.0; })
      .def("__iter__", [](const MassFunction& self) { return py::iter(keys_of(self)); })
      .def("__len__", [](const MassFunction& self) { return items_of(self).size(); })
      .def("keys", keys_of, "keys(self)\n--\n\nThe focal elements, ordered by their regions.")
      .def("values", values_of, "values(self)\n--\n\nTheir masses, all > 0.")
      .def("items", items_of, "items(self)\n--\n\nPairs of the two.")
      .def_property_readonly("focals", focals_of, R"(Pairs of proposition and mass, in the forms in which they are kept.

They are the items, but on a hybrid model: there what a constraint empties keeps its form, which DSmH and PCR2 look
at, and is an item ∅ all together.)");
}

void bind_mass_properties(py::class_<MassFunction>& mass_function) {
  mass_function
      .def_property_readonly(
          "frame", [](const MassFunction& self) { return self.frame(); }, "What it is on.")
      .def_property_readonly("conflict", &MassFunction::conflict, "m(∅).")
      .def_property_readonly("is_normal", &MassFunction::is_normal, "Nothing on ∅.")
      .def_property_readonly("is_dogmatic", &MassFunction::is_dogmatic, "Nothing on Θ.")
      .def_property_readonly("is_vacuous", &MassFunction::is_vacuous, "All on Θ.")
      .def_property_readonly("is_categorical", &MassFunction::is_categorical, "All on one proposition.")
      .def_property_readonly("is_bayesian", &MassFunction::is_bayesian, "All on single Venn regions.")
      .def_property_readonly("is_consonant", &MassFunction::is_consonant, "The focal elements are nested.");
}

}  // namespace

void bind_mass_functions(py::module_& module) {
  py::class_<MassFunction> mass_function(module, "MassFunction",
                                         R"(A mass function (basic belief assignment) on a frame of any model.

A value: it never changes, all masses are > 0 and sum to 1; mass on ∅ is allowed (the open world of the TBM). Reads as
a mapping from its focal elements; `m[set]` is 0 for what is none.

>>> frame = Frame.shafer(["A", "B"])
>>> m = MassFunction(frame, {"A": 0.6, "A ∪ B": 0.4})
>>> m["A"], m["B"], [str(set) for set in m]
(0.6, 0.0, ['A', 'Θ']))");
  bind_mass_making(mass_function);
  bind_special_kinds(mass_function);
  bind_masses_of_elements(mass_function);
  bind_mass_mapping(mass_function);
  bind_mass_properties(mass_function);
  bind_fused<Fused>(module, "Fused",
                    R"(A mass function and the conflict that was met (and moved or divided out) on the way.

Unpacks: `mass, conflict = dempster(a, b)`.)");
  bind_readouts(mass_function, module);
  bind_utility(mass_function, module);
  bind_dense(mass_function, module);
  mass_function.def(py::self == py::self)
      .def("__repr__", mass_repr)
      .def("__str__",
           [](const MassFunction& self) {
             std::ostringstream text;
             text << self;
             return text.str();
           })
      .def(py::pickle([](const MassFunction& self) { return py::make_tuple(self.frame(), focals_of(self)); },
                      [](const py::tuple& state) {
                        std::vector<Focal> focals;
                        for (const auto& [set, mass] :
                             state[1].cast<std::vector<std::pair<NamedProposition, double>>>()) {
                          focals.push_back({set.set, mass});
                        }
                        return MassFunction::restored(state[0].cast<Frame>(), focals);
                      }));
}

}  // namespace credo::python
