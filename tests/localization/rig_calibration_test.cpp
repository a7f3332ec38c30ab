// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/rig_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace credo::localization {
namespace {

using Eigen::Vector2d;

sensors::OmniCamera camera_with(int sign, double zero, double theta) {
  sensors::OmniCamera camera;
  camera.T_base_camera = {0.1, -0.05, theta};
  camera.center_px = {320.0, 240.0};
  camera.horizon_radius_px = 120.0;
  camera.azimuth_sign = sign;
  camera.azimuth_zero_rad = zero;
  return camera;
}

TEST(RigCalibration, MovingTheCentreTakesTheHarmonicOutOfTheAzimuths) {
  const Vector2d harmonic(0.0012, -0.0007);
  for (const int sign : {-1, 1})
    for (const double zero : {0.0, 0.8}) {
      const sensors::OmniCamera before = camera_with(sign, zero, 0.3);
      sensors::OmniCamera after = before;
      after.center_px += center_shift_px(before, harmonic);
      for (double phi = -3.0; phi < 3.1; phi += 0.5) {
        const Vector2d pixel = before.center_px + 120.0 * Vector2d(std::cos(phi), std::sin(phi));
        const double azimuth = before.azimuth_of(pixel.x(), pixel.y()) + 0.3;
        const double corrected = after.azimuth_of(pixel.x(), pixel.y()) + 0.3;
        const double expected = harmonic.x() * std::cos(azimuth) + harmonic.y() * std::sin(azimuth);
        EXPECT_NEAR(geometry::angle_difference(corrected, azimuth), expected, 5e-6) << sign << " " << zero;
      }
    }
}

TEST(RigCalibration, CorrectsTheMountingsOfTheRig) {
  sensors::Rig rig;
  rig.camera = camera_with(1, 0.0, 0.3);
  rig.range_finders.emplace_back().T_base_sensor = {0.2, 0.0, 1.0};
  CalibratedPose pose = calibrated_pose(rig, {});
  pose.common_errors << 0.01, -0.02, 0.004, -0.003, 0.0, 0.0;
  const RigCalibration learned = rig_calibration(rig, pose, {.center_px = {321.0, 239.5}});
  ASSERT_TRUE(learned.range && learned.camera);
  EXPECT_NEAR(learned.range->T_base_sensor.x, 0.21, 1e-5);
  EXPECT_NEAR(learned.range->T_base_sensor.y, -0.02 + 0.2 * 0.004, 1e-5);
  EXPECT_NEAR(learned.range->T_base_sensor.theta, 1.004, 1e-9);
  EXPECT_NEAR(learned.range->sigma(2), rig.range_finders[0].accuracy.theta_rad, 1e-9) << "nothing was learned yet";
  EXPECT_NEAR(learned.camera->theta_rad, 0.297, 1e-9);
  EXPECT_NEAR(learned.camera->center_sigma_px, rig.camera->accuracy.center_px, 1e-9);
  EXPECT_EQ(learned.camera->center_px, Vector2d(321.0, 239.5));
}

TEST(RigCalibration, SaysNothingOfWhatIsNotThere) {
  const RigCalibration learned = rig_calibration({}, calibrated_pose({}, {}), {});
  EXPECT_FALSE(learned.range);
  EXPECT_FALSE(learned.camera);
}

}  // namespace
}  // namespace credo::localization
