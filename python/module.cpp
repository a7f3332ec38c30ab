// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "python/bindings.hpp"

#include "evidence/grid_mass.hpp"

namespace credo::python {

evidence::Proposition resolved(const evidence::Frame& frame, const SetLike& set) {
  if (const auto* text = std::get_if<std::string>(&set)) return frame.parse(*text);
  const auto& named = std::get<NamedProposition>(set);
  if (!(named.frame == frame)) {
    throw std::invalid_argument("the proposition '" + named.frame.to_string(named.set) +
                                "' is of another frame: give its text, or refine it");
  }
  return named.set;
}

std::span<const double> numbers(const Array& values, const char* name) {
  if (values.ndim() != 1) {
    throw std::invalid_argument(std::string(name) + " must have one dimension; got " + std::to_string(values.ndim()));
  }
  return {values.data(), static_cast<std::size_t>(values.size())};
}

Array array(std::span<const double> values) { return Array(static_cast<py::ssize_t>(values.size()), values.data()); }

std::string shape_text(const py::array& array) { return py::str(py::tuple(array.attr("shape"))); }

double checked_reliability(double reliability) {
  if (!(reliability >= 0.0 && reliability <= 1.0)) {
    throw std::invalid_argument("a reliability must be in [0, 1]; got " + std::to_string(reliability));
  }
  return reliability;
}

py::list listed(const py::args& sources) {
  if (sources.size() != 1) return py::list(sources);
  const py::handle only = sources[0];
  const bool is_source = py::isinstance<evidence::MassFunction>(only) || py::isinstance<evidence::BinaryMass>(only) ||
                         py::isinstance<evidence::OpenBinaryMass>(only) || py::isinstance<evidence::GridMass>(only);
  if (is_source) return py::list(sources);
  if (!py::isinstance<py::iterable>(only)) {
    throw py::type_error("sources are given one by one or as one iterable; got " + std::string(py::repr(only)));
  }
  return py::list(py::reinterpret_borrow<py::object>(only));
}

std::string record(const char* type, std::initializer_list<std::pair<const char*, py::object>> fields) {
  std::string text = std::string(type) + "(";
  const char* between = "";
  for (const auto& [name, value] : fields) {
    text += between + std::string(name) + "=" + std::string(py::repr(value));
    between = ", ";
  }
  return text + ")";
}

}  // namespace credo::python

PYBIND11_MODULE(evidence, module) {
  namespace python = credo::python;
  pybind11::options options;
  options.disable_function_signatures();
  module.doc() = R"(Belief functions: frames of every model, mass functions, and the rules that combine them.

>>> frame = Frame.shafer(["rain", "snow", "sun"])
>>> radar = MassFunction(frame, {"rain ∪ snow": 0.8, "Θ": 0.2})
>>> window = MassFunction(frame, {"rain": 0.6, "sun": 0.3, "Θ": 0.1})
>>> mass, conflict = dempster(radar, window)
>>> round(mass.belief("rain"), 3), round(mass.plausibility("rain"), 3), round(conflict, 2)
(0.789, 0.921, 0.24)

A proposition is given as text ("rain ∪ snow", also with | & ~ and parentheses) or as the Proposition that
`frame["rain ∪ snow"]` is. Whatever cannot be computed is a ValueError that says what was found and what is
expected; a rule that has no result at total conflict returns None.)";
  module.attr("__version__") = CREDO_VERSION;
  python::bind_frames(module);
  python::bind_binary(module);
  python::bind_batch(module);
  python::bind_grid(module);
  python::bind_log_commonality(module);
  python::bind_mass_functions(module);
  python::bind_rules(module);
  python::bind_refinement(module);
  python::bind_open_world(module);
  python::bind_log_evidence(module);
  python::bind_elicitation(module);
  python::bind_sensor_matching(module);
  python::bind_criteria(module);
  python::bind_four_kinds(module);
}
