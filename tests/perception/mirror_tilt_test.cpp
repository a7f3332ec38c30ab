// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/mirror_tilt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "annulus_image.hpp"
#include "geometry/angles.hpp"
#include "perception/radial_fit.hpp"

namespace credo::perception {
namespace {

using Eigen::Vector2d;
using geometry::kTurn;

Vector2d unit(double azimuth) { return {std::cos(azimuth), std::sin(azimuth)}; }

class Tilt : public ::testing::Test {
 protected:
  Tilt() {
    for (double radius = 64.0; radius <= 226.0; radius += 2.0) radii_.push_back(radius);
  }
  [[nodiscard]] MirrorTilt mirror() const { return {camera_, camera_.horizon_radius_px, radii_, params_}; }
  [[nodiscard]] int row_of(double radius) const { return static_cast<int>(std::lround((radius - radii_[0]) / 2.0)); }

  /// By how much a tilt shifts an azimuth on a row: tilt * tan(elevation) * a sine of the azimuth.
  [[nodiscard]] double shift_by(const Vector2d& tilt, int row, double azimuth) const {
    const double focal = camera_.mirror->focal_px;
    const double elevation =
        std::atan(radii_[static_cast<std::size_t>(row)] / focal) - std::atan(camera_.horizon_radius_px / focal);
    return std::tan(elevation) * tilt.dot(unit(azimuth));
  }

  /// The slopes of plumb lines all around under a tilt, less what `learned` explains, as a fit measures them.
  [[nodiscard]] std::vector<SlopeReading> slopes(const Vector2d& tilt, const MirrorTilt& learned,
                                                 int lines = 24) const {
    std::vector<SlopeReading> readings;
    for (int i = 0; i < lines; ++i) {
      const double azimuth = (i + 0.3) * kTurn / lines;
      std::vector<RadialPoint> points;
      for (int row = 0; row < static_cast<int>(radii_.size()); ++row) {
        const double radius = radii_[static_cast<std::size_t>(row)];
        points.push_back({.azimuth = shift_by(tilt, row, azimuth) - learned.shift(row, unit(azimuth)),
                          .sigma = 0.1 / radius,
                          .lever = 1.0 / radius - 1.0 / camera_.horizon_radius_px,
                          .row = row,
                          .step = 30.0});
      }
      const RadialFit fit = fit_radial_line(RadialPoints(points), 0.0, 100.0, {});
      readings.push_back({.azimuth = azimuth, .slope = fit.slope, .sigma = 0.02});
    }
    return readings;
  }
  /// After a number of images of a camera under this tilt.
  [[nodiscard]] MirrorTilt learned(const Vector2d& tilt, int images = 10) const {
    MirrorTilt result = mirror();
    for (int i = 0; i < images; ++i) result.learn(slopes(tilt, result));
    return result;
  }

