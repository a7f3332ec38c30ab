// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/radial_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "geometry/angles.hpp"
#include "perception/line_votes.hpp"

namespace credo::perception {
namespace {

using geometry::kTurn;

constexpr std::size_t kColumnsPerHit = 8;  // more edges than that are no image
constexpr std::size_t kUsualLines = 512;

void check(const sensors::OmniCamera& camera) {
  if (!(camera.inner_radius_px > 0.0) || !(camera.outer_radius_px > camera.inner_radius_px)) {
    throw std::invalid_argument("the camera's annulus needs an inner radius above 0 and an outer one above that");
  }
  if (!camera.mask.empty() &&
      (camera.mask.type() != CV_8UC1 || camera.mask.cols != camera.width_px || camera.mask.rows != camera.height_px)) {
    throw std::invalid_argument("the camera's mask must be an 8-bit grey image of the camera's resolution");
  }
}

void check(const sensors::OmniImage& image, const sensors::OmniCamera& camera) {
  const cv::Mat& pixels = image.pixels;
  if (pixels.type() != CV_8UC1 || pixels.cols != camera.width_px || pixels.rows != camera.height_px) {
    throw std::invalid_argument("expected an 8-bit grey image of " + std::to_string(camera.width_px) + " x " +
                                std::to_string(camera.height_px) + " pixels, found " + std::to_string(pixels.cols) +
                                " x " + std::to_string(pixels.rows) + " with " + std::to_string(pixels.channels()) +
                                " channels of " + std::to_string(8 * pixels.elemSize1()) + " bits");
  }
}

/// Brings an image near, in the order in which it lies in memory: the circles cross it in an order that no memory
/// foresees. A byte of each cache line is read, for what is merely asked for may not come.
void fetch(const cv::Mat& pixels) {
  constexpr std::size_t kLine = 64;
  const std::size_t bytes = pixels.total();
  std::uint8_t sum = 0;
  for (std::size_t i = 0; i < bytes; i += kLine) sum ^= pixels.data[i];
  [[maybe_unused]] const volatile std::uint8_t keep = sum;  // or the compiler would leave the reads out
}

std::vector<double> annulus_radii(const sensors::OmniCamera& camera, const RadialLineParams& params) {
  const double first = camera.inner_radius_px + params.border_px;
  const double last = camera.outer_radius_px - params.border_px;
  if (last <= first) throw std::invalid_argument("the camera's annulus is too narrow for radial lines");
  return evenly_spaced_radii(first, last, params.row_step_px);
}

double horizon_radius(const sensors::OmniCamera& camera) {
  return camera.horizon_radius_px > 0.0 ? camera.horizon_radius_px
                                        : 0.5 * (camera.inner_radius_px + camera.outer_radius_px);
}

}  // namespace

struct RadialLineExtractor::State {
  State(const sensors::OmniCamera& camera_in, const RadialLineParams& params_in);

  void recenter();
  bool look(const std::uint8_t* pixels, Scene& scene);
  void correct_hits();
  void find_lines(std::vector<RadialLine>& lines);
  void fit_peak(const LinePeak& peak, std::vector<RadialLine>& lines);
  void widen_crowded(std::vector<RadialLine>& lines) const;

