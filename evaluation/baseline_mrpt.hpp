// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "evaluation/baseline_localizer.hpp"
#include "geometry/floor_plan.hpp"

namespace credo::evaluation {

struct MrptParams {
  int particles = 500;
  int beams = 60;                ///< of a scan, about
  double random_share = 0.05;    ///< LF_zRandom
  double cell_m = 0.02;          ///< of the grid that the plan is drawn into
  double typical_range_m = 3.0;  ///< LF_stdHit is one number: the sigma of a point at this range
  std::uint32_t seed = 1;
};

/// The particle filter of MRPT (mrpt::slam::CMonteCarloLocalization2D, standard proposal, systematic resampling) with
/// the likelihood field of its occupancy grid, the same noise as MclLocalizer, and odometry's motion as a Gaussian. Its
/// confidence is MclLocalizer's too: the mean likelihood of the points, at the mean of the particles. It draws from
/// MRPT's global generator, which its construction seeds: one at a time.
class MrptLocalizer {
 public:
  /// Nothing where Credo was built without MRPT.
  [[nodiscard]] static std::optional<MrptLocalizer> create(const geometry::FloorPlan& plan, const sensors::Rig& rig,
                                                           const geometry::PoseEstimate& initial,
                                                           const MrptParams& params = {});
  ~MrptLocalizer();
  MrptLocalizer(MrptLocalizer&&) noexcept;
  MrptLocalizer& operator=(MrptLocalizer&&) noexcept;

  localization::Localization update(const perception::Scene& scene,
                                    const std::optional<geometry::PoseEstimate>& motion);

 private:
  struct State;
  explicit MrptLocalizer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};
static_assert(Localizer<MrptLocalizer>);

}  // namespace credo::evaluation
