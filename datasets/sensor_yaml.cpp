// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/sensor_yaml.hpp"

#include <cmath>
#include <numbers>

#include "datasets/checked_yaml.hpp"
#include "datasets/image_file.hpp"
#include "sensors/sound.hpp"

namespace credo::datasets {
namespace {

constexpr int kLargestCount = 100'000;  ///< beams
constexpr int kLargestImage_px = 32'768;
constexpr double kLongestTurn_s = 3600.0;
constexpr double kFullTurn = 2.0 * std::numbers::pi;

constexpr Bounds kMounting{.low = -100.0, .high = 100.0};  // of a sensor on the robot [m]
constexpr Bounds kPixels{.low = -1e6, .high = 1e6};
constexpr Bounds kPositivePixels{.low = 0.0, .high = 1e6, .low_open = true};
constexpr Bounds kDuration{.low = -kLongestTurn_s, .high = kLongestTurn_s};
constexpr Bounds kOpening{.low = 0.0, .high = kFullTurn, .low_open = true};

/// What every sensor.yaml may say.
struct CommonKeys {
  geometry::Pose2 T_base_sensor;
  double height_m = 0.0;
  sensors::CalibrationAccuracy accuracy;
};

sensors::CalibrationAccuracy accuracy_of(const CheckedValue& value) {
  sensors::CalibrationAccuracy accuracy;
  const CheckedMap keys = value.map({"pose", "center", "tilt"});
  if (const auto pose = keys.optional("pose")) {
    const std::vector<double> sigmas = pose->numbers(3, kSigma);
    accuracy.x_m = sigmas[0], accuracy.y_m = sigmas[1], accuracy.theta_rad = sigmas[2];
  }
  if (const auto center = keys.optional("center")) accuracy.center_px = center->number(kSigma);
  if (const auto tilt = keys.optional("tilt")) accuracy.tilt_rad = tilt->number(kSigma);
  return accuracy;
}

/// \param times  which of the time keys have an effect on this kind of sensor; the others are remarked on
CommonKeys common_of(const CheckedMap& keys, double default_height_m, std::string_view time_key,
                     const std::filesystem::path& file, Remarks& remarks) {
  CommonKeys common{.T_base_sensor = {}, .height_m = default_height_m, .accuracy = {}};
  if (const auto pose = keys.optional("pose")) common.T_base_sensor = pose->pose(kMounting);
  if (const auto rate = keys.optional("rate_hz")) (void)rate->number({.low = 0.0, .high = 1e6, .low_open = true});
  if (const auto height = keys.optional("height")) common.height_m = height->number({.low = -100.0, .high = 1e4});
  if (const auto accuracy = keys.optional("accuracy")) common.accuracy = accuracy_of(*accuracy);
  for (const char* key : {"exposure", "scan_time", "firing_times"}) {
    const auto value = keys.optional(key);
    if (!value || key == time_key) continue;
    if (std::string_view(key) == "firing_times")
      (void)value->numbers(0, kDuration);
    else
      (void)value->number(kDuration);
    remarks.push_back(file.string() + ":" + std::to_string(value->line()) + ": " + key +
                      " has no effect on this kind of sensor");
  }
  return common;
}

sensors::MeiProjection mei_of(const CheckedValue& value) {
  const CheckedMap keys = value.map({"xi", "intrinsics", "distortion"});
  sensors::MeiProjection mei;
  mei.xi = keys.required("xi").number({.low = 0.0, .high = 100.0});
  const CheckedValue intrinsics = keys.required("intrinsics");
  const std::vector<double> f = intrinsics.numbers(4, kPixels);
  if (f[0] == 0.0 || f[1] == 0.0) intrinsics.fail("mei.intrinsics: expected [fu, fv, pu, pv] with fu and fv not 0");
  mei.focal_px = {f[0], f[1]};
  mei.principal_px = {f[2], f[3]};
  if (const auto distortion = keys.optional("distortion"))
    mei.distortion = Eigen::Vector4d(distortion->numbers(4).data());
  return mei;
}

sensors::ScaramuzzaProjection scaramuzza_of(const CheckedValue& value) {
  const CheckedMap keys = value.map({"polynomial", "inverse_polynomial", "affine"});
  sensors::ScaramuzzaProjection projection;
  const CheckedValue polynomial = keys.required("polynomial");
  projection.polynomial = polynomial.numbers(0);
  if (projection.polynomial.empty()) polynomial.fail("scaramuzza.polynomial: expected at least one coefficient");
  if (const auto inverse = keys.optional("inverse_polynomial")) projection.inverse_polynomial = inverse->numbers(0);
  if (const auto affine = keys.optional("affine")) projection.affine = Eigen::Vector3d(affine->numbers(3).data());
  return projection;
}

/// The block of a model is there for that model alone, and then it must be.
void read_projection(const CheckedMap& keys, sensors::OmniCamera& camera) {
  using Model = sensors::OmniCamera::Model;
  static constexpr std::pair<const char*, Model> kBlocks[] = {
      {"mirror", Model::kConic}, {"mei", Model::kMei}, {"scaramuzza", Model::kScaramuzza}};
  for (const auto& [key, model] : kBlocks)
    if (const auto block = keys.optional(key); block && camera.model != model)
      block->fail(std::string(key) + ": belongs to another model than the one that `model` names");
  if (camera.model == Model::kMei) camera.mei = mei_of(keys.required("mei"));
  if (camera.model == Model::kScaramuzza) camera.scaramuzza = scaramuzza_of(keys.required("scaramuzza"));
  if (const auto mirror = keys.optional("mirror")) {
    const CheckedMap cone = mirror->map({"half_angle", "apex_distance", "focal"});
    camera.mirror = sensors::ConicMirror{
        .half_angle_rad =
            cone.required("half_angle").number({.low = 0.0, .high = std::numbers::pi / 2.0, .low_open = true}),
        .apex_distance_m = cone.required("apex_distance").number(kPositiveLength),
        .focal_px = cone.required("focal").number(kPositivePixels)};
  }
}

/// The radius where the elevation is zero: a ray at angle a to the axis leaves the cone at 2 half_angle - a, which is
/// horizontal for a = 2 half_angle - pi/2.
double horizon_radius(const sensors::ConicMirror& mirror) {
  return mirror.focal_px * std::tan(2.0 * mirror.half_angle_rad - std::numbers::pi / 2.0);
}

void read_annulus(const CheckedMap& keys, sensors::OmniCamera& camera) {
  const CheckedValue center = keys.required("center");
  const std::vector<double> uv = center.numbers(2, kPixels);
  camera.center_px = {uv[0], uv[1]};
  if (uv[0] < 0.0 || uv[1] < 0.0 || uv[0] > camera.width_px - 1 || uv[1] > camera.height_px - 1)
    center.fail("center: expected a point within the resolution of " + std::to_string(camera.width_px) + " x " +
                std::to_string(camera.height_px) + ", found [" + std::to_string(uv[0]) + ", " + std::to_string(uv[1]) +
                "]");
  const CheckedValue radius = keys.required("radius");
  const std::vector<double> radii = radius.numbers(2, {.low = 0.0, .high = 1e6});
  camera.inner_radius_px = radii[0];
  camera.outer_radius_px = radii[1];
  const double farthest = std::hypot(camera.width_px, camera.height_px);
  if (radii[0] >= radii[1] || radii[1] > farthest)
    radius.fail("radius: expected [inner, outer] with inner below outer and outer at most the diagonal of the image, " +
                std::to_string(farthest) + " px, found [" + std::to_string(radii[0]) + ", " + std::to_string(radii[1]) +
                "]");
  if (const auto rim = keys.optional("rim_radius")) camera.rim_radius_px = rim->number(kPositivePixels);
  if (const auto horizon = keys.optional("horizon_radius"))
    camera.horizon_radius_px = horizon->number(kPositivePixels);
  else if (camera.mirror && horizon_radius(*camera.mirror) > 0.0)
    camera.horizon_radius_px = horizon_radius(*camera.mirror);
  else if (camera.model == sensors::OmniCamera::Model::kConic)
    (void)keys.required("horizon_radius");
}

void check_sensor_type(const CheckedMap& keys, std::string_view type) {
  (void)keys.required("sensor_type").one_of({type});
}

/// What a true range is, of one that was computed from its time of flight with the nominal speed of sound.
double range_factor(const CheckedMap& keys) {
  constexpr double kNominalCelsius = 20.0;
  const auto celsius = keys.optional("air_temperature"), assumed = keys.optional("sound_speed");
  if (!celsius) {
    if (assumed) assumed->fail("sound_speed: has no effect without air_temperature, in degrees Celsius");
    return 1.0;
  }
  const double nominal_mps =
      assumed ? assumed->number({.low = 100.0, .high = 1000.0}) : sensors::sound_speed(kNominalCelsius);
  const double time_per_metre_s = 2.0 / nominal_mps;
  return sensors::distance_of_flight(sensors::sound_speed(celsius->number({.low = -90.0, .high = 100.0})),
                                     time_per_metre_s);
}

}  // namespace

sensors::OmniCamera read_camera(const std::filesystem::path& file, Remarks& remarks) {
  const CheckedMap keys = load_yaml(file).map(
      {"sensor_type",  "pose",         "rate_hz",      "height", "accuracy", "exposure",       "scan_time",
       "firing_times", "resolution",   "model",        "center", "radius",   "horizon_radius", "rim_radius",
       "mask",         "azimuth_zero", "azimuth_sign", "mirror", "mei",      "scaramuzza"});
  check_sensor_type(keys, "omnidirectional_camera");
  (void)keys.required("pose");
  sensors::OmniCamera camera;
  const CommonKeys common = common_of(keys, camera.height_m, "exposure", file, remarks);
  camera.T_base_camera = common.T_base_sensor;
  camera.height_m = common.height_m;
  camera.accuracy = common.accuracy;
  if (const auto exposure = keys.optional("exposure")) camera.exposure_s = exposure->number({.low = 0.0, .high = 60.0});
  const std::vector<CheckedValue> resolution = keys.required("resolution").items(2);
  camera.width_px = resolution[0].integer(1, kLargestImage_px);
  camera.height_px = resolution[1].integer(1, kLargestImage_px);
  camera.model = static_cast<sensors::OmniCamera::Model>(
      keys.required("model").one_of({"conic", "mei", "scaramuzza", "equirectangular"}));
  read_projection(keys, camera);
  read_annulus(keys, camera);
  camera.azimuth_zero_rad = keys.required("azimuth_zero").number(kAnyAngle);
  const CheckedValue sign = keys.required("azimuth_sign");
  camera.azimuth_sign = sign.integer(-1, 1);
  if (camera.azimuth_sign == 0) sign.fail("azimuth_sign: expected -1 or 1, found 0");
  if (const auto mask = keys.optional("mask"))
    camera.mask = read_grey_image(file.parent_path() / mask->text(), camera.width_px, camera.height_px);
  return camera;
}

sensors::RangeFinder read_range_finder(const std::filesystem::path& file, Remarks& remarks) {
  const CheckedMap keys =
      load_yaml(file).map({"sensor_type", "pose", "rate_hz", "height", "accuracy", "exposure", "scan_time",
                           "firing_times", "angle_min", "angle_increment", "count", "range_min", "range_max", "noise"});
  check_sensor_type(keys, "range_scanner");
  (void)keys.required("pose");
  sensors::RangeFinder finder;
  const CommonKeys common = common_of(keys, finder.height_m, "scan_time", file, remarks);
  finder.T_base_sensor = common.T_base_sensor;
  finder.height_m = common.height_m;
  finder.accuracy = common.accuracy;
  if (const auto scan_time = keys.optional("scan_time")) finder.scan_time_s = scan_time->number(kDuration);
  finder.angle_min_rad = keys.required("angle_min").number(kAnyAngle);
  finder.count = keys.required("count").integer(1, kLargestCount);
  const CheckedValue increment = keys.required("angle_increment");
  finder.angle_increment_rad = increment.number(kAnyAngle);
  const double span = std::abs(finder.angle_increment_rad) * (finder.count - 1);
  if (finder.angle_increment_rad == 0.0 || span > kFullTurn + 1e-2)
    increment.fail("angle_increment: expected radians, not 0, with " + std::to_string(finder.count) +
                   " beams within one turn; found " + std::to_string(finder.angle_increment_rad) + ", that is " +
                   std::to_string(span / kFullTurn) + " turns");
  finder.range_min_m = keys.required("range_min").number(kLength);
  const CheckedValue range_max = keys.required("range_max");
  finder.range_max_m = range_max.number(kPositiveLength);
  if (finder.range_min_m >= finder.range_max_m)
    range_max.fail("range_max: expected more than range_min, " + std::to_string(finder.range_min_m) + ", found " +
                   std::to_string(finder.range_max_m));
  if (const auto value = keys.optional("noise")) {
    const CheckedMap noise = value->map({"sigma_0", "k"});
    finder.noise.sigma_0_m = noise.required("sigma_0").number(kSigma);
    if (const auto k = noise.optional("k")) finder.noise.k_per_m = k->number(kSigma);
    if (finder.noise.sigma_0_m == 0.0) value->fail("noise.sigma_0: expected more than 0: no range finder is exact");
  } else {
    remarks.push_back(file.string() + ": says nothing about its noise; taken as sigma_0 " +
                      std::to_string(finder.noise.sigma_0_m) + " m");
  }
  return finder;
}

sensors::RangeFinder counter_clockwise(const sensors::RangeFinder& range_finder) {
  sensors::RangeFinder turned = range_finder;
  if (range_finder.angle_increment_rad >= 0.0) return turned;
  turned.angle_min_rad = range_finder.beam_angle(range_finder.count - 1);
  turned.angle_increment_rad = -range_finder.angle_increment_rad;
  turned.scan_time_s = -range_finder.scan_time_s;
  return turned;
}

RecordedSonarRing read_sonar_ring(const std::filesystem::path& file, Remarks& remarks) {
  const CheckedMap keys = load_yaml(file).map({"sensor_type", "pose", "rate_hz", "height", "accuracy", "exposure",
                                               "scan_time", "firing_times", "transducers", "beam_width", "range_min",
                                               "range_max", "sigma", "air_temperature", "sound_speed"});
  check_sensor_type(keys, "sonar_ring");
  RecordedSonarRing recorded{.ring = {}, .range_factor = range_factor(keys)};
  sensors::SonarRing& ring = recorded.ring;
  const CommonKeys common = common_of(keys, ring.height_m, "firing_times", file, remarks);
  ring.height_m = common.height_m;
  if (common.T_base_sensor != geometry::Pose2{})
    remarks.push_back(file.string() + ": pose has no effect: the transducers are given in the robot base frame");
  const CheckedValue transducers = keys.required("transducers");
  for (const CheckedValue& transducer : transducers.items())
    ring.T_base_transducer.push_back(transducer.pose(kMounting));
  if (ring.T_base_transducer.empty()) transducers.fail("transducers: expected at least one [x, y, theta], found none");
  if (const auto times = keys.optional("firing_times"))
    ring.firing_times_s = times->numbers(ring.T_base_transducer.size(), kDuration);
  ring.range_min_m = keys.required("range_min").number(kLength);
  const CheckedValue range_max = keys.required("range_max");
  ring.range_max_m = range_max.number(kPositiveLength);
  if (ring.range_min_m >= ring.range_max_m)
    range_max.fail("range_max: expected more than range_min, " + std::to_string(ring.range_min_m) + ", found " +
                   std::to_string(ring.range_max_m));
  if (const auto beam_width = keys.optional("beam_width"))
    ring.beam_width_rad = beam_width->number(kOpening);
  else
    remarks.push_back(file.string() + ": says no beam_width; taken as " + std::to_string(ring.beam_width_rad));
  if (const auto sigma = keys.optional("sigma"))
    ring.sigma_m = sigma->number({.low = 0.0, .high = 1e3, .low_open = true});
  else
    remarks.push_back(file.string() + ": says no sigma; taken as " + std::to_string(ring.sigma_m) + " m");
  ring.range_min_m *= recorded.range_factor;
  ring.range_max_m *= recorded.range_factor;
  return recorded;
}

sensors::OdometryNoise read_odometry_noise(const std::filesystem::path& file, Remarks& remarks) {
  const CheckedMap keys = load_yaml(file).map(
      {"sensor_type", "pose", "rate_hz", "height", "accuracy", "exposure", "scan_time", "firing_times", "noise"});
  check_sensor_type(keys, "odometry");
  if (common_of(keys, 0.0, "", file, remarks).T_base_sensor != geometry::Pose2{})
    remarks.push_back(file.string() + ": pose has no effect: the rows are poses of the robot base");
  sensors::OdometryNoise noise;
  if (const auto value = keys.optional("noise")) {
    const CheckedMap sigmas = value->map({"translation_per_metre", "rotation_per_metre", "rotation_per_radian"});
    noise.translation_per_metre = sigmas.required("translation_per_metre").number(kSigma);
    noise.rotation_per_metre = sigmas.required("rotation_per_metre").number(kSigma);
    noise.rotation_per_radian = sigmas.required("rotation_per_radian").number(kSigma);
  } else {
    remarks.push_back(file.string() + ": says nothing about its noise; the defaults of OdometryNoise are taken");
  }
  return noise;
}

}  // namespace credo::datasets
