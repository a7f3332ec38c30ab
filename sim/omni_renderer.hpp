// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "sim/conic_optics.hpp"
#include "sim/lighting.hpp"
#include "sim/panel_view.hpp"
#include "sim/simulation.hpp"
#include "sim/world.hpp"

namespace credo::sim {

/// What the bars that hold the mirror let through, at an offset from the mirror's centre in the image. 0..1
[[nodiscard]] double strut_transmission(const CameraSetup& setup, const Eigen::Vector2d& offset_px);

/// The brightness of an image point by its radius, relative to the centre: cos^4 of the camera ray and the mirror's
/// own.
[[nodiscard]] double fall_off(const sensors::OmniCamera& camera, double radius_px);

/// Pictures of a world through a conic mirror, with all that a real camera adds: light fall-off, struts, dust, the
/// mirror's rim, defocus, motion blur, glare, noise. Const after construction; threads share it, each with its own
/// Workspace.
class OmniRenderer {
 public:
  /// \param world  is kept by reference and must have a camera with a mirror.
  /// \param seed   of what is fixed in this camera (its centre, tilt, dust, pixel gains) and of the noise
  OmniRenderer(const World& world, std::uint64_t seed);

  struct Workspace {
    explicit Workspace(const World& world) : view(world) {}
    PanelView view;
    std::vector<float> corners;  ///< radiance at the corners of the pixels
    cv::Mat image;               ///< CV_32FC1, mean grey levels
  };

  /// What differs from image to image besides the pose.
  struct Exposure {
    double light = 1.0;                   ///< that reaches the sensor, of the usual; 0: the lens is covered
    double noise = 1.0;                   ///< of the usual
    std::span<const Panel> passing = {};  ///< what is there besides the world's panels: people
  };

  /// The image, CV_8UC1, that the camera takes while the robot base moves through `T_map_base` (at least one pose,
  /// equally spaced over the exposure). \param index  of the image: selects its noise
  [[nodiscard]] cv::Mat render(std::span<const geometry::Pose2> T_map_base, std::uint64_t index, Workspace& workspace,
                               const Exposure& exposure) const;
  [[nodiscard]] cv::Mat render(std::span<const geometry::Pose2> T_map_base, std::uint64_t index,
                               Workspace& workspace) const {
    return render(T_map_base, index, workspace, Exposure{});
  }

  /// What `render` would give without noise and quantisation, not cut off at white: mean grey levels, CV_32FC1.
  [[nodiscard]] cv::Mat render_ideal(std::span<const geometry::Pose2> T_map_base, Workspace& workspace,
                                     const Exposure& exposure) const;
  [[nodiscard]] cv::Mat render_ideal(std::span<const geometry::Pose2> T_map_base, Workspace& workspace) const {
    return render_ideal(T_map_base, workspace, Exposure{});
  }

  /// Vertical edges in view, by azimuth: of every panel's ends, people's included, and every step of its pattern, what
  /// an ideal camera at the true place sees of it on `kRows` circles, with a contrast of at least `kFaintest_grey` on 5
  /// % of them. Edges closer together than 0.15 degrees count as one.
  [[nodiscard]] std::vector<TrueVertical> true_verticals(const geometry::Pose2& T_map_base, Workspace& workspace,
                                                         std::span<const Panel> passing = {}) const;

  /// The camera as it really is.
  [[nodiscard]] const ConicOptics& optics() const { return optics_; }
  [[nodiscard]] const geometry::Pose2& T_base_camera() const { return T_base_camera_; }

  static constexpr int kRows = 32;
  static constexpr double kFaintest_grey = 5.0;

 private:
  void draw_calibration_errors(std::uint64_t seed);
  void make_ray_table();
  void make_static_image(std::uint64_t seed);
  void make_noise_table();
  void add_scene(const geometry::Pose2& T_map_base, std::span<const Panel> passing, Workspace& workspace,
                 cv::Mat& sum) const;
  [[nodiscard]] float radiance(const PanelView& view, const float ray[4], std::uint16_t bin) const;
  [[nodiscard]] float refined(const PanelView& view, std::size_t corner, std::uint16_t bin) const;
  void add_glare(cv::Mat& image) const;
  [[nodiscard]] cv::Mat expose(const cv::Mat& mean, std::uint64_t index, double noise) const;

  const World* world_;
  const CameraSetup* setup_;
  LightMap light_;
  std::uint64_t seed_;
  ConicOptics optics_;
  geometry::Pose2 T_base_camera_;
  cv::Mat gain_;             ///< CV_32FC1: grey levels per unit of radiance
  cv::Mat base_;             ///< CV_32FC1: grey levels of the camera's own parts
  std::vector<float> rays_;  ///< of each pixel corner, row by row: direction x, y, z, and the slope of the ray
  std::vector<std::uint16_t> bins_;
  std::vector<float> noise_;        ///< standard normal quantiles
  std::vector<float> noise_sigma_;  ///< by grey level
};

}  // namespace credo::sim
