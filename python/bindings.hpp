// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <pybind11/numpy.h>
#include <pybind11/operators.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "evidence/binary_mass.hpp"
#include "evidence/frame.hpp"
#include "evidence/mass_function.hpp"

/// The Python module credo.evidence. Docstrings begin with the signature in the form that Python reads back
/// ("name(arguments)", "--", empty line); the stubs in credo/evidence/ have the types, and a test compares the two.
namespace credo::python {

namespace py = pybind11;

/// A proposition that knows its frame, hence its name: what Python sees.
struct NamedProposition {
  evidence::Frame frame;
  evidence::Proposition set;

  [[nodiscard]] evidence::Proposition existing() const { return frame.existing(set); }
  friend bool operator==(const NamedProposition& a, const NamedProposition& b) {
    return a.frame == b.frame && a.existing() == b.existing();
  }
};

/// What every function takes for a proposition: its text or itself.
using SetLike = std::variant<std::string, NamedProposition>;

/// \throws std::invalid_argument for text that is no proposition of the frame, or a proposition of another frame
[[nodiscard]] evidence::Proposition resolved(const evidence::Frame& frame, const SetLike& set);

/// Any array of numbers, or nested sequences of them.
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The numbers of a vector. \throws std::invalid_argument, naming it, for another number of dimensions than one
[[nodiscard]] std::span<const double> numbers(const Array& values, const char* name);
[[nodiscard]] Array array(std::span<const double> values);  ///< a new one

[[nodiscard]] std::string shape_text(const py::array& array);  ///< "(400, 400, 3)"

/// For closed forms that do not check. \throws std::invalid_argument unless it is in [0, 1]
[[nodiscard]] double checked_reliability(double reliability);

/// "Type(name=value, ...)"
[[nodiscard]] std::string record(const char* type, std::initializer_list<std::pair<const char*, py::object>> fields);

/// The value that a word stands for. \throws std::invalid_argument, naming the words
template <typename Value, std::size_t N>
[[nodiscard]] Value chosen(std::string_view word, const char* what,
                           const std::array<std::pair<std::string_view, Value>, N>& choices) {
  std::string known;
  for (const auto& [name, value] : choices) {
    if (name == word) return value;
    known += (known.empty() ? "'" : ", '") + std::string(name) + "'";
  }
  throw std::invalid_argument(std::string(what) + " must be one of " + known + "; got '" + std::string(word) + "'");
}

/// Read with pickle, so also with copy: a value is the tuple of these of its members.
template <typename Value, typename... Members>
[[nodiscard]] auto pickled(Members Value::*... members) {
  return py::pickle([members...](const Value& value) { return py::make_tuple(value.*members...); },
                    [members...](const py::tuple& state) {
                      Value value;
                      std::size_t i = 0;
                      ((value.*members = state[i++].template cast<Members>()), ...);
                      return value;
                    });
}

/// Fused, FusedBinaryMass and FusedGridMass: a mass and the conflict that was met on the way to it.
template <typename Result>
void bind_fused(py::module_& module, const char* name, const char* doc) {
  using Mass = decltype(Result::mass);
  py::class_<Result>(module, name, doc)
      .def_readonly("mass", &Result::mass, "What the sources say together.")
      .def_readonly("conflict", &Result::conflict, "In [0, 1].")
      .def("__iter__", [](const Result& self) { return py::iter(py::make_tuple(self.mass, self.conflict)); })
      .def(py::self == py::self)
      .def("__repr__",
           [name](const Result& self) {
             return record(name, {{"mass", py::cast(self.mass)}, {"conflict", py::cast(self.conflict)}});
           })
      .def(py::pickle([](const Result& self) { return py::make_tuple(self.mass, self.conflict); },
                      [](const py::tuple& state) {
                        return Result{state[0].cast<Mass>(), state[1].cast<double>()};
                      }));
}

/// The sources that a rule is called with: rule(a, b, c), or rule([a, b, c]) with any iterable.
[[nodiscard]] py::list listed(const py::args& sources);

/// All of one type. \throws py::type_error, saying what was found
template <typename Mass>
[[nodiscard]] std::vector<Mass> sources_of(const py::list& sources, const char* type) {
  std::vector<Mass> result;
  for (const py::handle source : sources) {
    if (!py::isinstance<Mass>(source)) {
      throw py::type_error(std::string("every source must be a ") + type + "; got " + std::string(py::repr(source)));
    }
    result.push_back(source.cast<Mass>());
  }
  return result;
}

/// The masses that a rule has in closed form: of BinaryMass, GridMass, or OpenBinaryMass with BinaryMass among them.
/// \returns nothing for other sources. \throws py::type_error for a rule that has none, or another type among them
[[nodiscard]] std::optional<py::object> in_closed_form(std::string_view rule, const py::list& sources);
[[nodiscard]] bool are_binary(const py::list& sources);  ///< the first is a BinaryMass
/// \throws py::type_error for another type
[[nodiscard]] std::vector<evidence::BinaryMass> binary_masses(const py::list& sources);
[[nodiscard]] evidence::OpenBinaryMass opened(const evidence::BinaryMass& mass);  ///< with no conflict

/// The result of work that touches nothing of Python's, while its other threads run.
template <typename Work>
auto without_gil(Work work) {
  const py::gil_scoped_release released;
  return work();
}

inline constexpr const char* kEvaluatedDoc =
    "__call__(self, x)\n--\n\nThe BinaryMass at a number, or the masses, shape (..., 3), at an array of them.";

/// The BinaryMass of a shape at a number; at an array of them the masses, of shape (..., 3).
template <typename BeliefShape>
[[nodiscard]] py::object evaluated(const BeliefShape& shape, const Array& x) {
  if (x.ndim() == 0) return py::cast(shape(*x.data()));
  std::vector<py::ssize_t> dimensions(x.shape(), x.shape() + x.ndim());
  dimensions.push_back(3);
  Array masses(dimensions);
  const std::span<const double> from(x.data(), static_cast<std::size_t>(x.size()));
  double* to = masses.mutable_data();
  without_gil([&] {
    for (const double each : from) {
      const evidence::BinaryMass mass = shape(each);
      for (const double value : {mass.yes, mass.no, mass.unknown}) *to++ = value;
    }
  });
  return masses;
}

void bind_frames(py::module_& module);
void bind_mass_functions(py::module_& module);
void bind_readouts(py::class_<evidence::MassFunction>& mass_function, py::module_& module);
void bind_utility(py::class_<evidence::MassFunction>& mass_function, py::module_& module);
void bind_dense(py::class_<evidence::MassFunction>& mass_function, py::module_& module);
void bind_binary(py::module_& module);
void bind_batch(py::module_& module);
void bind_grid(py::module_& module);
void bind_log_commonality(py::module_& module);
void bind_rules(py::module_& module);
void bind_refinement(py::module_& module);
void bind_open_world(py::module_& module);
void bind_log_evidence(py::module_& module);
void bind_elicitation(py::module_& module);
void bind_sensor_matching(py::module_& module);
void bind_criteria(py::module_& module);
void bind_four_kinds(py::module_& module);

}  // namespace credo::python
