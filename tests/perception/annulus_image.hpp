// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <opencv2/core/mat.hpp>
#include <random>
#include <vector>

#include "sensors/omni_camera.hpp"

namespace credo::perception::test {

/// A piece of an annulus: azimuths (directions of the base frame, in [-2 pi, 2 pi)) from..to counter-clockwise, radii
/// inner..outer.
struct Patch {
  double from = 0.0;
  double to = 0.0;
  double gray = 0.0;
  double inner_px = 0.0;
  double outer_px = 1e9;
};

/// What an omnidirectional image is made of. Later patches hide earlier ones.
struct AnnulusScene {
  double background = 120.0;
  std::vector<Patch> patches = {};
  std::vector<Patch> struts = {};  ///< in front of everything, the camera's reflection included
  Eigen::Vector2d center_error_px = Eigen::Vector2d::Zero();  ///< true minus calibrated
  double tilt_rad = 0.0;                                      ///< of the mirror axis, towards azimuth pi/2
  double blur_px = 0.7;
  double noise = 1.5;     ///< 1-sigma [grey levels]
  double exposure = 1.0;  ///< factor on all grey levels
  unsigned seed = 1;
};

/// A conic camera, 640 x 480, with a rim.
[[nodiscard]] sensors::OmniCamera test_camera();

/// The image by its definition: 4 x 4 points in pixels whose corners differ, blurred, with noise, rounded.
[[nodiscard]] cv::Mat render(const sensors::OmniCamera& camera, const AnnulusScene& scene);

}  // namespace credo::perception::test
