// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <vector>

#include "localization/global_search.hpp"
#include "localization/localization.hpp"
#include "localization/scan_agreement.hpp"
#include "localization/scene_fit.hpp"

namespace credo::localization {

struct PoseHypothesesParams {
  double missing_cost = 0.7;    ///< log plausibility of a point of the plan in sight that is not recognised
  int independent_points = 25;  ///< of a scan, at most: neighbours share the errors of plan and pose
  double none_cost = 1.0;       ///< of such a point, where no place that is known explains the scene
  double novel_m = 0.5;         ///< a scene counts as far as the robot has moved on since the one before: in full from
  double novel_rad = 0.5;       ///< this way or this turn on
  double drop_below = -14.0;    ///< hypotheses so much less plausible than the best, in logarithms, are given up
  int searches = 3;        ///< scenes from the first on in which new places are looked for; later only where none fits
  double same_m = 0.3;     ///< nearer hypotheses are one, if also
  double same_rad = 0.17;  ///< turned by less
  double searched_sigma_m = 0.08;  ///< of a pose that was found by search
  double searched_sigma_rad = 0.02;
  // When one of them is taken for the truth: a wrong one shall be less likely than 1 in 1000.
  double resolved_gap = 6.9;    ///< ln 1000: log plausibility above that of every other one, "none of these" included
  int resolved_scenes = 3;      ///< in so many scenes, over
  double resolved_way_m = 0.5;  ///< this way, or
  double resolved_turn_rad = 1.0;  ///< this turn
  double listed_above = 0.02;      ///< plausibility of a hypothesis that is told
};

/// Several poses that may be the robot's, carried over motion until one is left. Belief is consonant: the plausibility
/// of each is its likelihood against that of the best one (Shafer 1976, ch. 11), and the best is believed as far as all
/// others, and "none of these", are implausible.
class PoseHypotheses {
 public:
  /// \param search, fitter  of the same plan; must outlive this
  PoseHypotheses(GlobalSearch& search, SceneFitter& fitter, const PoseHypothesesParams& params = {});

  /// Forgets everything.
  void clear();
  /// A pose that is to be among them, if none is there yet. Before the first update.
  void add(const SplitPose& pose);
  /// One scene. \param motion  from the scene before; of no matter in the first one
  void update(const perception::Scene& scene, const geometry::PoseEstimate& motion);

  [[nodiscard]] bool empty() const { return scenes_ == 0; }
  /// By falling plausibility; those worth telling.
  [[nodiscard]] std::vector<Hypothesis> listed() const;
  /// What the most plausible one rests on; nothing where there is none.
  [[nodiscard]] const SceneFit* best() const;
  /// The best one is the truth: see PoseHypothesesParams.
  [[nodiscard]] bool resolved() const;
  /// Log plausibility of the best against that of a pose, or against the least that is kept where it is not among them.
  [[nodiscard]] double lead_over(const geometry::Pose2& pose) const;

 private:
  struct Member {
    SceneFit fit;
    double log_plausibility = 0.0;
    int scenes = 0;  ///< it was seen in
  };

  [[nodiscard]] bool same(const geometry::Pose2& a, const geometry::Pose2& b) const;
  [[nodiscard]] double independent_points(const perception::Scene& scene) const;
  void weigh(const perception::Scene& scene, double novelty, Member& member);
  void look_for_more(const perception::Scene& scene, double history, double novelty);
  void sort_out();

  GlobalSearch* search_;
  SceneFitter* fitter_;
  PoseHypothesesParams params_;
  std::vector<Member> members_;  ///< by falling plausibility after an update
  double none_ = 0.0;            ///< log plausibility of "none of these"
  int scenes_ = 0;
  double way_m_ = 0.0;
  double turn_rad_ = 0.0;
};

}  // namespace credo::localization
