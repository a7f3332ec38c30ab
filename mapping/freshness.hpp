// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <map>

#include "geometry/pose.hpp"
#include "sensors/acquisition.hpp"

namespace credo::mapping {

struct FreshnessParams {
  /// Of the errors of two readings of a sensor from one place, in [0, 1): however many there are, they count as
  /// 1 / correlation independent ones at most. 0: each counts in full.
  double correlation = 0.1;
  double way_m = 0.01;      ///< after this way what was said is forgotten to 1 / e: the place is another one,
  double turn_rad = 0.005;  ///< or after this turn
  /// A pose within these of the robot's place has not moved: localized poses are not that sure. Beyond them it takes
  /// the place along, and only that is way and turn.
  double still_m = 0.01;
  double still_rad = 0.015;
};

/// How much of a reading is new. Readings from one place repeat what they do not see rightly there (specular walls,
/// cross-talk, the bias of the instrument), so that n of them are worth
///
///     g(n) = n / (1 + (n - 1) correlation)
///
/// independent ones (the design effect of Kish 1965), and the next one adds g(n + 1) - g(n). n is what has
/// been read from here: it fades by exp(-way / way_m - turn / turn_rad) with the way and the turn that the sensor's
/// place is taken along from each reading to the next. In the map shares are rounded to steps of a reliability of
/// 1/32. A pure function of the poses of each sensor's readings in the order of their times.
class Freshness {
 public:
  /// \throws std::invalid_argument unless 0 <= correlation < 1, way_m and turn_rad are above 0 and still_m and
  ///         still_rad not below.
  explicit Freshness(const FreshnessParams& params = {});

  /// The share of the sensor's next reading that is new, in (0, 1], rounded to a power of a half, so that few tables of
  /// increments are needed and a robot on its way maps as ever; 1 for its first one. By time.
  [[nodiscard]] double of_next(const sensors::RangeScan& scan, const geometry::Pose2& T_map_base) {
    return of_next(scans_[scan.sensor], T_map_base);
  }
  [[nodiscard]] double of_next(const sensors::SonarSweep& sweep, const geometry::Pose2& T_map_base) {
    return of_next(sweeps_[sweep.sensor], T_map_base);
  }

 private:
  struct Place {
    geometry::Pose2 T_map_base;  ///< follows the pose, still_m and still_rad behind
    double read = 0.0;           ///< n, from here
  };
  [[nodiscard]] double of_next(Place& place, const geometry::Pose2& T_map_base) const;

  FreshnessParams params_;
  std::map<int, Place> scans_, sweeps_;  ///< by sensor
};

}  // namespace credo::mapping
