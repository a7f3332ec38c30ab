// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/localization_belief.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tests/evidence/random_masses.hpp"
#include "tests/support/seeded.hpp"

namespace credo::localization {
namespace {

using evidence::BinaryMass;
using evidence::distance;
using perception::Method;
using perception::PrimitiveType;
using tracking::Track;
using tracking::TrackState;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// ---------------------------------------------------------------------------------------------- belief

Track track(const BinaryMass& existence, PrimitiveType type = PrimitiveType::kCorner) {
  Track result;
  result.type = type;
  result.existence = existence;
  result.landmark = 0;
  return result;
}
constexpr BinaryMass kSure{.yes = 0.8, .no = 0.0, .unknown = 0.2}, kDoubted{.yes = 0.0, .no = 0.8, .unknown = 0.2};

/// Eight of eight primitives are matched: 0.8 YES by their count, 0.8 YES by their ratio, and nothing by points.
LocalizationEvidence all_matched(const std::vector<Track>& tracks) {
  LocalizationEvidence evidence;
  evidence.matched = 8;
  evidence.detected = evidence.explained = 8.0;
  evidence.tracks = tracks;
  return evidence;
}

LocalizationBeliefParams by(Method method) {
  LocalizationBeliefParams params;
  params.method = method;
  return params;
}

TEST(LocalizationBelief, TheDefaultFusesTheMeanPartThePaperAllOfThem) {
  // A track that is doubted is -0.48 as a criterion. Conflict goes to ignorance, or is divided out.
  const std::vector<Track> one{track(kDoubted)}, two(2, track(kDoubted));
  const BinaryMass mean{.yes = 0.4992, .no = 0.0192, .unknown = 0.4816};
  EXPECT_LT(distance(localization_belief(all_matched(one)).mass, mean), 1e-12);
  EXPECT_LT(distance(localization_belief(all_matched(two)).mass, mean), 1e-12);
  EXPECT_NEAR(localization_belief(all_matched(two)).conflict, 0.4608, 1e-12);
  const LocalizationBeliefParams paper = by(Method::kPaper);
  EXPECT_NEAR(localization_belief(all_matched(one), paper).mass.yes, 0.96 * 0.52 / (1.0 - 0.96 * 0.48), 1e-12);
  EXPECT_NEAR(localization_belief(all_matched(two), paper).mass.yes, 0.96 * 0.2704 / (1.0 - 0.96 * 0.7296), 1e-12);
}

TEST(LocalizationBelief, OnlyTracksMatchedNowThatHaveALandmarkTakePart) {
  std::vector<Track> others(3, track(kDoubted));
  others[0].landmark = tracking::kNoLandmark;
  others[1].state = TrackState::kMissed;
  others[2].state = TrackState::kUndecided;
  const auto without = localization_belief(all_matched({}));
  EXPECT_EQ(localization_belief(all_matched(others)).mass, without.mass);
  others.push_back(track(kDoubted));
  EXPECT_LT(localization_belief(all_matched(others)).mass.yes, without.mass.yes - 0.01);
}

TEST(LocalizationBelief, UnderThePapersMethodEveryTrackWithALandmarkTakesPart) {
  const LocalizationBeliefParams paper = by(Method::kPaper);
  std::vector<Track> unknown{track(kDoubted)}, missed{track(kDoubted)}, seen{track(kDoubted)};
  unknown[0].landmark = tracking::kNoLandmark;
  missed[0].state = TrackState::kMissed;
  EXPECT_EQ(localization_belief(all_matched(unknown), paper).mass, localization_belief(all_matched({}), paper).mass);
  EXPECT_EQ(localization_belief(all_matched(missed), paper).mass, localization_belief(all_matched(seen), paper).mass);
  EXPECT_LT(localization_belief(all_matched(seen), paper).mass.yes, 0.95);
}

TEST(LocalizationBelief, AWallIsReliedOnLessThanAPoint) {
  for (const Method method : {Method::kDefault, Method::kPaper}) {
    const std::vector<Track> wall{track(kSure, PrimitiveType::kWall)}, edge{track(kSure, PrimitiveType::kEdge)};
    const double by_wall = localization_belief(all_matched(wall), by(method)).mass.yes;
    EXPECT_LT(by_wall, localization_belief(all_matched(edge), by(method)).mass.yes);
    EXPECT_GT(by_wall, localization_belief(all_matched({}), by(method)).mass.yes);
  }
}

TEST(LocalizationBelief, WhereNothingIsSeenOnlyTheCountSpeaks) {
  for (const Method method : {Method::kDefault, Method::kPaper})
    EXPECT_LT(distance(localization_belief({}, by(method)).mass, {.yes = 0.0, .no = 0.6, .unknown = 0.4}), 1e-12);
}

TEST(LocalizationBelief, MissedPointsCountByDefaultOnly) {
  LocalizationEvidence missed = all_matched({});
  missed.in_sight = 8;
  EXPECT_LT(localization_belief(missed).mass.yes, localization_belief(all_matched({})).mass.yes);
  EXPECT_EQ(localization_belief(missed, by(Method::kPaper)).mass,
            localization_belief(all_matched({}), by(Method::kPaper)).mass);
}

TEST(LocalizationBelief, AScanThatDoesNotLieOnThePlanSpeaksAgainstItOneThatDoesSaysNothing) {
  LocalizationEvidence scanned = all_matched({});
  const double without = localization_belief(scanned).mass.yes;
  scanned.scan_agreement = 0.95;
  EXPECT_DOUBLE_EQ(localization_belief(scanned).mass.yes, without);
  scanned.scan_agreement = 0.2;
  EXPECT_LT(localization_belief(scanned).mass.yes, 0.2 * without);
}

TEST(LocalizationBelief, TotalConflictIsIgnorance) {
  for (const Method method : {Method::kDefault, Method::kPaper}) {
    LocalizationBeliefParams params = by(method);
    params.count.max_yes = params.other_reliability = 1.0;
    const std::vector<Track> denied{track({.yes = 0.0, .no = 1.0, .unknown = 0.0})};
    const auto belief = localization_belief(all_matched(denied), params);
    EXPECT_LT(distance(belief.mass, BinaryMass::vacuous()), 1e-12);
    EXPECT_DOUBLE_EQ(belief.conflict, 1.0);
  }
}

RC_GTEST_PROP(LocalizationBelief, IsAMassWhateverIsSeen, (const std::vector<BinaryMass>& existences, bool paper)) {
  std::vector<Track> tracks;
  for (const BinaryMass& existence : existences) tracks.push_back(track(existence));
  LocalizationEvidence seen;
  seen.detected = *rc::gen::inRange(0, 20);
  seen.matched = *rc::gen::inRange(0, static_cast<int>(seen.detected) + 1);
  seen.explained = seen.matched;
  seen.in_sight = *rc::gen::inRange(0, 10);
  seen.recognised = *rc::gen::inRange(0, seen.in_sight + 1);
  seen.tracks = tracks;
  const auto belief = localization_belief(seen, by(paper ? Method::kPaper : Method::kDefault));
  RC_ASSERT(std::abs(evidence::total(belief.mass) - 1.0) < 1e-9);
  RC_ASSERT(std::min({belief.mass.yes, belief.mass.no, belief.mass.unknown, belief.conflict}) >= 0.0);
}

// ---------------------------------------------------------------------------------------------- status

/// Everything that judge() looks at, as it should be.
struct Judged {
  Localization localization;
  bool camera_seen = true;
  bool range_finder_seen = true;

