// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <vector>

#include "geometry/floor_plan.hpp"
#include "localization/wall_grid.hpp"
#include "perception/scene.hpp"
#include "tracking/track.hpp"

namespace credo::localization {

struct LandmarkMapParams {
  double join_tolerance_m = 0.05;        ///< wall ends closer than this, or than 3 uncertainties, are one junction
  double min_wall_length_m = 0.3;        ///< shorter walls hide what is behind them, but are no landmarks
  double max_collinear_turn_rad = 0.09;  ///< joined walls that turn by less, and stay on the line, are one wall
  double min_corner_angle_rad = 0.7854;  ///< a junction's angle for a corner or an edge: 45 ..
  double max_corner_angle_rad = 2.3562;  ///< .. 135 degrees
  double visibility_margin_m = 0.08;     ///< a landmark this much behind a wall of the plan still counts as visible
  bool cut_walls_at_points = false;      ///< a wall ends at each point that lies on it, as the paper's segments end at
                                         ///< radial lines
};

/// How much a landmark is off with one junction of the plan: a point as much as the junction (offset 1); a wall's line
/// across itself, at `along` from extent.a, by (offset + slope * along) times as much, and it is turned by slope times
/// as much. [1, 1/m]
struct PlanTerm {
  int junction = 0;
  double offset = 1.0;
  double slope = 0.0;
};

/// A wall of the plan: collinear joined walls are one.
struct WallLandmark {
  geometry::Segment extent;
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();
  double length_m = 0.0;
  std::vector<PlanTerm> plan_terms;  ///< of the junctions that the line is drawn through

  [[nodiscard]] Eigen::Vector2d normal() const { return {-direction.y(), direction.x()}; }
  /// Covariance of (offset across the line at `along` from extent.a, angle) from independent errors of the junctions.
  [[nodiscard]] Eigen::Matrix2d plan_covariance(double along_m, double uncertainty_m) const;
};

/// Where walls meet, or one ends; or a mark without relief.
struct PointLandmark {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  bool vertical = false;     ///< a mark without relief: type `other` from wherever it is seen
  std::vector<double> arms;  ///< directions in which walls leave the junction, growing, (-pi, pi] [rad]
  PlanTerm plan_term;
};

/// The four lists of the theoretical map (Clerentin et al., sec. 4.2) as seen from a pose: a junction is a corner from
/// within its sector below 180 degrees and an edge from outside. Ids are dense: walls first, then points.
class LandmarkMap {
 public:
  explicit LandmarkMap(const geometry::FloorPlan& plan, const LandmarkMapParams& params = {});

  [[nodiscard]] const std::vector<WallLandmark>& walls() const { return walls_; }
  [[nodiscard]] const std::vector<PointLandmark>& points() const { return points_; }
  /// The plan's walls as they are: what hides.
  [[nodiscard]] const std::vector<geometry::Segment>& surfaces() const { return surfaces_; }
  [[nodiscard]] double uncertainty_m() const { return uncertainty_m_; }
  /// Number of places of the plan whose errors are independent: all junctions and marks.
  [[nodiscard]] int junction_count() const { return static_cast<int>(points_.size()); }
  [[nodiscard]] int landmark_count() const { return static_cast<int>(walls_.size() + points_.size()); }
  [[nodiscard]] bool empty() const { return walls_.empty() && points_.empty(); }

  [[nodiscard]] tracking::LandmarkId wall_id(std::size_t wall) const { return static_cast<int>(wall); }
  [[nodiscard]] tracking::LandmarkId point_id(std::size_t point) const {
    return static_cast<int>(walls_.size() + point);
  }
  /// Of CalibratedPose::with_plan: the first of two columns for what a landmark is off beside its junctions.
  [[nodiscard]] int own_column(tracking::LandmarkId id) const { return 2 * (junction_count() + id); }
  [[nodiscard]] bool is_wall(tracking::LandmarkId id) const { return id < static_cast<int>(walls_.size()); }
  /// Precondition: is_wall(id).
  [[nodiscard]] const WallLandmark& wall(tracking::LandmarkId id) const { return walls_[static_cast<std::size_t>(id)]; }
  /// Precondition: !is_wall(id).
  [[nodiscard]] const PointLandmark& point(tracking::LandmarkId id) const {
    return points_[static_cast<std::size_t>(id) - walls_.size()];
  }

  /// The type under which a point is seen from a place; nothing where it gives neither a corner nor an edge.
  [[nodiscard]] std::optional<perception::PrimitiveType> type_from(const PointLandmark& point,
                                                                   const Eigen::Vector2d& viewpoint) const;

  /// Whether no wall of the plan stands between the viewpoint and the target, `margin_m` before the target excepted.
  [[nodiscard]] bool sees(const Eigen::Vector2d& viewpoint, const Eigen::Vector2d& target, double margin_m) const;

  /// The same for a landmark: with LandmarkMapParams::visibility_margin_m.
  [[nodiscard]] bool shows(const Eigen::Vector2d& viewpoint, const Eigen::Vector2d& landmark) const {
    return sees(viewpoint, landmark, params_.visibility_margin_m);
  }

  /// Whether a point is at most that far from a wall of the plan.
  [[nodiscard]] bool on_surface(const Eigen::Vector2d& point, double tolerance_m) const {
    return grid_.any_near(point, tolerance_m);
  }

  /// Distance to the first wall of the plan along a ray, if below `max_range_m`; infinity where there is none. [m]
  [[nodiscard]] double cast(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double max_range_m) const {
    return grid_.first_crossing(origin, direction, max_range_m);
  }
  /// The same with the wall's normal.
  [[nodiscard]] RayHit first_hit(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                 double max_range_m) const {
    return grid_.first_hit(origin, direction, max_range_m);
  }

 private:
  void cut_walls_at_points(double tolerance);

  LandmarkMapParams params_;
  double uncertainty_m_ = 0.0;
  std::vector<geometry::Segment> surfaces_;
  WallGrid grid_;  ///< of the surfaces
  std::vector<WallLandmark> walls_;
  std::vector<PointLandmark> points_;
};

}  // namespace credo::localization
