// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/log_commonality.hpp"

#include <algorithm>
#include <cmath>

#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::FixedLogCommonality;
using evidence::GridMass;
using evidence::LogCommonality;

template <typename Cell>
void check_cell(const Cell& cell) {
  const bool ordered = cell.empty <= 0 && cell.occupied <= 0 && cell.unknown <= std::min(cell.empty, cell.occupied);
  if (!ordered || std::isinf(static_cast<double>(cell.unknown))) {
    throw std::invalid_argument("log-commonalities must be finite, <= 0, and unknown the lowest; got " +
                                std::to_string(cell.empty) + ", " + std::to_string(cell.occupied) + ", " +
                                std::to_string(cell.unknown));
  }
}

// What both forms of a cell have; `Number` is that of a channel.
template <typename Number, typename Cell>
void bind_cell(py::class_<Cell>& cell, const char* name) {
  cell.def(py::init([](Number empty, Number occupied, Number unknown) {
             const Cell result{empty, occupied, unknown};
             check_cell(result);
             return result;
           }),
           py::arg("empty") = Number{}, py::arg("occupied") = Number{}, py::arg("unknown") = Number{},
           std::is_integral_v<Number>
               ? "__init__(self, empty=0, occupied=0, unknown=0)\n--\n\nAll <= 0, unknown the lowest."
               : "__init__(self, empty=0.0, occupied=0.0, unknown=0.0)\n--\n\nAll finite and <= 0, unknown the lowest.")
      .def_readonly("empty", &Cell::empty, "ln(m(empty) + m(unknown)).")
      .def_readonly("occupied", &Cell::occupied, "ln(m(occupied) + m(unknown)).")
      .def_readonly("unknown", &Cell::unknown, "ln m(unknown).")
      .def(py::self + py::self)
      .def(py::self - py::self)
      .def(py::self == py::self)
      .def("__hash__",
           [](const Cell& self) { return py::hash(py::make_tuple(self.empty, self.occupied, self.unknown)); })
      .def("__repr__",
           [name](const Cell& self) {
             return record(name, {{"empty", py::cast(self.empty)},
                                  {"occupied", py::cast(self.occupied)},
                                  {"unknown", py::cast(self.unknown)}});
           })
      .def(pickled(&Cell::empty, &Cell::occupied, &Cell::unknown));
}

void bind_cell_readouts(py::class_<LogCommonality>& cell) {
  cell.def("quantise", &evidence::quantise,
           "quantise(self)\n--\n\nTo fixed point, rounded to nearest; what is below the range goes to the floor.")
      .def(
          "discount",
          [](const LogCommonality& self, double reliability) {
            return evidence::discount(self, checked_reliability(reliability));
          },
          py::arg("reliability"), R"(discount(self, reliability)
--

The whole cell discounted, ln(1 - r + r q), r in [0, 1]. Does not commute with merging.)")
      .def("masses", &evidence::masses, "masses(self)\n--\n\nAs DSmC and TBM leave them, conflict included.")
      .def("normalised_masses", &evidence::normalised_masses,
           "normalised_masses(self)\n--\n\nUnder Dempster's rule, exact however much evidence there is.")
      .def("conflict", &evidence::conflict, "conflict(self)\n--\n\nMass of the conflict, without cancellation.")
      .def("contested", &evidence::contested, R"(contested(self)
--

How much of the evidence contradicts the rest, in [0, 1]: 2 min(v_e, v_o) / (v_e + v_o), v the evidence for each.)")
      .def("evidence_for_empty", &evidence::evidence_for_empty,
           "evidence_for_empty(self)\n--\n\nln(q(empty) / q(unknown)) >= 0, a sum over the readings.")
      .def("evidence_for_occupied", &evidence::evidence_for_occupied,
           "evidence_for_occupied(self)\n--\n\nln(q(occupied) / q(unknown)) >= 0, a sum over the readings.")
      .def("pignistic_occupied", &evidence::pignistic_occupied,
           "pignistic_occupied(self)\n--\n\nPignistic probability of occupied, of the normalised masses.")
      .def("plausibility_probability_occupied", &evidence::plausibility_probability_occupied,
           R"(plausibility_probability_occupied(self)
--

Pl(occupied) / (Pl(empty) + Pl(occupied)): the logistic function of a Bayes filter's log-odds.)");
}

}  // namespace

void bind_log_commonality(py::module_& module) {
  py::class_<FixedLogCommonality> fixed(module, "FixedLogCommonality",
                                        R"(The cell of a map: log-commonalities in Q11.20.

Sums are bit-identical in any order, thread and robot. Unit 2^-20; sums stop at -2048 and are `saturated`.)");
  py::class_<LogCommonality> cell(module, "LogCommonality", R"(All evidence about a grid cell: three log-commonalities.

`+` takes evidence in and merges cells, `-` takes out again; LogCommonality() is the cell that nothing is known about.
DSmC, TBM, Dempster's and Bayes' rule are read-outs of it. Masses never underflow.

>>> reading = log_commonality(GridMass(occupied=0.7), reliability=0.9)
>>> cell = reading + reading
>>> round(cell.normalised_masses().occupied, 4), cell - reading == reading
(0.8631, True))");
  bind_cell<double>(cell, "LogCommonality");
  bind_cell_readouts(cell);
  bind_cell<std::int32_t>(fixed, "FixedLogCommonality");
  fixed.def("value", &FixedLogCommonality::value, "value(self)\n--\n\nThe cell as a LogCommonality.")
      .def_property_readonly("saturated", &FixedLogCommonality::saturated,
                             "A channel has reached the floor: read-outs are bounds, nothing can be taken out.");
  module.def("log_commonality", &evidence::log_commonality, py::arg("mass"), py::arg("reliability"),
             R"(log_commonality(mass, reliability)
--

The evidence of one reading, discounted: ln(1 - r + r q). The reliability keeps every commonality above zero.

ValueError unless 0 <= reliability < 1.)");
}

}  // namespace credo::python
