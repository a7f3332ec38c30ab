// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/grid_mass.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

constexpr GridElement kElements[] = {GridElement::kEmpty, GridElement::kOccupied, GridElement::kUnknown};

RC_GTEST_PROP(GridMassLaws, DsmcIsACommutativeMonoid, (const GridMass& a, const GridMass& b, const GridMass& c)) {
  const GridMass ab = dsmc(a, b);
  RC_ASSERT(std::abs(total(ab) - 1.0) < 1e-15);
  RC_ASSERT(std::min({ab.empty, ab.occupied, ab.conflict, ab.unknown}) >= 0.0);
  RC_ASSERT(distance(ab, dsmc(b, a)) < 1e-15);
  RC_ASSERT(distance(dsmc(ab, c), dsmc(a, dsmc(b, c))) < 1e-15);
  RC_ASSERT(dsmc(a, GridMass::vacuous()) == a);
}

RC_GTEST_PROP(GridMassLaws, CommonalitiesMultiply, (const GridMass& a, const GridMass& b)) {
  for (const GridElement element : kElements) {
    const double product = commonality(a, element, GridModel::kFree) * commonality(b, element, GridModel::kFree);
    RC_ASSERT(std::abs(commonality(dsmc(a, b), element, GridModel::kFree) - product) < 1e-15);
  }
}

RC_GTEST_PROP(GridMassLaws, BeliefIsBelowPignisticBelowPlausibility, (const GridMass& mass)) {
  for (const GridModel model : {GridModel::kFree, GridModel::kExclusive}) {
    const double kept = model == GridModel::kFree ? 1.0 : 1.0 - mass.conflict;
    if (kept < 1e-9) continue;
    for (const GridElement element : kElements) {
      const double probability = kept * pignistic(mass, element, model);
      RC_ASSERT(belief(mass, element, model) <= probability + 1e-15);
      RC_ASSERT(probability <= plausibility(mass, element, model) + 1e-15);
    }
  }
}

RC_GTEST_PROP(GridMassLaws, ProbabilitiesAreAdditive, (const GridMass& mass)) {
  const double epsilon = *rc::gen::element(0.0, 1e-3, 0.1, 1.0);
  const auto sum = [&](auto probability, GridModel model) {
    const double overlap = model == GridModel::kFree ? probability(GridElement::kConflict, model) : 0.0;
    return probability(GridElement::kEmpty, model) + probability(GridElement::kOccupied, model) - overlap;
  };
  const auto betp = [&](GridElement element, GridModel model) { return pignistic(mass, element, model); };
  const auto proportional = [&](GridElement element, GridModel model) { return dsmp(mass, element, model, epsilon); };
  RC_ASSERT(std::abs(sum(betp, GridModel::kFree) - 1.0) < 1e-14);
  RC_ASSERT(std::abs(sum(proportional, GridModel::kFree) - 1.0) < 1e-14);
  RC_PRE(mass.conflict < 1.0);
  RC_ASSERT(std::abs(sum(betp, GridModel::kExclusive) - 1.0) < 1e-14);
  RC_ASSERT(std::abs(sum(proportional, GridModel::kExclusive) - 1.0) < 1e-14);
}

// On two elements every transform decides alike: it changes the probability shown, not the decision.
RC_GTEST_PROP(GridMassLaws, TransformsAgreeOnTheDecision, (const GridMass& mass)) {
  RC_PRE(mass.conflict < 1.0 && std::abs(mass.empty - mass.occupied) > 1e-9);
  const bool occupied = mass.occupied > mass.empty;
  const auto decide = [&](auto value) { return value(GridElement::kOccupied) > value(GridElement::kEmpty); };
  RC_ASSERT(decide([&](GridElement e) { return pignistic(mass, e, GridModel::kExclusive); }) == occupied);
  RC_ASSERT(decide([&](GridElement e) { return plausibility(mass, e, GridModel::kExclusive); }) == occupied);
  RC_ASSERT(decide([&](GridElement e) { return dsmp(mass, e, GridModel::kExclusive, 1e-3); }) == occupied);
}

