// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/line_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/angles.hpp"
#include "range_world.hpp"

namespace credo::perception {
namespace {

using geometry::LineEstimate;
using sensors::ScanPoint;

double angle_error(double a, double b) { return std::remainder(a - b, std::numbers::pi); }

/// Readings of the wall y = distance between two bearings.
std::vector<ScanPoint> wall_readings(double distance, double from, double to, int count, const PointNoise& noise,
                                     std::mt19937* generator) {
  std::normal_distribution<double> normal;
  std::vector<ScanPoint> points;
  for (int i = 0; i < count; ++i) {
    const double angle = from + (to - from) * i / (count - 1);
    const double truth = distance / std::sin(angle);
    const double true_angle = generator ? angle + noise.params.beam_sigma_rad * normal(*generator) : angle;
    double range = distance / std::sin(true_angle);
    if (generator) range += noise.range.sigma(truth) * normal(*generator);
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    points.push_back(
        {.position = range * ray, .ray = ray, .range_m = range, .sigma_m = noise.range.sigma(range), .beam = i});
  }
  return points;
}

struct Spread {
  double sum = 0.0, squares = 0.0;
  int n = 0;
  void add(double z) { sum += z, squares += z * z, ++n; }
  double mean() const { return sum / n; }
  double deviation() const { return std::sqrt(squares / n); }
};

TEST(LineFit, FindsAnExactLine) {
  const auto points = wall_readings(2.0, 0.8, 2.2, 40, {}, nullptr);
  const LineFit fit = fit_line(points, {});
  EXPECT_NEAR(angle_error(fit.line.angle, 0.0), 0.0, 1e-9);
  EXPECT_NEAR(fit.line.centroid.y(), 2.0, 1e-9);
  EXPECT_EQ(fit.support, 40);
  EXPECT_NEAR(fit.chi2, 0.0, 1e-12);
}

// The errors of many fits, divided by the sigmas that the fits state, must have spread 1.
TEST(LineFit, SaysHowGoodItIs) {
  struct Case {
    const char* name;
    sensors::RangeNoise noise;
    double from, to;
    int count;
  };
  const Case cases[] = {{"time of flight, head-on", {0.01, 0.0}, 1.0, 2.1, 60},
                        {"triangulation, head-on", {0.01, 0.01}, 1.0, 2.1, 40},
                        {"triangulation, oblique", {0.004, 0.0015}, 0.25, 1.2, 50},
                        {"coarse triangulation, oblique", {0.005, 0.0045}, 0.35, 1.6, 30},
                        {"few points", {0.01, 0.0}, 1.3, 1.8, 6}};
  for (const Case& c : cases) {
    PointNoise noise{c.noise, {}};
    noise.params.flatness_m = 0.0;
    std::mt19937 generator(7);
    Spread across, angle;
    for (int run = 0; run < 800; ++run) {
      const auto points = wall_readings(1.5, c.from, c.to, c.count, noise, &generator);
      const LineEstimate line = fit_line(points, noise).line;
      const double side = std::cos(line.angle) > 0.0 ? 1.0 : -1.0;
      const double offset = side * line.normal().dot(Eigen::Vector2d(line.centroid.x(), 1.5) - line.centroid);
      across.add(offset / line.sigma_across);
      angle.add(angle_error(line.angle, 0.0) / line.sigma_angle);
    }
    EXPECT_NEAR(across.deviation(), 1.0, 0.12) << c.name;
    EXPECT_NEAR(angle.deviation(), 1.0, 0.12) << c.name;
    EXPECT_NEAR(across.mean(), 0.0, 0.35) << c.name;
    EXPECT_NEAR(angle.mean(), 0.0, 0.35) << c.name;
  }
}

TEST(LineFit, IsNotBentByStrayReadings) {
  const PointNoise noise{{0.01, 0.0}, {}};
  std::mt19937 generator(3);
  auto points = wall_readings(2.0, 0.8, 2.2, 40, noise, &generator);
  const LineFit clean = fit_line(points, noise);
  for (const std::size_t i : {3, 17, 38}) {
    points[i].range_m -= 0.7;
    points[i].position = points[i].range_m * points[i].ray;
  }
  const LineFit fit = fit_line(points, noise);
  EXPECT_NEAR(angle_error(fit.line.angle, clean.line.angle), 0.0, 3.0 * clean.line.sigma_angle);
  EXPECT_EQ(fit.support, clean.support - 3);
  EXPECT_LT(fit.mean_residual_sigmas, 1.2);
}

TEST(LineFit, GrowsItsSigmasWhereTheNoiseLawIsTooGood) {
  const PointNoise promised{{0.005, 0.0}, {}}, real{{0.012, 0.0}, {}};
  std::mt19937 generator(5);
  const auto points = wall_readings(2.0, 0.8, 2.2, 60, real, &generator);
  EXPECT_GT(fit_line(points, promised).line.sigma_across, 1.3 * 0.005 / std::sqrt(60.0));
}

TEST(LineFit, TakesWhateverPointsThereAre) {
  const PointNoise noise{};
  EXPECT_EQ(fit_line({}, noise).support, 0);
  std::vector<ScanPoint> points(1);
  points[0] = {.position = {2.0, 0.0}, .ray = {1.0, 0.0}, .range_m = 2.0, .sigma_m = 0.01, .beam = 0};
  for (const std::size_t copies : {1, 2, 5}) {
    points.assign(copies, points[0]);
    const LineFit fit = fit_line(points, noise);
    EXPECT_EQ(fit.support, static_cast<int>(copies));
    EXPECT_NEAR(std::abs(fit.line.normal().x()), 1.0, 1e-12) << "across the ray";
    EXPECT_NEAR(fit.line.sigma_angle, std::numbers::pi / 2.0, 1e-12);
    EXPECT_TRUE(std::isfinite(fit.line.sigma_across));
  }
}

/// Numeric covariance of a function of independent errors.
template <typename F>
Eigen::Matrix2d numeric_covariance(const F& f, const std::vector<double>& sigmas) {
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  std::vector<double> errors(sigmas.size(), 0.0);
  for (std::size_t i = 0; i < sigmas.size(); ++i) {
    constexpr double kStep = 1e-6;
    errors[i] = kStep;
    const Eigen::Vector2d plus = f(errors);
    errors[i] = -kStep;
    const Eigen::Vector2d minus = f(errors);
    errors[i] = 0.0;
    const Eigen::Vector2d jacobian = (plus - minus) / (2.0 * kStep);
    covariance += sigmas[i] * sigmas[i] * jacobian * jacobian.transpose();
  }
  return covariance;
}

LineEstimate moved(LineEstimate line, double across, double turn) {
  line.centroid += across * line.normal();
  line.angle += turn;
  return line;
}

TEST(LineFit, IntersectionCovarianceIsThatOfTheLines) {
  const LineEstimate a{{1.0, 2.0}, 0.1, 0.01, 0.02}, b{{3.0, 1.0}, 1.4, 0.02, 0.01};
  const auto point = intersect(a, b);
  ASSERT_TRUE(point);
  EXPECT_NEAR(a.normal().dot(point->position - a.centroid), 0.0, 1e-12);
  EXPECT_NEAR(b.normal().dot(point->position - b.centroid), 0.0, 1e-12);
  const Eigen::Matrix2d numeric = numeric_covariance(
      [&](const std::vector<double>& e) { return intersect(moved(a, e[0], e[1]), moved(b, e[2], e[3]))->position; },
      {a.sigma_across, a.sigma_angle, b.sigma_across, b.sigma_angle});
  EXPECT_TRUE(point->covariance.isApprox(numeric, 1e-6)) << point->covariance << "\n\n" << numeric;
  EXPECT_FALSE(intersect(a, moved(a, 0.3, 0.01)));
}

TEST(LineFit, BearingOnALineHasBothTheirErrors) {
  const LineEstimate line{{3.0, 1.0}, 1.9, 0.02, 0.01};
  const Eigen::Vector2d origin(0.1, -0.2);
  const auto point = intersect_ray(line, origin, 0.3, 0.004);
  ASSERT_TRUE(point);
  const Eigen::Matrix2d numeric = numeric_covariance(
      [&](const std::vector<double>& e) {
        return intersect_ray(moved(line, e[0], e[1]), origin, 0.3 + e[2], 0.004)->position;
      },
      {line.sigma_across, line.sigma_angle, 0.004});
  EXPECT_TRUE(point->covariance.isApprox(numeric, 1e-6)) << point->covariance << "\n\n" << numeric;
  EXPECT_FALSE(intersect_ray(line, origin, 0.3 + std::numbers::pi, 0.004)) << "behind";
  EXPECT_FALSE(intersect_ray(line, origin, 1.9, 0.004)) << "parallel";
}

TEST(LineFit, ABearingSharpensAPointAcrossItOnly) {
  PointEstimate point{.position = {2.0, 0.0}, .covariance = Eigen::Vector2d(0.04, 0.04).asDiagonal()};
  const PointEstimate fused = with_bearing(point, {0.0, 0.0}, 0.05, 0.001);
  EXPECT_NEAR(std::atan2(fused.position.y(), fused.position.x()), 0.05, 1e-4);
  EXPECT_NEAR(fused.covariance(0, 0), 0.04, 1e-9);
  EXPECT_NEAR(fused.covariance(1, 1), 0.002 * 0.002, 1e-6);
  // A vague bearing changes nothing.
  const PointEstimate same = with_bearing(point, {0.0, 0.0}, 0.05, 1e3);
  EXPECT_TRUE(same.position.isApprox(point.position, 1e-6));
}

}  // namespace
}  // namespace credo::perception
