// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/log_evidence.hpp"

#include <cmath>

#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::LogEvidence;

LogEvidence checked_evidence(double yes, double no) {
  if (!std::isfinite(yes) || !std::isfinite(no)) {
    throw std::invalid_argument("evidence must be finite; got yes = " + std::to_string(yes) +
                                ", no = " + std::to_string(no));
  }
  return {yes, no};
}

}  // namespace

void bind_log_evidence(py::module_& module) {
  py::class_<LogEvidence>(module, "LogEvidence", R"(Dempster's rule as addition: the weights of evidence for YES and NO.

`+` takes evidence in (Shafer 1976, ch. 5), `-` takes it out again; LogEvidence() is the vacuous mass. Nothing underflows
and nothing locks; yes - no is the log-odds of a Bayes filter.

>>> heard, seen = log_evidence(BinaryMass(0.6, 0.1)), log_evidence(BinaryMass(0.2, 0.5))
>>> str((heard + seen).normalised_mass()) == str(dempster(BinaryMass(0.6, 0.1), BinaryMass(0.2, 0.5)).mass)
True)")
      .def(py::init(&checked_evidence), py::arg("yes") = 0.0, py::arg("no") = 0.0,
           R"(__init__(self, yes=0.0, no=0.0)
--

ValueError unless both are finite. Below 0, as rounding leaves where evidence was taken out, they count as 0.)")
      .def_readonly("yes", &LogEvidence::yes, "ln(1 + m(YES) / m(Θ)).")
      .def_readonly("no", &LogEvidence::no, "ln(1 + m(NO) / m(Θ)).")
      .def(py::self + py::self)
      .def(py::self - py::self)
      .def(py::self == py::self)
      .def("__hash__", [](const LogEvidence& self) { return py::hash(py::make_tuple(self.yes, self.no)); })
      .def("normalised_mass", &evidence::normalised_mass<double>,
           "normalised_mass(self)\n--\n\nThe BinaryMass; there is one for any amount of evidence.")
      .def("pignistic", &evidence::pignistic<double>, "pignistic(self)\n--\n\nPignistic probability of YES.")
      .def("plausibility_probability", &evidence::plausibility_probability<double>,
           R"(plausibility_probability(self)
--

Pl(YES) / (Pl(YES) + Pl(NO)): the logistic function of yes - no.)")
      .def("__repr__",
           [](const LogEvidence& self) {
             return record("LogEvidence", {{"yes", py::cast(self.yes)}, {"no", py::cast(self.no)}});
           })
      .def(pickled(&LogEvidence::yes, &LogEvidence::no));
  module.def(
      "log_evidence", [](const evidence::BinaryMass& mass) { return evidence::log_evidence(mass); }, py::arg("mass"),
      R"(log_evidence(mass)
--

The evidence in a BinaryMass, or in a LogCommonality, whose conflict is forgotten and whose YES is occupied.

ValueError for a dogmatic mass (unknown = 0), which is infinite evidence: discount it first.)");
  module.def(
      "log_evidence", [](const evidence::LogCommonality& cell) { return evidence::log_evidence(cell); },
      py::arg("mass"));
}

}  // namespace credo::python
