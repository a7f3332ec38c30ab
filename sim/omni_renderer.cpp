// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/omni_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "sim/random.hpp"

namespace credo::sim {
namespace {

constexpr float kRefineContrast = 0.012F;  // radiance: where the corners of a pixel differ more, 9 rays are taken
constexpr int kSub = 3;                    // 3 x 3 rays, turned so that their 9 columns and rows are all different
constexpr int kNoiseBits = 13;
constexpr double kBezel_px = 5.0;    // the machined edge of the mirror, outside of its rim
constexpr double kBezelGain = 22.0;  // grey levels
constexpr double kDark_grey = 4.0;   // outside of the mirror
constexpr double kBody_grey = 38.0;  // the camera that sees itself in the middle

/// How much of a pixel at `radius` lies inside of a circle.
double inside(double radius, double circle) { return std::clamp(circle - radius + 0.5, 0.0, 1.0); }

/// The camera's mirror image around the mirror's tip: rings of its lens.
double body_grey(double radius, double inner) {
  if (radius < 0.25 * inner) return 6.0;
  if (radius < 0.65 * inner) return 24.0;
  return kBody_grey;
}

struct Speck {
  Eigen::Vector2d center;
  double radius, depth;
};

std::vector<Speck> draw_dust(const Nuisances& nuisances, const Eigen::Vector2d& center, double outer,
                             std::uint64_t seed) {
  Random random(seed, kDustStream);
  std::vector<Speck> specks;
  for (int i = 0; i < nuisances.dust; ++i) {
    const double radius = outer * std::sqrt(random.uniform(0.1, 1.0)),
                 angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    specks.push_back({center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)), random.uniform(1.5, 4.0),
                      random.uniform(0.1, 0.35)});
  }
  return specks;
}

double rim_of(const sensors::OmniCamera& camera) { return camera.rim_radius_px.value_or(camera.outer_radius_px); }

}  // namespace

double strut_transmission(const CameraSetup& setup, const Eigen::Vector2d& offset_px) {
  double through = 1.0;
  for (const double angle : setup.struts_rad) {
    const Eigen::Vector2d bar(std::cos(angle), std::sin(angle));
    if (bar.dot(offset_px) < 0.0) continue;
    const double half_width = 0.5 * setup.strut_width_px * (0.5 + offset_px.norm() / rim_of(setup.camera));
    through *= 1.0 - 0.96 * inside(std::abs(bar.x() * offset_px.y() - bar.y() * offset_px.x()), half_width);
  }
  return through;
}

double fall_off(const sensors::OmniCamera& camera, double radius_px) {
  const double cos_phi = 1.0 / std::hypot(1.0, radius_px / camera.mirror->focal_px);
  return std::pow(cos_phi, 4) * (1.0 - 0.25 * std::pow(radius_px / rim_of(camera), 4));
}

OmniRenderer::OmniRenderer(const World& world, std::uint64_t seed)
    : world_(&world), setup_(&world.camera.value()), light_(world), seed_(seed) {
  if (!setup_->camera.mirror || setup_->camera.model != sensors::OmniCamera::Model::kConic)
    throw std::invalid_argument("the simulator renders conic mirrors: give the camera a mirror block");
  draw_calibration_errors(seed);
  make_ray_table();
  make_static_image(seed);
  make_noise_table();
}

