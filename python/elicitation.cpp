// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <optional>

#include "evidence/piecewise_belief.hpp"
#include "evidence/predictive_belief.hpp"
#include "evidence/shape_fitting.hpp"
#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::Breakpoint;
using evidence::Calibration;
using evidence::Direction;
using evidence::FittedShape;
using evidence::LabelledSample;
using evidence::PiecewiseBelief;

constexpr std::array<std::pair<std::string_view, Direction>, 2> kDirections{
    {{"rising", Direction::kRising}, {"falling", Direction::kFalling}}};

const char* word_for(Direction direction) { return direction == Direction::kRising ? "rising" : "falling"; }

// Only truth values: what other numbers mean is not guessed.
std::vector<LabelledSample> samples_from(const Array& x, const py::object& labels) {
  const std::span<const double> values = numbers(x, "x");
  const auto truths = py::array::ensure(labels, py::array::c_style);
  const bool fits =
      truths && py::isinstance<py::array_t<bool>>(truths) && truths.ndim() == 1 && truths.shape(0) == x.shape(0);
  if (!fits) {
    throw std::invalid_argument("labels must be one bool for each x, the shape " + shape_text(x) + "; got " +
                                (truths ? std::string(py::str(truths.attr("dtype"))) + " of " + shape_text(truths)
                                        : std::string(py::repr(labels))));
  }
  std::vector<LabelledSample> samples;
  const auto* const truth = static_cast<const bool*>(truths.data());
  for (std::size_t i = 0; i < values.size(); ++i) samples.push_back({values[i], truth[i]});
  return samples;
}

FittedShape fitted(const Array& x, const py::object& labels, const std::string& name, const std::string& quantity,
                   const std::string& unit, int breakpoints, int min_samples, double confidence,
                   const std::optional<std::string>& direction) {
  const std::vector<LabelledSample> samples = samples_from(x, labels);
  evidence::FitParams params{.breakpoints = breakpoints, .min_samples = min_samples, .confidence = confidence};
  if (direction) params.direction = chosen(*direction, "direction", kDirections);
  return without_gil([&] { return evidence::fit_shape(samples, {name, quantity, unit}, params); });
}

Calibration judged(const PiecewiseBelief& shape, const Array& x, const py::object& labels, int bins) {
  const std::vector<LabelledSample> samples = samples_from(x, labels);
  return without_gil([&] { return evidence::calibration_of(shape, samples, bins); });
}

void bind_breakpoint(py::module_& module) {
  py::class_<Breakpoint>(module, "Breakpoint", "A place of a shape where its slope may change, with the masses there.")
      .def(py::init([](std::string name, double x, double yes, double no) {
             return Breakpoint{std::move(name), x, yes, no};
           }),
           py::arg("name"), py::arg("x"), py::arg("yes") = 0.0, py::arg("no") = 0.0,
           "__init__(self, name, x, yes=0.0, no=0.0)\n--\n\nChecked by the shape that it is given to.")
      .def_readonly("name", &Breakpoint::name, "One line of text.")
      .def_readonly("x", &Breakpoint::x, "In the unit of the quantity.")
      .def_readonly("yes", &Breakpoint::yes, "m(YES).")
      .def_readonly("no", &Breakpoint::no, "m(NO).")
      .def(py::self == py::self)
      .def("__repr__",
           [](const Breakpoint& self) {
             return record("Breakpoint", {{"name", py::cast(self.name)},
                                          {"x", py::cast(self.x)},
                                          {"yes", py::cast(self.yes)},
                                          {"no", py::cast(self.no)}});
           })
      .def(pickled(&Breakpoint::name, &Breakpoint::x, &Breakpoint::yes, &Breakpoint::no));
}

