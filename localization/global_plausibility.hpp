// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <span>
#include <vector>

#include "localization/distance_field.hpp"
#include "localization/landmark_map.hpp"

namespace credo::localization {

/// What one reading says of a pose, as a log ratio against "the robot is where the plan does not show": there, a good
/// half of the readings would be on no wall of the plan.
struct PlausibilityParams {
  int most_beams = 90;   ///< of a scan that are looked at, evenly chosen
  double on_plan = 1.2;  ///< log ratio of a point on the first wall of the plan along its beam,
  double before = -1.0;  ///< of one before it: furniture, people and open doors are on no plan,
  double behind = -3.3;  ///< and of one behind it: walls are opaque
  double on_plan_sigma_m =
      0.03;  ///< how near to its wall a point lies: plan and pose; the beam's own sigma comes to it
  double silent_before_wall = -1.0;  ///< of a beam that came back empty although the plan has a wall well within reach
  double silent_in_the_open = 0.3;   ///< and of one where it has none within reach
  double surely_in_reach = 0.6;      ///< of the range finder's largest range, at
  double steepest_incidence = 0.5;   ///< so large a cosine between beam and normal: dark walls answer worse
  /// Readings beside each other see the same thing, mapped or not: of all beams about every fifth is an independent
  /// witness.
  double beam_weight = 0.2;

  double sight_m = 6.0;             ///< how far points of the plan are looked for in the image
  double bearing_sigma_rad = 0.01;  ///< of a radial line from a point of the plan: camera,
  double bearing_sigma_m = 0.05;    ///< and pose and plan
  double recognised_share = 0.8;    ///< of the points of the plan in sight: so many radial lines come from one, but
  double most_mapped_share = 0.5;   ///< of all at most this: the rest are posters, furniture and shadows
  double bearing_weight = 0.35;     ///< like beam_weight: a door's two edges are one door
};

/// How one pose explains a scene.
struct Plausibility {
  /// Sum of the tempered log ratios of the parameters: 0 as plausible as a place that is on no plan; about +20 where
  /// all agrees; below -10 where walls are looked through.
  double log_ratio = 0.0;
  int on_plan = 0;  ///< beams looked at
  int before = 0;
  int behind = 0;

  /// on_plan of all points that say something; 0 without points. A point before a wall counts a tenth.
  [[nodiscard]] double scan_share() const;
};

/// The plausibility of poses given one scene, without any other knowledge of the pose: the raw scan against the first
/// wall of the plan along each beam, and the camera's radial lines against the points of the plan in sight. Keeps its
/// memory; a pose takes some tens of microseconds.
class ScenePlausibility {
 public:
  /// A beam of the scene, in the base frame.
  struct Beam {
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();
    Eigen::Vector2d ray = Eigen::Vector2d::UnitX();
    Eigen::Vector2d point = Eigen::Vector2d::Zero();
    double range_m = 0.0;
    double sigma_m = 0.0;
  };

  /// \param map, field  of the same plan; must outlive this
  ScenePlausibility(const LandmarkMap& map, const DistanceField& field, const sensors::Rig& rig,
                    const PlausibilityParams& params = {});

  /// Everything below is about this scene, until the next call.
  void look_at(const perception::Scene& scene);

  /// The beams that came back, of those chosen; counter-clockwise.
  [[nodiscard]] std::span<const Beam> beams() const { return beams_; }
  /// Whether there is too little to tell any pose from another.
  [[nodiscard]] bool blind() const { return beams_.size() < kLeastBeams; }

  [[nodiscard]] Plausibility at(const geometry::Pose2& T_map_base);

  /// What a beam adds to Plausibility::log_ratio where nothing stands before its end, which is so many of its standard
  /// deviations from the nearest wall. The most that it can add, so that it bounds what poses nearby can reach.
  [[nodiscard]] double on_plan(double sigmas) const;
  [[nodiscard]] const DistanceField& field() const { return *field_; }

  /// The pose nearby that explains the scene best: point to line along the beams, and bearings, by robust
  /// Gauss-Newton with a scale that shrinks.
  /// \param expected  its covariance is positive definite and says how far the pose may go
  /// \returns with the covariance of expectation and scene together
  [[nodiscard]] geometry::PoseEstimate refine(const geometry::PoseEstimate& expected);

 private:
  static constexpr std::size_t kLeastBeams = 20;
  /// A point of the plan as the camera should see it.
  struct Sight {
    Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< map frame
    double azimuth = 0.0;                             ///< in the map's directions
    Eigen::Vector2d way = Eigen::Vector2d::Zero();    ///< from the camera, map frame
    double sigma = 0.0;
  };
  struct NormalEquations {
    Eigen::Matrix3d information;
    Eigen::Vector3d pull;

    void add(const Eigen::Vector3d& by_pose, double residual, double weight);
  };

  void list_sights(const geometry::Pose2& pose);
  void aim_sights(const geometry::Pose2& pose);
  [[nodiscard]] double mapped_share() const;
  [[nodiscard]] double against_chance(const Sight& sight, double sigmas) const;
  [[nodiscard]] double bearings_at(const geometry::Pose2& pose);
  void pull_beams(const geometry::Pose2& pose, double scale_m, NormalEquations& equations) const;
  void pull_bearings(const geometry::Pose2& pose, NormalEquations& equations) const;

  const LandmarkMap* map_;
  PlausibilityParams params_;
  std::vector<sensors::RangeFinder> range_finder_;  ///< one or none
  const DistanceField* field_;

  // The scene.
  std::vector<Beam> beams_;
  std::vector<Beam> silent_;      ///< beams that came back empty, with their neighbours
  std::vector<double> bearings_;  ///< of radial lines, from the camera, base frame [rad]
  Eigen::Vector2d camera_ = Eigen::Vector2d::Zero();

  std::vector<bool> answered_;  ///< by beam
  std::vector<Sight> sights_;
};

}  // namespace credo::localization
