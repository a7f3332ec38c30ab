// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/presets.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sim/yaml_map.hpp"

namespace credo::sim {
namespace {

using std::numbers::pi;

[[noreturn]] void unknown(const std::string& name, const std::vector<std::string>& known) {
  std::string message = "unknown preset '" + name + "': one of";
  for (const std::string& candidate : known) message += " " + candidate;
  const std::string near = nearest_word(name, known);
  throw std::invalid_argument(message + (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

/// A cone of 52 degrees that sees from -14 to +12 degrees, its horizon half-way out.
CameraSetup conic(int width, int height, double focal_px) {
  CameraSetup setup;
  sensors::OmniCamera& camera = setup.camera;
  const double half_angle = geometry::to_radians(52.0);
  camera.width_px = width;
  camera.height_px = height;
  camera.center_px = {0.5 * width + 0.4, 0.5 * height - 0.9};
  camera.mirror = sensors::ConicMirror{half_angle, 0.06, focal_px};
  camera.horizon_radius_px = focal_px * std::tan(2.0 * half_angle - 0.5 * pi);
  const double rim = std::floor(focal_px * std::tan(geometry::to_radians(26.0)));
  camera.rim_radius_px = rim;
  camera.outer_radius_px = rim - 2.0;
  camera.inner_radius_px = std::ceil(0.26 * rim);
  camera.exposure_s = 0.008;
  camera.accuracy = {.x_m = 0.002, .y_m = 0.002, .theta_rad = 0.0026, .center_px = 0.3, .tilt_rad = 0.0087};
  setup.struts_rad = {1.31, 4.57};
  setup.strut_width_px = 4.0 * width / 640.0;
  return setup;
}

struct RangePreset {
  const char* name;
  int count;
  double field_rad, range_max_m, sigma_0_m, k_per_m, scan_time_s;
};

constexpr RangePreset kRangePresets[] = {{"lds-neato", 360, 2.0 * pi, 6.0, 0.005, 0.0008, 0.1},
                                         {"rplidar-a1", 360, 2.0 * pi, 12.0, 0.005, 0.0015, 0.1},
                                         {"opensimple", 180, 2.0 * pi, 4.0, 0.005, 0.0045, 0.1},
                                         {"lab-1999", 256, 2.0 * pi, 5.0, 0.010, 0.010, 1.0},
                                         {"tof-lms", 361, pi, 20.0, 0.010, 0.0, 0.0133}};

}  // namespace

CameraSetup camera_preset(const std::string& name) {
  if (name == "conic-640") return conic(640, 480, 480.0);
  if (name == "conic-1024") return conic(1024, 1024, 1037.0);
  unknown(name, {"conic-640", "conic-1024"});
}

RangeFinderSetup range_finder_preset(const std::string& name) {
  std::vector<std::string> known;
  for (const RangePreset& preset : kRangePresets) {
    known.emplace_back(preset.name);
    if (name != preset.name) continue;
    RangeFinderSetup setup;
    const bool full = preset.field_rad > 6.0;
    setup.finder = {.T_base_sensor = {},
                    .height_m = 0.8,
                    .angle_min_rad = full ? -pi : -0.5 * preset.field_rad,
                    .angle_increment_rad = preset.field_rad / (full ? preset.count : preset.count - 1),
                    .count = preset.count,
                    .range_min_m = 0.2,
                    .range_max_m = preset.range_max_m,
                    .noise = {preset.sigma_0_m, preset.k_per_m},
                    .scan_time_s = preset.scan_time_s,
                    .accuracy = {}};
    setup.faintest = 0.2 / (preset.range_max_m * preset.range_max_m);
    setup.bias_per_m = preset.k_per_m > 0.0 ? 0.0005 : 0.0;
    setup.quantum_m = preset.k_per_m > 0.0 ? 0.0 : 0.01;
    return setup;
  }
  unknown(name, known);
}

void state_accuracy(World& world) {
  const Nuisances& n = world.nuisances;
  const sensors::CalibrationAccuracy accuracy{.x_m = n.mounting_m,
                                              .y_m = n.mounting_m,
                                              .theta_rad = n.mounting_rad,
                                              .center_px = n.center_px,
                                              .tilt_rad = n.tilt_rad};
  if (world.camera) world.camera->camera.accuracy = accuracy;
  for (RangeFinderSetup& setup : world.range_finders) setup.finder.accuracy = accuracy;
}

SonarSetup sonar_preset(const std::string& name) {
  if (name != "pioneer-16") unknown(name, {"pioneer-16"});
  SonarSetup setup;
  // ARIA's robot parameter files: x and y in mm, heading in degrees, of the front eight; the rear eight mirror them.
  constexpr double kFront[8][3] = {{69, 136, 90},   {114, 119, 50},  {148, 78, 30},    {166, 27, 10},
                                   {166, -27, -10}, {148, -78, -30}, {114, -119, -50}, {69, -136, -90}};
  constexpr double kRear[8][3] = {{-157, -136, -90}, {-203, -119, -130}, {-237, -78, -150}, {-255, -27, -170},
                                  {-255, 27, 170},   {-237, 78, 150},    {-203, 119, 130},  {-157, 136, 90}};
  for (const auto* half : {kFront, kRear})
    for (int i = 0; i < 8; ++i)
      setup.ring.T_base_transducer.push_back({half[i][0] * 1e-3, half[i][1] * 1e-3, geometry::to_radians(half[i][2])});
  setup.ring.height_m = 0.25;
  // Front and rear fire in step, one transducer each 10 ms.
  for (int i = 0; i < 16; ++i) setup.ring.firing_times_s.push_back(0.01 * (i % 8) - 0.035);
  return setup;
}

}  // namespace credo::sim
