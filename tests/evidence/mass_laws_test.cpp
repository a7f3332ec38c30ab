// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include "evidence/conflict_to_sets.hpp"
#include "evidence/conjunctive.hpp"
#include "evidence/decomposition.hpp"
#include "evidence/discounting.hpp"
#include "evidence/disjunctive.hpp"
#include "evidence/measures.hpp"
#include "evidence/moebius.hpp"
#include "evidence/probability.hpp"
#include "evidence/proportional.hpp"
#include "evidence/refinement.hpp"
#include "tests/evidence/random_mass_functions.hpp"

namespace credo::evidence {
namespace {

constexpr double kRounding = 1e-12;

const MassDomain kAnyModel{.frames = all_frames()};
const MassDomain kPowerSet{.frames = power_sets()};
const MassDomain kFree{.frames = hyper_power_sets()};
const MassDomain kPowerSetUnknown{.frames = power_sets(), .some_unknown = true};
const MassDomain kPowerSetOpen{.frames = power_sets(), .some_unknown = true, .some_conflict = true};

MassFunction one(const MassDomain& domain) { return (*random_sources(1, domain)).front(); }

Proposition any_set(const Frame& frame) {
  const std::vector<Proposition>& sets = propositions_of(frame);
  return sets[*rc::gen::resize(100, rc::gen::inRange<std::size_t>(0, sets.size()))];
}

void assert_near(double a, double b, double tolerance = kRounding) { RC_ASSERT(std::abs(a - b) <= tolerance); }
void assert_near(const MassFunction& a, const MassFunction& b, double tolerance = kRounding) {
  RC_LOG() << a << " and " << b << '\n';
  RC_ASSERT(distance(a, b) <= tolerance);
}

RC_GTEST_PROP(MassLaws, BeliefIsBelowProbabilityIsBelowPlausibility, ()) {
  const MassFunction mass = one(kAnyModel);
  RC_PRE(mass.conflict() == 0.0);  // a constraint may have emptied what was drawn
  const Proposition set = any_set(mass.frame());
  const double low = belief(mass, set), high = plausibility(mass, set);
  for (const double probability : {pignistic(mass, set), dsmp(mass, set, 0.01), dsmp(mass, set, 0.0)}) {
    RC_ASSERT(low <= probability + kRounding && probability <= high + kRounding);
  }
  assert_near(implicability(mass, set), low);
}

RC_GTEST_PROP(MassLaws, PlausibilityIsWhatDoesNotContradict, ()) {
  const MassFunction mass = one(kPowerSetOpen);
  const Proposition set = any_set(mass.frame()), rest = mass.frame().all() - set;
  assert_near(plausibility(mass, set), 1.0 - implicability(mass, rest));
  assert_near(belief(mass, set), 1.0 - mass.conflict() - plausibility(mass, rest));
}

RC_GTEST_PROP(MassLaws, BeliefIsSuperadditive, ()) {
  const MassFunction mass = one(kAnyModel);
  const Proposition a = any_set(mass.frame()), b = any_set(mass.frame());
  RC_ASSERT(belief(mass, a | b) + belief(mass, a & b) >= belief(mass, a) + belief(mass, b) - kRounding);
}

RC_GTEST_PROP(MassLaws, ProbabilitiesAreAdditive, ()) {
  const MassFunction mass = one(kFree);
  const Proposition a = any_set(mass.frame()), b = any_set(mass.frame());
  assert_near(pignistic(mass, a | b) + pignistic(mass, a & b), pignistic(mass, a) + pignistic(mass, b));
  assert_near(dsmp(mass, a | b, 0.1) + dsmp(mass, a & b, 0.1), dsmp(mass, a, 0.1) + dsmp(mass, b, 0.1));
  assert_near(dsmp(mass, mass.frame().all(), 0.0), 1.0);
}

RC_GTEST_PROP(MassLaws, EverythingIsPlausibleOnAFreeModel, ()) {
  const MassFunction mass = one(kFree);
  assert_near(plausibility(mass, any_set(mass.frame())), 1.0);
}

RC_GTEST_PROP(MassLaws, TransformsThereAndBackChangeNothing, ()) {
  const MassFunction mass = one(kPowerSetOpen);
  const std::vector<double> dense = to_dense(mass);
  std::vector<double> q = dense, b = dense;
  mass_to_commonality(q);
  mass_to_implicability(b);
  const Proposition set = any_set(mass.frame());
  assert_near(q[set.low_bits()], commonality(mass, set));
  assert_near(b[set.low_bits()], implicability(mass, set));
  const std::optional<MassFunction> back = from_commonality(mass.frame(), q);
  RC_ASSERT(back.has_value());
  assert_near(*back, mass);
  implicability_to_mass(b);
  for (std::size_t i = 0; i < b.size(); ++i) assert_near(b[i], dense[i]);
}

RC_GTEST_PROP(MassLaws, CommonalitiesMultiplyUnderTheConjunctiveRule, ()) {
  const std::vector<MassFunction> sources = *random_sources(3, kAnyModel);
  const MassFunction together = conjunctive(sources);
  const Proposition set = any_set(together.frame());
  double product = 1.0;
  for (const MassFunction& source : sources) product *= commonality(source, set);
  assert_near(commonality(together, set), product);
  assert_near(total(together), 1.0);
}

RC_GTEST_PROP(MassLaws, ImplicabilitiesMultiplyUnderTheDisjunctiveRule, ()) {
  const std::vector<MassFunction> sources = *random_sources(3, kAnyModel);
  const MassFunction together = disjunctive(sources);
  const Proposition set = any_set(together.frame());
  double product = 1.0;
  for (const MassFunction& source : sources) product *= implicability(source, set);
  assert_near(implicability(together, set), product);
}

RC_GTEST_PROP(MassLaws, NegationTurnsTheConjunctiveRuleIntoTheDisjunctive, ()) {
  const std::vector<MassFunction> sources = *random_sources(2, kPowerSetOpen);
  assert_near(negation(conjunctive({negation(sources[0]), negation(sources[1])})), disjunctive(sources));
  assert_near(negation(negation(sources[0])), sources[0], 0.0);
}

RC_GTEST_PROP(MassLaws, DempstersRuleIsTheNormalisedConjunctiveRule, ()) {
  const std::vector<MassFunction> sources = *random_sources(3, kAnyModel);
  const std::optional<Fused> fused = dempster(sources), expected = normalised(conjunctive(sources));
  RC_ASSERT(fused.has_value() == expected.has_value());
  if (!fused) return;
  assert_near(fused->mass, expected->mass, 1e-10);
  assert_near(fused->conflict, expected->conflict);
}

RC_GTEST_PROP(MassLaws, DempsterMultipliesPlausibilityTransforms, ()) {
  const std::vector<MassFunction> sources = *random_sources(2, kPowerSetUnknown);
  const std::optional<Fused> fused = dempster(sources);
  RC_ASSERT(fused.has_value());
  const std::vector<double> a = plausibility_transform(sources[0]), b = plausibility_transform(sources[1]),
                            both = plausibility_transform(fused->mass);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  for (std::size_t i = 0; i < a.size(); ++i) assert_near(both[i], a[i] * b[i] / sum, 1e-10);
}

RC_GTEST_PROP(MassLaws, ConditioningMovesMassIntoTheEvent, ()) {
  const MassFunction mass = one(kPowerSetOpen);
  const Proposition event = any_set(mass.frame()), set = any_set(mass.frame());
  const std::optional<Fused> given = condition(mass, event);
  RC_ASSERT(given.has_value());
  assert_near(plausibility(given->mass, set), plausibility(mass, set & event) / plausibility(mass, event), 1e-10);
}

RC_GTEST_PROP(MassLaws, WhatWasCombinedIsTakenOutAgain, ()) {
  const std::vector<MassFunction> sources = *random_sources(2, kPowerSetUnknown);
  const std::optional<MassFunction> left = decombine(conjunctive(sources), sources[1]);
  RC_ASSERT(left.has_value());
  assert_near(*left, sources[0], 1e-10);
}

RC_GTEST_PROP(MassLaws, DecompositionThereAndBackChangesNothing, ()) {
  const MassFunction mass = one(kPowerSetOpen);
  assert_near(recompose(decompose(mass)), mass, 1e-10);
}

RC_GTEST_PROP(MassLaws, LogWeightsAddUpUnderTheConjunctiveRule, ()) {
  const std::vector<MassFunction> sources = *random_sources(2, kPowerSetOpen);
  const CanonicalDecomposition a = decompose(sources[0]), b = decompose(sources[1]),
                               both = decompose(conjunctive(sources));
  for (std::size_t i = 0; i < a.log_weights.size(); ++i) {
    assert_near(both.log_weights[i], a.log_weights[i] + b.log_weights[i], 1e-9);
  }
}

RC_GTEST_PROP(MassLaws, DiscountingTwiceIsDiscountingByTheProduct, ()) {
  const MassFunction mass = one(kAnyModel);
  const double r = *rc::gen::inRange(0, 11) / 10.0, s = *rc::gen::inRange(0, 11) / 10.0;
  assert_near(discount(discount(mass, r), s), discount(mass, r * s));
  const Proposition set = any_set(mass.frame());
  assert_near(commonality(discount(mass, r), set), 1.0 - r + r * commonality(mass, set));
}

RC_GTEST_PROP(MassLaws, ContextualDiscountingFollowsItsDefinition, ()) {
  const MassFunction mass = one(kPowerSetOpen);
  const Frame& frame = mass.frame();
  std::vector<double> reliabilities;
  std::vector<MassFunction> factors{mass};
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const double r = *rc::gen::inRange(0, 11) / 10.0;
    reliabilities.push_back(r);
    const Focal focals[] = {{Proposition(), r}, {frame.element(k), 1.0 - r}};
    factors.emplace_back(frame, focals);
  }
  assert_near(contextual_discount(mass, reliabilities), disjunctive(factors));
}

RC_GTEST_PROP(MassLaws, RulesThatAreOneOnPowerSetsAgree, ()) {
  const std::vector<MassFunction> sources = *random_sources(3, kPowerSet);
  assert_near(dubois_prade(sources).mass, dsmh(sources).mass);
}

RC_GTEST_PROP(MassLaws, ForTwoSourcesPcr5IsPcr6, ()) {
  const std::vector<MassFunction> sources = *random_sources(2, kAnyModel);
  assert_near(pcr5(sources).mass, pcr6(sources).mass);
}

RC_GTEST_PROP(MassLaws, WithoutConflictAllRulesAreTheConjunctive, ()) {
  const std::vector<MassFunction> sources = *random_sources(3, kFree);
  const MassFunction expected = conjunctive(sources);
  for (const MassFunction& mass :
       {dempster(sources)->mass, conflict_to_ignorance(sources).mass, dubois_prade(sources).mass, dsmh(sources).mass,
        pcr2(sources).mass, pcr5(sources).mass, pcr6(sources).mass}) {
    assert_near(mass, expected);
  }
}

RC_GTEST_PROP(MassLaws, JousselmesDistanceIsAMetric, ()) {
  const std::vector<MassFunction> m = *random_sources(3, kAnyModel);
  const double ab = jousselme_distance(m[0], m[1]), bc = jousselme_distance(m[1], m[2]),
               ac = jousselme_distance(m[0], m[2]);
  RC_ASSERT(ab >= 0.0 && ab <= 1.0);
  assert_near(ab, jousselme_distance(m[1], m[0]));
  RC_ASSERT(ac <= ab + bc + kRounding);
  RC_ASSERT((ab <= 1e-7) == (distance(m[0], m[1]) <= 1e-7));  // the root of a difference of 1e-16 is 1e-8
}

RC_GTEST_PROP(MassLaws, UncertaintyMeasuresKeepTheirBounds, ()) {
  const MassFunction mass = one(kPowerSet);
  const double bits = std::log2(static_cast<double>(mass.frame().size()));
  for (const double measure : {nonspecificity(mass), strife(mass), dissonance(mass), pignistic_entropy(mass)}) {
    RC_ASSERT(measure >= -kRounding && measure <= bits + kRounding);
  }
  const double total_uncertainty = jirousek_shenoy_entropy(mass);
  RC_ASSERT(total_uncertainty >= -kRounding && total_uncertainty <= 2.0 * bits + kRounding);
}

RC_GTEST_PROP(MassLaws, CoarseningUndoesRefining, ()) {
  const Frame weather = Frame::shafer({"dry", "wet"}), road = Frame::shafer({"level", "steep", "none"});
  const ProductFrame product({weather, road});
  const MassFunction mass = one({.frames = {road}});
  assert_near(product.marginal(product.extend(mass, 1), 1), mass, 0.0);
  assert_near(coarsen_inner(product.extend(mass, 1), product.factor(1)), mass, 0.0);

  const MassFunction joint = one({.frames = {product.frame()}});
  const Proposition set = any_set(weather), fine = product.factor(0).refine(set);
  assert_near(plausibility(product.marginal(joint, 0), set), plausibility(joint, fine));
  assert_near(belief(product.marginal(joint, 0), set), belief(joint, fine));
  assert_near(commonality(coarsen_inner(joint, product.factor(0)), set), commonality(joint, fine));
}

}  // namespace
}  // namespace credo::evidence
