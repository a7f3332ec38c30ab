// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/refinement.hpp"

#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::Frame;
using evidence::MassFunction;
using evidence::ProductFrame;
using evidence::Proposition;
using evidence::Refining;

Refining refining_of(const Frame& coarse, const Frame& fine, const std::map<std::string, SetLike>& images) {
  std::vector<Proposition> sets(coarse.size());
  for (const auto& [name, image] : images) sets[coarse.index(name)] = resolved(fine, image);
  return Refining(coarse, fine, std::move(sets));
}

const Refining& factor_of(const ProductFrame& self, std::size_t i) {
  if (i >= self.size()) {
    throw py::index_error("the product has " + std::to_string(self.size()) + " factors, numbered from 0; got " +
                          std::to_string(i));
  }
  return self.factor(i);
}

void bind_refining(py::module_& module) {
  py::class_<Refining>(module, "Refining",
                       R"(A frame seen in more detail: elements of `coarse` split into some of `fine`.

>>> sky, weather = Frame.shafer(["wet", "dry"]), Frame.shafer(["rain", "snow", "sun"])
>>> detail = Refining(sky, weather, {"wet": "rain ∪ snow", "dry": "sun"})
>>> detail.refine(MassFunction.simple_support(sky, "wet", 0.8))
MassFunction({'rain ∪ snow': 0.8, 'Θ': 0.19999999999999996}))")
      .def(py::init(&refining_of), py::arg("coarse"), py::arg("fine"), py::arg("images"),
           R"(__init__(self, coarse, fine, images)
--

images: of each element of coarse, a proposition of fine; disjoint, together all of fine. ValueError if they are not,
or a frame is of another model than Shafer's.)")
      .def_property_readonly("coarse", &Refining::coarse, "The frame that is refined.")
      .def_property_readonly("fine", &Refining::fine, "The frame with more detail.")
      .def(
          "refine_set",
          [](const Refining& self, const SetLike& set) {
            return NamedProposition{self.fine(), self.refine(resolved(self.coarse(), set))};
          },
          py::arg("set"), "refine_set(self, set)\n--\n\nThe same, said in `fine`.")
      .def(
          "coarsen_set",
          [](const Refining& self, const SetLike& set) {
            return NamedProposition{self.coarse(), self.coarsen_outer(resolved(self.fine(), set))};
          },
          py::arg("set"), "coarsen_set(self, set)\n--\n\nThe elements of `coarse` that it meets.")
      .def(
          "coarsen_set_inner",
          [](const Refining& self, const SetLike& set) {
            return NamedProposition{self.coarse(), self.coarsen_inner(resolved(self.fine(), set))};
          },
          py::arg("set"), "coarsen_set_inner(self, set)\n--\n\nThe elements of `coarse` that it contains.")
      .def(
          "refine", [](const Refining& self, const MassFunction& mass) { return evidence::refine(mass, self); },
          py::arg("mass"), "refine(self, mass)\n--\n\nVacuous extension: every focal element said in `fine`.")
      .def(
          "coarsen", [](const Refining& self, const MassFunction& mass) { return evidence::coarsen(mass, self); },
          py::arg("mass"), R"(coarsen(self, mass)
--

Outer reduction: what `coarse` cannot say becomes ignorance; plausibilities stay. After refine the mass as it was.)")
      .def(
          "coarsen_inner",
          [](const Refining& self, const MassFunction& mass) { return evidence::coarsen_inner(mass, self); },
          py::arg("mass"),
          "coarsen_inner(self, mass)\n--\n\nInner reduction: keeps beliefs; what fits into no element goes to ∅.");
}

void bind_product(py::module_& module) {
  py::class_<ProductFrame>(module, "ProductFrame", R"(The frame of all combinations of the elements of some frames.

Elements are named "wet × cold"; the last factor runs fastest.)")
      .def(py::init<std::vector<Frame>>(), py::arg("factors"), R"(__init__(self, factors)
--

ValueError for no factor, one of another model than Shafer's, more than 256 combinations.)")
      .def_property_readonly("frame", &ProductFrame::frame, "The product.")
      .def("__len__", &ProductFrame::size)
      .def("factor", factor_of, py::arg("i"), py::return_value_policy::copy,
           "factor(self, i)\n--\n\nHow a factor is refined to the product: a Refining.")
      .def(
          "extend",
          [](const ProductFrame& self, const MassFunction& mass, std::size_t i) {
            return evidence::refine(mass, factor_of(self, i));
          },
          py::arg("mass"), py::arg("i"), "extend(self, mass, i)\n--\n\nWhat is known of factor i, said on the product.")
      .def(
          "marginal",
          [](const ProductFrame& self, const MassFunction& mass, std::size_t i) {
            return evidence::coarsen(mass, factor_of(self, i));
          },
          py::arg("mass"), py::arg("i"), "marginal(self, mass, i)\n--\n\nWhat is known of the product, for factor i.");
}

}  // namespace

void bind_refinement(py::module_& module) {
  bind_refining(module);
  bind_product(module);
}

}  // namespace credo::python
