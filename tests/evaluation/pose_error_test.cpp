// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/pose_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace credo::evaluation {
namespace {

using geometry::Pose2;
constexpr double kPi = std::numbers::pi;

Trajectory trajectory(std::string name, const std::vector<Pose2>& poses) {
  Trajectory result{.name = std::move(name)};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    result.poses.push_back(lift(static_cast<sensors::Timestamp>(i) * 1'000'000'000, poses[i]));
  }
  return result;
}

AssociatedPair fixture() {
  return associate(
      trajectory("ref", {{0, 0, 0}, {1, 0, 0}, {2, 0, kPi / 2}, {2, 1, kPi / 2}, {2, 2, kPi}}),
      trajectory(
          "est",
          {{0.1, 0, 0}, {1.1, 0.1, 0.02}, {2.0, 0.1, kPi / 2 - 0.05}, {2.1, 1.0, kPi / 2}, {2.1, 2.2, kPi - 0.1}}));
}

void expect_statistics(const Statistics& s, const std::array<double, 7>& golden) {
  const std::array<double, 7> ours{s.max, s.mean, s.median, s.min, s.rmse, s.sse, s.std};
  for (std::size_t i = 0; i < golden.size(); ++i) EXPECT_NEAR(ours[i], golden[i], 6e-7) << "statistic " << i;
}

// Golden values: evo v1.36.5 on the same five poses; max, mean, median, min, rmse, sse, std.
TEST(Ape, AgreesWithEvoOnTranslations) {
  expect_statistics(absolute_pose_error(fixture(), PoseRelation::kTranslationPart).statistics,
                    {0.223607, 0.133006, 0.100000, 0.100000, 0.141421, 0.100000, 0.048057});
}

TEST(Ape, AgreesWithEvoOnAngles) {
  expect_statistics(absolute_pose_error(fixture(), PoseRelation::kAngleDegrees).statistics,
                    {5.729578, 1.948057, 1.145916, 0.000000, 2.910265, 42.348202, 2.162109});
}

TEST(Ape, AgreesWithEvoAfterUmeyamaAlignment) {
  AssociatedPair pair = fixture();
  const Alignment fit = align(pair, {.align = true});
  EXPECT_NEAR(fit.rotation(0, 0), 0.99992427, 1e-8);
  EXPECT_NEAR(fit.rotation(0, 1), 0.01230676, 1e-8);
  EXPECT_NEAR(fit.translation.x(), -0.08825652, 1e-8);
  EXPECT_NEAR(fit.translation.y(), -0.0617345, 1e-7);
  expect_statistics(absolute_pose_error(pair, PoseRelation::kTranslationPart).statistics,
                    {0.118725, 0.077949, 0.088239, 0.027880, 0.083684, 0.035015, 0.030447});
}

TEST(Ape, AgreesWithEvoAfterOriginAlignment) {
  AssociatedPair pair = fixture();
  align(pair, {.align_origin = true});
  expect_statistics(absolute_pose_error(pair, PoseRelation::kTranslationPart).statistics,
                    {0.200000, 0.088284, 0.100000, 0.000000, 0.118322, 0.070000, 0.078777});
}

TEST(Rpe, AgreesWithEvoOnTranslationsPerFrame) {
  expect_statistics(relative_pose_error(fixture(), {}).statistics,
                    {0.200000, 0.128120, 0.106240, 0.100000, 0.134735, 0.072614, 0.041697});
}

TEST(Rpe, AgreesWithEvoOnAnglesPerFrame) {
  expect_statistics(relative_pose_error(fixture(), {.relation = PoseRelation::kAngleDegrees}).statistics,
                    {5.729578, 3.437747, 3.437747, 1.145916, 3.822105, 58.433953, 1.670445});
}

TEST(Rpe, AgreesWithEvoOnAllPairsOfTheReferenceTwoMetresApart) {
  expect_statistics(
      relative_pose_error(fixture(),
                          {.delta = 2.0, .unit = DeltaUnit::kMetres, .all_pairs = true, .pairs_from_reference = true})
          .statistics,
      {0.141421, 0.121803, 0.121490, 0.102499, 0.122836, 0.045266, 0.015891});
}

TEST(Rpe, PicksPairsAsEvoDoes) {
  const auto line = trajectory("line", {{0, 0, 0}, {1, 0, 0.3}, {2, 0, 0.6}, {3, 0, 0.9}, {4, 0, 1.2}});
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  EXPECT_EQ(pairs_at(line.poses, {.delta = 2}), (Pairs{{0, 2}, {2, 4}}));
  EXPECT_EQ(pairs_at(line.poses, {.delta = 2, .all_pairs = true}), (Pairs{{0, 2}, {1, 3}, {2, 4}}));
  // Along the path: the first pair starts where the path is delta long for the first time.
  EXPECT_EQ(pairs_at(line.poses, {.delta = 1.5, .unit = DeltaUnit::kMetres}), (Pairs{{2, 4}}));
  EXPECT_EQ(pairs_at(line.poses, {.delta = 0.5, .unit = DeltaUnit::kRadians}), (Pairs{{0, 2}, {2, 4}}));
  EXPECT_EQ(pairs_at(line.poses, {.delta = geometry::to_degrees(0.6), .unit = DeltaUnit::kDegrees, .all_pairs = true}),
            (Pairs{{0, 2}, {1, 3}, {2, 4}}));
}

TEST(Rpe, SaysWhatToDoWhenNoPairIsFarEnoughApart) {
  EXPECT_THAT([] { (void)relative_pose_error(fixture(), {.delta = 100.0, .unit = DeltaUnit::kMetres}); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("smaller --delta")));
  EXPECT_THROW((void)relative_pose_error(fixture(), {.delta = 1.5}), std::runtime_error);
  for (const double delta : {std::nan(""), 0.0, -1.0, 1e300, 1e7}) {
    EXPECT_THROW((void)relative_pose_error(fixture(), {.delta = delta}), std::runtime_error) << delta;
  }
}

TEST(Block, IsEvosToTheByte) {
  EXPECT_EQ(to_text(absolute_pose_error(fixture(), PoseRelation::kTranslationPart), {}),
            "APE w.r.t. translation part (m)\n(not aligned)\n\n"
            "       max\t0.223607\n      mean\t0.133006\n    median\t0.100000\n       min\t0.100000\n"
            "      rmse\t0.141421\n       sse\t0.100000\n       std\t0.048057\n");
  EXPECT_EQ(relative_pose_error(fixture(), {.delta = 2.0, .unit = DeltaUnit::kMetres, .all_pairs = true}).title,
            "RPE w.r.t. translation part (m)\nfor delta = 2.0 (m) using all pairs");
  EXPECT_EQ(relative_pose_error(fixture(), {.relation = PoseRelation::kFull}).title,
            "RPE w.r.t. full transformation (unit-less)\nfor delta = 1 (frames) using consecutive pairs");
}

TEST(Block, NamesTheAlignment) {
  EXPECT_EQ(describe({}), "(not aligned)");
  EXPECT_EQ(describe({.align = true}), "(with SE(3) Umeyama alignment)");
  EXPECT_EQ(describe({.align = true, .correct_scale = true}), "(with Sim(3) Umeyama alignment)");
  EXPECT_EQ(describe({.correct_scale = true}), "(scale corrected)");
  EXPECT_EQ(describe({.align_origin = true}), "(with origin alignment)");
  EXPECT_EQ(describe({.align = true, .n_to_align = 7}), "(with SE(3) Umeyama alignment) (aligned poses: 7)");
}

TEST(Statistics, AreThoseOfThePopulation) {
  const std::array<double, 4> errors{1.0, 2.0, 3.0, 6.0};
  expect_statistics(statistics(errors), {6.0, 3.0, 2.5, 1.0, std::sqrt(12.5), 50.0, std::sqrt(3.5)});
  EXPECT_THROW((void)statistics({}), std::invalid_argument);
}

TEST(Umeyama, RefusesAStraightLine) {
  AssociatedPair pair =
      associate(trajectory("a", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), trajectory("b", {{0, 1, 0}, {1, 1, 0}, {2, 1, 0}}));
  EXPECT_THAT([&] { align(pair, {.align = true}); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("straight line")));
}

/// Full-range values whatever RapidCheck's size: a degenerate geometry is another test.
class Random {
 public:
  Random() : engine_(*rc::gen::arbitrary<std::uint32_t>()) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }

 private:
  std::mt19937 engine_;
};

Trajectory random_trajectory(Random& uniform, bool planar) {
  Trajectory result{.name = "random"};
  for (int i = 0; i < 12; ++i) {
    StampedPose pose = lift(i * 100'000'000, {uniform(-5, 5), uniform(-5, 5), uniform(-3, 3)});
    if (!planar) pose.position.z() = uniform(-2, 2);
    result.poses.push_back(pose);
  }
  return result;
}

RC_GTEST_PROP(Umeyama, RemovesExactlyTheTransformThatWasApplied, ()) {
  Random uniform;
  const bool planar = *rc::gen::arbitrary<bool>();
  const Trajectory reference = random_trajectory(uniform, planar);
  const double scale = uniform(0.5, 2.0), angle = uniform(-kPi, kPi);
  const StampedPose moved = lift(0, {uniform(-9, 9), uniform(-9, 9), angle});
  Trajectory estimate = reference;
  for (StampedPose& pose : estimate.poses) {
    pose.position = scale * moved.rotation * pose.position + moved.position;
    pose.rotation = moved.rotation * pose.rotation;
  }
  AssociatedPair pair = associate(reference, estimate);
  const Alignment fit = align(pair, {.align = true, .correct_scale = true});
  RC_ASSERT(std::abs(fit.scale * scale - 1.0) < 1e-9);
  RC_ASSERT(absolute_pose_error(pair, PoseRelation::kFull).statistics.max < 1e-8);
}

RC_GTEST_PROP(Rpe, DoesNotSeeARigidMotionOfTheEstimate, ()) {
  Random uniform;
  const Trajectory reference = random_trajectory(uniform, true), estimate = random_trajectory(uniform, true);
  AssociatedPair pair = associate(reference, estimate);
  const auto before = relative_pose_error(pair, {.relation = PoseRelation::kFull});
  const StampedPose moved = lift(0, {uniform(-9, 9), uniform(-9, 9), uniform(-kPi, kPi)});
  for (StampedPose& pose : pair.estimate.poses) {
    pose.position = moved.rotation * pose.position + moved.position;
    pose.rotation = moved.rotation * pose.rotation;
  }
  const auto after = relative_pose_error(pair, {.relation = PoseRelation::kFull});
  for (std::size_t i = 0; i < before.errors.size(); ++i) RC_ASSERT(std::abs(before.errors[i] - after.errors[i]) < 1e-9);
}

TEST(RotationAngle, IsExactForTinyAndForHalfTurns) {
  for (const double angle : {0.0, 1e-9, 1e-3, 1.0, 3.0, kPi - 1e-7, kPi}) {
    EXPECT_NEAR(rotation_angle(lift(0, {0, 0, angle}).rotation), angle, 1e-15 + 1e-12 * angle);
  }
}

}  // namespace
}  // namespace credo::evaluation
