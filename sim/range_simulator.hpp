// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sensors/acquisition.hpp"
#include "sim/crowd.hpp"
#include "sim/failures.hpp"
#include "sim/random.hpp"
#include "sim/ray_caster.hpp"
#include "sim/world.hpp"

namespace credo::sim {

/// A range finder by triangulation (k > 0: an image point at x = f b / r on a line of pixels) or time of flight (k =
/// 0). What comes back is inf (too dark, too slanting, glass, beyond the range), what is broken or too near is nan.
class RangeSimulator {
 public:
  /// \param world, setup  are kept by reference
  /// \param sensor        index of the range finder
  RangeSimulator(const World& world, const RangeFinderSetup& setup, int sensor, std::uint64_t seed);

  /// \param T_map_base  the true pose at a number of seconds from the scan's timestamp: beams are taken one after
  ///   another
  /// \param index       of the scan: selects its noise
  /// \param people      who stands where at such a time, cut at the height of the range finder; nobody where it is empty
  /// \param condition   of the range finder
  [[nodiscard]] sensors::RangeScan scan(sensors::Timestamp time,
                                        const std::function<geometry::Pose2(double)>& T_map_base, std::uint64_t index,
                                        const std::function<std::vector<Disc>(double)>& people = {},
                                        const Condition& condition = {}) const;

  /// One reading along a unit direction. [m]
  [[nodiscard]] float reading(const Eigen::Vector2d& origin, double angle, Random& random,
                              std::span<const Disc> people = {}) const;

  [[nodiscard]] const geometry::Pose2& T_base_sensor() const { return T_base_sensor_; }

 private:
  struct Spot {
    double range_m, light;
  };
  struct Echo {
    double range_m, cos_incidence;
    const Material* material;
  };
  [[nodiscard]] std::optional<Echo> first_surface(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                                                  std::span<const Disc> people) const;
  [[nodiscard]] float worsened(float range, const Condition& condition, Random& random) const;
  [[nodiscard]] bool is_lost(double light, const Material& material, Random& random) const;
  [[nodiscard]] double measured(const Spot& spot, Random& random) const;

  const World* world_;
  const RangeFinderSetup* setup_;
  RayCaster caster_;
  std::uint64_t seed_;
  int sensor_;
  geometry::Pose2 T_base_sensor_;  ///< as really mounted
  double bias_per_m_ = 0.0;
};

}  // namespace credo::sim