  sensors::OmniCamera camera_ = test::test_camera();
  std::vector<double> radii_;
  TiltParams params_;
  const Vector2d tilt_{0.012, -0.007};
};

TEST_F(Tilt, NothingIsShiftedBeforeAnythingIsLearned) {
  const MirrorTilt none = mirror();
  EXPECT_EQ(none.tilt_rad(), Vector2d::Zero());
  EXPECT_EQ(none.shift(row_of(220.0), unit(1.0)), 0.0);
  EXPECT_GT(none.slope_sigma(), 0.0);
}

TEST_F(Tilt, IsLearnedFromTheSlopesOfLinesAllAround) {
  const MirrorTilt found = learned(tilt_);
  EXPECT_LT((found.tilt_rad() - tilt_).norm(), 1e-3);
  for (const SlopeReading& left : slopes(tilt_, found)) EXPECT_LT(std::abs(left.slope), 0.1);
  EXPECT_GT(std::abs(slopes(tilt_, mirror())[0].slope), 0.3) << "which were leaning before";
}

TEST_F(Tilt, ItsShiftIsAHarmonicThatVanishesAtTheHorizonAndTurnsThere) {
  const MirrorTilt found = learned(tilt_);
  for (double azimuth = 0.0; azimuth < kTurn; azimuth += 0.5) {
    EXPECT_DOUBLE_EQ(found.shift(row_of(120.0), unit(azimuth)), 0.0) << "bearings are read there";
    for (const double radius : {70.0, 100.0, 150.0, 220.0}) {
      const int row = row_of(radius);
      const double here = found.shift(row, unit(azimuth)), across = found.shift(row, unit(azimuth + 0.25 * kTurn));
      EXPECT_NEAR(here, shift_by(found.tilt_rad(), row, azimuth), 1e-12);
      EXPECT_NEAR(found.shift(row, unit(azimuth + 0.5 * kTurn)), -here, 1e-12);
      EXPECT_NEAR(std::hypot(here, across), std::abs(shift_by(found.tilt_rad(), row, std::atan2(tilt_.y(), tilt_.x()))),
                  1e-4);
    }
    EXPECT_LE(found.shift(row_of(70.0), unit(azimuth)) * found.shift(row_of(220.0), unit(azimuth)), 0.0);
  }
}

TEST_F(Tilt, TheMoreIsSeenTheBetterItIsKnownDownToAFloor) {
  MirrorTilt found = mirror();
  const double per_tilt = found.slope_sigma() / camera_.accuracy.tilt_rad;
  found.learn(slopes(tilt_, found));
  const double once = found.slope_sigma();
  EXPECT_LT(once, 0.5 * per_tilt * camera_.accuracy.tilt_rad);
  EXPECT_NEAR(once, per_tilt * params_.floor_rad, 0.5 * once);
  EXPECT_GE(learned(tilt_, 50).slope_sigma(), per_tilt * params_.floor_rad * (1.0 - 1e-12));
}

TEST_F(Tilt, AFewLinesTeachNothingAndItIsForgottenMeanwhile) {
  MirrorTilt found = learned(tilt_);
  const Vector2d before = found.tilt_rad();
  const double sigma = found.slope_sigma();
  for (int i = 0; i < 5; ++i) found.learn(slopes(-tilt_, found, params_.least_lines - 1));
  EXPECT_EQ(found.tilt_rad(), before);
  EXPECT_GT(found.slope_sigma(), sigma);
  found.learn(slopes(-tilt_, found, params_.least_lines));
  EXPECT_NE(found.tilt_rad(), before);
}

TEST_F(Tilt, ItFollowsAChange) {
  MirrorTilt found = learned(tilt_);
  for (int i = 0; i < 40; ++i) found.learn(slopes(-tilt_, found));
  EXPECT_LT((found.tilt_rad() + tilt_).norm(), 1e-3);
}

TEST_F(Tilt, SomeLinesThatAreNotPlumbDoNotMatter) {
  MirrorTilt found = mirror();
  for (int i = 0; i < 10; ++i) {
    std::vector<SlopeReading> readings = slopes(tilt_, found);
    for (std::size_t k = 0; k < 5; ++k) readings[k].slope = 4.0;
    found.learn(readings);
  }
  EXPECT_LT((found.tilt_rad() - tilt_).norm(), 1e-3);
}

TEST_F(Tilt, OfAMirrorThatIsNotAConeIsLearnedToo) {
  camera_.mirror.reset();
  MirrorTilt found = mirror();
  std::vector<SlopeReading> readings;
  for (int i = 0; i < 24; ++i) {
    const double azimuth = i * kTurn / 24.0;
    readings.push_back({.azimuth = azimuth, .slope = -0.5 * std::cos(azimuth - 0.8), .sigma = 0.02});
  }
  found.learn(readings);
  EXPECT_GT(found.tilt_rad().normalized().dot(unit(0.8)), 0.999);
  EXPECT_EQ(found.shift(row_of(120.0), unit(0.8)), 0.0);
  EXPECT_GT(found.shift(row_of(220.0), unit(0.8)), 0.0);
}

}  // namespace
}  // namespace credo::perception