  Judged() {
    localization.belief = {.yes = 0.8, .no = 0.05, .unknown = 0.15};
    localization.innovation = 2.0;
    localization.detected = 10;
    localization.matched = 8;
    covariance().diagonal() << 1e-4, 1e-4, 1e-4;
  }
  Eigen::Matrix3d& covariance() { return localization.estimate.covariance; }
  void judge() { localization::judge(localization, camera_seen, range_finder_seen); }
};

struct Case {
  const char* name;
  std::function<void(Judged&)> change;
  Status status;
  const char* reason;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

void weaken(Judged& j) { j.localization.belief = {.yes = 0.5, .no = 0.0, .unknown = 0.5}; }
void deny(Judged& j) { j.localization.belief = {.yes = 0.1, .no = 0.7, .unknown = 0.2}; }

class Judgement : public ::testing::TestWithParam<Case> {};

TEST_P(Judgement, GivesStatusAndReason) {
  Judged judged;
  judged.localization.reason = "of the time before";
  GetParam().change(judged);
  judged.judge();
  EXPECT_EQ(to_string(judged.localization.status), std::string(to_string(GetParam().status)));
  EXPECT_EQ(judged.localization.reason, GetParam().reason);
}

constexpr Status kLocalized = Status::kLocalized, kUncertain = Status::kUncertain, kLost = Status::kLost;
const std::vector<Case> kCases{
    {"AllIsWell", [](Judged&) {}, kLocalized, ""},
    {"DarkButSure", [](Judged& j) { j.camera_seen = false; }, kLocalized, ""},
    {"FewButSure", [](Judged& j) { j.localization.matched = 1; }, kLocalized, ""},
    {"Weak", weaken, kUncertain, "belief is weak"},
    {"Dark", [](Judged& j) { weaken(j), j.camera_seen = false; }, kUncertain, "camera dark or missing"},
    {"NoScan", [](Judged& j) { weaken(j), j.range_finder_seen = false; }, kUncertain, "range finder missing"},
    {"ALandmarkMayBeWrong", [](Judged& j) { j.localization.protection.position_high_m = 2.0; }, kUncertain,
     "if one of few landmarks is wrong, so is the pose"},
    {"ALandmarkMayBeWrongInHeading",
     [](Judged& j) { j.localization.protection.heading_high_rad = std::numeric_limits<double>::infinity(); },
     kUncertain, "if one of few landmarks is wrong, so is the pose"},
    {"Few", [](Judged& j) { weaken(j), j.localization.matched = 2; }, kUncertain, "few landmarks"},
    {"NothingSeen", [](Judged& j) { j.localization.detected = j.localization.matched = 0; }, kUncertain,
     "nothing is seen: the pose is predicted"},
    {"NothingMatched", [](Judged& j) { j.localization.matched = 0; }, kUncertain,
     "nothing matches the plan: the pose is predicted"},
    {"Denied", deny, kLost, "more speaks against the pose than for it"},
    {"UnsureAlongADiagonal", [](Judged& j) { j.covariance().topLeftCorner<2, 2>() << 0.01, 0.01, 0.01, 0.01; },
     kUncertain, "position too uncertain"},
    {"UnsureHeading", [](Judged& j) { j.covariance()(2, 2) = 0.0025; }, kUncertain, "heading too uncertain"},
    {"Contradicted", [](Judged& j) { j.localization.innovation = 30.0; }, kUncertain,
     "the pose contradicts its prediction"},
    {"Unrecognised", [](Judged& j) { j.localization.unrecognised = true; }, kUncertain,
     "landmarks that should be in sight are not seen"},
    {"BrokenOff", [](Judged& j) { j.localization.broken_off = true; }, kUncertain,
     "what was followed is not seen any more"},
    {"Inconsistent", [](Judged& j) { j.localization.inconsistent = true; }, kUncertain,
     "landmarks contradict each other"},
    {"OffPlan", [](Judged& j) { j.localization.off_plan = true; }, kUncertain, "the scan does not lie on the plan"},
    {"DeniedInTheDark", [](Judged& j) { deny(j), j.camera_seen = false; }, kLost,
     "camera dark or missing; more speaks against the pose than for it"},
    {"PositionNotANumber", [](Judged& j) { j.covariance()(0, 1) = j.covariance()(1, 0) = kNan; }, kUncertain,
     "position too uncertain"},
    {"HeadingNotANumber", [](Judged& j) { j.covariance()(2, 2) = kNan; }, kUncertain, "heading too uncertain"},
    {"InnovationNotANumber", [](Judged& j) { j.localization.innovation = kNan; }, kUncertain,
     "the pose contradicts its prediction"},
    {"BeliefNotANumber",
     [](Judged& j) {
       j.localization.belief = {kNan, kNan, kNan};
     },
     kUncertain, "belief is weak"}};
INSTANTIATE_TEST_SUITE_P(Cases, Judgement, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

/// A localization as good or bad as random shares of what judge() bears.
Judged random_judged() {
  const auto share = [] { return *rc::gen::inRange(0, 6) / 4.0; };  // 0 .. 1.25 times the limit
  Judged judged;
  const StatusParams limits;
  judged.localization.belief = *rc::gen::arbitrary<BinaryMass>();
  judged.localization.innovation = share() * limits.max_innovation;
  judged.localization.matched = *rc::gen::inRange(0, 6);
  judged.localization.detected = judged.localization.matched + *rc::gen::inRange(0, 3);
  judged.covariance().setZero();
  judged.covariance()(0, 0) = std::pow(share() * limits.max_position_sigma_m, 2);
  judged.covariance()(2, 2) = std::pow(share() * limits.max_heading_sigma_rad, 2);
  judged.camera_seen = *rc::gen::arbitrary<bool>();
  return judged;
}

RC_GTEST_PROP(Judge, IsLocalizedWhereThereIsNoReasonAndOnlyThere, ()) {
  Judged judged = random_judged();
  judged.judge();
  RC_CLASSIFY(judged.localization.status == kLocalized, "localized");
  RC_ASSERT((judged.localization.status == kLocalized) == judged.localization.reason.empty());
}

RC_GTEST_PROP(Judge, WhatIsWorseNeverLooksBetter, ()) {
  Judged judged = random_judged(), worse = judged;
  worse.covariance() *= 1.0 + *rc::gen::inRange(0, 4);
  worse.localization.innovation *= 1.0 + *rc::gen::inRange(0, 4);
  const double moved = 0.25 * *rc::gen::inRange(0, 5) * judged.localization.belief.yes;
  worse.localization.belief.yes -= moved;
  worse.localization.belief.no += moved;
  judged.judge(), worse.judge();
  RC_ASSERT(worse.localization.status >= judged.localization.status);
}

}  // namespace
}  // namespace credo::localization
