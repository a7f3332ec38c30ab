// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/grid_rules.hpp"

#include <sstream>

#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::FusedGridMass;
using evidence::GridElement;
using evidence::GridMass;
using evidence::GridModel;

constexpr std::array<std::pair<std::string_view, GridElement>, 4> kGridElements{{{"empty", GridElement::kEmpty},
                                                                                 {"occupied", GridElement::kOccupied},
                                                                                 {"conflict", GridElement::kConflict},
                                                                                 {"unknown", GridElement::kUnknown}}};
constexpr std::array<std::pair<std::string_view, GridModel>, 2> kGridModels{
    {{"free", GridModel::kFree}, {"exclusive", GridModel::kExclusive}}};

// A measure of one element, both given by name.
template <double (*kMeasure)(const GridMass&, GridElement, GridModel)>
double of_element(const GridMass& self, const std::string& element, const std::string& model) {
  return kMeasure(self, chosen(element, "element", kGridElements), chosen(model, "model", kGridModels));
}

double grid_dsmp(const GridMass& self, const std::string& element, const std::string& model, double epsilon) {
  return evidence::dsmp(self, chosen(element, "element", kGridElements), chosen(model, "model", kGridModels), epsilon);
}

void bind_grid_measures(py::class_<GridMass>& mass) {
  mass.def("belief", of_element<evidence::belief>, py::arg("element"), py::arg("model"),
           R"(belief(self, element, model)
--

Bel of "empty", "occupied", "conflict" (both; of the free model) or "unknown" (either). model: "free", where the overlap
exists and implies both, or "exclusive", where it is ∅.)")
      .def("plausibility", of_element<evidence::plausibility>, py::arg("element"), py::arg("model"),
           "plausibility(self, element, model)\n--\n\nPl of an element; always 1 under the free model.")
      .def("commonality", of_element<evidence::commonality>, py::arg("element"), py::arg("model"),
           "commonality(self, element, model)\n--\n\nq: the mass of all that the element implies.")
      .def("pignistic", of_element<evidence::pignistic>, py::arg("element"), py::arg("model"),
           R"(pignistic(self, element, model)
--

(Generalised) pignistic probability. ValueError at total conflict under the exclusive model.)")
      .def("dsmp", grid_dsmp, py::arg("element"), py::arg("model"), py::arg("epsilon"),
           R"(dsmp(self, element, model, epsilon)
--

DSmP, epsilon >= 0 and finite (Dezert and Smarandache 2008). ValueError at total conflict under the exclusive model.)");
}

void bind_grid_changes(py::class_<GridMass>& mass) {
  mass.def(
          "discount",
          [](const GridMass& self, double reliability) { return discount(self, checked_reliability(reliability)); },
          py::arg("reliability"), R"(discount(self, reliability)
--

All but the ignorance times the reliability in [0, 1].)")
      .def("without_conflict", evidence::without_conflict,
           "without_conflict(self)\n--\n\nThe conflict divided out (Dempster). None at total conflict.");
}

}  // namespace

void bind_grid(py::module_& module) {
  py::class_<GridMass> mass(module, "GridMass", R"(Masses on a grid cell, {empty, occupied}, whose elements may overlap.

`conflict` is the mass of empty ∩ occupied, under Shafer's model of ∅; `unknown` that of empty ∪ occupied. dsmc is the
rule of the free model; the other rules take grid masses under the exclusive one.

>>> dempster(GridMass(empty=0.5), GridMass(occupied=0.5, conflict=0.25)).mass.unknown
0.25)");
  mass.def(py::init(&GridMass::from), py::arg("empty") = 0.0, py::arg("occupied") = 0.0, py::arg("conflict") = 0.0,
           R"(__init__(self, empty=0.0, occupied=0.0, conflict=0.0)
--

From the committed masses; the rest is ignorance. ValueError unless all are >= 0 and sum to at most 1.)")
      .def_static("vacuous", &GridMass::vacuous, "vacuous()\n--\n\nTotal ignorance.")
      .def_readonly("empty", &GridMass::empty, "m(empty).")
      .def_readonly("occupied", &GridMass::occupied, "m(occupied).")
      .def_readonly("conflict", &GridMass::conflict, "m(empty ∩ occupied).")
      .def_readonly("unknown", &GridMass::unknown, "m(empty ∪ occupied).");
  bind_grid_measures(mass);
  bind_grid_changes(mass);
  mass.def("__iter__",
           [](const GridMass& self) {
             return py::iter(py::make_tuple(self.empty, self.occupied, self.conflict, self.unknown));
           })
      .def(py::self == py::self)
      .def("__hash__",
           [](const GridMass& self) {
             return py::hash(py::make_tuple(self.empty, self.occupied, self.conflict, self.unknown));
           })
      .def("__str__",
           [](const GridMass& self) {
             std::ostringstream text;
             text << self;
             return text.str();
           })
      .def("__repr__",
           [](const GridMass& self) {
             return record("GridMass", {{"empty", py::cast(self.empty)},
                                        {"occupied", py::cast(self.occupied)},
                                        {"conflict", py::cast(self.conflict)}});
           })
      .def(pickled(&GridMass::empty, &GridMass::occupied, &GridMass::conflict, &GridMass::unknown));
  bind_fused<FusedGridMass>(module, "FusedGridMass", "As Fused, of grid masses; unpacks into mass and conflict.");
  module.def(
      "dsmc",
      [](const py::args& sources) {
        const std::vector<GridMass> masses = sources_of<GridMass>(listed(sources), "GridMass");
        return evidence::dsmc(std::span<const GridMass>(masses));
      },
      R"(dsmc(*sources)
--

DSm classic rule of grid masses, given one by one or as one iterable (Li X. 2006, eq. (3)). Associative, commutative;
the vacuous mass is neutral, and is what no source gives. The conflict absorbs: decide by `without_conflict`.)");
}

}  // namespace credo::python