void OmniRenderer::draw_calibration_errors(std::uint64_t seed) {
  Random random(seed, kCalibrationStream);
  const Nuisances& sigma = world_->nuisances;
  optics_ = ConicOptics::of(setup_->camera);
  optics_.center_px += Eigen::Vector2d(random.normal(sigma.center_px), random.normal(sigma.center_px));
  const double roll = random.normal(sigma.tilt_rad), pitch = random.normal(sigma.tilt_rad);
  optics_.tilt =
      (Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  const geometry::Pose2 error{random.normal(sigma.mounting_m), random.normal(sigma.mounting_m),
                              random.normal(sigma.mounting_rad)};
  const geometry::Pose2& calibrated = setup_->camera.T_base_camera;
  T_base_camera_ = {calibrated.x + error.x, calibrated.y + error.y,
                    geometry::wrap_angle(calibrated.theta + error.theta)};
}

/// The ray of every pixel corner: independent of the pose, so that no frame computes an angle. Between corners, rays
/// are interpolated: the horizontal part is linear in the pixel, the rest bends by less than 1e-3 of itself over a
/// pixel.
void OmniRenderer::make_ray_table() {
  const int width = setup_->camera.width_px + 1, height = setup_->camera.height_px + 1;
  rays_.resize(4U * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  bins_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  ConicOptics upright = optics_;
  upright.tilt.setIdentity();
  std::size_t corner = 0;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u, ++corner) {
      const Ray ray = upright.ray({u - 0.5, v - 0.5});
      const Eigen::Vector3d tilted = optics_.tilt * ray.direction;
      for (int i = 0; i < 3; ++i) rays_[4 * corner + static_cast<std::size_t>(i)] = static_cast<float>(tilted[i]);
      rays_[4 * corner + 3] = static_cast<float>(ray.origin.z());
      bins_[corner] = PanelView::bin_of(std::atan2(tilted.y(), tilted.x()));
    }
}

void OmniRenderer::make_static_image(std::uint64_t seed) {
  const sensors::OmniCamera& camera = setup_->camera;
  gain_.create(camera.height_px, camera.width_px, CV_32FC1);
  base_.create(camera.height_px, camera.width_px, CV_32FC1);
  Random pixel(seed, kPixelStream);
  const double rim = rim_of(camera);
  const double body = std::max(0.0, camera.inner_radius_px - 2.0);
  const std::vector<Speck> dust = draw_dust(world_->nuisances, optics_.center_px, camera.outer_radius_px, seed);
  for (int v = 0; v < camera.height_px; ++v)
    for (int u = 0; u < camera.width_px; ++u) {
      const Eigen::Vector2d d = Eigen::Vector2d(u, v) - optics_.center_px;
      const double radius = d.norm();
      const double mirror = inside(radius, rim), own = inside(radius, body);
      double through = strut_transmission(*setup_, d);
      for (const Speck& speck : dust)
        through *= 1.0 - speck.depth * inside((Eigen::Vector2d(u, v) - speck.center).norm() / speck.radius, 1.0);
      const double response = 1.0 + pixel.normal(world_->nuisances.pixel_gain);
      const double bezel =
          kBezelGain * (1.0 + 0.5 * d.x() / std::max(radius, 1.0)) * (inside(radius, rim + kBezel_px) - mirror);
      gain_.at<float>(v, u) =
          static_cast<float>(world_->exposure_gain * fall_off(camera, radius) * (mirror - own) * through * response);
      base_.at<float>(v, u) =
          static_cast<float>(kDark_grey + through * (bezel + own * body_grey(radius, camera.inner_radius_px)));
    }
}

/// Quantiles of the normal distribution at equal steps of probability, by Newton's method from one to the next; and
/// what a pixel adds in noise by its grey level: read noise and photon noise, whose variance grows with the light (EMVA
/// 1288).
void OmniRenderer::make_noise_table() {
  constexpr int kCount = 1 << kNoiseBits;
  noise_.resize(kCount);
  double x = -4.0;
  for (int i = 0; i < kCount; ++i) {
    const double target = (i + 0.5) / kCount;
    for (int step = 0; step < 6; ++step) {
      const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
      x -= (0.5 * std::erfc(-x / std::numbers::sqrt2) - target) / density;
    }
    noise_[static_cast<std::size_t>(i)] = static_cast<float>(x);
  }
  const double read = std::min(world_->nuisances.read_noise_grey, world_->nuisances.noise_grey);
  const double total = world_->nuisances.noise_grey;
  const double gain = (total * total - read * read) / 128.0;
  for (int grey = 0; grey <= 255; ++grey)
    noise_sigma_.push_back(static_cast<float>(std::sqrt(read * read + gain * grey)));
}

/// \param ray  direction x, y, z and slope, as in the table
float OmniRenderer::radiance(const PanelView& view, const float ray[4], std::uint16_t bin) const {
  const float origin[3] = {static_cast<float>(optics_.tilt(0, 2)) * ray[3],
                           static_cast<float>(optics_.tilt(1, 2)) * ray[3],
                           static_cast<float>(optics_.tilt(2, 2)) * ray[3]};
  return view.radiance(view.trace(bin, origin, ray), light_, origin, ray);
}

/// The mean over 3 x 3 rays inside of the pixel whose upper left corner is `corner`.
float OmniRenderer::refined(const PanelView& view, std::size_t corner, std::uint16_t bin) const {
  const std::size_t width = static_cast<std::size_t>(setup_->camera.width_px) + 1;
  const float* const a = rays_.data() + 4 * corner;
  const float* const b = a + 4;
  const float* const c = a + 4 * width;
  const float* const d = c + 4;
  float sum = 0.0F;
  for (int j = 0; j < kSub; ++j)
    for (int i = 0; i < kSub; ++i) {
      const float fu = (static_cast<float>(kSub * i + j) + 0.5F) / (kSub * kSub);
      const float fv = (static_cast<float>(kSub * j + kSub - 1 - i) + 0.5F) / (kSub * kSub);
      float ray[4];
      for (int k = 0; k < 4; ++k)
        ray[k] = (a[k] * (1.0F - fu) + b[k] * fu) * (1.0F - fv) + (c[k] * (1.0F - fu) + d[k] * fu) * fv;
      sum += radiance(view, ray, bin);
    }
  return sum / (kSub * kSub);
}

/// Adds the radiance of the scene to `sum`, pixel by pixel: one ray per pixel corner, nine where the corners disagree.
void OmniRenderer::add_scene(const geometry::Pose2& T_map_base, std::span<const Panel> passing, Workspace& workspace,
                             cv::Mat& sum) const {
  const sensors::OmniCamera& camera = setup_->camera;
  workspace.view.look_from(T_map_base * T_base_camera_, camera.height_m, passing);
  const auto width = static_cast<std::size_t>(camera.width_px), height = static_cast<std::size_t>(camera.height_px);
  const std::size_t stride = width + 1;
  workspace.corners.resize(stride * (height + 1));
  const double rim = rim_of(camera) + 1.5;
  const double body = std::max(0.0, camera.inner_radius_px - 4.0);
  for (std::size_t v = 0, corner = 0; v <= height; ++v)
    for (std::size_t u = 0; u <= width; ++u, ++corner) {
      const double du = static_cast<double>(u) - 0.5 - optics_.center_px.x();
      const double dv = static_cast<double>(v) - 0.5 - optics_.center_px.y();
      const double squared = du * du + dv * dv;
      if (squared < body * body || squared > rim * rim) continue;
      workspace.corners[corner] = radiance(workspace.view, rays_.data() + 4 * corner, bins_[corner]);
    }
  for (std::size_t v = 0; v < height; ++v) {
    const float* const gain = gain_.ptr<float>(static_cast<int>(v));
    float* const out = sum.ptr<float>(static_cast<int>(v));
    for (std::size_t u = 0; u < width; ++u) {
      if (gain[u] <= 0.0F) continue;
      const std::size_t corner = v * stride + u;
      const float a = workspace.corners[corner], b = workspace.corners[corner + 1];
      const float c = workspace.corners[corner + stride], d = workspace.corners[corner + stride + 1];
      const float low = std::min(std::min(a, b), std::min(c, d)), high = std::max(std::max(a, b), std::max(c, d));
      out[u] += high - low > kRefineContrast ? refined(workspace.view, corner, bins_[corner]) : 0.25F * (a + b + c + d);
    }
  }
}

/// Light of what is far too bright spreads over the neighbourhood.
void OmniRenderer::add_glare(cv::Mat& image) const {
  if (world_->nuisances.glare <= 0.0) return;
  cv::Mat excess, small;
  cv::subtract(image, 255.0, excess);
  cv::max(excess, 0.0, excess);
  cv::resize(excess, small, {}, 0.125, 0.125, cv::INTER_AREA);
  cv::GaussianBlur(small, small, {}, 3.0);
  cv::resize(small, excess, image.size(), 0.0, 0.0, cv::INTER_LINEAR);
  cv::scaleAdd(excess, 10.0 * world_->nuisances.glare, image, image);
}

cv::Mat OmniRenderer::render_ideal(std::span<const geometry::Pose2> T_map_base, Workspace& workspace,
                                   const Exposure& exposure) const {
  cv::Mat& image = workspace.image;
  image.create(gain_.size(), CV_32FC1);
  image.setTo(0.0);
  if (exposure.light > 0.0)
    for (const geometry::Pose2& pose : T_map_base) add_scene(pose, exposure.passing, workspace, image);
  cv::multiply(image, gain_, image, exposure.light / static_cast<double>(T_map_base.size()));
  cv::scaleAdd(base_, exposure.light, image, image);
  image += (1.0 - exposure.light) * kDark_grey;
  if (world_->nuisances.blur_px > 0.0) {
    const int size = 2 * static_cast<int>(std::ceil(3.5 * world_->nuisances.blur_px)) + 1;
    cv::GaussianBlur(image, image, {size, size}, world_->nuisances.blur_px, 0.0, cv::BORDER_REPLICATE);
  }
  add_glare(image);
  return image;
}

cv::Mat OmniRenderer::render(std::span<const geometry::Pose2> T_map_base, std::uint64_t index, Workspace& workspace,
                             const Exposure& exposure) const {
  return expose(render_ideal(T_map_base, workspace, exposure), index, exposure.noise);
}

cv::Mat OmniRenderer::expose(const cv::Mat& mean, std::uint64_t index, double noise) const {
  const float factor = static_cast<float>(noise);
  cv::Mat image(mean.size(), CV_8UC1);
  Random random(seed_, kImageStream, index);
  constexpr std::uint64_t kMask = (1U << kNoiseBits) - 1;
  std::uint64_t bits = 0;
  int left = 0;
  for (int v = 0; v < mean.rows; ++v) {
    const float* const in = mean.ptr<float>(v);
    std::uint8_t* const out = image.ptr<std::uint8_t>(v);
    for (int u = 0; u < mean.cols; ++u) {
      if (left == 0) {
        bits = random.bits();
        left = 4;
      }
      const float level = std::clamp(in[u], 0.0F, 255.0F);
      const float value = in[u] + factor * noise_sigma_[static_cast<std::size_t>(level)] * noise_[bits & kMask];
      out[u] = static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
      bits >>= kNoiseBits;
      --left;
    }
  }
  return image;
}

}  // namespace credo::sim