void bind_shape(py::module_& module) {
  py::class_<PiecewiseBelief> shape(module, "PiecewiseBelief",
                                    R"(Belief as any piecewise linear function of one measured quantity.

YES and NO are linear between the breakpoints and constant outside. Called as RampBelief.

>>> shape = PiecewiseBelief("alignment", "mean residual", "standard deviations",
...                         [Breakpoint("good until", 1.0, yes=0.5), Breakpoint("bad from", 3.0, no=0.75)])
>>> shape(2.0)
BinaryMass(yes=0.25, no=0.375)
>>> shape([0.0, 2.0])
array([[0.5  , 0.   , 0.5  ],
       [0.25 , 0.375, 0.375]]))");
  shape
      .def(py::init([](std::string name, std::string quantity, std::string unit, std::vector<Breakpoint> breakpoints) {
             return PiecewiseBelief({std::move(name), std::move(quantity), std::move(unit)}, std::move(breakpoints));
           }),
           py::arg("name"), py::arg("quantity"), py::arg("unit"), py::arg("breakpoints"),
           R"(__init__(self, name, quantity, unit, breakpoints)
--

What it is called, what was measured, and in which unit ("1" for a pure number): each one line of text.

breakpoints: one at least, ascending in x, each with a name of its own. ValueError, naming what is wrong, for others
and unless yes >= 0, no >= 0 and yes + no <= 1.)")
      .def_static("from_text", evidence::read_piecewise_belief, py::arg("text"),
                  "from_text(text)\n--\n\nThe inverse of to_text. ValueError, with the line, for another text.")
      .def("to_text", evidence::to_text, "to_text(self)\n--\n\nLines of text that read back as the same numbers.")
      .def("__call__", evaluated<PiecewiseBelief>, py::arg("x"), kEvaluatedDoc)
      .def_property_readonly(
          "name", [](const PiecewiseBelief& self) { return self.title().name; }, "What it is called.")
      .def_property_readonly(
          "quantity", [](const PiecewiseBelief& self) { return self.title().quantity; }, "What was measured.")
      .def_property_readonly(
          "unit", [](const PiecewiseBelief& self) { return self.title().unit; }, "\"1\" for a pure number.")
      .def_property_readonly("breakpoints", &PiecewiseBelief::breakpoints, "Ascending in x.")
      .def(py::self == py::self)
      .def("__repr__",
           [](const PiecewiseBelief& self) {
             return record("PiecewiseBelief", {{"name", py::cast(self.title().name)},
                                               {"quantity", py::cast(self.title().quantity)},
                                               {"unit", py::cast(self.title().unit)},
                                               {"breakpoints", py::cast(self.breakpoints())}});
           })
      .def(py::pickle(
          [](const PiecewiseBelief& self) { return py::make_tuple(evidence::to_text(self)); },
          [](const py::tuple& state) { return evidence::read_piecewise_belief(state[0].cast<std::string>()); }));
  module.def(
      "piecewise",
      [](const evidence::RampBelief& ramps, std::string name, std::string quantity, std::string unit) {
        return evidence::piecewise(ramps, {std::move(name), std::move(quantity), std::move(unit)});
      },
      py::arg("shape"), py::arg("name"), py::arg("quantity"), py::arg("unit"), R"(piecewise(shape, name, quantity, unit)
--

A RampBelief as a PiecewiseBelief, with its parameters as names of the breakpoints.)");
}

