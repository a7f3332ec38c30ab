// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/motion_prediction.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/angles.hpp"

namespace credo::localization {
namespace {

using geometry::Pose2;
using perception::Primitive;

/// Where a track that was seen before the step is to be seen after it. [rad]
double azimuth_after(const Primitive& seen, const Pose2& step) {
  if (seen.bearing_only) return geometry::wrap_angle(seen.azimuth - step.theta);
  const Eigen::Vector2d position = step.inverse() * seen.position;
  return std::atan2(position.y(), position.x());
}

}  // namespace

void MotionPredictor::add(const Pose2& motion, double seconds) {
  if (steps_.size() == kSteps) steps_.erase(steps_.begin());
  steps_.push_back({motion, seconds});
}

geometry::PoseEstimate MotionPredictor::predict(double seconds) const {
  std::array<std::array<double, kSteps>, 3> parts{};
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const double share = std::clamp(seconds / steps_[i].seconds, 0.0, 5.0);
    const Pose2 step = geometry::interpolate({}, steps_[i].motion, share);
    parts[0][i] = step.x, parts[1][i] = step.y, parts[2][i] = step.theta;
  }
  const auto usual = [n = steps_.size()](std::array<double, kSteps>& values) {
    if (n < kSteps) return n == 0 ? 0.0 : values[n - 1];
    std::nth_element(values.begin(), values.begin() + kSteps / 2, values.end());
    return values[kSteps / 2];
  };
  const Pose2 step{usual(parts[0]), usual(parts[1]), usual(parts[2])};
  const double distance = empty() ? params_.first_step_m : std::hypot(step.x, step.y);
  const double turn = empty() ? params_.first_turn_rad : std::abs(step.theta);
  const double sigma_t = params_.translation_sigma_m + params_.translation_sigma_share * distance;
  const double sigma_r = params_.rotation_sigma_rad + params_.rotation_sigma_share * turn;
  const Eigen::Vector3d variance(sigma_t * sigma_t, sigma_t * sigma_t, sigma_r * sigma_r);
  return {step, variance.asDiagonal()};
}

double unforeseen_turn(std::span<const tracking::Track> tracks, sensors::Timestamp before,
                       const perception::Scene& scene, const Pose2& step, const ConstantVelocityParams& params) {
  const int reach = static_cast<int>(std::ceil(params.max_unforeseen_turn_rad / params.turn_bin_rad));
  std::vector<double> votes(static_cast<std::size_t>(2 * reach + 1), 0.0);
  int voters = 0;
  for (const tracking::Track& track : tracks) {
    if (track.last_seen_time != before) continue;
    ++voters;
    const double expected = azimuth_after(track.last_seen, step);
    for (const Primitive& primitive : scene.primitives) {
      if (primitive.type != track.type || primitive.bearing_only != track.last_seen.bearing_only) continue;
      // A vote is shared by the two nearest bins. A robot that turns counter-clockwise sees the world turn clockwise.
      const double place = geometry::angle_difference(expected, primitive.azimuth) / params.turn_bin_rad + reach;
      const double below = std::floor(place);
      const auto bin = static_cast<std::ptrdiff_t>(below);
      if (bin < 0 || bin >= 2 * reach) continue;
      votes[static_cast<std::size_t>(bin)] += 1.0 - (place - below);
      votes[static_cast<std::size_t>(bin) + 1] += place - below;
    }
  }
  const auto most = std::max_element(votes.begin(), votes.end()) - votes.begin();
  const auto at = [&votes](std::ptrdiff_t bin) { return votes[static_cast<std::size_t>(bin)]; };
  const double least = std::max(params.turn_lead * std::max(1.0, at(reach)), params.turn_share * voters);
  if (most == 0 || most == 2 * reach || at(most) < least) return 0.0;
  const double sum = at(most - 1) + at(most) + at(most + 1);
  return (static_cast<double>(most - reach) + (at(most + 1) - at(most - 1)) / sum) * params.turn_bin_rad;
}

}  // namespace credo::localization
