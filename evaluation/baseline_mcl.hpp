// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <vector>

#include "evaluation/baseline_localizer.hpp"
#include "geometry/floor_plan.hpp"
#include "localization/distance_field.hpp"

namespace credo::evaluation {

struct MclParams {
  int particles = 500;
  int beams = 60;               ///< of a scan, evenly chosen: neighbouring beams err together
  double random_share = 0.05;   ///< z_rand: of a beam that hits something the plan does not have
  double resample_below = 0.5;  ///< effective share of the particles
  std::uint64_t seed = 1;
};

/// Monte Carlo localization with a likelihood field (Thrun, Burgard and Fox 2005, tables 8.2 and 6.3, low-variance
/// resampling of table 4.4) on the points of the scan. Its noise is the rig's: a point's own sigma, the plan's, the
/// mounting's, and the field's cells. Its confidence: the mean likelihood over beams and weighted particles, 1 where
/// every point lies on the plan (the w_avg of table 8.3, as a share of the largest possible).
class MclLocalizer {
 public:
  /// \param initial  particles are drawn from it
  MclLocalizer(const geometry::FloorPlan& plan, const sensors::Rig& rig, const geometry::PoseEstimate& initial,
               const MclParams& params = {});

  localization::Localization update(const perception::Scene& scene,
                                    const std::optional<geometry::PoseEstimate>& motion);

 private:
  struct Particle {
    geometry::Pose2 pose;
    double weight = 0.0;
  };
  /// A point of the scan with the precision of where it should be.
  struct Beam {
    Eigen::Vector2d position;
    double half_precision = 0.0;  ///< 1 / (2 sigma^2) [1/m^2]
  };

  void move(const geometry::PoseEstimate& step);
  void choose_beams(const perception::Scene& scene);
  void weigh();
  void resample();
  [[nodiscard]] geometry::PoseEstimate mean() const;

  MclParams params_;
  localization::DistanceField field_;
  double fixed_variance_ = 0.0;  ///< of any point: plan, mounting and cells [m^2]
  double mounting_sigma_rad_ = 0.0;
  BaselineMotion motion_;
  std::uint64_t step_ = 0;
  double confidence_ = 1.0;
  std::vector<Beam> beams_;
  std::vector<Particle> particles_, drawn_;
};
static_assert(Localizer<MclLocalizer>);

}  // namespace credo::evaluation
