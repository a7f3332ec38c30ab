// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/localization_belief.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/principal_axes.hpp"

namespace credo::localization {

using evidence::BinaryMass;

BinaryMass recognition_belief(const LocalizationEvidence& evidence, const LocalizationBeliefParams& params) {
  if (params.method == perception::Method::kPaper || evidence.in_sight < params.least_in_sight)
    return BinaryMass::vacuous();
  return params.recognised(static_cast<double>(evidence.recognised) / evidence.in_sight);
}

BinaryMass agreement_belief(const LocalizationEvidence& evidence, const LocalizationBeliefParams& params) {
  return evidence.scan_agreement ? params.scan_agreement(*evidence.scan_agreement) : BinaryMass::vacuous();
}

BinaryMass bearing_belief(const LocalizationEvidence& evidence, const LocalizationBeliefParams& params) {
  return evidence.bearing_agreement ? params.bearings(*evidence.bearing_agreement) : BinaryMass::vacuous();
}

evidence::FusedBinaryMass localization_belief(const LocalizationEvidence& evidence,
                                              const LocalizationBeliefParams& params) {
  const double ratio =
      evidence.detected > 0.0 ? evidence.explained / evidence.detected : std::numeric_limits<double>::quiet_NaN();
  const std::array criteria{params.count(evidence.matched),
                            params.ratio(ratio),
                            recognition_belief(evidence, params),
                            agreement_belief(evidence, params),
                            bearing_belief(evidence, params),
                            evidence.separation ? params.separation(*evidence.separation) : BinaryMass::vacuous()};
  const auto part_of = [&params](const tracking::Track& track) {
    const bool wall = track.type == perception::PrimitiveType::kWall;
    return evidence::Part{track.existence, wall ? params.wall_reliability : params.other_reliability};
  };
  if (params.method == perception::Method::kDefault) {
    evidence::PartMean parts;
    for (const tracking::Track& track : evidence.tracks)
      if (track.landmark != tracking::kNoLandmark && track.state == tracking::TrackState::kTracked)
        parts.add(part_of(track));
    return evidence::whole_from_mean(criteria, parts.mean());
  }
  std::vector<evidence::Part> parts;  // "the p tracks managed by the robot", the missed ones too
  for (const tracking::Track& track : evidence.tracks)
    if (track.landmark != tracking::kNoLandmark) parts.push_back(part_of(track));
  const auto fused = evidence::whole_from_all_parts(criteria, parts, evidence::FusionRule::kDempster);
  return fused.value_or(evidence::FusedBinaryMass{BinaryMass::vacuous(), 1.0});
}

void judge(Localization& localization, bool camera_seen, bool range_finder_seen, const StatusParams& params) {
  const Eigen::Matrix3d& P = localization.estimate.covariance;
  const double sigma = std::sqrt(geometry::largest_variance(P.topLeftCorner<2, 2>()));
  const BinaryMass& belief = localization.belief;
  localization.reason.clear();
  const auto because = [&localization](const char* words) {
    if (!localization.reason.empty()) localization.reason += "; ";
    localization.reason += words;
  };
  if (!camera_seen) because("camera dark or missing");
  if (!range_finder_seen) because("range finder missing");
  if (localization.detected == 0)
    because("nothing is seen: the pose is predicted");
  else if (localization.matched == 0)
    because("nothing matches the plan: the pose is predicted");
  else if (localization.matched < 3)
    because("few landmarks");
  if (belief.no > belief.yes) because("more speaks against the pose than for it");
  if (localization.unrecognised) because("landmarks that should be in sight are not seen");
  if (localization.off_plan) because("the scan does not lie on the plan");
  if (localization.contradicted) because("camera, range finder and wheels contradict each other");
  if (localization.doubted && !localization.unrecognised && !localization.off_plan && !localization.contradicted)
    because("just doubted, and not confirmed yet");
  if (localization.elsewhere) because("another pose fits far better");
  // Written so that what is not a number fails.
  const bool position_known = sigma <= params.max_position_sigma_m;
  const bool heading_known = std::sqrt(P(2, 2)) <= params.max_heading_sigma_rad;
  if (!position_known) because("position too uncertain");
  if (!heading_known) because("heading too uncertain");
  const ProtectionLevels& levels = localization.protection;
  const bool guarded =
      !(levels.position_high_m > params.max_protection_m) && !(levels.heading_high_rad > params.max_protection_rad);
  if (!guarded) because("if one of few landmarks is wrong, so is the pose");
  const bool predicted = localization.innovation <= params.max_innovation;
  if (!predicted) because("the pose contradicts its prediction");

  if (localization.hypotheses.size() > 1) {
    because("several poses fit: a place that looks like others");
    localization.status = Status::kAmbiguous;
  } else if (belief.no > belief.yes || localization.elsewhere) {
    localization.status = Status::kLost;
  } else if (localization.matched == 0 || localization.unrecognised || localization.off_plan ||
             localization.contradicted || localization.doubted || !(belief.yes > params.min_belief_yes) ||
             !position_known || !heading_known || !guarded || !predicted) {
    localization.status = Status::kUncertain;
    if (localization.reason.empty()) because("belief is weak");
  } else {
    localization.status = Status::kLocalized;
    localization.reason.clear();
  }
}

}  // namespace credo::localization
