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

namespace {

/// Which limits of StatusParams the localization keeps. Written so that what is not a number fails.
struct Limits {
  Limits(const Localization& localization, const StatusParams& params) {
    const Eigen::Matrix3d& P = localization.estimate.covariance;
    const ProtectionLevels& levels = localization.protection;
    position_known = std::sqrt(geometry::largest_variance(P.topLeftCorner<2, 2>())) <= params.max_position_sigma_m;
    heading_known = std::sqrt(P(2, 2)) <= params.max_heading_sigma_rad;
    // No monitor has looked where a level is not a number.
    guarded =
        !(levels.position_high_m > params.max_protection_m) && !(levels.heading_high_rad > params.max_protection_rad);
    as_predicted = localization.innovation <= params.max_innovation;
    believed = localization.belief.yes > params.min_belief_yes;
  }
  [[nodiscard]] bool all_kept() const { return position_known && heading_known && guarded && as_predicted && believed; }

  bool position_known, heading_known, guarded, as_predicted, believed;
};

const char* too_little_seen(const Localization& localization) {
  if (localization.detected == 0) return "nothing is seen: the pose is predicted";
  if (localization.matched == 0) return "nothing matches the plan: the pose is predicted";
  return localization.matched < 3 ? "few landmarks" : nullptr;
}

/// All that speaks against the pose or for caution, joined by "; ".
std::string reasons(const Localization& localization, const Limits& limits, bool camera_seen, bool range_finder_seen) {
  std::string text;
  const auto say = [&text](bool holds, const char* words) {
    if (!holds) return;
    if (!text.empty()) text += "; ";
    text += words;
  };
  say(!camera_seen, "camera dark or missing");
  say(!range_finder_seen, "range finder missing");
  if (const char* words = too_little_seen(localization)) say(true, words);
  say(localization.belief.no > localization.belief.yes, "more speaks against the pose than for it");
  say(localization.unrecognised, "landmarks that should be in sight are not seen");
  say(localization.off_plan, "the scan does not lie on the plan");
  say(localization.inconsistent, "landmarks contradict each other");
  say(localization.contradicted, "camera, range finder and wheels contradict each other");
  say(localization.broken_off, "what was followed is not seen any more");
  say(localization.doubted && !is_contested(localization), "just doubted, and not confirmed yet");
  say(localization.elsewhere, "another pose fits far better");
  say(!limits.position_known, "position too uncertain");
  say(!limits.heading_known, "heading too uncertain");
  say(!limits.guarded, "if one of few landmarks is wrong, so is the pose");
  say(!limits.as_predicted, "the pose contradicts its prediction");
  say(localization.hypotheses.size() > 1, "several poses fit: a place that looks like others");
  return text;
}

}  // namespace

void judge(Localization& localization, bool camera_seen, bool range_finder_seen, const StatusParams& params) {
  const Limits limits(localization, params);
  localization.reason = reasons(localization, limits, camera_seen, range_finder_seen);
  if (localization.hypotheses.size() > 1) {
    localization.status = Status::kAmbiguous;
  } else if (localization.belief.no > localization.belief.yes || localization.elsewhere) {
    localization.status = Status::kLost;
  } else if (localization.matched == 0 || is_contested(localization) || localization.doubted || !limits.all_kept()) {
    localization.status = Status::kUncertain;
    if (localization.reason.empty()) localization.reason = "belief is weak";
  } else {
    localization.status = Status::kLocalized;
    localization.reason.clear();
  }
}

}  // namespace credo::localization
