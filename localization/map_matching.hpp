// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

#include "evidence/belief_shapes.hpp"
#include "evidence/open_world.hpp"
#include "localization/landmark_map.hpp"
#include "perception/observer.hpp"

namespace credo::localization {

/// The default's belief shapes; x is an innovation in its expected standard deviations (pose, plan and sensor
/// together).
struct MapMatchingParams {
  perception::Method method = perception::Method::kDefault;
  evidence::RampBelief wall_angle{.max_yes = 0.8,
                                  .yes_full_until = 1.0,
                                  .yes_zero_from = 4.0,
                                  .max_no = 0.9,
                                  .no_zero_until = 3.0,
                                  .no_full_from = 6.0};
  evidence::RampBelief wall_across{.max_yes = 0.8,
                                   .yes_full_until = 1.0,
                                   .yes_zero_from = 4.0,
                                   .max_no = 0.9,
                                   .no_zero_until = 3.0,
                                   .no_full_from = 6.0};
  /// How far the observation reaches beyond the map's wall. Shorter is ignorance: something may stand before it.
  evidence::RampBelief wall_excess{.max_yes = 0.0,
                                   .yes_full_until = 0.0,
                                   .yes_zero_from = 1.0,
                                   .max_no = 0.9,
                                   .no_zero_until = 3.0,
                                   .no_full_from = 8.0};
  double farthest_m = 60.0;        ///< a point of the map farther than this is not looked for
  double wall_end_sigma_m = 0.05;  ///< of an observed wall's end: beam spacing, mixed readings, skirting
  evidence::RampBelief point_range{.max_yes = 0.8,
                                   .yes_full_until = 1.0,
                                   .yes_zero_from = 4.0,
                                   .max_no = 0.9,
                                   .no_zero_until = 3.0,
                                   .no_full_from = 6.0};
  evidence::RampBelief point_azimuth{.max_yes = 0.8,
                                     .yes_full_until = 1.0,
                                     .yes_zero_from = 4.0,
                                     .max_no = 0.9,
                                     .no_zero_until = 3.0,
                                     .no_full_from = 6.0};
  evidence::BinaryMass other_type{.yes = 0.0, .no = 0.3, .unknown = 0.7};  ///< seen under another type than expected
  double min_margin = 0.05;  ///< of the pignistic probability over the second candidate

  // The paper's, absolute (Clerentin et al., sec. 4.2; the breakpoints are ours, docs/equations.md).
  evidence::RampBelief paper_wall_angle_deg{.max_yes = 0.9,
                                            .yes_full_until = 0.0,
                                            .yes_zero_from = 10.0,
                                            .max_no = 0.9,
                                            .no_zero_until = 10.0,
                                            .no_full_from = 25.0};
  evidence::RampBelief paper_wall_length_m{.max_yes = 0.6,
                                           .yes_full_until = 0.0,
                                           .yes_zero_from = 0.5,
                                           .max_no = 0.4,
                                           .no_zero_until = 0.5,
                                           .no_full_from = 2.0};
  evidence::RampBelief paper_wall_center_m{.max_yes = 0.8,
                                           .yes_full_until = 0.0,
                                           .yes_zero_from = 0.5,
                                           .max_no = 0.8,
                                           .no_zero_until = 0.5,
                                           .no_full_from = 1.5};
  evidence::RampBelief paper_point_range_m{.max_yes = 0.8,
                                           .yes_full_until = 0.0,
                                           .yes_zero_from = 0.3,
                                           .max_no = 0.8,
                                           .no_zero_until = 0.3,
                                           .no_full_from = 0.8};
  evidence::RampBelief paper_point_azimuth_deg{.max_yes = 0.8,
                                               .yes_full_until = 0.0,
                                               .yes_zero_from = 5.0,
                                               .max_no = 0.8,
                                               .no_zero_until = 5.0,
                                               .no_full_from = 12.0};
};

/// A primitive that is believed to be a landmark.
struct MapMatch {
  int primitive = 0;
  tracking::LandmarkId landmark = tracking::kNoLandmark;
  double yes = 0.0;  ///< m_m(YES)
};

/// Matches primitives to the theoretical map from a believed pose (Clerentin et al., sec. 4.2). Keeps its memory.
class MapMatcher {
 public:
  /// \param map  must outlive this
  explicit MapMatcher(const LandmarkMap& map, const MapMatchingParams& params = {});

  /// The wall primitives among `primitives`; several may be pieces of one wall of the map.
  const std::vector<MapMatch>& match_walls(const perception::Scene& scene, std::span<const int> primitives,
                                           const geometry::PoseEstimate& pose);

  /// The corners, edges and others among `primitives`. A point of the map is matched once, and not if it is `taken`.
  const std::vector<MapMatch>& match_points(const perception::Scene& scene, std::span<const int> primitives,
                                            const geometry::PoseEstimate& pose,
                                            std::span<const tracking::LandmarkId> taken);

 private:
  /// A point in polar coordinates, with the variances that the pose and the plan give it.
  struct PolarView {
    double azimuth = 0.0;
    double range_m = 0.0;
    double azimuth_variance = 0.0;
    double range_variance = 0.0;
  };
  struct VisiblePoint {
    tracking::LandmarkId id = tracking::kNoLandmark;
    perception::PrimitiveType type = perception::PrimitiveType::kOther;
    PolarView from_base, from_camera;
  };
  struct SeenWall;
  /// A primitive whose point of the map is looked for.
  struct Sought {
    Eigen::Vector2d direction;  ///< unit vector, from the base or the camera
    double azimuth_variance = 0.0;
    bool from_camera = false;
  };

  [[nodiscard]] static PolarView view(const Eigen::Vector2d& way, const Eigen::Matrix2d& covariance);
  void list_sought(const perception::Scene& scene, std::span<const int> primitives);
  [[nodiscard]] bool is_sought(const Eigen::Vector2d& in_base, const Eigen::Vector2d& camera_origin,
                               const Eigen::Matrix3d& pose_covariance) const;
  void list_visible_points(const geometry::PoseEstimate& pose, const Eigen::Vector2d& camera_origin,
                           std::span<const tracking::LandmarkId> taken);
  /// m_m, its conflict as ignorance; all NO where the conflict or NO forbids the match.
  [[nodiscard]] evidence::BinaryMass wall_evidence(const SeenWall& wall, const WallLandmark& landmark,
                                                   const geometry::PoseEstimate& pose) const;
  [[nodiscard]] evidence::BinaryMass paper_wall_evidence(const SeenWall& wall, const WallLandmark& landmark) const;
  [[nodiscard]] evidence::BinaryMass point_evidence(const perception::Primitive& point,
                                                    const VisiblePoint& landmark) const;
  /// The candidate that the method decides for, as an index into `evidence_`, or -1.
  [[nodiscard]] int decide();

  const LandmarkMap* map_;
  MapMatchingParams params_;
  evidence::OpenWorldMatcher matcher_;
  double azimuth_gate_;  ///< innovation in standard deviations beyond which the azimuth alone forbids a match
  std::vector<Sought> sought_;
  std::vector<VisiblePoint> visible_;
  std::vector<evidence::BinaryMass> evidence_;    ///< one row: a primitive against its candidates
  std::vector<tracking::LandmarkId> candidates_;  ///< of that row
  std::vector<MapMatch> claims_;
  std::vector<MapMatch> matches_;
};

}  // namespace credo::localization
