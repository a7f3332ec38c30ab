// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/baseline_association_table.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "evaluation/consistency.hpp"
#include "localization/observations.hpp"

namespace credo::evaluation {
namespace {

using Eigen::Vector2d;
using perception::Primitive;
using perception::PrimitiveType;
using perception::Scene;

/// A point of the base frame with the covariance of its position.
tracking::PolarPoint polar(const Vector2d& position, const Eigen::Matrix2d& covariance) {
  const double range = std::max(position.norm(), 1e-3);
  const Vector2d along = position / range;
  Eigen::Matrix2d by_position;
  by_position.row(0) << -along.y() / range, along.x() / range;
  by_position.row(1) = -along.transpose() / (range * range);
  return {.azimuth = std::atan2(position.y(), position.x()),
          .inverse_range = 1.0 / range,
          .covariance = by_position * covariance * by_position.transpose()};
}

/// The points of a scene with nothing but their azimuths and types; indices stay.
Scene azimuths_alone(const Scene& scene) {
  Scene result = scene;
  result.camera_origin.setZero();
  for (Primitive& primitive : result.primitives)
    if (primitive.type != PrimitiveType::kWall) primitive.bearing_only = true;
  return result;
}

/// The primitive that shows a point of the map, under the type that it has from there: of several, the nearest in
/// azimuth. Nothing where there is none.
const Primitive* sighting(const Scene& scene, const localization::LandmarkMap& map, tracking::LandmarkId id,
                          const geometry::Pose2& truth, const MatchCheckParams& params) {
  const auto type = map.type_from(map.point(id), truth.translation());
  const Vector2d expected = truth.inverse() * map.point(id).position;
  const double azimuth = std::atan2(expected.y(), expected.x());
  const Primitive* nearest = nullptr;
  double least = geometry::kTurn;
  for (const Primitive& seen : scene.primitives) {
    if (seen.type != type || is_wrong_match(seen, scene.camera_origin, map, id, truth, params)) continue;
    const double apart = std::abs(geometry::angle_difference(seen.azimuth, azimuth));
    if (apart >= least) continue;
    least = apart;
    nearest = &seen;
  }
  return nearest;
}

std::string percent_text(const std::optional<double>& share) {
  return share ? fmt::format("{:.2f} %", 100.0 * *share) : "-";
}

}  // namespace

AssociationCounts& AssociationCounts::operator+=(const AssociationCounts& other) {
  right += other.right;
  wrong += other.wrong;
  missed += other.missed;
  absent += other.absent;
  return *this;
}

std::optional<double> AssociationCounts::wrong_share() const {
  if (right + wrong == 0) return {};
  return static_cast<double>(wrong) / static_cast<double>(right + wrong);
}

std::optional<double> AssociationCounts::recall() const {
  if (right + missed == 0) return {};
  return static_cast<double>(right) / static_cast<double>(right + missed);
}

AssociationComparison::AssociationComparison(const localization::LandmarkMap& map,
                                             const AssociationComparisonParams& params)
    : map_(&map), params_(params), gate_squared_(chi_square_quantile(params.gate_probability, 1.0)) {
  for (const char* name : {"nearest neighbour", "global nearest neighbour", "JPDA, likeliest", "JPDA, above 1/2",
                           "Credo, paper's matcher", "Credo, azimuths alone", "Credo, with ranges"})
    counts_.push_back({.name = name});
}

void AssociationComparison::add(const Scene& before, const geometry::Pose2& truth_before, const Scene& now,
                                const geometry::Pose2& truth_now, const geometry::PoseEstimate& motion) {
  const std::vector<Landmark> landmarks = expected(before, truth_before, motion);
  const Scene azimuths = azimuths_alone(now);
  const std::vector<GatedPair> pairs = gated(landmarks, azimuths);
  const int tracks = static_cast<int>(landmarks.size()), observations = static_cast<int>(now.primitives.size());
  const std::vector<int> chosen[] = {nearest_neighbour(tracks, pairs),
                                     global_nearest_neighbour(tracks, observations, pairs, gate_squared_),
                                     joint_probabilistic(tracks, observations, pairs, 0.0, params_.jpda),
                                     joint_probabilistic(tracks, observations, pairs, 0.5, params_.jpda),
                                     by_credo(landmarks, azimuths, perception::Method::kPaper),
                                     by_credo(landmarks, azimuths, perception::Method::kDefault),
                                     by_credo(landmarks, now, perception::Method::kDefault)};
  for (std::size_t k = 0; k < counts_.size(); ++k) count(counts_[k], landmarks, chosen[k], now, truth_now);
}

/// The points of the plan that the scene before shows, where they should be now; by azimuth, so that neighbours follow
/// each other.
std::vector<AssociationComparison::Landmark> AssociationComparison::expected(
    const Scene& before, const geometry::Pose2& truth_before, const geometry::PoseEstimate& motion) const {
  const geometry::PoseEstimate now = geometry::compose({truth_before, Eigen::Matrix3d::Zero()}, motion);
  std::vector<Landmark> result;
  for (std::size_t k = 0; k < map_->points().size(); ++k) {
    const Vector2d position = map_->points()[k].position;
    if (!map_->shows(truth_before.translation(), position)) continue;
    const tracking::LandmarkId id = map_->point_id(k);
    const Primitive* const seen = sighting(before, *map_, id, truth_before, params_.truth);
    if (seen == nullptr) continue;
    const Vector2d in_base = now.pose.inverse() * position;
    const Eigen::Matrix<double, 2, 3> by_pose = localization::base_coordinates_by_pose(now.pose, in_base);
    const double plan = map_->uncertainty_m() * map_->uncertainty_m();
    Landmark& landmark = result.emplace_back();
    landmark.id = id;
    landmark.type = seen->type;
    landmark.polarity = polarity_of(*seen, before);
    landmark.prediction.point =
        polar(in_base, by_pose * now.covariance * by_pose.transpose() + plan * Eigen::Matrix2d::Identity());
  }
  std::ranges::stable_sort(result, {}, [](const Landmark& l) { return l.prediction.point.azimuth; });
  return result;
}

std::vector<GatedPair> AssociationComparison::gated(const std::vector<Landmark>& landmarks,
                                                    const Scene& azimuths) const {
  const double floor = params_.credo.floor_azimuth_rad * params_.credo.floor_azimuth_rad;
  std::vector<GatedPair> pairs;
  for (std::size_t t = 0; t < landmarks.size(); ++t) {
    const tracking::PolarPoint& predicted = landmarks[t].prediction.point;
    for (std::size_t i = 0; i < azimuths.primitives.size(); ++i) {
      const Primitive& seen = azimuths.primitives[i];
      if (seen.type != landmarks[t].type) continue;
      const GatedPair pair{.track = static_cast<int>(t),
                           .observation = static_cast<int>(i),
                           .innovation = geometry::angle_difference(seen.azimuth, predicted.azimuth),
                           .variance = predicted.covariance(0, 0) + seen.sigma_azimuth * seen.sigma_azimuth + floor};
      if (pair.distance_squared() < gate_squared_) pairs.push_back(pair);
    }
  }
  return pairs;
}

std::vector<int> AssociationComparison::by_credo(const std::vector<Landmark>& landmarks, const Scene& scene,
                                                 perception::Method method) {
  std::vector<tracking::Expected> tracks;
  for (const Landmark& l : landmarks) tracks.push_back({l.type, l.polarity, &l.prediction});
  std::vector<int> chosen;
  for (const tracking::Outcome& outcome :
       associator_.associate(tracks, scene, method, params_.credo, params_.prediction))
    chosen.push_back(outcome.kind == evidence::MatchDecision::kMatched ? outcome.primitive : -1);
  return chosen;
}

void AssociationComparison::count(AssociationCounts& counts, const std::vector<Landmark>& landmarks,
                                  const std::vector<int>& chosen, const Scene& now,
                                  const geometry::Pose2& truth) const {
  const auto is_right = [&](std::size_t t, int primitive) {
    const Primitive& seen = now.primitives[static_cast<std::size_t>(primitive)];
    return seen.type != PrimitiveType::kWall &&
           !is_wrong_match(seen, now.camera_origin, *map_, landmarks[t].id, truth, params_.truth);
  };
  std::vector<int> left;
  for (int i = 0; i < static_cast<int>(now.primitives.size()); ++i)
    if (std::ranges::find(chosen, i) == chosen.end()) left.push_back(i);
  for (std::size_t t = 0; t < landmarks.size(); ++t) {
    if (chosen[t] >= 0)
      ++(is_right(t, chosen[t]) ? counts.right : counts.wrong);
    else
      ++(std::ranges::any_of(left, [&](int i) { return is_right(t, i); }) ? counts.missed : counts.absent);
  }
}

std::string to_text(const std::vector<AssociationCounts>& counts) {
  std::string text = fmt::format("  {:<26} {:>7} {:>7} {:>7} {:>7} {:>12} {:>9}\n", "", "right", "wrong", "missed",
                                 "absent", "wrong share", "recall");
  for (const AssociationCounts& c : counts)
    text += fmt::format("  {:<26} {:>7} {:>7} {:>7} {:>7} {:>12} {:>9}\n", c.name, c.right, c.wrong, c.missed, c.absent,
                        percent_text(c.wrong_share()), percent_text(c.recall()));
  return text;
}

std::string association_table_terms(const MatchCheckParams& p) {
  return fmt::format(
      "landmarks that the scene before shows, predicted from the true pose and odometry, looked for in the next scene\n"
      "wrong: predicted from the true pose, the observation is off by > {} sigma and by > {} deg or {} m\n"
      "missed: not continued, although an observation of the landmark is left; absent: not continued, rightly\n"
      "wrong share: of the matches that were made; recall: right, of right and missed\n"
      "all but the last see azimuths and types alone; the last sees ranges, types and polarities\n",
      p.sigmas, p.angle_deg, p.distance_m);
}

}  // namespace credo::evaluation
