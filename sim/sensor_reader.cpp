// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/sensor_reader.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "sim/presets.hpp"

namespace credo::sim {
namespace {

constexpr double kFastest_hz = 1000.0;
double rate(YamlMap& map, double fallback) { return map.number_within("rate", fallback, 0.0, kFastest_hz); }

geometry::Pose2 read_pose(YamlMap& map, const geometry::Pose2& fallback) {
  if (!map.has("pose")) return fallback;
  const std::vector<double> p = map.numbers("pose", 3);
  return {p[0], p[1], p[2]};
}

CameraSetup read_camera(YamlMap map) {
  CameraSetup setup;
  placed(map, "preset", [&] { setup = camera_preset(map.text("preset", "conic-640")); });
  sensors::OmniCamera& camera = setup.camera;
  camera.T_base_camera = read_pose(map, camera.T_base_camera);
  camera.height_m = positive(map, "height", camera.height_m);
  camera.azimuth_zero_rad = map.number("azimuth_zero", camera.azimuth_zero_rad);
  camera.azimuth_sign = map.integer_within("azimuth_sign", camera.azimuth_sign, -1, 1);
  if (camera.azimuth_sign == 0) map.fail("azimuth_sign", "'azimuth_sign' must be 1 or -1");
  camera.exposure_s = map.number_within("exposure", camera.exposure_s, 0.0, 60.0);
  if (map.has("center")) camera.center_px = map.point("center");
  if (!map.flag("rim_visible", true)) camera.rim_radius_px.reset();
  setup.rate_hz = rate(map, setup.rate_hz);
  setup.strut_width_px = not_negative(map, "strut_width", setup.strut_width_px);
  if (map.has("struts")) {
    const YAML::Node struts = map.child("struts");
    setup.struts_rad = map.numbers_of(struts, struts.size(), "struts");
  }
  map.close();
  return setup;
}

/// Beams all around are one step short of a full turn; others go from edge to edge, straight ahead in the middle.
void read_fan(YamlMap& map, sensors::RangeFinder& finder) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  const auto goes_around = [](double field) { return field > kTurn_rad - 1e-3; };
  const double turn = finder.angle_increment_rad * finder.count, edge_to_edge = turn - finder.angle_increment_rad;
  const double field = map.number_within("field", goes_around(turn) ? turn : edge_to_edge, 0.01, kTurn_rad + 1e-3);
  finder.count = map.integer_within("count", finder.count, 1, 100'000);
  finder.angle_increment_rad =
      goes_around(field) ? std::min(field, kTurn_rad) / finder.count : field / std::max(finder.count - 1, 1);
  finder.angle_min_rad = goes_around(field) ? -std::numbers::pi : -0.5 * field;
}

RangeFinderSetup read_range_finder(YamlMap& map) {
  RangeFinderSetup setup;
  placed(map, "preset", [&] { setup = range_finder_preset(map.text("preset", "opensimple")); });
  sensors::RangeFinder& finder = setup.finder;
  finder.T_base_sensor = read_pose(map, finder.T_base_sensor);
  finder.height_m = not_negative(map, "height", finder.height_m);
  finder.noise.sigma_0_m = positive(map, "sigma_0", finder.noise.sigma_0_m);
  finder.noise.k_per_m = not_negative(map, "k", finder.noise.k_per_m);
  read_fan(map, finder);
  finder.range_min_m = not_negative(map, "range_min", finder.range_min_m);
  finder.range_max_m = positive(map, "range_max", finder.range_max_m);
  finder.scan_time_s = map.number_within("scan_time", finder.scan_time_s, 0.0, 60.0);
  setup.rate_hz = rate(map, setup.rate_hz);
  setup.spot_m = not_negative(map, "spot", setup.spot_m);
  setup.spot_rad = not_negative(map, "spot_growth", setup.spot_rad);
  setup.bias_per_m = not_negative(map, "bias", setup.bias_per_m);
  setup.outlier_share = share(map, "outlier_share", setup.outlier_share);
  setup.faintest = not_negative(map, "faintest", setup.faintest);
  map.close();
  return setup;
}

/// Transducers of its own fire all at once unless `firing_times` says otherwise.
void read_transducers(YamlMap& map, sensors::SonarRing& ring) {
  if (map.has("transducers")) {
    ring.T_base_transducer.clear();
    ring.firing_times_s.clear();
    for (const YAML::Node& item : map.child("transducers")) {
      const std::vector<double> p = map.numbers_of(item, 3, "transducers");
      ring.T_base_transducer.push_back({p[0], p[1], p[2]});
    }
    if (ring.T_base_transducer.empty())
      map.fail("transducers", "'transducers' must be a list of at least one [x, y, theta]");
  }
  if (!map.has("firing_times")) return;
  ring.firing_times_s = map.numbers("firing_times", ring.T_base_transducer.size());
  constexpr double kLongest_s = 60.0;
  for (const double time : ring.firing_times_s)
    if (std::abs(time) > kLongest_s)
      map.fail("firing_times", "'firing_times' must be within 60 s of the sweep's timestamp");
}

SonarSetup read_sonar(YamlMap& map) {
  SonarSetup setup;
  placed(map, "preset", [&] { setup = sonar_preset(map.text("preset", "pioneer-16")); });
  read_transducers(map, setup.ring);
  setup.ring.height_m = not_negative(map, "height", setup.ring.height_m);
  setup.ring.beam_width_rad = positive(map, "beam_width", setup.ring.beam_width_rad);
  setup.ring.range_min_m = not_negative(map, "range_min", setup.ring.range_min_m);
  setup.ring.range_max_m = positive(map, "range_max", setup.ring.range_max_m);
  setup.ring.sigma_m = not_negative(map, "sigma", setup.ring.sigma_m);
  setup.rate_hz = map.number_within("rate", setup.rate_hz, 0.01, kFastest_hz);
  setup.cross_talk_share = share(map, "cross_talk", setup.cross_talk_share);
  map.close();
  return setup;
}

}  // namespace

void read_sensors(YamlMap sensors, World& world) {
  if (sensors.has("camera")) world.camera = read_camera(sensors.map("camera"));
  for (YamlMap& map : sensors.maps("range_finders")) world.range_finders.push_back(read_range_finder(map));
  for (YamlMap& map : sensors.maps("sonars")) world.sonars.push_back(read_sonar(map));
  if (sensors.has("odometry")) {
    YamlMap map = sensors.map("odometry");
    OdometrySetup setup;
    setup.rate_hz = rate(map, setup.rate_hz);
    setup.noise.translation_per_metre = not_negative(map, "translation_per_metre", setup.noise.translation_per_metre);
    setup.noise.rotation_per_metre = not_negative(map, "rotation_per_metre", setup.noise.rotation_per_metre);
    setup.noise.rotation_per_radian = not_negative(map, "rotation_per_radian", setup.noise.rotation_per_radian);
    map.close();
    world.odometry = setup;
  }
  sensors.close();
}

}  // namespace credo::sim
