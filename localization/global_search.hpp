// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <vector>

#include "localization/global_plausibility.hpp"

namespace credo::localization {

struct GlobalSearchParams {
  PlausibilityParams plausibility;

  // Headings: observed walls against those of the plan.
  double least_walls_m = 1.5;  ///< of walls seen, weighted with their belief; with less, all headings are tried
  double heading_share = 0.5;  ///< a heading is tried that explains so much of what the best one does
  double wall_heading_sigma_rad = 0.035;  ///< of a heading from walls: 2 degrees
  double heading_step_rad = 0.0873;       ///< where all are tried: 5 degrees

  // Constellations.
  double least_belief = 0.3;     ///< BetP(YES) of a primitive that takes part
  int most_walls = 5;            ///< observed ones, the longest, that are paired
  double wall_excess_m = 0.3;    ///< by which a wall may look longer than the plan has it
  double least_wall_sine = 0.5;  ///< of the angle between two walls that make a pose

  // The lattice, coarse to fine.
  double coarsest_m = 0.4;
  double most_cells = 250000.0;             ///< for each heading: 200 m x 200 m; a larger plan begins with coarser ones
  std::size_t most_coarser_nodes = 100000;  ///< that are kept of each coarser level
  std::array<std::size_t, 3> most_nodes{3000, 1200, 3000};  ///< that are kept of 0.4 m, 0.2 m and 0.1 m
  double least_log_ratio = -6.0;                            ///< what cannot reach this is dropped at once

  // From seeds to candidates.
  std::size_t most_refined = 160;  ///< seeds that are refined
  double seed_apart_m = 0.25;
  double seed_apart_rad = 0.14;
  double seed_sigma_m = 0.2;  ///< how far a seed may be off
  double seed_sigma_rad = 0.05;
  double apart_m = 0.5;     ///< candidates nearer than this and
  double apart_rad = 0.35;  ///< turned by less are one
  std::size_t most_candidates = 100;
  double depth = 15.0;  ///< log ratio below the best at which a candidate is none any more
};

/// A pose that may explain a scene.
struct PoseCandidate {
  geometry::PoseEstimate estimate;  ///< T_map_base
  Plausibility plausibility;
};

/// Where the robot may be, from one scene and no idea of the pose. Seeds are constellations, that is primitives and
/// landmarks that may be each other (a corner, edge or wall mark under each heading that the walls allow; two walls
/// that are not parallel), and a lattice over the whole plan, coarse to fine, so that no place is missed where few
/// landmarks are seen: the distance to the nearest wall changes by no more than the way one goes, which bounds what any
/// pose of a cell can reach (as Olson, ICRA 2015, does with pyramids). Seeds are refined, judged by ScenePlausibility
/// and thinned out. Keeps its memory; the same scene gives the same candidates.
class GlobalSearch {
 public:
  /// \param map, field  of the same plan; must outlive this
  GlobalSearch(const LandmarkMap& map, const DistanceField& field, const sensors::Rig& rig,
               const GlobalSearchParams& params = {});

  /// By falling plausibility. Empty where the scene is too poor (ScenePlausibility::blind) or the plan is empty.
  /// \returns a reference that stays valid until the next call
  const std::vector<PoseCandidate>& search(const perception::Scene& scene);

  /// How a pose explains a scene, on the scale of Plausibility::log_ratio, which candidates of the same scene share.
  [[nodiscard]] Plausibility plausibility(const perception::Scene& scene, const geometry::Pose2& pose);
  [[nodiscard]] double log_plausibility(const perception::Scene& scene, const geometry::Pose2& pose) {
    return plausibility(scene, pose).log_ratio;
  }
  /// The pose nearby that explains the scene best. \param expected  says how far it may go: positive definite
  [[nodiscard]] PoseCandidate refine(const perception::Scene& scene, const geometry::PoseEstimate& expected);

 private:
  /// A pose with a bound of what it and its surroundings can reach.
  struct Seed {
    geometry::Pose2 pose;
    double bound = 0.0;
  };
  /// How far the poses lie apart that a bound is to hold for.
  struct Cell {
    double half_m = 0.0;
    double half_rad = 0.0;
  };
  /// A thinned beam end, for bounds.
  struct BeamEnd {
    Eigen::Vector2d point = Eigen::Vector2d::Zero();
    double range_m = 0.0;
    double inverse_sigma = 0.0;
  };

  void find_headings(const perception::Scene& scene);
  void thin_beams();
  void turn_beams(double heading, const Cell& cell);
  [[nodiscard]] double bound(const Eigen::Vector2d& position) const;
  void add_point_constellations(const perception::Scene& scene);
  void add_wall_constellations(const perception::Scene& scene);
  void add_wall_pair(const perception::Primitive& first, const perception::Primitive& second);
  void add_lattice();
  void lay_cells(double side_m, double half_rad);
  void quarter_cells(double side_m, double half_rad);
  void split(double side_m, std::size_t most);
  void bound_constellations();
  void choose_seeds();
  void judge_seeds();

  const LandmarkMap* map_;
  GlobalSearchParams params_;
  ScenePlausibility plausibility_;
  std::vector<double> on_plan_;  ///< ScenePlausibility::on_plan by sigmas, in steps of 1 / kStepsPerSigma
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero(), high_ = Eigen::Vector2d::Zero();  ///< of the plan

  // One search's workspace.
  bool walls_tell_heading_ = false;
  std::vector<double> headings_;
  std::vector<BeamEnd> ends_;
  std::vector<BeamEnd> turned_;  ///< range_m is how far the end may move within the cell
  std::vector<Seed> nodes_, children_, seeds_, chosen_;
  std::vector<const perception::Primitive*> walls_;
  std::vector<PoseCandidate> judged_, candidates_;
};

}  // namespace credo::localization
