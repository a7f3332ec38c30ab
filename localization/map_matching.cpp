// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/map_matching.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

constexpr std::size_t kUsualPrimitives = 256;
constexpr std::size_t kUsualCandidates = 64;  // of one primitive

/// From how many standard deviations on the azimuth forbids a match whatever the range says; infinity: it never does.
double azimuth_gate(const MapMatchingParams& params) {
  const evidence::RampBelief& shape = params.point_azimuth;
  const bool forbids = shape.max_no >= params.point_range.max_yes && shape.no_zero_until <= shape.no_full_from;
  if (params.method == Method::kPaper || !forbids) return std::numeric_limits<double>::infinity();
  return std::max(shape.yes_zero_from, shape.no_full_from);
}

/// How far [low, high] reaches beyond [0, length]. [m]
double excess_of(double low, double high, double length) { return std::max({0.0, -low, high - length}); }

}  // namespace

MapMatcher::MapMatcher(const LandmarkMap& map, const MapMatchingParams& params)
    : map_(&map), params_(params), azimuth_gate_(azimuth_gate(params)) {
  sought_.reserve(kUsualPrimitives);
  matcher_.reserve(kUsualCandidates);
  visible_.reserve(kUsualPrimitives);
  evidence_.reserve(kUsualPrimitives);
  candidates_.reserve(kUsualPrimitives);
  claims_.reserve(kUsualPrimitives);
  matches_.reserve(kUsualPrimitives);
}

/// A wall primitive in the map frame.
struct MapMatcher::SeenWall {
  SeenWall(const Primitive& wall, const geometry::Pose2& T_map_base)
      : primitive(&wall),
        centroid(T_map_base * wall.line.centroid),
        lever(centroid - T_map_base.translation()),
        extent{T_map_base * wall.extent.a, T_map_base * wall.extent.b},
        angle(wall.line.angle + T_map_base.theta) {}

  [[nodiscard]] double turn_from(const WallLandmark& landmark) const {
    return std::abs(geometry::wrap_line_angle(angle - std::atan2(landmark.direction.y(), landmark.direction.x())));
  }

  const Primitive* primitive;
  Vector2d centroid;
  Vector2d lever;  ///< from the base to the centroid
  geometry::Segment extent;
  double angle;
};

BinaryMass MapMatcher::paper_wall_evidence(const SeenWall& wall, const WallLandmark& landmark) const {
  const std::array criteria{params_.paper_wall_angle_deg(to_degrees(wall.turn_from(landmark))),
                            params_.paper_wall_length_m(std::abs(wall.primitive->extent.length() - landmark.length_m)),
                            params_.paper_wall_center_m((wall.extent.centre() - landmark.extent.centre()).norm())};
  return accepted(criteria);
}

BinaryMass MapMatcher::wall_evidence(const SeenWall& wall, const WallLandmark& landmark,
                                     const PoseEstimate& pose) const {
  const double end_1 = (wall.extent.a - landmark.extent.a).dot(landmark.direction);
  const double end_2 = (wall.extent.b - landmark.extent.a).dot(landmark.direction);
  const double low = std::min(end_1, end_2), high = std::max(end_1, end_2);
  if (high < 0.0 || low > landmark.length_m) return kDenied;
  const double across = std::abs(landmark.normal().dot(wall.centroid - landmark.extent.a));
  const double at = (wall.centroid - landmark.extent.a).dot(landmark.direction);
  const double u = map_->uncertainty_m();
  const Matrix2d plan = landmark.plan_covariance(std::clamp(at, 0.0, landmark.length_m), u);
  // Across the map's line: n^T (t + R c), by the pose: (n_x, n_y, n^T R turned(c)).
  const geometry::LineEstimate& line = wall.primitive->line;
  const Eigen::Vector3d by_pose(landmark.normal().x(), landmark.normal().y(),
                                landmark.normal().dot(Vector2d(-wall.lever.y(), wall.lever.x())));
  const double sigma_across =
      std::sqrt(line.sigma_across * line.sigma_across + by_pose.dot(pose.covariance * by_pose) + plan(0, 0));
  const BinaryMass by_offset = params_.wall_across(across / sigma_across);
  if (by_offset.yes == 0.0 && by_offset.no >= params_.wall_angle.max_yes) return kDenied;  // whatever the angle says
  const double sigma_turn = std::sqrt(line.sigma_angle * line.sigma_angle + pose.covariance(2, 2) + plan(1, 1));
  const double along_variance = landmark.direction.dot(pose.covariance.topLeftCorner<2, 2>() * landmark.direction);
  const double sigma_end = std::sqrt(along_variance + u * u + params_.wall_end_sigma_m * params_.wall_end_sigma_m);
  const std::array criteria{params_.wall_angle(wall.turn_from(landmark) / sigma_turn), by_offset,
                            params_.wall_excess(excess_of(low, high, landmark.length_m) / sigma_end)};
  return accepted(criteria);
}

