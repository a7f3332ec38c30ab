// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evidence/belief_shapes.hpp"
#include "evidence/whole_belief.hpp"
#include "localization/localization.hpp"
#include "localization/localization_evidence.hpp"

namespace credo::localization {

/// The p + 2 criteria of Clerentin et al., sec. 4.5. The breakpoints are ours (docs/equations.md).
struct LocalizationBeliefParams {
  perception::Method method = perception::Method::kDefault;
  /// On the number of primitives that the pose rests on.
  evidence::RampBelief count{.max_yes = 0.8,
                             .yes_full_until = 6.0,
                             .yes_zero_from = 2.0,
                             .max_no = 0.6,
                             .no_zero_until = 3.0,
                             .no_full_from = 1.0};
  /// On matched / detected.
  evidence::RampBelief ratio{.max_yes = 0.8,
                             .yes_full_until = 0.8,
                             .yes_zero_from = 0.4,
                             .max_no = 0.6,
                             .no_zero_until = 0.5,
                             .no_full_from = 0.2};
  /// The default's third: on the share of the plan's points in sight that are recognised. A pose that is shifted along
  /// a corridor fits all walls; the points tell.
  evidence::RampBelief recognised{.max_yes = 0.6,
                                  .yes_full_until = 0.6,
                                  .yes_zero_from = 0.4,
                                  .max_no = 0.8,
                                  .no_zero_until = 0.4,
                                  .no_full_from = 0.25};
  /// The default's fourth: on the share of the scan's points that lie on the plan. One that fits the walls says little
  /// of where along them; one that does not says that the pose is wrong.
  evidence::RampBelief scan_agreement{.max_yes = 0.0,
                                      .yes_full_until = 1.0,
                                      .yes_zero_from = 0.0,
                                      .max_no = 0.9,
                                      .no_zero_until = 0.70,
                                      .no_full_from = 0.45};
  /// The default's fifth: on the share of the camera's votes for the heading of the pose.
  evidence::RampBelief bearings{.max_yes = 0.5,
                                .yes_full_until = 0.55,
                                .yes_zero_from = 0.45,
                                .max_no = 0.8,
                                .no_zero_until = 0.36,
                                .no_full_from = 0.25};
  /// The default's sixth: on how far the pose without one landmark is from the pose with all, in standard deviations.
  evidence::RampBelief separation{.max_yes = 0.3,
                                  .yes_full_until = 1.5,
                                  .yes_zero_from = 2.5,
                                  .max_no = 0.4,
                                  .no_zero_until = 2.5,
                                  .no_full_from = 4.0};
  int least_in_sight = 4;          ///< fewer points say nothing
  double wall_reliability = 0.3;   ///< of a wall's track as a criterion
  double other_reliability = 0.6;  ///< of a corner's, an edge's, another's: the strong azimuths
};

/// Whether what should be seen is seen: vacuous under the paper's method, and where there is too little to say.
[[nodiscard]] evidence::BinaryMass recognition_belief(const LocalizationEvidence& evidence,
                                                      const LocalizationBeliefParams& params = {});

/// Whether the raw scan lies on the plan: vacuous where there is nothing to tell.
[[nodiscard]] evidence::BinaryMass agreement_belief(const LocalizationEvidence& evidence,
                                                    const LocalizationBeliefParams& params = {});

/// Whether the camera sees the plan under the heading of the pose: vacuous where there is nothing to tell.
[[nodiscard]] evidence::BinaryMass bearing_belief(const LocalizationEvidence& evidence,
                                                  const LocalizationBeliefParams& params = {});

/// Mass on "the localization is correct". The tracks that were matched in this acquisition and have a landmark take
/// part; under the paper's method those that are missed, too.
[[nodiscard]] evidence::FusedBinaryMass localization_belief(const LocalizationEvidence& evidence,
                                                            const LocalizationBeliefParams& params = {});

struct StatusParams {
  double min_belief_yes = 0.5;          ///< localized asks for more
  double max_position_sigma_m = 0.125;  ///< of the worst direction: two of them stay within 0.25 m
  /// Squared Mahalanobis distance of the pose from its prediction: chi-square with 3 degrees of freedom at 1e-4.
  double max_innovation = 21.1;
  double max_heading_sigma_rad = 0.0436;  ///< 2.5 degrees: two of them stay within 5 degrees
  double max_protection_m = 0.5;          ///< of the upper protection levels, where an integrity monitor has looked
  double max_protection_rad = 0.0873;     ///< 5 degrees
};

/// The status that belief and covariance give to an absolute pose, and the reason where it is not localized.
void judge(Localization& localization, bool camera_seen, bool range_finder_seen, const StatusParams& params = {});

}  // namespace credo::localization
