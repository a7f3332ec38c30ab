// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/rules.hpp"

#include <optional>

#include "evidence/averaging.hpp"
#include "evidence/binary_rules.hpp"
#include "evidence/conjunctive.hpp"
#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::BinaryMass;
using evidence::Fused;
using evidence::FusedBinaryMass;
using evidence::Laws;
using evidence::MassFunction;
using evidence::NamedRule;
using evidence::OpenBinaryMass;

std::vector<MassFunction> mass_functions(const py::list& sources) {
  return sources_of<MassFunction>(sources, "MassFunction");
}

py::object combined(const NamedRule& rule, const py::args& sources) {
  const py::list all = listed(sources);
  if (std::optional<py::object> fused = in_closed_form(rule.name, all)) return *std::move(fused);
  const std::vector<MassFunction> masses = mass_functions(all);
  return py::cast(without_gil([&] { return rule.combine(masses); }));
}

py::object averaged(const py::args& sources, const py::object& weights) {
  const NamedRule& rule = evidence::rule_named(evidence::rule::Average::kName);
  if (weights.is_none()) return combined(rule, sources);
  const Array values(weights);
  const std::span<const double> given = numbers(values, "weights");
  if (given.empty()) throw std::invalid_argument("weights must be one for each source, or None; got none");
  const py::list all = listed(sources);
  if (are_binary(all)) return py::cast(FusedBinaryMass{evidence::average(binary_masses(all), given), 0.0});
  MassFunction mass = evidence::average(mass_functions(all), given);
  const double conflict = mass.conflict();
  return py::cast(Fused{std::move(mass), conflict});
}

using Combine = std::optional<Fused> (*)(const evidence::Sources&);

// fold_in_order of each rule, chosen while running.
template <typename... Rules>
Combine fold_of(std::string_view name) {
  Combine fold = nullptr;
  ((Rules::kName == name ? void(fold = &evidence::fold_in_order<Rules>) : void()), ...);
  return fold;
}

std::optional<Fused> folded_in_order(const std::string& rule, const py::args& sources) {
  using namespace evidence::rule;
  const Combine fold = fold_of<Conjunctive, Dempster, Disjunctive, ConflictToIgnorance, DuboisPrade, Dsmh, Pcr2, Pcr5,
                               Pcr6, Cautious, Bold, Average, Murphy>(evidence::rule_named(rule).name);
  const std::vector<MassFunction> masses = mass_functions(listed(sources));
  return without_gil([&] { return fold(masses); });
}

/// evidence::Fold of a rule that is chosen while running.
class Fold {
 public:
  Fold(const std::string& rule, MassFunction first) : rule_(evidence::rule_named(rule)), mass_(std::move(first)) {
    if (rule_.laws.associative) return;
    throw py::type_error("only associative rules are folded; what " + rule +
                         " gives depends on the order of the sources: combine all at once, or use fold_in_order");
  }

  bool add(const MassFunction& source) {
    std::optional<Fused> fused = rule_.combine({mass_, source});
    if (fused) mass_ = std::move(fused->mass);
    return fused.has_value();
  }
  [[nodiscard]] const std::string_view& rule() const { return rule_.name; }
  [[nodiscard]] const MassFunction& mass() const { return mass_; }

 private:
  NamedRule rule_;
  MassFunction mass_;
};

struct Documented {
  std::string_view name;
  const char* doc;
};

