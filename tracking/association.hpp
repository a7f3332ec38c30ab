// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

#include "evidence/belief_shapes.hpp"
#include "evidence/open_world.hpp"
#include "geometry/angles.hpp"
#include "tracking/assignment.hpp"
#include "tracking/prediction.hpp"

namespace credo::tracking {

/// Extended-open-world matching of predictions with primitives (Clerentin et al., sec. 4.1, fig. 12).
struct AssociationParams {
  /// The paper's: on the difference of the azimuths [deg].
  evidence::RampBelief azimuth_deg{.max_yes = 0.9,
                                   .yes_full_until = 0.0,
                                   .yes_zero_from = 5.0,
                                   .max_no = 0.9,
                                   .no_zero_until = 5.0,
                                   .no_full_from = 10.0};
  /// The default: on the Mahalanobis distance of the innovation, in its expected standard deviations. Points: azimuth,
  /// and inverse range where a range was measured. Walls: angle and distance of the line, and the gap between the
  /// extents. Primitives from `no_full_from` on are no candidates at all.
  evidence::RampBelief sigmas{.max_yes = 0.9,
                              .yes_full_until = 0.0,
                              .yes_zero_from = 3.0,
                              .max_no = 0.9,
                              .no_zero_until = 3.0,
                              .no_full_from = 6.0};
  /// Lead in pignistic probability below which a match is ambiguous (default method).
  double min_margin = 0.05;
  /// What is left of the belief in a match (YES) where the types of two points differ, or their radial lines change
  /// from brighter to darker in opposite senses (default method). A wall is matched with walls only.
  double reliability_of_other_type = 0.7;
  double reliability_of_other_polarity = 0.7;
  /// What even a perfect sensor and a perfect prediction leave of a point, 1-sigma.
  double floor_azimuth_rad = geometry::to_radians(0.1);
  double floor_position_m = 0.02;
  WallFloors wall_floors;
};

/// A track as the association sees it.
struct Expected {
  perception::PrimitiveType type = perception::PrimitiveType::kOther;
  int polarity = 0;  ///< of its radial line; 0: none
  const Prediction* prediction = nullptr;
};

/// What becomes of one track in a scene.
struct Outcome {
  evidence::MatchDecision kind = evidence::MatchDecision::kNone;
  /// Where matched. Where undecided only because of a rival: what the most plausible assignment gives; -1 otherwise.
  int primitive = -1;
  double match_yes = 0.0;  ///< m_match(P_i)
};

/// Who is who: the closed form track by track, the assignment where tracks compete. Keeps its memory.
///
/// Paper: each track decides for the largest mass of {P_1 .. P_p, *, ignorance}, among the primitives of its type;
/// tracks that decide for the same primitive are assigned on the sum of m(P_i) - m(*).
///
/// Default: the most plausible assignment of all tracks and primitives; then each track asks whether its share in it is
/// clear: whether among what the others leave to it one of {P_i, *} leads in pignistic probability, and whether no
/// exchange with one rival would be almost as plausible. If not it is undecided.
class Associator {
 public:
  Associator();

  /// \returns the outcome of each track, valid until the next call
  const std::vector<Outcome>& associate(std::span<const Expected> tracks, const perception::Scene& scene,
                                        perception::Method method, const AssociationParams& params,
                                        const PredictionParams& prediction);

  /// Whether the primitive may belong to a track that is undecided: it is too early to call it new.
  [[nodiscard]] bool claimed_by(int track, int primitive) const;

 private:
  struct Option {
    int primitive = 0;
    evidence::BinaryMass evidence;
    double weight = 0.0;
    double overlap = 0.0;  ///< of walls [m]
  };

  void see(const perception::Scene& scene, const AssociationParams& params, const PredictionParams& prediction);
  void compare_azimuths(const Expected& track, const perception::Scene& scene, const AssociationParams& params);
  void compare_points(const Expected& track, const perception::Scene& scene, const AssociationParams& params);
  void compare_walls(const Expected& track, const perception::Scene& scene, const AssociationParams& params);
  void keep_one_piece_per_face(std::size_t first);
  void decide_as_the_paper(int tracks, int primitives);
  void decide_by_plausibility(int tracks, int primitives, double min_margin);
  void decide_among_what_is_left(int track, double min_margin);
  void withhold_near_ties(double min_margin);
  [[nodiscard]] std::span<const Option> options(int track) const;
  [[nodiscard]] const Option* option(int track, int primitive) const;
  [[nodiscard]] double best_free_weight(int track) const;

  evidence::OpenWorldMatcher matcher_;
  Assigner assigner_;
  std::vector<Option> options_;  // of all tracks, one after the other
  std::vector<int> first_option_;
  std::vector<Candidate> candidates_;
  std::vector<evidence::BinaryMass> row_;
  std::vector<int> row_primitives_;
  std::vector<int> column_of_track_, track_of_column_;
  std::vector<PolarPoint> points_;  // of the scene's primitives
  std::vector<WallLine> walls_;
  std::vector<int> polarities_;
  std::vector<char> ambiguous_, dropped_;
  bool any_bearing_only_ = false;
  std::vector<Outcome> outcomes_;
};

}  // namespace credo::tracking
