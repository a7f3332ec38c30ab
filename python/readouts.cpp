// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <optional>

#include "evidence/conjunctive.hpp"
#include "evidence/decomposition.hpp"
#include "evidence/discounting.hpp"
#include "evidence/measures.hpp"
#include "evidence/probability.hpp"
#include "evidence/summarization.hpp"
#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::Criterion;
using evidence::MassFunction;
using evidence::Proposition;

constexpr std::array<std::pair<std::string_view, Criterion>, 3> kCriteria{
    {{"belief", Criterion::kBelief}, {"plausibility", Criterion::kPlausibility}, {"pignistic", Criterion::kPignistic}}};

struct Decision {
  NamedProposition choice;
  bool rejected;
  double value;
  double margin;

  friend bool operator==(const Decision&, const Decision&) = default;
};

Decision decide(const MassFunction& mass, const std::optional<std::vector<SetLike>>& candidates,
                const std::string& criterion, double min_value, double min_margin) {
  std::vector<Proposition> sets;
  if (candidates) {
    for (const SetLike& candidate : *candidates) sets.push_back(resolved(mass.frame(), candidate));
  } else {
    for (std::size_t i = 0; i < mass.frame().size(); ++i) sets.push_back(mass.frame().element(i));
  }
  const evidence::Decision made = evidence::decide(
      mass, sets,
      {.criterion = chosen(criterion, "criterion", kCriteria), .min_value = min_value, .min_margin = min_margin});
  return {{mass.frame(), sets[made.choice]}, made.rejected, made.value, made.margin};
}

// A measure of one proposition.
template <double (*kMeasure)(const MassFunction&, const Proposition&)>
double of_set(const MassFunction& self, const SetLike& set) {
  return kMeasure(self, resolved(self.frame(), set));
}

