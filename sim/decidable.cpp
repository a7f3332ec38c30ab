// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/decidable.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "sim/free_space.hpp"
#include "sim/passage.hpp"
#include "sim/ray_caster.hpp"

namespace credo::sim {
namespace {

using geometry::Pose2;
using Point = Eigen::Vector2d;

constexpr int kDirections = 72;       // of the coarse search: 5 degrees
constexpr double kCoarse_m = 0.2;     // between its places
constexpr double kAlike_m = 0.3;      // a coarse difference counts at most this much
constexpr double kSlimness = 0.6;     // of the robot that looks for places: what is on the grid must not miss any
constexpr std::size_t kRefined = 24;  // most similar poses that are refined
constexpr double kApart_m = 0.4;      // of which no two are nearer together, and
constexpr double kApart_rad = 0.25;   // turned less
constexpr int kSteps = 4;             // of the refinement, at each fineness
constexpr int kShortenings = 4;       // of a step that leads to the place that is sought
constexpr double kLongest_m = 0.2;    // of the steps

/// A pose and how much what is read there differs from what is sought.
struct Candidate {
  Pose2 pose;
  double difference = 0.0;
};

/// Compares readings at poses of the range finder.
class Comparison {
 public:
  Comparison(const World& world, const Pose2& T_map_sensor, const DecidableParams& params)
      : finder_(&world.range_finders.front().finder),
        caster_(world, finder_->height_m),
        plan_m_(world.plan_uncertainty_m),
        params_(&params),
        sought_at_(T_map_sensor) {
    for (int beam = 0; beam < finder_->count; ++beam)
      sought_.push_back(range(T_map_sensor.translation(), T_map_sensor.theta + finder_->beam_angle(beam)));
    for (int i = 0; i < kDirections; ++i) {
      const double direction = geometry::kTurn * i / kDirections;
      coarse_sought_.push_back(range(T_map_sensor.translation(), T_map_sensor.theta + direction));
      const double from_first = direction - finder_->angle_min_rad;
      const double turns = std::floor(from_first / geometry::kTurn + 1e-9);
      in_field_.push_back(from_first - geometry::kTurn * turns <= finder_->count * finder_->angle_increment_rad);
    }
  }

  [[nodiscard]] bool is_elsewhere(const Pose2& pose) const {
    return (pose.translation() - sought_at_.translation()).norm() > params_->elsewhere_m ||
           std::abs(geometry::angle_difference(pose.theta, sought_at_.theta)) >
               geometry::to_radians(params_->elsewhere_deg);
  }

  /// What is read at a pose minus what is sought, beam by beam, in sigmas.
  /// \param slack_m  is added to the sigma of every beam
  [[nodiscard]] Eigen::VectorXd residuals(const Pose2& pose, double slack_m) const {
    Eigen::VectorXd residuals(finder_->count);
    for (int beam = 0; beam < finder_->count; ++beam) {
      const double sought = sought_[static_cast<std::size_t>(beam)];
      const double found = range(pose.translation(), pose.theta + finder_->beam_angle(beam));
      residuals[beam] = (found - sought) / std::hypot(finder_->noise.sigma(std::min(sought, found)), plan_m_, slack_m);
    }
    return residuals;
  }

  /// The root of the sum of their squares, none counted for more than `most_of_a_beam`.
  [[nodiscard]] double difference(const Pose2& pose) const {
    return residuals(pose, 0.0).cwiseAbs().cwiseMin(params_->most_of_a_beam).norm();
  }

  /// The step, in the frame of the pose, towards a more similar one, at most kLongest_m long (Gauss-Newton, of the
  /// beams that count in full, with numeric derivatives).
  [[nodiscard]] Pose2 step_from(const Pose2& pose, double slack_m) const {
    constexpr double kNudge = 0.005;  // m, rad
    const double most = params_->most_of_a_beam;
    const Eigen::VectorXd here = residuals(pose, slack_m);
    Eigen::Array<bool, Eigen::Dynamic, 1> counts = here.array().abs() < most;
    Eigen::MatrixX3d jacobian(here.size(), 3);
    for (int k = 0; k < 3; ++k) {
      const Pose2 nudge{k == 0 ? kNudge : 0.0, k == 1 ? kNudge : 0.0, k == 2 ? kNudge : 0.0};
      const Eigen::VectorXd ahead = residuals(pose * nudge, slack_m),
                            behind = residuals(pose * nudge.inverse(), slack_m);
      jacobian.col(k) = (ahead - behind) / (2.0 * kNudge);
      counts = counts && ahead.array().abs() < most && behind.array().abs() < most;
    }
    const Eigen::VectorXd weights = counts.cast<double>();
    const Eigen::Matrix3d normal = jacobian.transpose() * weights.asDiagonal() * jacobian + Eigen::Matrix3d::Identity();
    const Eigen::Vector3d step = -normal.ldlt().solve(jacobian.transpose() * weights.asDiagonal() * here);
    const double shortened = std::min(1.0, kLongest_m / std::max(step.norm(), 1e-12));
    return {shortened * step.x(), shortened * step.y(), shortened * step.z()};
  }

