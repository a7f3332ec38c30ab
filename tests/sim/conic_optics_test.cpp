// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/conic_optics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/presets.hpp"

namespace credo::sim {
namespace {

TEST(ConicOptics, TheRayThroughAProjectedPointPassesThroughThePoint) {
  sensors::OmniCamera camera = camera_preset("conic-640").camera;
  for (const int sign : {-1, 1}) {
    camera.azimuth_sign = sign;
    camera.azimuth_zero_rad = 0.7;
    const ConicOptics optics = ConicOptics::of(camera);
    for (double azimuth = -3.0; azimuth < 3.1; azimuth += 0.37)
      for (double range = 0.5; range < 30.0; range *= 1.7)
        for (double elevation = -0.2; elevation < 0.2; elevation += 0.05) {
          const Eigen::Vector3d point(range * std::cos(azimuth), range * std::sin(azimuth), range * elevation);
          const Ray ray = optics.ray(optics.project(point));
          const double t = range / ray.direction.head<2>().norm();
          EXPECT_LT((ray.origin + t * ray.direction - point).norm(), 1e-9)
              << azimuth << " " << range << " " << elevation;
        }
  }
}

/// The mirror equations themselves: camera ray, reflection at the cone, world ray.
TEST(ConicOptics, AgreesWithTheReflectionAtTheCone) {
  const sensors::OmniCamera camera = camera_preset("conic-640").camera;
  const ConicOptics optics = ConicOptics::of(camera);
  const auto& mirror = *camera.mirror;
  const double tau = mirror.half_angle_rad, d = mirror.apex_distance_m;
  for (double phi = 0.12; phi < 0.45; phi += 0.03) {
    // Pinhole at the origin, axis up: where the ray meets the cone, and where it goes from there.
    const double s = d * std::sin(tau) / std::sin(tau - phi);
    const Eigen::Vector2d hit = s * Eigen::Vector2d(std::sin(phi), std::cos(phi));
    const Eigen::Vector2d in(std::sin(phi), std::cos(phi)), normal(std::cos(tau), -std::sin(tau));
    const Eigen::Vector2d out = in - 2.0 * in.dot(normal) * normal;
    // The effective viewpoint lies 2 d sin^2(tau) above the pinhole.
    const double height = hit.y() + 3.0 / out.x() * out.y() - 2.0 * d * std::sin(tau) * std::sin(tau);
    const Eigen::Vector2d pixel = optics.project({hit.x() + 3.0, 0.0, height});
    EXPECT_NEAR((pixel - optics.center_px).norm(), mirror.focal_px * std::tan(phi), 1e-9);
  }
}

TEST(ConicOptics, PointsAtViewpointHeightLieOnTheHorizonRing) {
  const sensors::OmniCamera camera = camera_preset("conic-1024").camera;
  const ConicOptics optics = ConicOptics::of(camera);
  for (const double range : {0.3, 2.0, 50.0})
    EXPECT_NEAR((optics.project({0.0, range, 0.0}) - optics.center_px).norm(), camera.horizon_radius_px, 1e-9);
}

TEST(ConicOptics, AzimuthsAgreeWithTheCameraModel) {
  sensors::OmniCamera camera = camera_preset("conic-640").camera;
  camera.azimuth_zero_rad = -1.1;
  const ConicOptics optics = ConicOptics::of(camera);
  for (double azimuth = -3.1; azimuth < 3.1; azimuth += 0.3) {
    const Eigen::Vector2d pixel = optics.project({2.0 * std::cos(azimuth), 2.0 * std::sin(azimuth), 0.1});
    EXPECT_NEAR(geometry::angle_difference(camera.azimuth_of(pixel.x(), pixel.y()), azimuth), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace credo::sim
