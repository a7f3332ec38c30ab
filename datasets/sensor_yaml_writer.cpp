// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <initializer_list>
#include <ostream>
#include <span>

#include "datasets/number_text.hpp"
#include "datasets/sensor_yaml.hpp"

namespace credo::datasets {
namespace {

std::string text_of(double value) {
  std::string text;
  append_shortest(text, value);
  return text;
}

std::string list_of(std::span<const double> values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() > 1 ? ", " : "") + text_of(value);
  return text + "]";
}

std::string list_of(std::initializer_list<double> values) { return list_of(std::span(values.begin(), values.size())); }
std::string list_of(const geometry::Pose2& pose) { return list_of({pose.x, pose.y, pose.theta}); }

void write_common(std::ostream& out, const char* type, const geometry::Pose2& pose, double height_m) {
  out << "sensor_type: " << type << "\npose: " << list_of(pose) << "\nheight: " << text_of(height_m) << "\n";
}

void write_accuracy(std::ostream& out, const sensors::CalibrationAccuracy& accuracy) {
  out << "accuracy: {pose: " << list_of({accuracy.x_m, accuracy.y_m, accuracy.theta_rad})
      << ", center: " << text_of(accuracy.center_px) << ", tilt: " << text_of(accuracy.tilt_rad) << "}\n";
}

void write_projection(std::ostream& out, const sensors::OmniCamera& camera) {
  if (camera.mirror)
    out << "mirror: {half_angle: " << text_of(camera.mirror->half_angle_rad)
        << ", apex_distance: " << text_of(camera.mirror->apex_distance_m)
        << ", focal: " << text_of(camera.mirror->focal_px) << "}\n";
  if (camera.mei) {
    const sensors::MeiProjection& mei = *camera.mei;
    out << "mei: {xi: " << text_of(mei.xi)
        << ", intrinsics: " << list_of({mei.focal_px.x(), mei.focal_px.y(), mei.principal_px.x(), mei.principal_px.y()})
        << ", distortion: " << list_of(std::span(mei.distortion.data(), 4)) << "}\n";
  }
  if (camera.scaramuzza)
    out << "scaramuzza: {polynomial: " << list_of(camera.scaramuzza->polynomial)
        << ", inverse_polynomial: " << list_of(camera.scaramuzza->inverse_polynomial)
        << ", affine: " << list_of(std::span(camera.scaramuzza->affine.data(), 3)) << "}\n";
}

}  // namespace

void write_sensor_yaml(std::ostream& out, const sensors::OmniCamera& camera) {
  static constexpr const char* kModels[] = {"conic", "mei", "scaramuzza", "equirectangular"};
  write_common(out, "omnidirectional_camera", camera.T_base_camera, camera.height_m);
  out << "resolution: [" << camera.width_px << ", " << camera.height_px << "]\n"
      << "model: " << kModels[static_cast<std::size_t>(camera.model)] << "\n"
      << "center: " << list_of({camera.center_px.x(), camera.center_px.y()}) << "\n"
      << "radius: " << list_of({camera.inner_radius_px, camera.outer_radius_px}) << "\n";
  if (camera.horizon_radius_px > 0.0) out << "horizon_radius: " << text_of(camera.horizon_radius_px) << "\n";
  if (camera.rim_radius_px) out << "rim_radius: " << text_of(*camera.rim_radius_px) << "\n";
  if (!camera.mask.empty()) out << "mask: mask.png\n";
  out << "azimuth_zero: " << text_of(camera.azimuth_zero_rad) << "\nazimuth_sign: " << camera.azimuth_sign << "\n";
  write_projection(out, camera);
  if (camera.exposure_s != 0.0) out << "exposure: " << text_of(camera.exposure_s) << "\n";
  write_accuracy(out, camera.accuracy);
}

void write_sensor_yaml(std::ostream& out, const sensors::RangeFinder& range_finder) {
  write_common(out, "range_scanner", range_finder.T_base_sensor, range_finder.height_m);
  out << "angle_min: " << text_of(range_finder.angle_min_rad)
      << "\nangle_increment: " << text_of(range_finder.angle_increment_rad) << "\ncount: " << range_finder.count
      << "\nrange_min: " << text_of(range_finder.range_min_m) << "\nrange_max: " << text_of(range_finder.range_max_m)
      << "\nnoise: {sigma_0: " << text_of(range_finder.noise.sigma_0_m)
      << ", k: " << text_of(range_finder.noise.k_per_m) << "}\n";
  if (range_finder.scan_time_s != 0.0) out << "scan_time: " << text_of(range_finder.scan_time_s) << "\n";
  write_accuracy(out, range_finder.accuracy);
}

void write_sensor_yaml(std::ostream& out, const sensors::SonarRing& ring) {
  out << "sensor_type: sonar_ring\nheight: " << text_of(ring.height_m) << "\ntransducers:\n";
  for (const geometry::Pose2& transducer : ring.T_base_transducer) out << "  - " << list_of(transducer) << "\n";
  out << "beam_width: " << text_of(ring.beam_width_rad) << "\nrange_min: " << text_of(ring.range_min_m)
      << "\nrange_max: " << text_of(ring.range_max_m) << "\nsigma: " << text_of(ring.sigma_m) << "\n";
  if (!ring.firing_times_s.empty()) out << "firing_times: " << list_of(ring.firing_times_s) << "\n";
}

void write_sensor_yaml(std::ostream& out, const sensors::OdometryNoise& noise) {
  out << "sensor_type: odometry\nnoise: {translation_per_metre: " << text_of(noise.translation_per_metre)
      << ", rotation_per_metre: " << text_of(noise.rotation_per_metre)
      << ", rotation_per_radian: " << text_of(noise.rotation_per_radian) << "}\n";
}

}  // namespace credo::datasets