  /// At one place, by heading in steps of 5 degrees from the one sought: one panorama serves them all.
  void compare_headings(const Point& place, std::vector<Candidate>& candidates) const {
    double panorama[kDirections];
    for (int i = 0; i < kDirections; ++i)
      panorama[i] = range(place, sought_at_.theta + geometry::kTurn * i / kDirections);
    for (int turn = 0; turn < kDirections; ++turn) {
      double sum = 0.0;
      for (int i = 0; i < kDirections; ++i)
        if (in_field_[static_cast<std::size_t>(i)])
          sum += std::min(std::abs(panorama[(i + turn) % kDirections] - coarse_sought_[static_cast<std::size_t>(i)]),
                          kAlike_m);
      const double heading = geometry::wrap_angle(sought_at_.theta + geometry::kTurn * turn / kDirections);
      candidates.push_back({{place.x(), place.y(), heading}, sum});
    }
  }

 private:
  [[nodiscard]] double range(const Point& from, double angle) const {
    const std::optional<RayHit> hit = caster_.cast(from, {std::cos(angle), std::sin(angle)}, finder_->range_max_m);
    return hit ? hit->range_m : finder_->range_max_m;
  }

  const sensors::RangeFinder* finder_;
  RayCaster caster_;
  double plan_m_;
  const DecidableParams* params_;
  Pose2 sought_at_;
  std::vector<double> sought_;         ///< by beam
  std::vector<double> coarse_sought_;  ///< by direction from the sensor's heading
  std::vector<bool> in_field_;
};

/// The most similar candidates, no two of them close together.
std::vector<Candidate> most_alike(std::vector<Candidate> candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.difference < b.difference; });
  std::vector<Candidate> kept;
  for (const Candidate& candidate : candidates) {
    if (kept.size() == kRefined) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Candidate& other) {
      return (candidate.pose.translation() - other.pose.translation()).norm() < kApart_m &&
             std::abs(geometry::angle_difference(candidate.pose.theta, other.pose.theta)) < kApart_rad;
    });
    if (!known) kept.push_back(candidate);
  }
  return kept;
}

/// The least difference on the way down from a pose, never into the place that is sought. Readings are compared ever
/// more finely, so that what is far off is drawn in first. It ends early where the difference is small enough.
double refined(const Comparison& comparison, Pose2 pose, double enough) {
  double least = comparison.difference(pose);
  for (const double slack_m : {0.1, 0.03, 0.01, 0.0})
    for (int i = 0; i < kSteps && least > enough; ++i) {
      Pose2 step = comparison.step_from(pose, slack_m);
      for (int shorter = 0; shorter < kShortenings && !comparison.is_elsewhere(pose * step); ++shorter)
        step = {0.5 * step.x, 0.5 * step.y, 0.5 * step.theta};
      if (!comparison.is_elsewhere(pose * step)) break;
      pose = pose * step;
      least = std::min(least, comparison.difference(pose));
    }
  return least;
}

}  // namespace

bool decidable(const World& world, const Pose2& T_map_base, const DecidableParams& params) {
  if (world.range_finders.empty()) throw std::invalid_argument("a decidable place needs a range finder");
  const Pose2 T_map_sensor = T_map_base * world.range_finders.front().finder.T_base_sensor;
  const Comparison comparison(world, T_map_sensor, params);
  const FreeSpace space(world, {kSlimness * world.robot_radius_m, height_of_robot(world)}, T_map_base.translation());
  const std::vector<Point> places = space.places();
  const int every = static_cast<int>(std::lround(kCoarse_m / FreeSpace::kCell_m));
  std::vector<Candidate> candidates;
  for (const Point& place : places) {
    const Eigen::Vector2i cell = ((place - places.front()) / FreeSpace::kCell_m).array().round().cast<int>();
    if (cell.x() % every != 0 || cell.y() % every != 0) continue;
    comparison.compare_headings(place, candidates);
  }
  std::erase_if(candidates, [&](const Candidate& candidate) { return !comparison.is_elsewhere(candidate.pose); });
  for (const Candidate& candidate : most_alike(std::move(candidates)))
    if (refined(comparison, candidate.pose, params.sigmas) <= params.sigmas) return false;
  return true;
}

}  // namespace credo::sim
