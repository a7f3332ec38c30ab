// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluation/baseline_association.hpp"
#include "evaluation/match_check.hpp"
#include "geometry/pose.hpp"
#include "tracking/association.hpp"

namespace credo::evaluation {

/// What an association made of the landmarks that were in sight a moment ago.
struct AssociationCounts {
  std::string name;
  long right = 0;
  long wrong = 0;   ///< continued by an observation that is not the landmark's
  long missed = 0;  ///< not continued, although an observation of the landmark is left over
  long absent = 0;  ///< not continued, rightly: no observation that is left is the landmark's

  AssociationCounts& operator+=(const AssociationCounts& other);
  /// Of the matches that were made. Nothing without matches.
  [[nodiscard]] std::optional<double> wrong_share() const;
  /// Of the landmarks that could be continued. Nothing if there are none.
  [[nodiscard]] std::optional<double> recall() const;
};

struct AssociationComparisonParams {
  double gate_probability = 0.999;  ///< of the chi-square gate of all but Credo, which has its own
  JpdaParams jpda;
  tracking::AssociationParams credo;  ///< its floor of the azimuth is everybody's
  tracking::PredictionParams prediction;
  MatchCheckParams truth;
};

/// Association alone, on the same predictions and observations: the points of the plan that a scene shows, predicted
/// by the true pose and the motion since, are looked for in the next scene. Whether an observation is a landmark's is
/// decided from the true pose (is_wrong_match). All methods but the last see azimuths with their covariance, and
/// observations of the type that the landmark had, as the paper's matcher does; an observation without a range counts
/// as taken from the base origin.
class AssociationComparison {
 public:
  explicit AssociationComparison(const localization::LandmarkMap& map, const AssociationComparisonParams& params = {});

  /// \param before, now        successive scenes
  /// \param truth_before, truth_now  T_map_base then and now
  /// \param motion             between the two, measured, with covariance
  void add(const perception::Scene& before, const geometry::Pose2& truth_before, const perception::Scene& now,
           const geometry::Pose2& truth_now, const geometry::PoseEstimate& motion);

  /// By method.
  [[nodiscard]] const std::vector<AssociationCounts>& counts() const { return counts_; }

 private:
  struct Landmark {
    tracking::LandmarkId id = tracking::kNoLandmark;
    perception::PrimitiveType type = perception::PrimitiveType::kOther;
    int polarity = 0;
    tracking::Prediction prediction;
  };

  [[nodiscard]] std::vector<Landmark> expected(const perception::Scene& before, const geometry::Pose2& truth_before,
                                               const geometry::PoseEstimate& motion) const;
  [[nodiscard]] std::vector<GatedPair> gated(const std::vector<Landmark>& landmarks,
                                             const perception::Scene& azimuths) const;
  [[nodiscard]] std::vector<int> by_credo(const std::vector<Landmark>& landmarks, const perception::Scene& scene,
                                          perception::Method method);
  void count(AssociationCounts& counts, const std::vector<Landmark>& landmarks, const std::vector<int>& chosen,
             const perception::Scene& now, const geometry::Pose2& truth) const;

  const localization::LandmarkMap* map_;
  AssociationComparisonParams params_;
  double gate_squared_ = 0.0;
  tracking::Associator associator_;
  std::vector<AssociationCounts> counts_;
};

[[nodiscard]] std::string to_text(const std::vector<AssociationCounts>& counts);
/// What the words of the table mean.
[[nodiscard]] std::string association_table_terms(const MatchCheckParams& params = {});

}  // namespace credo::evaluation
