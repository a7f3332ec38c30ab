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

/// What it takes to look for poses in a building.
struct Finder {
  explicit Finder(const geometry::FloorPlan& plan) : map(plan) {}

  LandmarkMap map;
  SceneFitter fitter{map, test::rig_with_range(), {}};
  GlobalSearch search{map, fitter.scan_matcher().field(), test::rig_with_range()};
  PoseHypotheses hypotheses{search, fitter};
};

/// A robot in a building that does not know where it is.
class Robot {
 public:
  Robot(const geometry::FloorPlan& plan, const Pose2& start, const std::optional<Pose2>& tracked = {})
      : finder_(plan), at_(start) {
    if (tracked) finder_.hypotheses.add(calibrated_pose({}, {*tracked, 1e-3 * Eigen::Matrix3d::Identity()}));
    finder_.hypotheses.update(scene(), {});
  }

  void drive(int steps, double turn = 0.0, double step_m = 0.3) {
    for (int i = 0; i < steps; ++i) {
      const Pose2 step{step_m, 0.0, turn};
      at_ = at_ * step;
      finder_.hypotheses.update(scene(), driven(step));
    }
  }
  /// Turns on the spot; the wheels slip and tell `told_rad`.
  void turn(double by_rad, double told_rad) {
    at_ = at_ * Pose2{0.0, 0.0, by_rad};
    finder_.hypotheses.update(scene(), driven({0.0, 0.0, told_rad}));
  }
  /// Carried away without noticing.
  void carry_to(const Pose2& pose) {
    at_ = pose;
    finder_.hypotheses.update(scene(), driven({}));
  }
  void drive_blindly(const Pose2& step) {
    at_ = at_ * step;
    finder_.hypotheses.update({}, driven(step));
  }
  [[nodiscard]] bool holds(const Pose2& pose) const {
    const auto all = finder_.hypotheses.listed();
    return std::any_of(all.begin(), all.end(), [&](const Hypothesis& h) { return is_near(h.pose, pose); });
  }
  [[nodiscard]] bool found_itself() const {
    return finder_.hypotheses.resolved() && is_near(finder_.hypotheses.best()->pose.pose, at_);
  }
  [[nodiscard]] const PoseHypotheses& hypotheses() const { return finder_.hypotheses; }
  [[nodiscard]] const Pose2& at() const { return at_; }

 private:
  [[nodiscard]] perception::Scene scene() const { return scanned_with_walls(finder_.map, at_); }

  Finder finder_;
  Pose2 at_;
};

TEST(PoseHypotheses, NothingIsHeldBeforeTheFirstScene) {
  const Finder finder(test::odd_room());
  EXPECT_TRUE(finder.hypotheses.empty());
  EXPECT_TRUE(finder.hypotheses.listed().empty());
  EXPECT_EQ(finder.hypotheses.best(), nullptr);
  EXPECT_FALSE(finder.hypotheses.resolved());
  EXPECT_EQ(finder.hypotheses.plausibility_of_none(), 1.0);
}

TEST(PoseHypotheses, APoseIsResolvedOnlyAfterSomeWay) {
  Robot robot(test::odd_room(), {1.5, 1.0, 0.3});
  robot.drive(5, 0.0, 0.0);
  EXPECT_FALSE(robot.hypotheses().resolved());
  robot.drive(4);
  EXPECT_TRUE(robot.found_itself());
  EXPECT_GT(robot.hypotheses().listed().front().belief, 0.99);
}

TEST(PoseHypotheses, InASymmetricRoomBothPosesStayAndNoneIsBelieved) {
  Robot robot(test::plain_room(), {1.2, 1.2, 0.2});
  robot.drive(10, 0.05);
  EXPECT_FALSE(robot.hypotheses().resolved());
  EXPECT_TRUE(robot.holds(robot.at()));
  EXPECT_TRUE(robot.holds({6.0 - robot.at().x, 4.0 - robot.at().y, robot.at().theta + std::numbers::pi}));
  EXPECT_LT(robot.hypotheses().listed().front().belief, 0.1);
}

