// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

#include "localization/distance_field.hpp"
#include "localization/landmark_map.hpp"
#include "perception/scene.hpp"

namespace credo::localization {

struct GlobalSearchParams {
  // Headings, from the directions of walls.
  double heading_bin_rad = 0.0175;   ///< of their votes: 1 degree
  double heading_share = 0.25;       ///< of the best heading's votes that another needs
  double heading_step_rad = 0.0873;  ///< where no wall is seen: all headings, 5 degrees apart
  // Positions.
  double lattice_m = 0.25;       ///< places that are tried whatever the primitives say
  double min_believed = 0.4;     ///< BetP(YES) of a primitive that a place is derived from
  double nearest_wall_m = 0.15;  ///< a robot keeps so far from all walls
  int points = 60;               ///< of the scan that a place is scored by
  // What is kept.
  double worst_score = 0.10;  ///< below the best; mean nearness of the points to walls, 0 .. 1
  double apart_m = 0.4;       ///< of two poses that are different ones, or
  double apart_rad = 0.26;    ///< so much turned
  int most = 40;              ///< poses that are kept
};

/// A place where the robot may be.
struct PoseCandidate {
  geometry::Pose2 pose;
  double score = 0.0;  ///< mean nearness of the scan's points to walls, 0 .. 1
};

/// Global localization from one scene. The directions of its walls give the heading up to a few; then each corner, edge
/// or other with each point of the map that it may be, and each two walls that are not parallel with each two of the
/// map, give a place (constellations, weighted by nothing but that they are believed), and a lattice over the plan
/// gives the places where too little is seen for that. All are scored by how near the scan lies to walls, and the best,
/// different ones are kept. Deterministic; keeps its memory.
class GlobalSearch {
 public:
  /// \param map, field  of the same plan; must outlive this
  GlobalSearch(const LandmarkMap& map, const DistanceField& field, const GlobalSearchParams& params = {});

  /// \returns the candidates by falling score, valid until the next call; none where the scene has no points
  const std::vector<PoseCandidate>& search(const perception::Scene& scene);

 private:
  void find_headings(const perception::Scene& scene);
  void choose_points(const perception::Scene& scene);
  void turn_points(double heading);
  void try_constellations(const perception::Scene& scene, double heading);
  void try_lattice(double heading);
  void consider(const Eigen::Vector2d& position, double heading);
  [[nodiscard]] double score(const Eigen::Vector2d& position) const;
  void refine(PoseCandidate& candidate);
  void keep_different();

  const LandmarkMap* map_;
  const DistanceField* field_;
  GlobalSearchParams params_;
  std::vector<Eigen::Vector2d> lattice_;  ///< free places of the plan
  std::vector<double> headings_;
  std::vector<double> votes_;
  std::vector<Eigen::Vector2d> points_;  ///< of the scan, base frame
  std::vector<Eigen::Vector2d> turned_;  ///< the same in the map's directions
  double best_ = 0.0;
  std::vector<PoseCandidate> considered_;
  std::vector<PoseCandidate> candidates_;
};

}  // namespace credo::localization