constexpr std::array<Documented, 12> kDocs{{
    {"conjunctive", R"(conjunctive(*sources)
--

Conjunctive rule: products go to intersections, the conflict stays as m(∅). On a free model the DSm classic rule
(Li X. 2006, eq. (3)), on a power set the unnormalised rule of the TBM (Smets 1990). Associative; the vacuous mass
function is neutral.

As all rules: sources are MassFunctions of one frame, given one by one or as one iterable; the result is a Fused.
ValueError for no source, or different frames. BinaryMasses are combined in closed form, to a FusedBinaryMass; here, and
in cautious, whose conflict stays, to an OpenBinaryMass. So are GridMasses, under the exclusive model, to a
FusedGridMass; here, in disjunctive and in average to a GridMass.)"},
    {"dempster", R"(dempster(*sources)
--

Dempster's rule (Shafer 1976): the conjunctive rule without m(∅), divided by the sum of the rest. Associative; the
vacuous mass function is neutral. None at total conflict.)"},
    {"disjunctive", R"(disjunctive(*sources)
--

Disjunctive rule: products go to unions (Dubois and Prade 1986): at least one source is reliable, nobody knows which.
No conflict arises. Associative; the vacuous mass function absorbs all others.)"},
    {"yager", R"(yager(*sources)
--

Conflict to ignorance (Yager 1987): m(∅) of all sources together goes to Θ, once. Not associative; the vacuous mass
function is neutral. Total conflict gives the vacuous one.)"},
    {"dubois_prade", R"(dubois_prade(*sources)
--

Dubois and Prade (1988): a product whose sets meet nowhere goes to their union. Not associative; the vacuous mass
function is neutral beside one source, not beside two that conflict, but on two elements.)"},
    {"dsmh", R"(dsmh(*sources)
--

DSm hybrid rule (Smarandache and Dezert 2004): as Dubois and Prade; where constraints leave nothing of a union, to the
elements that compose it, else to Θ. Not associative; the vacuous mass function as in dubois_prade.)"},
    {"pcr2", R"(pcr2(*sources)
--

PCR2 (Smarandache and Dezert 2005; Li P., eq. (6)): all conflict together to the sets involved in it, in proportion to
the sums of their masses. Not associative; the vacuous mass function is neutral.)"},
    {"pcr5", R"(pcr5(*sources)
--

PCR5 (Smarandache and Dezert 2005): each conflicting product to the sets in it, in proportion to the product of the
masses given to each. Not associative; from three sources on the vacuous mass function is not neutral.

ValueError also for more than 1e8 products of focal elements, and unless GridMasses are two.)"},
    {"pcr6", R"(pcr6(*sources)
--

PCR6 (Martin and Osswald 2006): as PCR5, in proportion to the sum of these masses; for categorical sources the share of
votes. The same for two sources.)"},
    {"cautious", R"(cautious(*sources)
--

Cautious rule (Denoeux 2008): the smallest weight that a source gives to each simple mass function. For reliable
sources that may share evidence. Associative, idempotent; conflict stays as m(∅). Power sets only.

ValueError for a dogmatic source (m(Θ) = 0): discount it first. Takes OpenBinaryMasses too, as it gives them.)"},
    {"bold", R"(bold(*sources)
--

Bold rule (Denoeux 2008): the disjunctive counterpart of the cautious one. Associative, idempotent. Power sets only.

ValueError for a source without mass on ∅. Takes OpenBinaryMasses too, to give one; TypeError for BinaryMasses, which
have no mass there.)"},
    {"murphy", R"(murphy(*sources)
--

Murphy's rule (2000): the mean of s sources combined with itself s - 1 times by Dempster's rule. Neither associative nor
idempotent. None if all mass is on ∅.)"},
}};

void bind_table(py::module_& module) {
  py::class_<Laws>(module, "Laws", "What holds for a rule whatever the mass functions.")
      .def_readonly("associative", &Laws::associative, "Combining some sources first changes nothing.")
      .def_readonly("commutative", &Laws::commutative, "The order of the sources does not matter.")
      .def_readonly("idempotent", &Laws::idempotent, "A source combined with itself is itself.")
      .def_readonly("vacuous_neutral", &Laws::vacuous_neutral, "A source that knows nothing changes nothing.")
      .def("__repr__", [](const Laws& self) {
        return record("Laws", {{"associative", py::cast(self.associative)},
                               {"commutative", py::cast(self.commutative)},
                               {"idempotent", py::cast(self.idempotent)},
                               {"vacuous_neutral", py::cast(self.vacuous_neutral)}});
      });
  py::class_<NamedRule>(module, "Rule", "A rule chosen while running: called as the function of its name.")
      .def_readonly("name", &NamedRule::name, "As in rules().")
      .def_readonly("laws", &NamedRule::laws, "What holds for it.")
      .def("__call__", combined, "__call__(self, *sources)\n--\n\nAs the function of its name.")
      .def(
          "__eq__", [](const NamedRule& a, const NamedRule& b) { return a.name == b.name; }, py::is_operator())
      .def("__hash__", [](const NamedRule& self) { return py::hash(py::cast(self.name)); })
      .def("__repr__",
           [](const NamedRule& self) {
             return record("Rule", {{"name", py::cast(self.name)}});
           })
      .def(py::pickle([](const NamedRule& self) { return py::make_tuple(self.name); },
                      [](const py::tuple& state) { return evidence::rule_named(state[0].cast<std::string>()); }));
  module.def(
      "rules",
      [] {
        py::dict rules;
        for (const NamedRule& rule : evidence::all_rules()) rules[py::cast(rule.name)] = rule;
        return rules;
      },
      R"(rules()
--

All rules by their names, with their laws.

>>> [name for name, rule in rules().items() if rule.laws.associative]
['conjunctive', 'dempster', 'disjunctive', 'cautious', 'bold'])");
}

