// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_hypotheses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/localization/places.hpp"

namespace credo::localization {
namespace {

using geometry::Pose2;
using geometry::PoseEstimate;
using test::driven;
using test::scanned_with_walls;

bool is_near(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < 0.1 &&
         std::abs(geometry::angle_difference(a.theta, b.theta)) < 0.05;
}

/// A robot in a building that does not know where it is.
class Robot {
 public:
  Robot(const geometry::FloorPlan& plan, const Pose2& start) : map_(plan), at_(start) {
    hypotheses_.start(scanned_with_walls(map_, at_));
  }

  /// Drives straight on, in steps of 0.3 m, or on the spot.
  void drive(int steps, double turn = 0.0, double step_m = 0.3) {
    for (int i = 0; i < steps; ++i) {
      const Pose2 step{step_m, 0.0, turn};
      at_ = at_ * step;
      hypotheses_.update(scanned_with_walls(map_, at_), driven(step));
    }
  }
  /// Carried away without noticing.
  void carry_to(const Pose2& pose) {
    at_ = pose;
    hypotheses_.update(scanned_with_walls(map_, at_), driven({}));
  }
  [[nodiscard]] bool holds(const Pose2& pose) const {
    const auto all = hypotheses_.hypotheses();
    return std::any_of(all.begin(), all.end(), [&](const Hypothesis& h) { return is_near(h.pose, pose); });
  }
  [[nodiscard]] const PoseHypotheses& hypotheses() const { return hypotheses_; }
  [[nodiscard]] PoseHypotheses& hypotheses() { return hypotheses_; }
  [[nodiscard]] const Pose2& at() const { return at_; }
  [[nodiscard]] perception::Scene scene() const { return scanned_with_walls(map_, at_); }

