// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/map_matching.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "evidence/gated_match.hpp"
#include "localization/observations.hpp"

namespace credo::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using evidence::BinaryMass;
using geometry::PoseEstimate;
using geometry::to_degrees;
using perception::Method;
using perception::Primitive;
using perception::PrimitiveType;

constexpr BinaryMass kDenied{.yes = 0.0, .no = 1.0, .unknown = 0.0};

/// The criteria's TBM combination as a mass: conflict becomes ignorance; a refused match is a denial.
BinaryMass accepted(std::span<const BinaryMass> criteria) {
  const evidence::GatedMatch fused = evidence::gated_match(criteria);
  if (!fused.match) return kDenied;
  return {fused.mass.yes, fused.mass.no, fused.mass.unknown + fused.mass.conflict};
}

/// How far [low, high] reaches beyond [0, length]. [m]
double excess_of(double low, double high, double length) { return std::max({0.0, -low, high - length}); }

}  // namespace

BinaryMass MapMatcher::wall_evidence(const Primitive& wall, const WallLandmark& landmark,
                                     const PoseEstimate& pose) const {
  const geometry::Pose2& T = pose.pose;
  const double landmark_angle = std::atan2(landmark.direction.y(), landmark.direction.x());
  const double turn = std::abs(geometry::wrap_line_angle(wall.line.angle + T.theta - landmark_angle));
  const Vector2d centroid = T * wall.line.centroid;
  const double across = std::abs(landmark.normal().dot(centroid - landmark.extent.a));
  const double at = (centroid - landmark.extent.a).dot(landmark.direction);
  const double end_1 = (T * wall.extent.a - landmark.extent.a).dot(landmark.direction);
  const double end_2 = (T * wall.extent.b - landmark.extent.a).dot(landmark.direction);
  const double low = std::min(end_1, end_2), high = std::max(end_1, end_2);
  if (params_.method == Method::kPaper) {
    const std::array criteria{
        params_.paper_wall_angle_deg(to_degrees(turn)),
        params_.paper_wall_length_m(std::abs(wall.extent.length() - landmark.length_m)),
        params_.paper_wall_center_m((T * wall.extent.centre() - landmark.extent.centre()).norm())};
    return accepted(criteria);
  }
  if (high < 0.0 || low > landmark.length_m) return kDenied;
  const double u = map_->uncertainty_m();
  const Matrix2d plan = landmark.plan_covariance(std::clamp(at, 0.0, landmark.length_m), u);
  const double sigma_turn =
      std::sqrt(wall.line.sigma_angle * wall.line.sigma_angle + pose.covariance(2, 2) + plan(1, 1));
  // Across the map's line: n^T (t + R c), by the pose: (n_x, n_y, n^T R turned(c)).
  const Vector2d lever = centroid - T.translation();
  const Eigen::Vector3d by_pose(landmark.normal().x(), landmark.normal().y(),
                                landmark.normal().dot(Vector2d(-lever.y(), lever.x())));
  const double sigma_across =
      std::sqrt(wall.line.sigma_across * wall.line.sigma_across + by_pose.dot(pose.covariance * by_pose) + plan(0, 0));
  const double along_variance = landmark.direction.dot(pose.covariance.topLeftCorner<2, 2>() * landmark.direction);
  const double sigma_end = std::sqrt(along_variance + u * u + params_.wall_end_sigma_m * params_.wall_end_sigma_m);
  const std::array criteria{params_.wall_angle(turn / sigma_turn), params_.wall_across(across / sigma_across),
                            params_.wall_excess(excess_of(low, high, landmark.length_m) / sigma_end)};
  return accepted(criteria);
}

BinaryMass MapMatcher::point_evidence(const perception::Scene& scene, const Primitive& point,
                                      const VisiblePoint& landmark) const {
  const Vector2d origin = point.bearing_only ? scene.camera_origin : Vector2d::Zero();
  const Vector2d way = landmark.position_in_base - origin;
  const double range = way.norm();
  if (range < 1e-3) return kDenied;
  const double off = std::abs(geometry::angle_difference(std::atan2(way.y(), way.x()), point.azimuth));
  const bool same_type = point.bearing_only || point.type == landmark.type;
  if (params_.method == Method::kPaper) {
    if (point.bearing_only || !same_type) return kDenied;
    const std::array criteria{params_.paper_point_range_m(std::abs(point.range_m - range)),
                              params_.paper_point_azimuth_deg(to_degrees(off))};
    return accepted(criteria);
  }
  const Vector2d ahead = way / range, aside(-ahead.y(), ahead.x());
  const Matrix2d& C = landmark.covariance_in_base;
  const double sigma_off =
      std::sqrt(aside.dot(C * aside) / (range * range) + point.sigma_azimuth * point.sigma_azimuth);
  const BinaryMass by_azimuth = params_.point_azimuth(off / sigma_off);
  if (by_azimuth.yes == 0.0 && by_azimuth.no >= params_.point_range.max_yes) return kDenied;  // whatever the range says
  std::array<BinaryMass, 3> criteria{by_azimuth, BinaryMass::vacuous(),
                                     same_type ? BinaryMass::vacuous() : params_.other_type};
  if (!point.bearing_only) {
    const double sigma_range = std::sqrt(ahead.dot(C * ahead) + point.sigma_range_m * point.sigma_range_m);
    criteria[1] = params_.point_range(std::abs(point.range_m - range) / sigma_range);
  }
  return accepted(criteria);
}