void bind_fit_results(py::module_& module) {
  py::class_<Calibration>(module, "Calibration", "How well a shape agrees with samples, cut into bins of equal count.")
      .def_readonly("samples", &Calibration::samples, "That were judged on.")
      .def_readonly("ignored", &Calibration::ignored, "Whose x is not finite.")
      .def_readonly("bins", &Calibration::bins, "Of at least 10 samples each, but for few.")
      .def_readonly("coverage", &Calibration::coverage, "Share of the bins with a frequency of True in [Bel, Pl].")
      .def_readonly("refuted", &Calibration::refuted,
                    "Share of the bins that contradict the shape however few their samples; up to 0.05 is chance.")
      .def_readonly("brier_score", &Calibration::brier_score, "Mean of (BetP - label)^2 (Brier 1950).")
      .def_readonly("calibration_error", &Calibration::calibration_error,
                    "Mean over the samples of |mean BetP - frequency| of their bin.")
      .def_readonly("mean_unknown", &Calibration::mean_unknown, "Mass of Θ: what being careful costs.")
      .def("__repr__", [](const Calibration& self) {
        return record("Calibration", {{"samples", py::cast(self.samples)},
                                      {"ignored", py::cast(self.ignored)},
                                      {"bins", py::cast(self.bins)},
                                      {"coverage", py::cast(self.coverage)},
                                      {"refuted", py::cast(self.refuted)},
                                      {"brier_score", py::cast(self.brier_score)},
                                      {"calibration_error", py::cast(self.calibration_error)},
                                      {"mean_unknown", py::cast(self.mean_unknown)}});
      });
  py::class_<FittedShape>(module, "FittedShape", "A shape, and what it was fitted to.")
      .def_readonly("shape", &FittedShape::shape, "A PiecewiseBelief for which YES means: the label is True.")
      .def_property_readonly(
          "direction", [](const FittedShape& self) { return word_for(self.direction); },
          "\"rising\" or \"falling\", given or found.")
      .def_readonly("samples", &FittedShape::samples, "That were fitted.")
      .def_readonly("ignored", &FittedShape::ignored, "Whose x is not finite.")
      .def_readonly("held_out", &FittedShape::held_out,
                    "Calibration of a fit to every other sample by the rest; None for fewer than two.")
      .def("__repr__", [](const FittedShape& self) {
        return record("FittedShape", {{"shape", py::cast(self.shape)},
                                      {"direction", py::cast(word_for(self.direction))},
                                      {"samples", py::cast(self.samples)},
                                      {"ignored", py::cast(self.ignored)},
                                      {"held_out", py::cast(self.held_out)}});
      });
}

void bind_fitting(py::module_& module) {
  const evidence::FitParams defaults;
  module.def(
      "fit_shape", fitted, py::arg("x"), py::arg("labels"), py::arg("name"), py::arg("quantity"), py::arg("unit"),
      py::arg("breakpoints") = defaults.breakpoints, py::arg("min_samples") = defaults.min_samples,
      py::arg("confidence") = defaults.confidence, py::arg("direction") = py::none(),
      R"(fit_shape(x, labels, name, quantity, unit, breakpoints=16, min_samples=5, confidence=0.95, direction=None)
--

A monotone shape, a FittedShape, from measured numbers whose truth is known: isotonic regression (Ayer et al. 1955) of
shares of equal count, with the bounds of Clopper and Pearson (1934) as Bel and Pl. Few samples leave most unknown.

x, labels: shape (n,), labels of bool. breakpoints: at most; min_samples: of each; confidence in (0, 1): how often
[Bel, Pl] is to hold the true share, place by place, of independent samples. direction: "rising", "falling", or None for
the one that fits better. ValueError for others, and if no x is finite.

>>> fit = fit_shape([1.0] * 20 + [2.0] * 20, [False] * 20 + [True] * 20, "match", "score", "1")
>>> fit.direction, fit.shape([1.0, 2.0]).round(2)
('rising', array([[0.  , 0.83, 0.17],
       [0.83, 0.  , 0.17]])))");
  module.def("calibration_of", judged, py::arg("shape"), py::arg("x"), py::arg("labels"), py::arg("bins") = 10,
             R"(calibration_of(shape, x, labels, bins=10)
--

How well a shape agrees with samples, best such as it was not fitted to: a Calibration. x, labels as fit_shape.)");
  module.def("predictive_belief", evidence::predictive_belief, py::arg("successes"), py::arg("trials"),
             py::arg("confidence"), R"(predictive_belief(successes, trials, confidence)
--

Belief that the next of independent trials succeeds (Denoeux 2006): Bel and Pl are the bounds of Clopper and Pearson
(1934), which hold the true probability in at least the share `confidence`, in (0, 1), of all series. No trial gives the
vacuous mass.)");
}

}  // namespace

void bind_elicitation(py::module_& module) {
  bind_breakpoint(module);
  bind_shape(module);
  bind_fit_results(module);
  bind_fitting(module);
}

}  // namespace credo::python
