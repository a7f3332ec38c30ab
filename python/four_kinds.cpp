// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/four_kinds.hpp"

#include <cmath>

#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::FourKindMass;
using evidence::WhetherRegular;
using evidence::WhichKind;

double checked_breakpoint(double value, const char* name) {
  if (!std::isfinite(value))
    throw std::invalid_argument(std::string(name) + " must be finite; got " + std::to_string(value));
  return value;
}

double checked_committed(double committed) {
  if (!(committed >= 0.0 && committed <= 1.0)) {
    throw std::invalid_argument("committed must be in [0, 1]; got " + std::to_string(committed));
  }
  return committed;
}

WhichKind which_of(double deviation, double committed, double level_until, double level_zero_from) {
  return evidence::which_kind(deviation, {.committed = checked_committed(committed),
                                          .level_until = checked_breakpoint(level_until, "level_until"),
                                          .level_zero_from = checked_breakpoint(level_zero_from, "level_zero_from")});
}

WhetherRegular whether_of(double gap, double committed, double regular_until, double other_from) {
  return evidence::whether_regular(gap, {.committed = checked_committed(committed),
                                         .regular_until = checked_breakpoint(regular_until, "regular_until"),
                                         .other_from = checked_breakpoint(other_from, "other_from")});
}

evidence::BinaryMass kind_of(const FourKindMass& mass, int kind) {
  if (kind < 0 || kind > 3) throw std::invalid_argument("a kind is 0, 1, 2 or 3; got " + std::to_string(kind));
  return evidence::belief_in_kind(mass, kind);
}

void bind_kind_criteria(py::module_& module) {
  py::class_<WhichKind>(module, "WhichKind", "Which of the regular kinds it would be, if it is one.")
      .def_readonly("one_or_other", &WhichKind::one_or_other, "m({i, other}), i = 0 .. 2.")
      .def_readonly("unknown", &WhichKind::unknown, "The rest.")
      .def("__repr__", [](const WhichKind& self) {
        return record("WhichKind",
                      {{"one_or_other", py::cast(self.one_or_other)}, {"unknown", py::cast(self.unknown)}});
      });
  py::class_<WhetherRegular>(module, "WhetherRegular", "Whether it is of a regular kind at all.")
      .def_readonly("regular", &WhetherRegular::regular, "m({0, 1, 2}).")
      .def_readonly("other", &WhetherRegular::other, "m({other}).")
      .def_readonly("unknown", &WhetherRegular::unknown, "The rest.")
      .def("__repr__", [](const WhetherRegular& self) {
        return record("WhetherRegular", {{"regular", py::cast(self.regular)},
                                         {"other", py::cast(self.other)},
                                         {"unknown", py::cast(self.unknown)}});
      });
  const evidence::WhichKindParams which;
  module.def("which_kind", which_of, py::arg("deviation"), py::arg("committed") = which.committed,
             py::arg("level_until") = which.level_until, py::arg("level_zero_from") = which.level_zero_from,
             R"(which_kind(deviation, committed=0.9, level_until=10.0, level_zero_from=25.0)
--

First criterion, a WhichKind: 0 for a deviation well below zero, 1 well above, 2 about zero, linear between the
breakpoints of |deviation|. committed: mass that is not ignorance, in [0, 1]. nan is ignorance.)");
  const evidence::WhetherRegularParams whether;
  module.def("whether_regular", whether_of, py::arg("gap"), py::arg("committed") = whether.committed,
             py::arg("regular_until") = whether.regular_until, py::arg("other_from") = whether.other_from,
             R"(whether_regular(gap, committed=0.9, regular_until=0.05, other_from=0.2)
--

Second criterion, a WhetherRegular: regular for a small gap, other for a large one; nan is ignorance.)");
}

}  // namespace

void bind_four_kinds(py::module_& module) {
  bind_kind_criteria(module);
  py::class_<FourKindMass>(module, "FourKindMass",
                           R"(Masses on four exclusive kinds: regular ones, 0 .. 2, and other, 3.

Made by two criteria that never conflict (Clerentin et al., sec. 3.2). For junctions: corner, edge, wall, other, from the
interior angle minus 180 degrees and the gap between the segments in metres.

>>> mass = FourKindMass(which_kind(-90.0), whether_regular(0.01))
>>> mass.most_believed(), mass.belief_in_kind(0)
(0, BinaryMass(yes=0.81, no=0.0)))")
      .def(py::init(&evidence::combine), py::arg("which"), py::arg("whether"),
           "__init__(self, which, whether)\n--\n\nThe two criteria together; all rules agree.")
      .def_readonly("one", &FourKindMass::one, "m({i}), i = 0 .. 2.")
      .def_readonly("one_or_other", &FourKindMass::one_or_other, "m({i, other}).")
      .def_readonly("other", &FourKindMass::other, "m({other}).")
      .def_readonly("regular", &FourKindMass::regular, "m({0, 1, 2}).")
      .def_readonly("unknown", &FourKindMass::unknown, "The mass of the whole frame.")
      .def("most_believed", evidence::most_believed,
           "most_believed(self)\n--\n\nThe kind, 0 .. 3, that is believed most; of equal ones the lowest.")
      .def("belief_in_kind", kind_of, py::arg("kind"), R"(belief_in_kind(self, kind)
--

Bel and Pl of one kind as a BinaryMass: yes = Bel, no = 1 - Pl. ValueError unless the kind is 0 .. 3.)")
      .def("__repr__", [](const FourKindMass& self) {
        return record("FourKindMass", {{"one", py::cast(self.one)},
                                       {"one_or_other", py::cast(self.one_or_other)},
                                       {"other", py::cast(self.other)},
                                       {"regular", py::cast(self.regular)},
                                       {"unknown", py::cast(self.unknown)}});
      });
}

}  // namespace credo::python
