// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <memory>

#include "perception/azimuth_edges.hpp"
#include "perception/gray_curve.hpp"
#include "perception/mirror_tilt.hpp"
#include "perception/radial_fit.hpp"
#include "perception/rim_calibration.hpp"
#include "perception/scene.hpp"
#include "perception/strut_filter.hpp"
#include "sensors/omni_camera.hpp"

namespace credo::perception {

struct RadialLineParams {
  // Sampling of the annulus.
  double border_px = 3.0;  ///< kept free at the inner and outer border, where the reflection's blurred border is
  double row_step_px = 3.0;
  double column_px = 0.7;    ///< distance of the samples along a circle
  double recenter_px = 0.5;  ///< the tables are made anew when the rim has moved the centre further than that
  EdgeFilterParams edges;

  // Votes.
  double bin_rad = 0.0044;            ///< of the votes' histogram; three neighbouring bins vote together
  double least_visible_share = 0.22;  ///< of the annulus' rows that support a line
  double least_chance_sigmas = 5.0;   ///< support beyond what scattered hits give by chance, in its standard deviations
  double least_contrast = 4.0;        ///< [grey levels]

  // Fit.
  double window_rad = 0.010;          ///< hits that near to a line's votes take part in its fit
  double own_hits_rad = 0.006;        ///< hits that near to a line are used up by it, besides 3 sigmas of a hit
  double largest_slope_sigmas = 4.0;  ///< of the slope; steeper lines are not vertical
  double slope_margin_px = 0.15;      ///< of a slope beyond what centre and tilt explain
  double upright_slope_px = 0.05;     ///< 1-sigma of the slope in the second fit of a line that came out too steep
  double largest_scale = 4.0;         ///< of the residuals, in expected standard deviations
  double floor_sigma_rad = 0.0003;    ///< of a line's azimuth, whatever the fit says
  double crowd_rad = 0.025;           ///< lines nearer than that to another may be two edges in one, or half of a pair
  double crowd_sigma_rad = 0.0025;    ///< their further 1-sigma where they touch; it falls linearly to nothing
  RadialFitParams fit;

  // Is there anything to be seen? An image without contrast is dark if even its bright parts are; else it shows plain
  // walls.
  double dark_level = 24.0;          ///< 99th percentile of the annulus below which contrast is asked for [grey levels]
  double least_spread = 6.0;         ///< between the 1st and 99th percentile of the annulus [grey levels]
  double least_spread_sigmas = 7.0;  ///< the same in standard deviations of the noise
  double largest_saturated_share = 0.6;  ///< of the annulus

  RimParams rim;
  TiltParams tilt;
  StrutParams struts;
  GrayCurveParams gray;
};

/// Finds the radial lines of omnidirectional images and reads the grey-level curve, straight from the annulus through a
/// table that is made once for a camera.
///
/// Each circle of the annulus is filtered by the derivative of a Gaussian; the extrema vote, by sign, for their
/// azimuth; the hits behind a peak of the votes are fitted robustly by azimuth(r) = azimuth + slope (1/r - 1/horizon
/// radius). So the bearing is the one at the horizon ring, where a tilt of the mirror does not shift it. The centre is
/// the mirror rim's where that is seen. The bars that hold the mirror are taken out.
class RadialLineExtractor {
 public:
  explicit RadialLineExtractor(const sensors::OmniCamera& camera, const RadialLineParams& params = {});
  ~RadialLineExtractor();
  RadialLineExtractor(RadialLineExtractor&&) noexcept;
  RadialLineExtractor& operator=(RadialLineExtractor&&) noexcept;

  /// Fills Scene::radial_lines, gray, camera_seen and saturated_share. An image without contrast (dark, glaring) leaves
  /// the lines and the curve empty and camera_seen false.
  /// \throws std::invalid_argument if the image is not CV_8UC1 of the camera's size.
  void extract(const sensors::OmniImage& image, Scene& scene);

  /// Centre of the mirror as used for the last image. [px]
  [[nodiscard]] Eigen::Vector2d center_px() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace credo::perception
