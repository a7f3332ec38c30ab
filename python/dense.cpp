// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <bit>

#include "evidence/decomposition.hpp"
#include "evidence/moebius.hpp"
#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::CanonicalDecomposition;
using evidence::MassFunction;

// The transform of a copy.
template <void (*kTransform)(std::span<double>)>
Array transformed(const Array& values) {
  Array result = array(numbers(values, "values"));
  const auto size = static_cast<std::size_t>(result.size());
  if (!std::has_single_bit(size)) {
    throw std::invalid_argument("a function on a power set has 2^n values; got " + std::to_string(size));
  }
  kTransform({result.mutable_data(), size});
  return result;
}

CanonicalDecomposition decomposition_of(const evidence::Frame& frame, const Array& log_weights) {
  const std::span<const double> weights = numbers(log_weights, "log_weights");
  if (!frame.is_power_set() || frame.size() > evidence::kMaxDenseElements ||
      weights.size() != std::size_t{1} << frame.size()) {
    throw std::invalid_argument(
        "a decomposition needs a power set of up to " + std::to_string(evidence::kMaxDenseElements) +
        " elements and one weight for each of its 2^n subsets; got " + std::to_string(weights.size()));
  }
  return {frame, {weights.begin(), weights.end()}};
}

void bind_decomposition(py::module_& module) {
  py::class_<CanonicalDecomposition>(module, "CanonicalDecomposition",
                                     R"(A mass function as the conjunction of simple ones (Smets 1995).

A with the weight w(A) on Θ and 1 - w(A) on A, one for each A ≠ Θ. Weights over 1 take evidence back.)")
      .def(py::init(&decomposition_of), py::arg("frame"), py::arg("log_weights"),
           R"(__init__(self, frame, log_weights)
--

log_weights: shape (2^n,), as the property. ValueError for another, or another model.)")
      .def_readonly("frame", &CanonicalDecomposition::frame, "A power set of up to 20 elements.")
      .def_property_readonly(
          "log_weights", [](const CanonicalDecomposition& self) { return array(self.log_weights); },
          "ln w(A), shape (2^n,): entry `bits` belongs to the subset whose elements are the bits that are set; 0 at Θ.")
      .def("recompose", &evidence::recompose,
           "recompose(self)\n--\n\nThe conjunction of the simple ones. ValueError where the weights make none.")
      .def(py::self == py::self)
      .def("__repr__",
           [](const CanonicalDecomposition& self) {
             return record("CanonicalDecomposition",
                           {{"frame", py::cast(self.frame)}, {"log_weights", array(self.log_weights)}});
           })
      .def(py::pickle(
          [](const CanonicalDecomposition& self) { return py::make_tuple(self.frame, array(self.log_weights)); },
          [](const py::tuple& state) {
            return decomposition_of(state[0].cast<evidence::Frame>(), state[1].cast<Array>());
          }));
}

}  // namespace

void bind_dense(py::class_<MassFunction>& mass_function, py::module_& module) {
  bind_decomposition(module);
  mass_function
      .def(
          "to_dense", [](const MassFunction& self) { return array(evidence::to_dense(self)); }, R"(to_dense(self)
--

The masses of all subsets, shape (2^n,): entry `bits` belongs to the subset whose elements are the bits that are set,
and `dense[proposition]` works. ValueError unless the frame is a power set of up to 20 elements.)")
      .def_static(
          "from_dense",
          [](const evidence::Frame& frame, const Array& values) {
            return evidence::from_dense(frame, numbers(values, "values"));
          },
          py::arg("frame"), py::arg("values"), R"(from_dense(frame, values)
--

The inverse of to_dense. ValueError for another shape than (2^n,), and as the constructor.)")
      .def_static(
          "from_commonality",
          [](const evidence::Frame& frame, const Array& commonalities) {
            const std::span<const double> given = numbers(commonalities, "commonalities");
            return evidence::from_commonality(frame, {given.begin(), given.end()});
          },
          py::arg("frame"), py::arg("commonalities"), R"(from_commonality(frame, commonalities)
--

The mass function with these commonalities, shape (2^n,), q(∅) = 1. Masses that transforms leave by rounding are 0.

None where they are those of no mass function. ValueError for another shape or frame.)")
      .def("decompose", evidence::decompose, R"(decompose(self)
--

The canonical decomposition: ln w(A) = -Σ over B ⊇ A of (-1)^(|B| - |A|) ln q(B).

ValueError for a dogmatic mass function (m(Θ) = 0), which has no weights: discount it first.)");
  module.def("mass_to_commonality", transformed<evidence::mass_to_commonality>, py::arg("values"),
             R"(mass_to_commonality(values)
--

q(A) = Σ m(B), B ⊇ A: a new array of shape (2^n,), in n 2^n / 2 additions (fast Möbius transform; Kennes 1992).)");
  module.def("commonality_to_mass", transformed<evidence::commonality_to_mass>, py::arg("values"),
             "commonality_to_mass(values)\n--\n\nThe inverse of mass_to_commonality: a new array.");
  module.def("mass_to_implicability", transformed<evidence::mass_to_implicability>, py::arg("values"),
             "mass_to_implicability(values)\n--\n\nb(A) = Σ m(B), B ⊆ A, ∅ among them: a new array of shape (2^n,).");
  module.def("implicability_to_mass", transformed<evidence::implicability_to_mass>, py::arg("values"),
             "implicability_to_mass(values)\n--\n\nThe inverse of mass_to_implicability: a new array.");
}

}  // namespace credo::python
