// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/rules.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "evidence/averaging.hpp"
#include "evidence/conflict_to_sets.hpp"
#include "evidence/conjunctive.hpp"
#include "evidence/decomposition.hpp"
#include "evidence/disjunctive.hpp"
#include "evidence/proportional.hpp"

namespace credo::evidence {
namespace {

std::optional<Fused> with_its_conflict(MassFunction mass) {
  const double conflict = mass.conflict();
  return Fused{std::move(mass), conflict};
}

template <CombinationRule R>
constexpr NamedRule named() {
  return {R::kName, R::kLaws, &R::combine};
}

constexpr std::array kRules{
    named<rule::Conjunctive>(), named<rule::Dempster>(), named<rule::Disjunctive>(), named<rule::ConflictToIgnorance>(),
    named<rule::DuboisPrade>(), named<rule::Dsmh>(),     named<rule::Pcr2>(),        named<rule::Pcr5>(),
    named<rule::Pcr6>(),        named<rule::Cautious>(), named<rule::Bold>(),        named<rule::Average>(),
    named<rule::Murphy>()};

}  // namespace

namespace rule {

std::optional<Fused> Conjunctive::combine(const Sources& s) { return with_its_conflict(conjunctive(s)); }
std::optional<Fused> Dempster::combine(const Sources& s) { return dempster(s); }
std::optional<Fused> Disjunctive::combine(const Sources& s) { return with_its_conflict(disjunctive(s)); }
std::optional<Fused> ConflictToIgnorance::combine(const Sources& s) { return conflict_to_ignorance(s); }
std::optional<Fused> DuboisPrade::combine(const Sources& s) { return dubois_prade(s); }
std::optional<Fused> Dsmh::combine(const Sources& s) { return dsmh(s); }
std::optional<Fused> Pcr2::combine(const Sources& s) { return pcr2(s); }
std::optional<Fused> Pcr5::combine(const Sources& s) { return pcr5(s); }
std::optional<Fused> Pcr6::combine(const Sources& s) { return pcr6(s); }
std::optional<Fused> Cautious::combine(const Sources& s) { return with_its_conflict(cautious(s)); }
std::optional<Fused> Bold::combine(const Sources& s) { return with_its_conflict(bold(s)); }
std::optional<Fused> Average::combine(const Sources& s) { return with_its_conflict(average(s)); }
std::optional<Fused> Murphy::combine(const Sources& s) { return murphy(s); }

}  // namespace rule

std::span<const NamedRule> all_rules() { return kRules; }

const NamedRule& rule_named(std::string_view name) {
  const auto found = std::ranges::find(kRules, name, &NamedRule::name);
  if (found == kRules.end()) {
    std::string known;
    for (const NamedRule& each : kRules) known += (known.empty() ? "" : ", ") + std::string(each.name);
    throw std::invalid_argument("there is no rule '" + std::string(name) + "'; there are: " + known);
  }
  return *found;
}

}  // namespace credo::evidence
