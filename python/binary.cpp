// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <sstream>

#include "evidence/belief_shapes.hpp"
#include "evidence/binary_mass.hpp"
#include "evidence/binary_rules.hpp"
#include "evidence/mass_function.hpp"
#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::BinaryMass;
using evidence::FusedBinaryMass;
using evidence::MassFunction;
using evidence::OpenBinaryMass;
using evidence::RampBelief;

template <typename Printed>
std::string binary_text(const Printed& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string binary_repr(const BinaryMass& mass) {
  return record("BinaryMass", {{"yes", py::cast(mass.yes)}, {"no", py::cast(mass.no)}});
}

void bind_binary_mass(py::module_& module) {
  py::class_<BinaryMass> mass(module, "BinaryMass", R"(A mass function on {YES, NO}: the belief in one assertion.

Unpacks: `yes, no, unknown = mass`. Rules take it in place of MassFunction.

>>> dempster(BinaryMass(0.6, 0.1), BinaryMass(yes=0.5)).mass
BinaryMass(yes=0.7894736842105262, no=0.05263157894736842))");
  mass.def(py::init(&BinaryMass::from), py::arg("yes") = 0.0, py::arg("no") = 0.0,
           R"(__init__(self, yes=0.0, no=0.0)
--

From the two committed masses; the rest is ignorance.

ValueError unless yes >= 0, no >= 0 and yes + no <= 1 (tolerance 1e-9: what exceeds 1 is divided out).)")
      .def_static("vacuous", &BinaryMass::vacuous, "vacuous()\n--\n\nTotal ignorance.")
      .def_readonly("yes", &BinaryMass::yes, "m(YES).")
      .def_readonly("no", &BinaryMass::no, "m(NO).")
      .def_readonly("unknown", &BinaryMass::unknown, "The mass of the whole frame.")
      .def("belief", &BinaryMass::belief, "belief(self)\n--\n\nBel(YES).")
      .def("plausibility", &BinaryMass::plausibility, "plausibility(self)\n--\n\nPl(YES).")
      .def("pignistic", &BinaryMass::pignistic, "pignistic(self)\n--\n\nPignistic probability of YES.")
      .def(
          "discount",
          [](const BinaryMass& self, double reliability) { return discount(self, checked_reliability(reliability)); },
          py::arg("reliability"), R"(discount(self, reliability)
--

Committed masses times the reliability in [0, 1], the rest is ignorance (Shafer 1976).)")
      .def(
          "contextual_discount",
          [](const BinaryMass& self, double if_yes, double if_no) {
            return evidence::contextual_discount(self, checked_reliability(if_yes), checked_reliability(if_no));
          },
          py::arg("if_yes"), py::arg("if_no"), R"(contextual_discount(self, if_yes, if_no)
--

Discounting by the reliability in [0, 1] of the source where the truth is YES, and where it is NO (Mercier, Quost and
Denoeux 2008). What it says for YES is wrong only where the truth is NO, so that if_no counts there.)")
      .def(
          "to_mass_function",
          [](const BinaryMass& self, const evidence::Frame& frame) { return evidence::from_binary(frame, self); },
          py::arg("frame"), R"(to_mass_function(self, frame)
--

The same on a power set of two elements, of which the first is YES. ValueError for another frame.)")
      .def_static("from_mass_function", evidence::to_binary, py::arg("mass"), R"(from_mass_function(mass)
--

The inverse of to_mass_function. ValueError unless the mass is normal and its frame a power set of two elements.)");
  mass.def("__iter__", [](const BinaryMass& self) { return py::iter(py::make_tuple(self.yes, self.no, self.unknown)); })
      .def(py::self == py::self)
      .def("__hash__", [](const BinaryMass& self) { return py::hash(py::make_tuple(self.yes, self.no, self.unknown)); })
      .def("__str__", binary_text<BinaryMass>)
      .def("__repr__", binary_repr)
      .def(pickled(&BinaryMass::yes, &BinaryMass::no, &BinaryMass::unknown));
}

OpenBinaryMass open_mass(double yes, double no, double conflict) {
  if (!(yes >= 0.0 && no >= 0.0 && conflict >= 0.0 && yes + no + conflict <= 1.0 + evidence::kMassTolerance)) {
    throw std::invalid_argument("not a mass: yes = " + std::to_string(yes) + ", no = " + std::to_string(no) +
                                ", conflict = " + std::to_string(conflict) + "; all must be >= 0 and sum to at most 1");
  }
  const double sum = std::max(1.0, yes + no + conflict);
  return {yes / sum, no / sum, std::max(0.0, 1.0 - (yes + no + conflict)), conflict / sum};
}

void bind_binary_results(py::module_& module) {
  py::class_<OpenBinaryMass>(module, "OpenBinaryMass", R"(What the conjunctive rule leaves of binary masses (TBM).

Unpacks: `yes, no, unknown, conflict = conjunctive(a, b)`. The cautious and the bold rule take it too.)")
      .def(py::init(&open_mass), py::arg("yes") = 0.0, py::arg("no") = 0.0, py::arg("conflict") = 0.0,
           R"(__init__(self, yes=0.0, no=0.0, conflict=0.0)
--

From these masses; the rest is ignorance. ValueError unless all are >= 0 and sum to at most 1.)")
      .def_readonly("yes", &OpenBinaryMass::yes, "m(YES).")
      .def_readonly("no", &OpenBinaryMass::no, "m(NO).")
      .def_readonly("unknown", &OpenBinaryMass::unknown, "The mass of the whole frame.")
      .def_readonly("conflict", &OpenBinaryMass::conflict, "m(∅).")
      .def("__iter__",
           [](const OpenBinaryMass& self) {
             return py::iter(py::make_tuple(self.yes, self.no, self.unknown, self.conflict));
           })
      .def(py::self == py::self)
      .def("__hash__",
           [](const OpenBinaryMass& self) {
             return py::hash(py::make_tuple(self.yes, self.no, self.unknown, self.conflict));
           })
      .def(pickled(&OpenBinaryMass::yes, &OpenBinaryMass::no, &OpenBinaryMass::unknown, &OpenBinaryMass::conflict))
      .def("__str__", binary_text<OpenBinaryMass>)
      .def("__repr__", [](const OpenBinaryMass& self) {
        return record("OpenBinaryMass",
                      {{"yes", py::cast(self.yes)}, {"no", py::cast(self.no)}, {"conflict", py::cast(self.conflict)}});
      });
  bind_fused<FusedBinaryMass>(module, "FusedBinaryMass", "As Fused, of binary masses; unpacks into mass and conflict.");
}

RampBelief ramp(double max_yes, double yes_full_until, double yes_zero_from, double max_no, double no_zero_until,
                double no_full_from) {
  const RampBelief shape{max_yes, yes_full_until, yes_zero_from, max_no, no_zero_until, no_full_from};
  evidence::check(shape, "RampBelief");
  return shape;
}

void bind_binary_shapes(py::module_& module) {
  py::class_<RampBelief>(module, "RampBelief", R"(Belief as a piecewise linear function of one measured quantity.

The shape of every criterion of Clerentin et al. (figs. 7, 9, 12, 14): full belief, a ramp, none. Called with the
quantity it gives a BinaryMass, with an array of it masses as credo.evidence.batch takes them; nan, what could not be
measured, gives total ignorance.

>>> close = RampBelief(max_yes=0.8, yes_full_until=0.1, yes_zero_from=0.3,
...                    max_no=0.6, no_zero_until=0.2, no_full_from=0.5)
>>> close(0.05), close(0.5)
(BinaryMass(yes=0.8, no=0.0), BinaryMass(yes=0.0, no=0.6)))")
      .def(
          py::init(&ramp), py::arg("max_yes") = 0.0, py::arg("yes_full_until") = 0.0, py::arg("yes_zero_from") = 1.0,
          py::arg("max_no") = 0.0, py::arg("no_zero_until") = 0.0, py::arg("no_full_from") = 1.0,
          R"(__init__(self, max_yes=0.0, yes_full_until=0.0, yes_zero_from=1.0, max_no=0.0, no_zero_until=0.0, no_full_from=1.0)
--

Breakpoints may run either way: for a quantity that is the better the larger, yes_full_until > yes_zero_from.

ValueError unless they are finite, both ramps run the same way and yes + no <= 1 everywhere.)")
      .def("__call__", evaluated<RampBelief>, py::arg("x"), kEvaluatedDoc)
      .def_readonly("max_yes", &RampBelief::max_yes, "m(YES) where it is full.")
      .def_readonly("yes_full_until", &RampBelief::yes_full_until, "Where YES begins to fall.")
      .def_readonly("yes_zero_from", &RampBelief::yes_zero_from, "Where it is none.")
      .def_readonly("max_no", &RampBelief::max_no, "m(NO) where it is full.")
      .def_readonly("no_zero_until", &RampBelief::no_zero_until, "Where NO begins to rise.")
      .def_readonly("no_full_from", &RampBelief::no_full_from, "Where it is full.")
      .def(py::self == py::self)
      .def("__repr__",
           [](const RampBelief& self) {
             return record("RampBelief", {{"max_yes", py::cast(self.max_yes)},
                                          {"yes_full_until", py::cast(self.yes_full_until)},
                                          {"yes_zero_from", py::cast(self.yes_zero_from)},
                                          {"max_no", py::cast(self.max_no)},
                                          {"no_zero_until", py::cast(self.no_zero_until)},
                                          {"no_full_from", py::cast(self.no_full_from)}});
           })
      .def(pickled(&RampBelief::max_yes, &RampBelief::yes_full_until, &RampBelief::yes_zero_from, &RampBelief::max_no,
                   &RampBelief::no_zero_until, &RampBelief::no_full_from));
}

}  // namespace

void bind_binary(py::module_& module) {
  bind_binary_mass(module);
  bind_binary_results(module);
  bind_binary_shapes(module);
}

}  // namespace credo::python
