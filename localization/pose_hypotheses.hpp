// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <vector>

#include "localization/global_search.hpp"
#include "localization/localization.hpp"
#include "localization/scene_fit.hpp"

namespace credo::localization {

struct PoseHypothesesParams {
  std::size_t most = 100;   ///< hypotheses that are carried on
  double meet_m = 0.3;      ///< hypotheses nearer than this and
  double meet_rad = 0.17;   ///< turned by less have met: they are one
  double settled_m = 0.02;  ///< what a refined pose does not know of itself, 1-sigma: the plan's errors
  double settled_rad = 0.006;

  // Evidence over motion.
  double fresh_way_m = 0.6;   ///< a scene after this way is a witness of its own; after less, it counts in proportion
  double model_error = 3.0;   ///< log ratio by which a scene may speak for a wrong pose: what is on no plan, and the
                              ///< plan's errors, agree with some pose by chance. Only what a pose lacks beyond counts
  double most_at_once = 6.0;  ///< log ratio by which one scene alone can put a pose behind the best one
  double depth = 15.0;        ///< no pose falls farther behind: what contradicts the best one may be an error too
  double most_against_none = 6.0;  ///< log ratio that can be heaped up against "none of these": it is to be found soon
                                   ///< that the robot was carried away

  // New poses are searched for
  double search_from_none = -2.0;  ///< where "none of these" is so near to the best pose; and before one is called
                                   ///< resolved: what else explains the scene now and
  double rival_within = 4.0;       ///< so nearly as well as the best one, is held against it,
  double rival_behind = 2.0;       ///< as much less plausible than it

  // Resolved is a pose that
  double least_belief = 0.99;     ///< is believed so far: any other one is a hundred times less plausible,
  double least_log_ratio = 0.0;   ///< explains the scene better than a place that is on no plan, with
  double least_scan_share = 0.7;  ///< so much of the scan that says something on the plan,
  int least_scenes = 4;           ///< has been borne out by so many scenes,
  double least_way_m = 0.5;       ///< on so long a way,
  double least_turn_rad = 1.0;    ///< or so large a turn,
  double most_sigma_m = 0.15;     ///< and is known so well
  double most_sigma_rad = 0.06;

  double shown_plausibility = 0.01;  ///< of the hypotheses that are reported
};

/// Where the robot may be, over time: poses that are carried along with the motion and refined and judged by each
/// scene, until one is left. A consonant belief function over them and "none of these" (the open world):
///
///     Pl(i) = exp(L_i - L_max),   Bel(i) = 1 - max over j != i of Pl(j)
///
/// so that the best one alone is believed, as far as no other one is plausible. L_i sums up the scenes' log ratios
/// (Plausibility), each in proportion to the way since the one before: a scene from the same place says the same again,
/// errors included. "None of these" has the log ratio 0 in each scene, and L_none sums up what the best pose does
/// better, as in a CUSUM test (Page 1954). Keeps its memory; deterministic.
class PoseHypotheses {
 public:
  /// \param search, fitter  of the same plan; must outlive this
  PoseHypotheses(GlobalSearch& search, SceneFitter& fitter, const PoseHypothesesParams& params = {})
      : search_(&search), fitter_(&fitter), params_(params) {}

  /// Forgets everything.
  void clear();
  /// A pose that has been tracked, to be among the first ones. Before the first update.
  void add(const CalibratedPose& pose) { tracked_.push_back(pose.estimate()); }
  /// One scene. In the first one, and where none of the poses held explains what is seen, the whole plan is searched. A
  /// scene without a scan only moves the poses. \param motion  from the scene before; of no matter in the first one
  void update(const perception::Scene& scene, const geometry::PoseEstimate& motion);

  /// Before the first update.
  [[nodiscard]] bool empty() const { return scenes_ == 0; }
  /// Those plausible enough to be told, by falling plausibility.
  [[nodiscard]] std::vector<Hypothesis> listed() const;
  /// 1 where no pose is held.
  [[nodiscard]] double plausibility_of_none() const;
  /// What the most plausible one rests on; nothing where there is none.
  [[nodiscard]] const SceneFit* best() const { return held_.empty() ? nullptr : &best_; }
  /// The best one is the truth: see the parameters. Rivals that would explain the latest scene have been searched for.
  [[nodiscard]] bool resolved() const { return checked_ && convincing(); }
  /// Log plausibility of the best against that of a pose, or against the least that is kept where it is not among them.
  [[nodiscard]] double lead_over(const geometry::Pose2& pose) const;

 private:
  struct Held {
    geometry::PoseEstimate estimate;
    double log = 0.0;  ///< L_i, the best one's is 0
    Plausibility now;  ///< in the latest scene with a scan
    int scenes = 0;    ///< that bore it out
    double way_m = 0.0;
    double turn_rad = 0.0;
  };

  void start(const perception::Scene& scene);
  void carry(const perception::Scene& scene, const geometry::PoseEstimate& motion);
  void weigh(double freshness);
  void doubt();
  void search_again(const perception::Scene& scene, double within, double log_of_best);
  void tidy();
  void fit_best(const perception::Scene& scene);
  [[nodiscard]] Held* held_near(const geometry::Pose2& pose);
  [[nodiscard]] double belief_in_best() const;
  [[nodiscard]] bool convincing() const;

  GlobalSearch* search_;
  SceneFitter* fitter_;
  PoseHypothesesParams params_;
  std::vector<geometry::PoseEstimate> tracked_;
  std::vector<Held> held_, kept_;  ///< by falling log
  SceneFit best_;
  double none_ = 0.0;     ///< L_none, against the best one's 0
  bool checked_ = false;  ///< rivals of the best pose have been searched for
  int scenes_ = 0;
};

}  // namespace credo::localization