void bind_folds(py::module_& module) {
  py::class_<Fold>(module, "Fold", R"(Sources taken in one after the other, by an associative rule.

The result is that of all together, in any order.

>>> frame = Frame.shafer(["A", "B"])
>>> fold = Fold("dempster", MassFunction.vacuous(frame))
>>> fold.add(MassFunction.simple_support(frame, "A", 0.5)), fold.mass["A"]
(True, 0.5))")
      .def(py::init<const std::string&, MassFunction>(), py::arg("rule"), py::arg("first"),
           R"(__init__(self, rule, first)
--

rule: its name. TypeError for one that is not associative, ValueError for none.)")
      .def("add", &Fold::add, py::arg("source"),
           "add(self, source)\n--\n\nFalse at total conflict, where the mass function stays as it was.")
      .def_property_readonly("rule", &Fold::rule, "Its name.")
      .def_property_readonly("mass", &Fold::mass, "What the sources so far say.");
  module.def("fold_in_order", folded_in_order, py::arg("rule"), R"(fold_in_order(rule, *sources)
--

The left fold of any rule, by its name: what was before combined with the next. For rules that are not associative it
depends on the order. `conflict` is that of the last step. None if a step has no result.)");
}

}  // namespace

void bind_rules(py::module_& module) {
  bind_table(module);
  for (const auto& [name, doc] : kDocs) {
    const NamedRule& rule = evidence::rule_named(name);
    module.def(
        name.data(), [&rule](const py::args& sources) { return combined(rule, sources); }, doc);
  }
  module.def("average", averaged, py::arg("weights") = py::none(), R"(average(*sources, weights=None)
--

Mean of the mass functions, set by set. Idempotent, not associative; the vacuous mass function dilutes.

weights: shape (s,), >= 0, not all 0; None for equal ones. ValueError for others.)");
  module.def(
      "decombine", [](const MassFunction& whole, const MassFunction& part) { return evidence::decombine(whole, part); },
      py::arg("whole"), py::arg("part"), py::call_guard<py::gil_scoped_release>(), R"(decombine(whole, part)
--

Takes `part` out of what the conjunctive rule made of it and others: q_whole / q_part (Smets 1995). Power sets of up to
20 elements. None where the quotient is no mass function. ValueError for a dogmatic part (m(Θ) = 0).

Also a BinaryMass out of the OpenBinaryMass that conjunctive made, to another.)");
  module.def(
      "decombine", [](const OpenBinaryMass& whole, const BinaryMass& part) { return evidence::decombine(whole, part); },
      py::arg("whole"), py::arg("part"));
  bind_folds(module);
  module.def(
      "pcr5_plus",
      [](const py::args& sources) {
        const std::vector<BinaryMass> masses = binary_masses(listed(sources));
        return without_gil([&] { return evidence::pcr5_plus(masses); });
      },
      R"(pcr5_plus(*sources)
--

PCR5 without a share for ignorance, so that the vacuous mass is neutral (T. Dezert, J. Dezert and Smarandache 2021). Of
BinaryMasses: a FusedBinaryMass.)");
  module.def(
      "pcr6_plus", [](const py::args& sources) { return evidence::pcr6_plus(binary_masses(listed(sources))); },
      "pcr6_plus(*sources)\n--\n\nPCR6 without a share for ignorance, as pcr5_plus.");
}

}  // namespace credo::python