BinaryMass MapMatcher::point_evidence(const Primitive& point, const VisiblePoint& landmark) const {
  const PolarView& view = point.bearing_only ? landmark.from_camera : landmark.from_base;
  if (view.range_m < 1e-3) return kDenied;
  const double off = std::abs(geometry::angle_difference(view.azimuth, point.azimuth));
  const bool same_type = point.bearing_only || point.type == landmark.type;
  if (params_.method == Method::kPaper) {
    if (point.bearing_only || !same_type) return kDenied;
    const std::array criteria{params_.paper_point_range_m(std::abs(point.range_m - view.range_m)),
                              params_.paper_point_azimuth_deg(to_degrees(off))};
    return accepted(criteria);
  }
  const double sigma_off = std::sqrt(view.azimuth_variance + point.sigma_azimuth * point.sigma_azimuth);
  const BinaryMass by_azimuth = params_.point_azimuth(off / sigma_off);
  if (by_azimuth.yes == 0.0 && by_azimuth.no >= params_.point_range.max_yes) return kDenied;  // whatever the range says
  std::array<BinaryMass, 3> criteria{by_azimuth, BinaryMass::vacuous(),
                                     same_type ? BinaryMass::vacuous() : params_.other_type};
  if (!point.bearing_only) {
    const double sigma_range = std::sqrt(view.range_variance + point.sigma_range_m * point.sigma_range_m);
    criteria[1] = params_.point_range(std::abs(point.range_m - view.range_m) / sigma_range);
  }
  return accepted(criteria);
}

/// \param way  to the point
MapMatcher::PolarView MapMatcher::view(const Vector2d& way, const Matrix2d& covariance) {
  const double range = way.norm();
  if (range == 0.0) return {};
  const Vector2d ahead = way / range, aside(-ahead.y(), ahead.x());
  return {std::atan2(way.y(), way.x()), range, aside.dot(covariance * aside) / (range * range),
          ahead.dot(covariance * ahead)};
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
    const SeenWall seen(wall, pose.pose);
    for (std::size_t w = 0; w < map_->walls().size(); ++w) {
      const WallLandmark& landmark = map_->walls()[w];
      const BinaryMass m =
          params_.method == Method::kPaper ? paper_wall_evidence(seen, landmark) : wall_evidence(seen, landmark, pose);
      if (m.yes <= m.no) continue;
      const double at = std::clamp((seen.centroid - landmark.extent.a).dot(landmark.direction), 0.0, landmark.length_m);
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

void MapMatcher::list_sought(const perception::Scene& scene, std::span<const int> primitives) {
  sought_.clear();
  for (const int p : primitives) {
    const Primitive& point = scene.primitives[static_cast<std::size_t>(p)];
    if (point.type == PrimitiveType::kWall) continue;
    sought_.push_back({{std::cos(point.azimuth), std::sin(point.azimuth)},
                       point.sigma_azimuth * point.sigma_azimuth,
                       point.bearing_only});
  }
}

/// Whether a point of the map may be one of what is sought, by its direction: most are not, and this is quickly told.
/// The sine of an angle is at most the angle, and the variance across the way at most twice that of its parts.
bool MapMatcher::is_sought(const Vector2d& in_base, const Vector2d& camera_origin,
                           const Eigen::Matrix3d& pose_covariance) const {
  const double u = map_->uncertainty_m();
  const double across_variance =
      2.0 * (pose_covariance(0, 0) + pose_covariance(1, 1) + pose_covariance(2, 2) * in_base.squaredNorm()) + u * u;
  const double gate = azimuth_gate_ * azimuth_gate_;
  return std::any_of(sought_.begin(), sought_.end(), [&](const Sought& sought) {
    const Vector2d way = sought.from_camera ? Vector2d(in_base - camera_origin) : in_base;
    const double reach = gate * (across_variance + sought.azimuth_variance * way.squaredNorm());
    const double across = sought.direction.x() * way.y() - sought.direction.y() * way.x();
    return reach >= way.squaredNorm() || (across * across <= reach && sought.direction.dot(way) > 0.0);
  });
}

void MapMatcher::list_visible_points(const PoseEstimate& pose, const Vector2d& camera_origin,
                                     std::span<const tracking::LandmarkId> taken) {
  visible_.clear();
  const Vector2d viewpoint = pose.pose.translation();
  const Matrix2d R_base_map = pose.pose.rotation().transpose();
  const double u = map_->uncertainty_m(), farthest_squared = params_.farthest_m * params_.farthest_m;
  for (std::size_t k = 0; k < map_->points().size(); ++k) {
    const PointLandmark& point = map_->points()[k];
    if ((point.position - viewpoint).squaredNorm() > farthest_squared) continue;
    const Vector2d in_base = R_base_map * (point.position - viewpoint);
    if (!is_sought(in_base, camera_origin, pose.covariance)) continue;
    const tracking::LandmarkId id = map_->point_id(k);
    if (std::find(taken.begin(), taken.end(), id) != taken.end()) continue;
    const auto type = map_->type_from(point, viewpoint);
    if (!type || !map_->shows(viewpoint, point.position)) continue;
    const auto J = base_coordinates_by_pose(pose.pose, in_base);
    const Matrix2d covariance = J * pose.covariance * J.transpose() + u * u * Matrix2d::Identity();
    visible_.push_back({id, *type, view(in_base, covariance), view(in_base - camera_origin, covariance)});
  }
}

const std::vector<MapMatch>& MapMatcher::match_points(const perception::Scene& scene, std::span<const int> primitives,
                                                      const PoseEstimate& pose,
                                                      std::span<const tracking::LandmarkId> taken) {
  list_sought(scene, primitives);
  list_visible_points(pose, scene.camera_origin, taken);
  claims_.clear();
  for (const int p : primitives) {
    const Primitive& point = scene.primitives[static_cast<std::size_t>(p)];
    if (point.type == PrimitiveType::kWall) continue;
    evidence_.clear();
    candidates_.clear();
    for (const VisiblePoint& landmark : visible_) {
      const BinaryMass m = point_evidence(point, landmark);
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
  std::sort(claims_.begin(), claims_.end(), [](const MapMatch& a, const MapMatch& b) {
    return a.landmark != b.landmark ? a.landmark < b.landmark : a.primitive < b.primitive;
  });
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
