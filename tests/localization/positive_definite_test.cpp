// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/positive_definite.hpp"

#include <gtest/gtest.h>

#include <random>

namespace credo::localization {
namespace {

using Matrix = PoseState::Matrix;

/// Metres beside milliradians, as a state has them.
Matrix covariance(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  PoseState::Vector scale;
  scale << 0.1, 0.1, 0.01, 1e-3, 1e-3, 1e-3, 1e-3, 1e-5, 1e-5;
  const Matrix any = Matrix::NullaryExpr([&] { return uniform(random); });
  return scale.asDiagonal() * (any * any.transpose() + 0.01 * Matrix::Identity()) * scale.asDiagonal();
}

TEST(PositiveDefinite, RootSquaredAndInverseTimesTheMatrixAreTheMatrixAndOne) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const Matrix P = covariance(random);
    const Matrix U = root<PoseState::kSize>(P);
    EXPECT_TRUE((U.transpose() * U).isApprox(P, 1e-12));
    Matrix inverted;
    ASSERT_TRUE(invert(P, inverted));
    EXPECT_TRUE((inverted * P).isApprox(Matrix::Identity(), 1e-8)) << inverted * P;
    EXPECT_EQ(inverted, inverted.transpose());
    EXPECT_EQ(inverted, inverse(P));
  }
}

TEST(PositiveDefinite, WhatIsSingularOrNegativeHasNoInverse) {
  std::mt19937 random(2);
  Matrix singular = covariance(random), kept = Matrix::Identity();
  singular.row(4).setZero();
  singular.col(4).setZero();
  EXPECT_FALSE(invert(singular, kept));
  Matrix negative = covariance(random);
  negative(0, 0) = -1.0;
  EXPECT_FALSE(invert(negative, kept));
  EXPECT_EQ(kept, Matrix::Identity());
}

TEST(PositiveDefinite, APivotRoundedBelowZeroIsZero) {
  Eigen::Matrix2d flat;
  flat << 1.0, 1.0, 1.0, 1.0 - 1e-16;
  EXPECT_EQ(root<2>(flat)(1, 1), 0.0);
}

}  // namespace
}  // namespace credo::localization
