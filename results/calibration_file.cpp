// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/calibration_file.hpp"

#include <fmt/format.h>

#include "geometry/angles.hpp"

namespace credo::results {
namespace {

using localization::CameraCalibration;
using localization::RangeCalibration;

double millirad(double rad) { return 1e3 * rad; }

std::string range_yaml(const RangeCalibration& range) {
  const geometry::Pose2& pose = range.T_base_sensor;
  return fmt::format("range0:\n  pose: [{:.5f}, {:.5f}, {:.6f}]\n  accuracy: {{pose: [{:.5f}, {:.5f}, {:.6f}]}}\n",
                     pose.x, pose.y, pose.theta, range.sigma(0), range.sigma(1), range.sigma(2));
}

std::string camera_yaml(const CameraCalibration& camera, const sensors::OmniCamera& before) {
  const geometry::Pose2& mounted = before.T_base_camera;
  return fmt::format(
      "camera0:\n  pose: [{:.5f}, {:.5f}, {:.6f}]\n  center: [{:.3f}, {:.3f}]\n"
      "  accuracy: {{pose: [{:.5f}, {:.5f}, {:.6f}], center: {:.3f}, tilt: {:.5f}}}\n"
      "  # For information: the tilt of the mirror's axis, and the first harmonic of the azimuths that `center` takes "
      "out.\n"
      "  # tilt: [{:.5f}, {:.5f}]\n  # harmonic: [{:.6f}, {:.6f}], accuracy [{:.6f}, {:.6f}]\n",
      mounted.x, mounted.y, camera.theta_rad, camera.center_px.x(), camera.center_px.y(), before.accuracy.x_m,
      before.accuracy.y_m, camera.theta_sigma_rad, camera.center_sigma_px, camera.tilt_sigma_rad, camera.tilt_rad.x(),
      camera.tilt_rad.y(), camera.harmonic_rad.x(), camera.harmonic_rad.y(), camera.harmonic_sigma_rad.x(),
      camera.harmonic_sigma_rad.y());
}

}  // namespace

std::string to_yaml(const localization::RigCalibration& calibration, const sensors::Rig& rig) {
  std::string out =
      "# What the drive has taught about the instruments: metres, radians, pixels; accuracy is 1-sigma.\n"
      "# Put `pose`, `center` and `accuracy` into the sensor.yaml of the same name, and the next drive starts with "
      "them."
      "\n";
  if (calibration.camera) out += camera_yaml(*calibration.camera, *rig.camera);
  if (calibration.range) out += range_yaml(*calibration.range);
  return out;
}

std::string to_text(const localization::RigCalibration& calibration, const sensors::Rig& rig) {
  std::string text;
  if (calibration.camera) {
    const CameraCalibration& camera = *calibration.camera;
    const Eigen::Vector2d moved = camera.center_px - rig.camera->center_px;
    text += fmt::format(
        "  camera0  heading {:+.2f} +- {:.2f} mrad, center {:+.2f} {:+.2f} +- {:.2f} px, tilt {:+.1f} "
        "{:+.1f} +- {:.1f} mrad\n",
        millirad(geometry::angle_difference(camera.theta_rad, rig.camera->T_base_camera.theta)),
        millirad(camera.theta_sigma_rad), moved.x(), moved.y(), camera.center_sigma_px, millirad(camera.tilt_rad.x()),
        millirad(camera.tilt_rad.y()), millirad(camera.tilt_sigma_rad));
  }
  if (calibration.range) {
    const geometry::Pose2& before = rig.range_finders.front().T_base_sensor;
    const geometry::Pose2& now = calibration.range->T_base_sensor;
    const Eigen::Vector3d& sigma = calibration.range->sigma;
    text += fmt::format("  range0   heading {:+.2f} +- {:.2f} mrad, x {:+.1f} +- {:.1f} mm, y {:+.1f} +- {:.1f} mm\n",
                        millirad(geometry::angle_difference(now.theta, before.theta)), millirad(sigma(2)),
                        1e3 * (now.x - before.x), 1e3 * sigma(0), 1e3 * (now.y - before.y), 1e3 * sigma(1));
  }
  return text.empty() ? text : "Learned of the instruments, against their sensor.yaml:\n" + text;
}

}  // namespace credo::results