 private:
  LandmarkMap map_;
  GlobalSearch search_{map_, test::rig_with_range()};
  PoseHypotheses hypotheses_{search_};
  Pose2 at_;
};

TEST(PoseHypotheses, NothingIsHeldBeforeTheFirstScene) {
  const LandmarkMap map(test::odd_room());
  GlobalSearch search(map, test::rig_with_range());
  const PoseHypotheses hypotheses(search);
  EXPECT_TRUE(hypotheses.empty());
  EXPECT_TRUE(hypotheses.hypotheses().empty());
  EXPECT_FALSE(hypotheses.best());
  EXPECT_FALSE(hypotheses.resolved());
  EXPECT_EQ(hypotheses.belief_in_none(), 0.0);
  EXPECT_EQ(hypotheses.plausibility_of_none(), 1.0);
}

TEST(PoseHypotheses, APoseIsResolvedOnlyAfterSomeWay) {
  Robot robot(test::odd_room(), {1.5, 1.0, 0.3});
  EXPECT_FALSE(robot.hypotheses().resolved());
  robot.drive(5, 0.0, 0.0);
  EXPECT_FALSE(robot.hypotheses().resolved());
  robot.drive(4);
  ASSERT_TRUE(robot.hypotheses().resolved());
  EXPECT_TRUE(is_near(robot.hypotheses().resolved()->pose, robot.at()));
  EXPECT_GT(robot.hypotheses().hypotheses().front().belief, 0.99);
}

TEST(PoseHypotheses, InASymmetricRoomBothPosesStayAndNoneIsBelieved) {
  Robot robot(test::plain_room(), {1.2, 1.2, 0.2});
  robot.drive(10, 0.05);
  EXPECT_FALSE(robot.hypotheses().resolved());
  EXPECT_TRUE(robot.holds(robot.at()));
  EXPECT_TRUE(robot.holds({6.0 - robot.at().x, 4.0 - robot.at().y, robot.at().theta + std::numbers::pi}));
  EXPECT_LT(robot.hypotheses().hypotheses().front().belief, 0.1);
}

TEST(PoseHypotheses, ARoomThatRepeatsIsToldByTheWayOutOfIt) {
  // Two equal bays along a corridor, whose far end differs.
  Robot robot(test::outline({{0, 0},
                             {16, 0},
                             {16, 3},
                             {14.5, 3},
                             {14.5, 2},
                             {11, 2},
                             {11, 5},
                             {8, 5},
                             {8, 2},
                             {5, 2},
                             {5, 5},
                             {2, 5},
                             {2, 2},
                             {0, 2}}),
              {9.5, 3.6, -1.57});
  robot.drive(2, 0.0, 0.1);
  EXPECT_TRUE(robot.holds(robot.at()));
  robot.drive(7);
  robot.drive(3, std::numbers::pi / 6.0, 0.0);
  robot.drive(8);
  ASSERT_TRUE(robot.hypotheses().resolved());
  EXPECT_TRUE(is_near(robot.hypotheses().resolved()->pose, robot.at()));
}

TEST(PoseHypotheses, BeliefAndPlausibilityAreConsonant) {
  Robot robot(test::plain_room(), {1.2, 1.2, 0.2});
  robot.drive(3);
  const auto all = robot.hypotheses().hypotheses();
  ASSERT_FALSE(all.empty());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_LE(all[i].belief, all[i].plausibility);
    if (i == 0) continue;
    EXPECT_LE(all[i].plausibility, all[i - 1].plausibility);
    EXPECT_EQ(all[i].belief, 0.0);
  }
  EXPECT_DOUBLE_EQ(std::max(all.front().plausibility, robot.hypotheses().plausibility_of_none()), 1.0);
}

TEST(PoseHypotheses, WhoIsCarriedAwayIsFoundAgain) {
  Robot robot(test::odd_room(), {1.5, 1.0, 0.3});
  robot.drive(5);
  ASSERT_TRUE(robot.hypotheses().resolved());
  robot.carry_to({6.8, 4.2, -2.4});
  robot.drive(1);
  EXPECT_FALSE(robot.hypotheses().resolved());
  robot.drive(7);
  ASSERT_TRUE(robot.hypotheses().resolved());
  EXPECT_TRUE(is_near(robot.hypotheses().resolved()->pose, robot.at()));
}

TEST(PoseHypotheses, OffThePlanNoneIsBelieved) {
  const LandmarkMap elsewhere(test::outline({{0, 0}, {2.2, 0.4}, {3.1, 2.4}, {1.7, 4.1}, {-1.5, 2.9}}));
  const LandmarkMap map(test::odd_room());
  GlobalSearch search(map, test::rig_with_range());
  PoseHypotheses hypotheses(search);
  Pose2 at{0.6, 1.4, 0.2};
  hypotheses.start(test::scanned(elsewhere, at));
  for (int i = 0; i < 8; ++i) {
    at = at * Pose2{0.15, 0.0, 0.2};
    hypotheses.update(test::scanned(elsewhere, at), driven({0.15, 0.0, 0.2}));
    EXPECT_FALSE(hypotheses.resolved());
  }
}

TEST(PoseHypotheses, ABlindSceneMovesThePosesAndSaysNothing) {
  Robot robot(test::odd_room(), {1.5, 1.0, 0.3});
  robot.drive(5);
  const PoseEstimate before = *robot.hypotheses().best();
  const double none = robot.hypotheses().plausibility_of_none();
  robot.hypotheses().update({}, driven({0.3, 0.0, 0.0}));
  EXPECT_TRUE(is_near(robot.hypotheses().best()->pose, before.pose * Pose2{0.3, 0.0, 0.0}));
  EXPECT_GT(robot.hypotheses().best()->covariance.trace(), before.covariance.trace());
  EXPECT_EQ(robot.hypotheses().plausibility_of_none(), none);
}

TEST(PoseHypotheses, ATrackedPoseThatIsHeldAlreadyIsNotHeldTwice) {
  Robot robot(test::odd_room(), {1.5, 1.0, 0.3});
  const std::size_t before = robot.hypotheses().hypotheses().size();
  robot.hypotheses().add(robot.scene(), {robot.at(), Eigen::Vector3d(1e-3, 1e-3, 1e-4).asDiagonal()});
  EXPECT_EQ(robot.hypotheses().hypotheses().size(), before);
}

TEST(PoseHypotheses, ATrackedPoseThatIsWrongIsImplausible) {
  Robot robot(test::odd_room(), {1.5, 1.0, 0.3});
  robot.hypotheses().add(robot.scene(), {{6.5, 3.0, 2.0}, Eigen::Vector3d(1e-3, 1e-3, 1e-4).asDiagonal()});
  EXPECT_TRUE(is_near(robot.hypotheses().best()->pose, robot.at()));
}

}  // namespace
}  // namespace credo::localization
