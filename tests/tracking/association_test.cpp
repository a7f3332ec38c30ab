// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/association.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "tests/support/seeded.hpp"
#include "tests/tracking/scenes.hpp"

namespace credo::tracking {
namespace {

using namespace test;  // NOLINT: the helpers of these tests
using evidence::MatchDecision;
using perception::Method;

constexpr auto kMatched = MatchDecision::kMatched;
constexpr auto kNone = MatchDecision::kNone;
constexpr auto kUndecided = MatchDecision::kUndecided;
constexpr Method kBoth[] = {Method::kDefault, Method::kPaper};

/// The outcomes where each of `before` is a track that is expected where it was seen.
struct Association {
  Associator associator;
  std::vector<Outcome> outcomes;

  Association(const std::vector<Primitive>& before, const Scene& now, Method method,
              const AssociationParams& params = {}) {
    const PredictionParams prediction;
    std::vector<Memory> memories(before.size());
    std::vector<Expected> tracks;
    for (std::size_t k = 0; k < before.size(); ++k) {
      observe(memories[k], before[k], scene({}), 0, true, prediction);
      tracks.push_back({.type = before[k].type, .polarity = 0, .prediction = &memories[k].now});
    }
    outcomes = associator.associate(tracks, now, method, params, prediction);
  }
  Association(const std::vector<Primitive>& before, const std::vector<Primitive>& now, Method method,
              const AssociationParams& params = {})
      : Association(before, scene(now), method, params) {}