void bind_measures(py::class_<MassFunction>& mass_function) {
  mass_function
      .def("belief", of_set<evidence::belief>, py::arg("set"), R"(belief(self, set)
--

Bel(A): the mass of all that implies A; what is on ∅ counts nowhere (Shafer 1976).)")
      .def("plausibility", of_set<evidence::plausibility>, py::arg("set"), R"(plausibility(self, set)
--

Pl(A): the mass of all that meets A. On a free model 1 for every A.)")
      .def("commonality", of_set<evidence::commonality>, py::arg("set"),
           "commonality(self, set)\n--\n\nq(A): the mass of all that A implies; q(∅) = 1.")
      .def("implicability", of_set<evidence::implicability>, py::arg("set"),
           "implicability(self, set)\n--\n\nb(A) = Bel(A) + m(∅).")
      .def("nonspecificity", evidence::nonspecificity, R"(nonspecificity(self)
--

Σ m(A) log2 |A|, in bits: what is not decided between the elements (Dubois and Prade 1985).)")
      .def("dissonance", evidence::dissonance,
           "dissonance(self)\n--\n\n-Σ m(A) log2 Pl(A), in bits: what contradicts the rest (Yager 1983).")
      .def("strife", evidence::strife, R"(strife(self)
--

-Σ m(A) log2 Σ m(B) |A ∩ B| / |A|, in bits: contradiction by degrees (Klir and Parviz 1992).)")
      .def("pignistic_entropy", evidence::pignistic_entropy, R"(pignistic_entropy(self)
--

Shannon's entropy of the pignistic probabilities of the Venn regions, in bits. ValueError at m(∅) = 1.)")
      .def("jirousek_shenoy_entropy", evidence::jirousek_shenoy_entropy, R"(jirousek_shenoy_entropy(self)
--

Shannon's entropy of the plausibility transform + nonspecificity, in bits (Jirousek and Shenoy 2018). Power sets only.
ValueError at m(∅) = 1, or on another model.)");
}

void bind_probabilities(py::class_<MassFunction>& mass_function) {
  mass_function
      .def("pignistic", of_set<evidence::pignistic>, py::arg("set"), R"(pignistic(self, set)
--

BetP(A): every mass shared equally among the Venn regions of its proposition (Smets; Dezert, Smarandache and Daniel
2004). As all probabilities here it divides m(∅) out. ValueError at m(∅) = 1.)")
      .def(
          "pignistic_regions", [](const MassFunction& self) { return array(evidence::pignistic_regions(self)); },
          R"(pignistic_regions(self)
--

BetP of every Venn region, shape (frame.region_count,): on a power set of the elements. Sums to 1.)")
      .def(
          "dsmp",
          [](const MassFunction& self, const SetLike& set, double epsilon) {
            return evidence::dsmp(self, resolved(self.frame(), set), epsilon);
          },
          py::arg("set"), py::arg("epsilon"), R"(dsmp(self, set, epsilon)
--

DSmP(A): every mass shared among its regions in proportion to what these were given alone, plus epsilon >= 0 each
(Dezert and Smarandache 2008). ValueError at m(∅) = 1.)")
      .def(
          "dsmp_regions",
          [](const MassFunction& self, double epsilon) { return array(evidence::dsmp_regions(self, epsilon)); },
          py::arg("epsilon"), "dsmp_regions(self, epsilon)\n--\n\nDSmP of every Venn region, as pignistic_regions.")
      .def(
          "plausibility_transform",
          [](const MassFunction& self) { return array(evidence::plausibility_transform(self)); },
          R"(plausibility_transform(self)
--

Normalised plausibilities of the elements, shape (n,) (Cobb and Shenoy 2006). Power sets only.)")
      .def("decide", decide, py::arg("candidates") = py::none(), py::arg("criterion") = "pignistic",
           py::arg("min_value") = 0.0, py::arg("min_margin") = 0.0,
           R"(decide(self, candidates=None, criterion='pignistic', min_value=0.0, min_margin=0.0)
--

The best of the candidates, of the elements if none are given; the first of equal ones.

criterion: "belief", "plausibility" or "pignistic". Rejected are a value below min_value, a lead over the second below
min_margin, and all at m(∅) = 1.)");
}

void bind_discounting(py::class_<MassFunction>& mass_function) {
  mass_function
      .def(
          "discount",
          [](const MassFunction& self, double reliability) { return evidence::discount(self, reliability); },
          py::arg("reliability"), R"(discount(self, reliability)
--

Classical discounting: every mass times the reliability in [0, 1] of its source, the rest to Θ (Shafer 1976). The
literature's α is 1 - reliability.)")
      .def(
          "contextual_discount",
          [](const MassFunction& self, const Array& reliabilities) {
            return evidence::contextual_discount(self, numbers(reliabilities, "reliabilities"));
          },
          py::arg("reliabilities"), R"(contextual_discount(self, reliabilities)
--

Discounting where reliability depends on the truth (Mercier, Quost and Denoeux 2008). Power sets only.

reliabilities: shape (n,), each in [0, 1]; where the truth is that element.)")
      .def("decay", evidence::decay, py::arg("age"), py::arg("half_life"), R"(decay(self, age, half_life)
--

discount(2^(-age / half_life)): what was said a time ago. age >= 0, half_life > 0, in one unit.)");
}

void bind_changes(py::class_<MassFunction>& mass_function) {
  mass_function
      .def(
          "condition",
          [](const MassFunction& self, const SetLike& event) {
            return evidence::condition(self, resolved(self.frame(), event));
          },
          py::arg("event"), R"(condition(self, event)
--

Dempster's conditioning, a Fused: what is left if the truth is in `event`. None if it is contradicted totally.)")
      .def("normalised", evidence::normalised,
           "normalised(self)\n--\n\nA Fused without m(∅), divided by the sum of the rest. None if there is no rest.")
      .def("negation", evidence::negation,
           "negation(self)\n--\n\nThe masses given to the complements: m'(A) = m(¬A). Power sets only.")
      .def("summarized", evidence::summarized, py::arg("most"), R"(summarized(self, most)
--

At most `most` focal elements, beside ∅: the largest masses stay, the others go to the union of their sets
(summarization; Lowrance, Garvey and Strat 1986). It never says more than the original: Bel falls, Pl rises.

ValueError unless most >= 1.

>>> frame = Frame.shafer(["A", "B", "C"])
>>> print(MassFunction(frame, {"A": 0.5, "B": 0.25, "C": 0.25}).summarized(2))
{A: 0.5, B ∪ C: 0.5})");
}

}  // namespace

void bind_readouts(py::class_<MassFunction>& mass_function, py::module_& module) {
  py::class_<Decision>(module, "Decision", "The choice among propositions, with what it takes to refuse it.")
      .def_readonly("choice", &Decision::choice, "What leads, also if it is rejected.")
      .def_readonly("rejected", &Decision::rejected, "Its value or lead is too small.")
      .def_readonly("value", &Decision::value, "What the criterion gives it.")
      .def_readonly("margin", &Decision::margin, "Lead over the second; the value itself where there is none.")
      .def(py::self == py::self)
      .def("__repr__",
           [](const Decision& self) {
             return record("Decision", {{"choice", py::cast(self.choice)},
                                        {"rejected", py::cast(self.rejected)},
                                        {"value", py::cast(self.value)},
                                        {"margin", py::cast(self.margin)}});
           })
      .def(py::pickle(
          [](const Decision& self) { return py::make_tuple(self.choice, self.rejected, self.value, self.margin); },
          [](const py::tuple& state) {
            return Decision{state[0].cast<NamedProposition>(), state[1].cast<bool>(), state[2].cast<double>(),
                            state[3].cast<double>()};
          }));
  bind_measures(mass_function);
  bind_probabilities(mass_function);
  bind_discounting(mass_function);
  bind_changes(mass_function);
  module.def("conflict_between", evidence::conflict_between, py::arg("a"), py::arg("b"), R"(conflict_between(a, b)
--

m(∅) of the two under the conjunctive rule, in [0, 1]. Not a distance: it may be > 0 between equal ones.)");
  module.def("jousselme_distance", evidence::jousselme_distance, py::arg("a"), py::arg("b"),
             py::call_guard<py::gil_scoped_release>(),
             R"(jousselme_distance(a, b)
--

sqrt((a - b)' D (a - b) / 2), D(A, B) = |A ∩ B| / |A ∪ B|: a metric in [0, 1] (Jousselme, Grenier and Bosse 2001).)");
  module.def("reliability_after", evidence::reliability_after, py::arg("age"), py::arg("half_life"),
             R"(reliability_after(age, half_life)
--

2^(-age / half_life): reliability of what was said a time ago. age >= 0, half_life > 0; both may be infinite.)");
}

}  // namespace credo::python
