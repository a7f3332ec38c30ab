// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/plan_covariance.hpp"

#include <gtest/gtest.h>

#include <random>

namespace credo::localization {
namespace {

using Pair = PoseState::Pair;

/// Numbers without a pattern.
template <class Matrix>
Matrix drawn(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Matrix::NullaryExpr([&] { return uniform(random); });
}

TEST(PlanCovariance, OfWhatWasNeverSeenIsZero) {
  std::mt19937 random(1);
  PlanPart part;
  part.clear(20);
  part.add(6, drawn<Pair>(random));
  PlanCovariance covariance(20);
  covariance -= part;
  covariance.transform(drawn<PoseState::Matrix>(random));
  for (int column = 0; column < 20; column += 2) EXPECT_EQ(covariance[column].isZero(0.0), column != 6) << column;
}

TEST(PlanCovariance, IsTheMatrixThatItStandsFor) {
  constexpr int kErrors = 26;
  using Columns = Eigen::Matrix<double, PoseState::kSize, kErrors>;
  std::mt19937 random(2);
  std::uniform_int_distribution<int> place(0, kErrors / 2 - 1);
  PlanCovariance covariance(kErrors);
  Columns expected = Columns::Zero();
  PlanPart part;
  for (int round = 0; round < 8; ++round) {
    const auto A = drawn<PoseState::Matrix>(random);
    part.clear(kErrors);
    Columns taken = Columns::Zero();
    for (int i = 0; i < 3; ++i) {
      const int column = 2 * place(random);
      const auto derivative = drawn<Pair>(random);
      part.add(column, derivative);
      taken.middleCols<2>(column) += derivative;
    }
    covariance.transform(A);
    covariance -= part;
    expected = (A * expected).eval() - taken;
    EXPECT_TRUE(part.covariance().isApprox(taken * taken.transpose(), 1e-12));
    for (int column = 0; column < kErrors; column += 2)
      EXPECT_LT((covariance[column] - expected.middleCols<2>(column)).norm(), 1e-9) << round << ", " << column;
  }
}

TEST(PlanCovariance, AssignedOverAFullerOneHasNothingOfIt) {
  std::mt19937 random(3);
  PlanPart all, one;
  all.clear(12), one.clear(12);
  for (int column = 0; column < 12; column += 2) all.add(column, drawn<Pair>(random));
  one.add(4, drawn<Pair>(random));
  PlanCovariance target(12), source(12);
  target -= all;
  source -= one;
  target = source;
  EXPECT_EQ(target.errors(), 12);
  target -= all;  // places that the fuller one had are taken anew
  for (const auto& [first, derivative] : all.columns())
    EXPECT_EQ(target[first], first == 4 ? Pair(source[4] - derivative) : Pair(-derivative));
}

}  // namespace
}  // namespace credo::localization