  [[nodiscard]] const Outcome& only() const { return outcomes.at(0); }
};

// ---------------------------------------------------------------------------------------------- points

TEST(Association, ATrackIsGivenWhatIsSeenWhereItIsExpected) {
  for (const Method method : kBoth) {
    for (const double azimuth : {20.0, 179.8}) {
      const Association seen({at(kEdge, azimuth)}, {at(kEdge, azimuth + 120.0), at(kEdge, azimuth + 0.4)}, method);
      EXPECT_EQ(seen.only().kind, kMatched);
      EXPECT_EQ(seen.only().primitive, 1);
      EXPECT_GT(seen.only().match_yes, 0.5);
      EXPECT_LE(seen.only().match_yes, 1.0);
    }
  }
}

TEST(Association, ATrackIsGivenNothingWhereNothingIsNear) {
  for (const Method method : kBoth) {
    for (const auto& now : {std::vector<Primitive>{}, {at(kEdge, 80.0)}}) {
      const Association seen({at(kEdge, 20.0)}, now, method);
      EXPECT_EQ(seen.only().kind, kNone);
      EXPECT_EQ(seen.only().primitive, -1);
      EXPECT_EQ(seen.only().match_yes, 0.0);
    }
    EXPECT_TRUE(Association({}, {at(kEdge, 20.0)}, method).outcomes.empty());
  }
}

TEST(Association, OfTwoTracksTheNearerHasThePrimitive) {
  for (const Method method : kBoth) {
    const Association seen({at(kEdge, 20.0), at(kEdge, 22.0)}, {at(kEdge, 21.8)}, method);
    EXPECT_EQ(seen.outcomes.at(0).kind, kNone);
    EXPECT_EQ(seen.outcomes.at(1).kind, kMatched);
    EXPECT_EQ(seen.outcomes.at(1).primitive, 0);
  }
}

TEST(Association, TheRangeTellsByDefaultWhereTheAzimuthDoesNot) {
  const std::vector<Primitive> before{at(kEdge, 20.0, 2.0)}, now{at(kEdge, 20.0, 4.0), at(kEdge, 20.1, 2.0)};
  EXPECT_EQ(Association(before, now, Method::kDefault).only().primitive, 1);
  EXPECT_EQ(Association(before, now, Method::kPaper).only().primitive, 0) << "the paper looks at azimuths alone";
}

TEST(Association, AnotherTypeIsLessAMatchAndNoneForThePaper) {
  const std::vector<Primitive> before{at(kEdge, 20.0)};
  const Association same(before, {at(kEdge, 20.1)}, Method::kDefault);
  const Association other(before, {at(kCorner, 20.1)}, Method::kDefault);
  EXPECT_EQ(other.only().kind, kMatched);
  EXPECT_LT(other.only().match_yes, same.only().match_yes - 0.05);
  EXPECT_EQ(Association(before, {at(kCorner, 20.1)}, Method::kPaper).only().kind, kNone);
  for (const Method method : kBoth) {
    EXPECT_EQ(
        Association(before, {wall(3.0 * std::cos(20.0 * kDegree), -1.0, 3.0 * std::cos(20.0 * kDegree), 3.0)}, method)
            .only()
            .kind,
        kNone)
        << "a point is never a wall";
  }
}

TEST(Association, BetweenEqualPrimitivesTheDefaultIsUndecidedAndClaimsThemBoth) {
  const std::vector<Primitive> before{at(kEdge, 20.0)};
  const std::vector<Primitive> now{at(kEdge, 19.7), at(kEdge, 20.3), at(kEdge, 60.0)};
  const Association seen(before, now, Method::kDefault);
  EXPECT_EQ(seen.only().kind, kUndecided);
  EXPECT_TRUE(seen.associator.claimed_by(0, 0));
  EXPECT_TRUE(seen.associator.claimed_by(0, 1));
  EXPECT_FALSE(seen.associator.claimed_by(0, 2));
  EXPECT_EQ(Association(before, now, Method::kPaper).only().kind, kMatched) << "which takes the first";
  AssociationParams eager;
  eager.min_margin = 0.0;
  EXPECT_EQ(Association(before, now, Method::kDefault, eager).only().kind, kMatched) << "it was for the margin";
}

TEST(Association, APrimitiveThatTwoTracksClaimAlikeIsWithheldByDefault) {
  const std::vector<Primitive> before{at(kEdge, 19.7), at(kEdge, 20.3)}, now{at(kEdge, 20.0)};
  const Association seen(before, now, Method::kDefault);
  for (const Outcome& outcome : seen.outcomes) EXPECT_EQ(outcome.kind, kUndecided);
  EXPECT_EQ(seen.outcomes[0].primitive + seen.outcomes[1].primitive, -1) << "the assignment has it at one of them";
  const Association paper(before, now, Method::kPaper);
  EXPECT_NE(paper.outcomes[0].kind == kMatched, paper.outcomes[1].kind == kMatched);
}

TEST(Association, OpposedPolarityIsLessAMatch) {
  const PredictionParams prediction;
  const Primitive before = bearing(20.0);
  Memory memory;
  observe(memory, before, scene({}), 0, true, prediction);
  Primitive now = bearing(20.0);
  now.radial_line = 0;
  Scene seen = scene({now});
  seen.radial_lines.push_back({.azimuth = now.azimuth, .polarity = -1});
  Associator associator;
  const auto yes = [&](int polarity) {
    const Expected track{.type = PrimitiveType::kOther, .polarity = polarity, .prediction = &memory.now};
    return associator.associate(std::span(&track, 1), seen, Method::kDefault, {}, prediction).at(0).match_yes;
  };
  EXPECT_DOUBLE_EQ(yes(-1), yes(0));
  EXPECT_LT(yes(+1), yes(-1) - 0.05);
}

// ---------------------------------------------------------------------------------------------- walls

TEST(Association, AWallIsItsLineByDefaultAndItsMiddleForThePaper) {
  const std::vector<Primitive> before{wall(5.0, 2.0, -5.0, 2.0)};
  const std::vector<Primitive> piece{wall(5.0, 2.02, 3.0, 2.02)}, beyond{wall(5.0, 2.5, -5.0, 2.5)};
  EXPECT_EQ(Association(before, piece, Method::kDefault).only().kind, kMatched);
  EXPECT_EQ(Association(before, beyond, Method::kDefault).only().kind, kNone);
  EXPECT_EQ(Association(before, piece, Method::kPaper).only().kind, kNone);
  EXPECT_EQ(Association(before, beyond, Method::kPaper).only().kind, kMatched);
}

TEST(Association, OfParallelWallsEachTrackHasItsOwn) {
  const std::vector<Primitive> walls{wall(3.0, 1.0, -3.0, 1.0), wall(3.0, 1.3, -3.0, 1.3)};
  const std::vector<Primitive> now{wall(-3.0, 1.31, 3.0, 1.31), wall(-3.0, 1.01, 3.0, 1.01)};
  const Association seen(walls, now, Method::kDefault);
  for (int track = 0; track < 2; ++track) {
    EXPECT_EQ(seen.outcomes[static_cast<std::size_t>(track)].kind, kMatched);
    EXPECT_EQ(seen.outcomes[static_cast<std::size_t>(track)].primitive, 1 - track);
  }
}

TEST(Association, OfTwoPiecesTheLongerContinuesAWall) {
  const Association seen({wall(5.0, 2.0, -5.0, 2.0)}, {wall(5.0, 2.0, 2.0, 2.0), wall(1.0, 2.0, -5.0, 2.0)},
                         Method::kDefault);
  EXPECT_EQ(seen.only().kind, kMatched) << "pieces are no ambiguity";
  EXPECT_EQ(seen.only().primitive, 1);
  EXPECT_FALSE(seen.associator.claimed_by(0, 0)) << "the other piece is free";
}

// ---------------------------------------------------------------------------------------------- laws

struct Crowd {
  std::vector<Primitive> before, now;
};

/// Up to twelve points, seen again a little off, some of them not, in any order.
Crowd crowd(unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  Crowd result;
  for (int k = 0; k < 12; ++k) {
    const double azimuth = uniform(0.0, 60.0), range = uniform(1.0, 4.0);
    if (k % 4 != 0) result.before.push_back(at(kEdge, azimuth, range));
    if (k % 4 != 1) result.now.push_back(at(kEdge, azimuth + uniform(-0.5, 0.5), range + uniform(-0.03, 0.03)));
  }
  std::shuffle(result.now.begin(), result.now.end(), random);
  return result;
}

RC_GTEST_PROP(Association, GivesAPrimitiveToOneTrackAtMost, (unsigned seed, bool paper)) {
  const Crowd c = crowd(seed);
  std::set<int> given;
  for (const Outcome& outcome : Association(c.before, c.now, kBoth[paper ? 1 : 0]).outcomes) {
    if (outcome.kind != kMatched) continue;
    RC_ASSERT(outcome.primitive >= 0 && outcome.primitive < static_cast<int>(c.now.size()));
    RC_ASSERT(given.insert(outcome.primitive).second);
  }
  RC_CLASSIFY(given.size() >= 4, "four or more");
}

RC_GTEST_PROP(Association, DoesNotDependOnTheOrderOfWhatIsSeen, (unsigned seed, bool paper)) {
  const Crowd c = crowd(seed);
  std::vector<Primitive> reversed(c.now.rbegin(), c.now.rend());
  const Association a(c.before, c.now, kBoth[paper ? 1 : 0]), b(c.before, reversed, kBoth[paper ? 1 : 0]);
  const int last = static_cast<int>(c.now.size()) - 1;
  for (std::size_t track = 0; track < a.outcomes.size(); ++track) {
    RC_ASSERT(a.outcomes[track].kind == b.outcomes[track].kind);
    RC_ASSERT(std::abs(a.outcomes[track].match_yes - b.outcomes[track].match_yes) < 1e-9);
    if (a.outcomes[track].kind == kMatched)
      RC_ASSERT(a.outcomes[track].primitive == last - b.outcomes[track].primitive);
  }
}

}  // namespace
}  // namespace credo::tracking
