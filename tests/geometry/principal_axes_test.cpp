// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "geometry/principal_axes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/geometry/any_number.hpp"

namespace credo::geometry {
namespace {

RC_GTEST_PROP(PrincipalAxes, MakeUpTheCovariance, ()) {
  Eigen::Matrix2d root;
  root << any_number(), any_number(), any_number(), any_number();
  const Eigen::Matrix2d covariance = root * root.transpose();
  const PrincipalAxes axes = principal_axes(covariance);
  const Eigen::Vector2d along(std::cos(axes.angle), std::sin(axes.angle)), across(-along.y(), along.x());
  const Eigen::Matrix2d again = axes.largest * along * along.transpose() + axes.smallest * across * across.transpose();
  RC_ASSERT((again - covariance).norm() <= 1e-12 * (1.0 + covariance.norm()));
  RC_ASSERT(axes.largest >= axes.smallest);
  RC_ASSERT(axes.largest == largest_variance(covariance));
  RC_ASSERT(axes.smallest >= -1e-12 * (1.0 + covariance.norm()));
}

TEST(PrincipalAxes, LieAlongTheCoordinatesOfADiagonalCovariance) {
  const PrincipalAxes along_x = principal_axes(Eigen::Vector2d(4.0, 1.0).asDiagonal());
  EXPECT_DOUBLE_EQ(along_x.largest, 4.0);
  EXPECT_DOUBLE_EQ(along_x.smallest, 1.0);
  EXPECT_DOUBLE_EQ(along_x.angle, 0.0);
  EXPECT_DOUBLE_EQ(principal_axes(Eigen::Vector2d(1.0, 4.0).asDiagonal()).angle, 0.5 * std::numbers::pi);
}

TEST(PrincipalAxes, AreNoNumberWhereTheCovarianceIsNone) {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(principal_axes(covariance).largest));
}

}  // namespace
}  // namespace credo::geometry
