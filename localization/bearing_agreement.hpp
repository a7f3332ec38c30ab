// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>

#include "localization/landmark_map.hpp"
#include "perception/scene.hpp"

namespace credo::localization {

struct BearingAgreementParams {
  double nearest_m = 0.8;    ///< nearer points of the plan, whose bearings an error of the plan moves, say nothing,
  double sight_m = 6.0;      ///< and farther ones are too close to each other
  double agree_rad = 0.013;  ///< 0.75 degrees: a bearing so near that of a point agrees with it
  double turned_at_most_rad = 0.26;  ///< other headings are looked at up to 15 degrees aside
  int least_votes = 12;              ///< fewer say nothing
};

/// How many pairs of a radial line and a point of the plan in sight agree: from the pose, and from the best other
/// heading at the same place.
struct BearingAgreement {
  int at_pose = 0;
  int turned = 0;
  double turn_rad = 0.0;  ///< of that heading

  /// at_pose against the two; nothing for fewer than least_votes. About a half where the camera cannot tell.
  [[nodiscard]] std::optional<double> share(const BearingAgreementParams& params = {}) const;
};

/// The camera alone against the plan, whatever was matched: a range finder that has turned on its mounting takes the
/// heading with it, and all that is matched from there agrees.
/// \param T_map_base  within a metre of the truth
[[nodiscard]] BearingAgreement compare_bearings(const perception::Scene& scene, const LandmarkMap& map,
                                                const geometry::Pose2& T_map_base,
                                                const BearingAgreementParams& params = {});

}  // namespace credo::localization