  RadialLineParams params;
  sensors::OmniCamera camera;
  RimCalibration rim;
  double horizon_px;
  MirrorTilt tilt;
  AnnulusTable annulus;
  AnnulusTable gray;
  AzimuthEdgeFilter filter;
  StrutFilter struts;
  LineVotes votes;
  double sigma_slope;  ///< of a line's slope beforehand [rad px]
  double noise = 0.0;
  cv::Mat gapless;  ///< copy of an image whose rows have gaps
  std::vector<EdgeHit> hits;
  RadialPoints points;
  std::vector<SlopeReading> slopes;
  std::vector<std::int16_t> scratch;
};

RadialLineExtractor::State::State(const sensors::OmniCamera& camera_in, const RadialLineParams& params_in)
    : params(params_in),
      camera((check(camera_in), camera_in)),
      rim(camera, params.rim),
      horizon_px(horizon_radius(camera)),
      tilt(camera, horizon_px, annulus_radii(camera, params), params.tilt),
      annulus(camera, camera.center_px, annulus_radii(camera, params), params.column_px),
      gray(camera, camera.center_px, gray_circles(camera, params.gray), params.column_px),
      filter(params.edges, params.column_px, annulus.max_columns()),
      struts(camera, camera.center_px, params.column_px, params.struts),
      votes(annulus, camera, params.bin_rad, horizon_px),
      sigma_slope(0.0),
      scratch(static_cast<std::size_t>(std::max(annulus.max_columns(), gray.max_columns()))) {
  const std::size_t most_hits = annulus.samples() / kColumnsPerHit;
  hits.reserve(most_hits);
  votes.reserve(most_hits);
  points.reserve(most_hits);
  slopes.reserve(kUsualLines);
}

/// Makes the tables anew about the rim's centre once that has left the tables' centre; in between, hits are corrected.
void RadialLineExtractor::State::recenter() {
  if ((rim.center_px() - annulus.center_px()).norm() <= params.recenter_px) return;
  const Eigen::Vector2d& center = rim.center_px();
  annulus.recenter(camera, center);
  gray.recenter(camera, center);
  struts.recenter(camera, center);
  votes.count_usable_rows(annulus);
}

/// \returns whether there is anything to be seen in the image.
bool RadialLineExtractor::State::look(const std::uint8_t* pixels, Scene& scene) {
  filter.measure(annulus, pixels);
  noise = filter.noise();
  const std::array<int, 256>& histogram = filter.levels();
  const int total = std::accumulate(histogram.begin(), histogram.end(), 0);
  const auto level_at = [&](double share) {
    int below = 0;
    int level = 0;
    while (level < 255 && below + histogram[level] < share * total) below += histogram[level++];
    return level;
  };
  int saturated = 0;
  for (int level = 0; level < 256; ++level) saturated += level > params.edges.saturated_level ? histogram[level] : 0;
  scene.saturated_share = total > 0 ? static_cast<double>(saturated) / total : 0.0;
  const double least = std::max(params.least_spread, params.least_spread_sigmas * noise);
  const bool dark = level_at(0.99) < params.dark_level && level_at(0.99) - level_at(0.01) < least;
  return total > 0 && !dark && scene.saturated_share <= params.largest_saturated_share;
}

/// Moves the hits to where they are seen from the rim's centre along an upright axis. A centre that is off by (du, dv)
/// turns a point at radius r and image angle phi by (du sin phi - dv cos phi) / r.
void RadialLineExtractor::State::correct_hits() {
  const Eigen::Vector2d offset = rim.center_px() - annulus.center_px();
  for (EdgeHit& hit : hits) {
    const auto& [in_image, in_base] = votes.direction(hit.azimuth);
    const double turn = camera.azimuth_sign * (offset.x() * in_image.y() - offset.y() * in_image.x()) /
                        annulus.rows()[hit.row].radius_px;
    double azimuth = hit.azimuth + turn - tilt.shift(hit.row, in_base);
    if (azimuth < 0.0) azimuth += kTurn;
    if (azimuth >= kTurn) azimuth -= kTurn;
    hit.azimuth = static_cast<float>(azimuth);
  }
}

void RadialLineExtractor::State::fit_peak(const LinePeak& peak, std::vector<RadialLine>& lines) {
  const double start = votes.gather(peak, params.window_rad, points);
  if (points.empty()) return;
  RadialFit fit = fit_radial_line(points, start, sigma_slope, params.fit);
  const double steepest =
      params.largest_slope_sigmas * std::hypot(sigma_slope, fit.sigma_slope) + params.slope_margin_px;
  // Hits of a neighbour or of something oblique bend a line: once more, held upright.
  if (std::abs(fit.slope) > steepest) fit = fit_radial_line(points, start, params.upright_slope_px, params.fit);
  const double usable_rows = votes.usable_rows(peak.azimuth + fit.azimuth);
  if (fit.rows < params.least_visible_share * usable_rows || fit.contrast < params.least_contrast) return;
  if (std::abs(fit.slope) > steepest || fit.scale > params.largest_scale) return;
  const double calibration = rim.sigma_px() / horizon_px;
  lines.push_back({.azimuth = geometry::wrap_angle(peak.azimuth + fit.azimuth),
                   .sigma = std::hypot(fit.sigma, params.floor_sigma_rad, calibration),
                   .contrast = fit.contrast,
                   .polarity = peak.polarity,
                   .visible_share = std::min(1.0, fit.rows / usable_rows),
                   .slope = fit.slope});
  // The slope as it would be without any expectation of it, where the line itself says more than half of it.
  const double own_share = 1.0 - std::pow(fit.sigma_slope / (params.fit.error_inflation * fit.scale * sigma_slope), 2);
  if (own_share > 0.5)
    slopes.push_back({peak.azimuth + fit.azimuth, fit.slope / own_share, fit.sigma_slope / std::sqrt(own_share)});
  votes.use_up(peak, fit, params.window_rad, params.own_hits_rad);
}

void RadialLineExtractor::State::find_lines(std::vector<RadialLine>& lines) {
  votes.count(hits);
  for (const LinePeak& peak : votes.peaks(params.least_visible_share, params.least_chance_sigmas)) {
    fit_peak(peak, lines);
  }
  std::sort(lines.begin(), lines.end(), [](const RadialLine& a, const RadialLine& b) { return a.azimuth < b.azimuth; });
}

/// Where edges crowd, what was fitted may be a neighbour's or two in one: that is not in the fit's own sigma.
void RadialLineExtractor::State::widen_crowded(std::vector<RadialLine>& lines) const {
  const std::size_t count = lines.size();
  for (std::size_t i = 0; count > 1 && i < count; ++i) {
    const double ahead = std::abs(geometry::angle_difference(lines[(i + 1) % count].azimuth, lines[i].azimuth));
    const double behind =
        std::abs(geometry::angle_difference(lines[(i + count - 1) % count].azimuth, lines[i].azimuth));
    const double crowd = std::max(0.0, 1.0 - std::min(ahead, behind) / params.crowd_rad);
    lines[i].sigma = std::hypot(lines[i].sigma, crowd * params.crowd_sigma_rad);
  }
}

RadialLineExtractor::RadialLineExtractor(const sensors::OmniCamera& camera, const RadialLineParams& params)
    : state_(std::make_unique<State>(camera, params)) {}
RadialLineExtractor::~RadialLineExtractor() = default;
RadialLineExtractor::RadialLineExtractor(RadialLineExtractor&&) noexcept = default;
RadialLineExtractor& RadialLineExtractor::operator=(RadialLineExtractor&&) noexcept = default;

Eigen::Vector2d RadialLineExtractor::center_px() const { return state_->rim.center_px(); }

void RadialLineExtractor::extract(const sensors::OmniImage& image, Scene& scene) {
  State& state = *state_;
  check(image, state.camera);
  scene.radial_lines.clear();
  scene.radial_lines.reserve(kUsualLines);
  scene.gray.values.clear();
  scene.camera_origin = {state.camera.T_base_camera.x, state.camera.T_base_camera.y};
  const cv::Mat* pixels = &image.pixels;
  if (!pixels->isContinuous()) {
    pixels->copyTo(state.gapless);
    pixels = &state.gapless;
  }
  fetch(*pixels);
  const std::uint8_t* first = pixels->ptr<std::uint8_t>();
  scene.camera_seen = state.look(first, scene);
  if (!scene.camera_seen) return;
  state.rim.update(first);
  state.recenter();
  state.hits.clear();
  state.filter.find(state.annulus, first, state.hits);
  state.correct_hits();
  state.slopes.clear();
  state.sigma_slope = std::max(1e-3, std::hypot(state.rim.sigma_px(), state.tilt.slope_sigma()));
  state.find_lines(scene.radial_lines);
  state.widen_crowded(scene.radial_lines);
  state.tilt.learn(state.slopes);
  scene.mirror = {state.rim.center_px(), state.rim.sigma_px(), state.tilt.tilt_rad(), state.tilt.sigma_rad()};
  state.struts.remove(first, state.noise, scene.radial_lines);
  read_gray_curve(state.gray, first, state.noise, state.params.gray.bins, state.scratch, scene.gray);
}

}  // namespace credo::perception
