// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "perception/annulus_table.hpp"
#include "sensors/omni_camera.hpp"

namespace credo::perception {

/// The centre of the mirror from its visible rim, and how it is smoothed over the images.
struct RimParams {
  int directions = 256;
  double search_px = 5.0;         ///< on both sides of the rim's calibrated radius, besides 3 sigmas of the centre
  double step_px = 0.75;          ///< along a radius
  double least_step = 6.0;        ///< fall of the grey level across the rim [grey levels]
  double tukey_px = 1.2;          ///< where a direction loses its weight, in the last iterations
  double least_share = 0.4;       ///< of the directions that must agree
  double floor_sigma_px = 0.06;   ///< of the centre of one image, whatever the fit says
  double walk_px = 0.02;          ///< how far the centre wanders from image to image
  double agreement_sigmas = 5.0;  ///< further from the calibrated centre than that, the rim is not believed
};

struct RimCircle {
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  double radius_px = 0.0;
  double sigma_px = 0.0;  ///< of the centre, per axis
  double share = 0.0;     ///< of the directions that agree
};

/// Places where the grey level falls outwards, a few side by side as the fit takes them.
struct RimFalls {
  static constexpr int kLanes = 8;
  using Lanes = Eigen::Array<double, kLanes, 1>;
  Lanes cosine = Lanes::Zero();  ///< of the direction
  Lanes sine = Lanes::Zero();
  Lanes radius_px = Lanes::Constant(1e9);  ///< too far from any rim to count where there is none
};

/// Where the mirror axis is in the image: the calibration's centre at first, sharpened by the rim image by image.
class RimCalibration {
 public:
  RimCalibration(const sensors::OmniCamera& camera, const RimParams& params);

  /// The rim of one image; absent where the camera has no rim radius or too little of the rim is seen.
  [[nodiscard]] std::optional<RimCircle> find(const std::uint8_t* pixels);

  /// Finds the rim and moves the centre.
  void update(const std::uint8_t* pixels);

  [[nodiscard]] const Eigen::Vector2d& center_px() const { return center_px_; }
  [[nodiscard]] double sigma_px() const { return sigma_px_; }  ///< per axis

 private:
  void find_falls(const std::uint8_t* pixels);
  void add_fall(const Eigen::Vector2d& direction, float radius_px);
  [[nodiscard]] std::optional<RimCircle> fit_circle() const;

  RimParams params_;
  double rim_radius_px_ = 0.0;
  double calibration_sigma_px_ = 0.0;
  Eigen::Vector2d calibrated_center_px_;
  Eigen::Vector2d center_px_;
  double sigma_px_ = 0.0;
  std::vector<AnnulusTable> circles_;  ///< none, or one table of circles about the calibrated centre
  std::vector<Eigen::Vector2d> directions_;
  std::vector<std::int16_t> samples_;  ///< circle by circle
  std::vector<RimFalls> falls_;        ///< by direction
  int fall_count_ = 0;
};

}  // namespace credo::perception