TEST(GridMass, DsmpWithoutAUsableEpsilonIsRefused) {
  for (const double epsilon : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW((void)dsmp({.3, .1, 0.0, .6}, GridElement::kEmpty, GridModel::kFree, epsilon), std::invalid_argument);
  }
}

TEST(GridMass, ConflictBelongsToBothUnderTheFreeModel) {
  const GridMass mass{.3, .1, .2, .4};
  EXPECT_NEAR(belief(mass, GridElement::kOccupied, GridModel::kFree), .3, 1e-15);
  EXPECT_NEAR(plausibility(mass, GridElement::kOccupied, GridModel::kFree), 1.0, 1e-15);
  EXPECT_NEAR(belief(mass, GridElement::kOccupied, GridModel::kExclusive), .1, 1e-15);
  EXPECT_NEAR(plausibility(mass, GridElement::kOccupied, GridModel::kExclusive), .5, 1e-15);
  EXPECT_NEAR(commonality(mass, GridElement::kConflict, GridModel::kFree), 1.0, 1e-15);
}

// One overlap region, one region of each alone: .3 (1, 1/2) + .1 (1/2, 1) + .2 (1, 1) + .4 (2/3, 2/3).
TEST(GridMass, PignisticSharesByVennRegions) {
  const GridMass mass{.3, .1, .2, .4};
  EXPECT_NEAR(pignistic(mass, GridElement::kEmpty, GridModel::kFree), .3 + .05 + .2 + .8 / 3.0, 1e-15);
  EXPECT_NEAR(pignistic(mass, GridElement::kEmpty, GridModel::kExclusive), .5 / .8, 1e-15);
}

TEST(GridMass, DsmpTakesItsLimitWhereNothingSingleIsBelieved) {
  const GridMass mass = GridMass::from(.3, .1);
  EXPECT_NEAR(dsmp(mass, GridElement::kEmpty, GridModel::kExclusive, 0.0), .75, 1e-15);
  EXPECT_NEAR(dsmp(GridMass::vacuous(), GridElement::kEmpty, GridModel::kExclusive, 0.0), .5, 1e-15);
  EXPECT_NEAR(dsmp(GridMass::vacuous(), GridElement::kEmpty, GridModel::kFree, 0.0), 2.0 / 3.0, 1e-15);
}

TEST(GridMass, TotalConflictHasNoProbability) {
  const GridMass mass{0.0, 0.0, 1.0, 0.0};
  EXPECT_FALSE(without_conflict(mass));
  EXPECT_THROW((void)pignistic(mass, GridElement::kEmpty, GridModel::kExclusive), std::domain_error);
  EXPECT_THROW((void)dsmp(mass, GridElement::kEmpty, GridModel::kExclusive, 0.0), std::domain_error);
  EXPECT_NEAR(pignistic(mass, GridElement::kEmpty, GridModel::kFree), 1.0, 1e-15);
}

TEST(GridMass, RefusesWhatIsNoMass) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)GridMass::from(-.1, .2), std::invalid_argument);
  EXPECT_THROW((void)GridMass::from(.5, .4, .2), std::invalid_argument);
  EXPECT_THROW((void)GridMass::from(.5, nan), std::invalid_argument);
  EXPECT_THROW((void)dsmp(GridMass::vacuous(), GridElement::kEmpty, GridModel::kFree, -1.0), std::invalid_argument);
  EXPECT_THROW((void)dsmp(GridMass::vacuous(), GridElement::kEmpty, GridModel::kFree, nan), std::invalid_argument);
  EXPECT_EQ(GridMass::from(.25, .25, .25), (GridMass{.25, .25, .25, .25}));
}

TEST(GridMass, DiscountingMovesTowardsIgnorance) {
  const GridMass weak = discount(GridMass{.5, .25, .25, 0.0}, .5);
  EXPECT_EQ(weak, (GridMass{.25, .125, .125, .5}));
  EXPECT_EQ(discount(weak, 0.0), GridMass::vacuous());
}

TEST(GridMass, PrintsReadably) {
  std::ostringstream text;
  text << GridMass{.25, .5, .25, 0.0};
  EXPECT_EQ(text.str(), "{empty 0.25, occupied 0.5, conflict 0.25, unknown 0}");
}

}  // namespace
}  // namespace credo::evidence