int MapMatcher::decide() {
  if (evidence_.empty()) return -1;
  if (params_.method == Method::kPaper) {
    const auto best = std::max_element(evidence_.begin(), evidence_.end(),
                                       [](const BinaryMass& a, const BinaryMass& b) { return a.yes < b.yes; });
    return best->yes > best->no ? static_cast<int>(best - evidence_.begin()) : -1;
  }
  matcher_.combine(evidence_);
  const evidence::OpenWorldDecision decision = matcher_.decide_by_pignistic(params_.min_margin);
  return decision.kind == evidence::MatchDecision::kMatched ? decision.candidate : -1;
}

const std::vector<MapMatch>& MapMatcher::match_walls(const perception::Scene& scene, std::span<const int> primitives,
                                                     const PoseEstimate& pose) {
  matches_.clear();
  const Vector2d viewpoint = pose.pose.translation();
  for (const int p : primitives) {
    const Primitive& wall = scene.primitives[static_cast<std::size_t>(p)];
    if (wall.type != PrimitiveType::kWall) continue;
    evidence_.clear();
    candidates_.clear();
    const Vector2d centroid = pose.pose * wall.line.centroid;
    for (std::size_t w = 0; w < map_->walls().size(); ++w) {
      const WallLandmark& landmark = map_->walls()[w];
      const BinaryMass m = wall_evidence(wall, landmark, pose);
      if (m.yes <= m.no) continue;
      const double at = std::clamp((centroid - landmark.extent.a).dot(landmark.direction), 0.0, landmark.length_m);
      if (!map_->shows(viewpoint, landmark.extent.a + at * landmark.direction)) continue;
      evidence_.push_back(m);
      candidates_.push_back(map_->wall_id(w));
    }
    const int best = decide();
    if (best < 0) continue;
    const auto b = static_cast<std::size_t>(best);
    matches_.push_back({.primitive = p, .landmark = candidates_[b], .yes = evidence_[b].yes});
  }
  return matches_;
}

void MapMatcher::list_visible_points(const PoseEstimate& pose, std::span<const tracking::LandmarkId> taken) {
  visible_.clear();
  const Vector2d viewpoint = pose.pose.translation();
  const geometry::Pose2 T_base_map = pose.pose.inverse();
  const double u = map_->uncertainty_m();
  for (std::size_t k = 0; k < map_->points().size(); ++k) {
    const PointLandmark& point = map_->points()[k];
    const tracking::LandmarkId id = map_->point_id(k);
    if (std::find(taken.begin(), taken.end(), id) != taken.end()) continue;
    const auto type = map_->type_from(point, viewpoint);
    if (!type || !map_->shows(viewpoint, point.position)) continue;
    VisiblePoint visible{
        .id = id, .type = *type, .position_in_base = T_base_map * point.position, .covariance_in_base = {}};
    const auto J = base_coordinates_by_pose(pose.pose, visible.position_in_base);
    visible.covariance_in_base = J * pose.covariance * J.transpose() + u * u * Matrix2d::Identity();
    visible_.push_back(visible);
  }
}

const std::vector<MapMatch>& MapMatcher::match_points(const perception::Scene& scene, std::span<const int> primitives,
                                                      const PoseEstimate& pose,
                                                      std::span<const tracking::LandmarkId> taken) {
  list_visible_points(pose, taken);
  claims_.clear();
  for (const int p : primitives) {
    const Primitive& point = scene.primitives[static_cast<std::size_t>(p)];
    if (point.type == PrimitiveType::kWall) continue;
    evidence_.clear();
    candidates_.clear();
    for (const VisiblePoint& landmark : visible_) {
      const BinaryMass m = point_evidence(scene, point, landmark);
      if (m.yes <= m.no) continue;
      evidence_.push_back(m);
      candidates_.push_back(landmark.id);
    }
    const int best = decide();
    if (best < 0) continue;
    const auto b = static_cast<std::size_t>(best);
    claims_.push_back({.primitive = p, .landmark = candidates_[b], .yes = evidence_[b].yes});
  }
  // A landmark that several primitives claim is decided the other way round.
  std::stable_sort(claims_.begin(), claims_.end(),
                   [](const MapMatch& a, const MapMatch& b) { return a.landmark < b.landmark; });
  matches_.clear();
  for (std::size_t first = 0, last = 0; first < claims_.size(); first = last) {
    evidence_.clear();
    for (last = first; last < claims_.size() && claims_[last].landmark == claims_[first].landmark; ++last)
      evidence_.push_back({claims_[last].yes, 0.0, 1.0 - claims_[last].yes});
    const int best = last - first == 1 ? 0 : decide();
    if (best >= 0) matches_.push_back(claims_[first + static_cast<std::size_t>(best)]);
  }
  return matches_;
}

}  // namespace credo::localization
