// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/generalized_bayes.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "evidence/conjunctive.hpp"
#include "evidence/measures.hpp"
#include "tests/evidence/random_mass_functions.hpp"

namespace credo::evidence {
namespace {

const Frame kAbc = Frame::shafer({"A", "B", "C"});

TEST(GeneralizedBayes, IsBayesTheoremWithAPrior) {
  const double likelihoods[] = {0.8, 0.4, 0.1}, prior[] = {0.2, 0.3, 0.5};
  const MassFunction posterior =
      dempster({generalized_bayes(kAbc, likelihoods), MassFunction::bayesian(kAbc, prior)})->mass;
  const double evidence = 0.8 * 0.2 + 0.4 * 0.3 + 0.1 * 0.5;
  EXPECT_NEAR(posterior.mass("A"), 0.8 * 0.2 / evidence, 1e-15);
  EXPECT_NEAR(posterior.mass("C"), 0.1 * 0.5 / evidence, 1e-15);
}

TEST(GeneralizedBayes, ImpossibleObservationsAreTotalConflict) {
  const double none[] = {0.0, 0.0, 0.0}, all[] = {1.0, 1.0, 1.0};
  EXPECT_EQ(generalized_bayes(kAbc, none).conflict(), 1.0);
  EXPECT_TRUE(generalized_bayes(kAbc, all).is_vacuous());
}

TEST(GeneralizedBayes, OtherPlausibilitiesAreRefused) {
  const double two[] = {0.5, 0.5}, wrong[] = {0.5, 0.5, 1.5};
  EXPECT_THROW(static_cast<void>(generalized_bayes(kAbc, two)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(generalized_bayes(kAbc, wrong)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(generalized_bayes(Frame::free_dsm({"A", "B"}), two)), std::invalid_argument);
}

RC_GTEST_PROP(GeneralizedBayesLaws, IsTheConjunctionOfOneDenialForEachElement, ()) {
  const Frame frame = power_sets()[*rc::gen::inRange<std::size_t>(0, 4)];
  std::vector<double> plausibilities;
  Masses denials;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    plausibilities.push_back(*rc::gen::inRange(0, 11) / 10.0);
    denials.push_back(MassFunction::simple_support(frame, frame.all() - frame.element(k), 1.0 - plausibilities.back()));
  }
  const MassFunction mass = generalized_bayes(frame, plausibilities);
  RC_ASSERT(distance(mass, conjunctive(denials)) < 1e-12);
  for (std::size_t k = 0; k < frame.size(); ++k) {
    RC_ASSERT(std::abs(plausibility(mass, frame.element(k)) - plausibilities[k]) < 1e-12);
  }
}

}  // namespace
}  // namespace credo::evidence