TEST(PoseHypotheses, InASymmetricRoomBothPosesStayWhereTheWheelsSlipInATurn) {
  Robot robot(test::outline({{0, 0}, {12, 0}, {12, 8}, {0, 8}}), {2.0, 3.0, 0.2});
  robot.drive(6, 0.05);
  robot.turn(-1.8, -1.65);
  for (int step = 0; step < 8; ++step) {
    robot.drive(1);
    EXPECT_FALSE(robot.hypotheses().resolved());
    EXPECT_TRUE(robot.holds(robot.at()));
    EXPECT_TRUE(robot.holds({12.0 - robot.at().x, 8.0 - robot.at().y, robot.at().theta + std::numbers::pi}));
  }
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
  EXPECT_TRUE(robot.found_itself());
}

TEST(PoseHypotheses, BeliefAndPlausibilityAreConsonant) {
  Robot robot(test::plain_room(), {1.2, 1.2, 0.2});
  robot.drive(3);
  const auto all = robot.hypotheses().listed();
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
  ASSERT_TRUE(robot.found_itself());
  robot.carry_to({6.8, 4.2, -2.4});
  robot.drive(1);
  EXPECT_FALSE(robot.hypotheses().resolved());
  robot.drive(7);
  EXPECT_TRUE(robot.found_itself());
}

TEST(PoseHypotheses, WhoIsCarriedAwayAgainDuringTheSearchIsFound) {
  Robot robot(test::odd_room(), {1.5, 1.0, 0.3});
  robot.drive(2);
  robot.carry_to({6.8, 4.2, -2.4});
  robot.drive(1);
  robot.carry_to({2.0, 3.0, -0.5});
  robot.drive(8);
  EXPECT_TRUE(robot.found_itself());
}

TEST(PoseHypotheses, OffThePlanNothingIsResolved) {
  const LandmarkMap elsewhere(test::outline({{0, 0}, {2.2, 0.4}, {3.1, 2.4}, {1.7, 4.1}, {-1.5, 2.9}}));
  Finder finder(test::odd_room());
  Pose2 at{0.6, 1.4, 0.2};
  finder.hypotheses.update(test::scanned(elsewhere, at), {});
  for (int i = 0; i < 8; ++i) {
    const Pose2 step{0.15, 0.0, 0.2};
    at = at * step;
    finder.hypotheses.update(test::scanned(elsewhere, at), driven(step));
    EXPECT_FALSE(finder.hypotheses.resolved());
  }
}

TEST(PoseHypotheses, ABlindSceneMovesThePosesAndSaysNothing) {
  Robot robot(test::odd_room(), {1.5, 1.0, 0.3});
  robot.drive(5);
  const double before = robot.hypotheses().best()->estimate().covariance.trace();
  const double none = robot.hypotheses().plausibility_of_none();
  robot.drive_blindly({0.3, 0.0, 0.0});
  EXPECT_TRUE(robot.holds(robot.at()));
  EXPECT_GT(robot.hypotheses().best()->estimate().covariance.trace(), before);
  EXPECT_EQ(robot.hypotheses().plausibility_of_none(), none);
}

TEST(PoseHypotheses, ATrackedPoseThatIsRightLeads) {
  const Pose2 start{1.5, 1.0, 0.3};
  EXPECT_EQ(Robot(test::odd_room(), start, start).hypotheses().lead_over(start), 0.0);
}

TEST(PoseHypotheses, ATrackedPoseThatIsWrongIsLeft) {
  const Pose2 wrong{6.5, 3.0, 2.0};
  Robot robot(test::odd_room(), {1.5, 1.0, 0.3}, wrong);
  EXPECT_GT(robot.hypotheses().lead_over(wrong), 2.0);
  robot.drive(4);
  EXPECT_TRUE(robot.found_itself());
}

}  // namespace
}  // namespace credo::localization
