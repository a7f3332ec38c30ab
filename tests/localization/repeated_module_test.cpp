// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/repeated_module.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/localization/places.hpp"

namespace credo::localization {
namespace {

using Eigen::Vector2d;
using geometry::FloorPlan;
using geometry::Pose2;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kModule_m = 0.9;
constexpr double kFirstDoor_m = 5.0;

/// Where a door's frame begins (side 0) or ends (side 1).
Vector2d frame(int door, int side) { return {kFirstDoor_m + kModule_m * door + 0.6 * side, 0.0}; }

/// 20 m x 2 m, with doors on one side: two marks each.
FloorPlan corridor(int doors) {
  FloorPlan plan = test::outline({{0, 0}, {20, 0}, {20, 2}, {0, 2}});
  for (int door = 0; door < doors; ++door)
    for (const int side : {0, 1}) plan.verticals.push_back(frame(door, side));
  return plan;
}

/// What a robot sees of a plan, by the places where it is.
class View {
 public:
  View(const FloorPlan& plan, const Pose2& pose, const RepeatedModuleParams& params = {})
      : map_(plan), modules_(map_, slips_, params) {
    solution_.pose.pose = pose;
  }

  View(const View&) = delete;  // the modules point to the map
  View& operator=(const View&) = delete;

  View& see_point(const Vector2d& place) {
    for (std::size_t p = 0; p < map_.points().size(); ++p)
      if ((map_.points()[p].position - place).norm() < 1e-9) see(ObservationKind::kPoint, map_.point_id(p), place);
    return *this;
  }
  View& see_wall(const Vector2d& middle) {
    for (std::size_t w = 0; w < map_.walls().size(); ++w)
      if (geometry::distance(middle, map_.walls()[w].extent) < 1e-9)
        see(ObservationKind::kWall, map_.wall_id(w), middle);
    return *this;
  }
  View& see_doors(int first, int last) {
    for (int door = first; door <= last; ++door) see_point(frame(door, 0)).see_point(frame(door, 1));
    return *this;
  }
  View& doubt_latest() {
    solution_.outlier.back() = true;
    return *this;
  }

  std::vector<Alias> aliases() {
    const std::span<const Alias> found = modules_.find(observations_, solution_);
    return {found.begin(), found.end()};
  }
  std::vector<double> distances() {
    std::vector<double> all;
    for (const Alias& alias : aliases()) all.push_back(std::round(alias.distance_m * 1e6) / 1e6);
    return all;
  }
  [[nodiscard]] const IntegrityParams& slips() const { return slips_; }

 private:
  void see(ObservationKind kind, tracking::LandmarkId landmark, const Vector2d& place) {
    Observation o;
    o.kind = kind;
    o.landmark = landmark;
    o.base_point = solution_.pose.pose.inverse() * place;
    observations_.push_back(o);
    solution_.outlier.push_back(false);
  }

  IntegrityParams slips_;
  LandmarkMap map_;
  RepeatedModules modules_;
  std::vector<Observation> observations_;
  PoseSolution solution_;
};

/// Between the walls of a corridor of eight doors, before the fourth.
View in_corridor(const FloorPlan& plan = corridor(8), const RepeatedModuleParams& params = {}) {
  return View{plan, Pose2{8.0, 1.0, 0.3}, params};
}

TEST(RepeatedModules, DoorsAlongACorridorRepeatOneAndTwoAndThreeModulesOn) {
  View view = in_corridor();
  view.see_wall({8.0, 0.0}).see_wall({7.5, 2.0}).see_doors(2, 4);
  // Two doors stand before the seen ones, three behind.
  EXPECT_THAT(view.distances(), ElementsAre(0.9, 0.9, 1.8, 1.8, 2.7));
}

TEST(RepeatedModules, WhereTheDoorsEndThereIsNoModuleToGoTo) {
  View view = in_corridor(corridor(4));
  view.see_wall({8.0, 0.0}).see_wall({7.5, 2.0}).see_doors(0, 2);
  EXPECT_THAT(view.distances(), ElementsAre(0.9)) << "backwards";
  EXPECT_THAT(in_corridor(corridor(3)).see_doors(0, 2).distances(), IsEmpty());
}

TEST(RepeatedModules, ShareOfThePointsThatAreThereAgainDecides) {
  FloorPlan plan = corridor(8);
  const Vector2d irregular(8.3, 2.0), another(7.1, 2.0);
  plan.verticals.push_back(irregular);
  plan.verticals.push_back(another);
  EXPECT_THAT(in_corridor(plan).see_doors(2, 4).see_point(irregular).distances(), ElementsAre(0.9, 0.9, 1.8, 1.8, 2.7))
      << "six of seven";
  EXPECT_THAT(in_corridor(plan).see_doors(2, 4).see_point(irregular).see_point(another).distances(), IsEmpty())
      << "six of eight";
  EXPECT_THAT(in_corridor(plan, {.least_share = 0.9}).see_doors(2, 4).see_point(irregular).distances(), IsEmpty());
}

TEST(RepeatedModules, EndWallOfTheCorridorTellsWhichDoorsTheseAre) {
  View view = in_corridor();
  view.see_wall({8.0, 0.0}).see_doors(2, 4).see_wall({20.0, 1.0});
  EXPECT_THAT(view.distances(), IsEmpty());
  EXPECT_THAT(view.doubt_latest().distances(), ElementsAre(0.9, 0.9, 1.8, 1.8, 2.7)) << "an outlier tells nothing";
}

TEST(RepeatedModules, WallReachesNoFartherThanItsEnd) {
  FloorPlan plan = corridor(8);
  plan.walls.push_back({{7.0, 1.6}, {9.0, 1.6}});  // a screen
  EXPECT_THAT(in_corridor(plan).see_doors(2, 4).see_wall({8.5, 1.6}).distances(), ElementsAre(0.9))
      << "towards its other end";
}

TEST(RepeatedModules, PiecesOfWallBetweenOpenDoorsStandForEachOther) {
  FloorPlan plan;
  for (int piece = 0; piece < 6; ++piece) plan.walls.push_back({frame(piece, 0), frame(piece, 1)});
  View view = in_corridor(plan);
  for (const int piece : {1, 2, 3}) view.see_wall(0.5 * (frame(piece, 0) + frame(piece, 1)));
  EXPECT_THAT(view.see_doors(1, 3).distances(), ElementsAre(0.9, 0.9, 1.8));
}

TEST(RepeatedModules, MarkIsNoJunctionAndEdgeNoCorner) {
  FloorPlan plan;
  for (int piece = 0; piece < 4; ++piece) plan.walls.push_back({frame(piece, 0), frame(piece, 1)});
  for (const int side : {0, 1}) plan.verticals.push_back(frame(4, side));
  EXPECT_THAT(in_corridor(plan).see_doors(1, 3).distances(), ElementsAre(0.9)) << "marks where the next piece would be";

  const std::vector<Vector2d> corners{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const auto beside_a_room = [&](const FloorPlan& other) {
    FloorPlan both = test::outline(corners);
    both.walls.insert(both.walls.end(), other.walls.begin(), other.walls.end());
    View view(both, Pose2{1, 1, 0});
    for (const Vector2d& corner : corners) view.see_point(corner);
    return view.distances();
  };
  std::vector<Vector2d> like_corners;
  FloorPlan rays;
  for (const Vector2d& corner : corners) {
    like_corners.emplace_back(corner + Vector2d(2.8, 0.0));
    rays.walls.push_back({like_corners.back(), like_corners.back() + 0.3 * (corner - Vector2d(1, 1))});
  }
  EXPECT_THAT(beside_a_room(test::outline(like_corners)), ElementsAre(2.8));
  EXPECT_THAT(beside_a_room(rays), IsEmpty()) << "ends of walls in the places of the corners";
}

TEST(RepeatedModules, UnevenModulesCountAsFarAsThePlanIsUncertain) {
  FloorPlan plan = corridor(0);
  const auto door = [](int i) { return Vector2d(kFirstDoor_m + kModule_m * i + (i % 2 == 0 ? 0.06 : 0.0), 0.0); };
  for (int i = 0; i < 10; ++i) plan.verticals.push_back(door(i));
  const auto distances = [&] {
    View view = in_corridor(plan);
    for (int i = 3; i < 7; ++i) view.see_point(door(i));
    return view.distances();
  };
  EXPECT_THAT(distances(), ElementsAre(1.8, 1.8)) << "every other one";
  plan.uncertainty_m = 0.05;
  EXPECT_THAT(distances(), ElementsAre(0.9, 0.9, 1.8, 1.8, 2.7, 2.7));
}

TEST(RepeatedModules, SingleRoomIsNowhereElse) {
  View view(test::plain_room(), Pose2{2, 1, 0.5});
  for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(6, 0), Vector2d(6, 4), Vector2d(0, 4)})
    view.see_point(corner);
  EXPECT_THAT(view.see_wall({3, 0}).see_wall({0, 2}).distances(), IsEmpty());
}

TEST(RepeatedModules, FewPointsSayNothing) {
  EXPECT_THAT(in_corridor().distances(), IsEmpty());
  EXPECT_THAT(in_corridor().see_wall({8.0, 0.0}).distances(), IsEmpty());
  View view = in_corridor();
  view.see_doors(3, 3).see_point(frame(4, 0));
  EXPECT_THAT(view.distances(), IsEmpty());
  view.see_point(frame(4, 0));
  EXPECT_THAT(view.distances(), IsEmpty()) << "the same point twice";
  EXPECT_FALSE(view.see_point(frame(4, 1)).distances().empty());
  EXPECT_THAT(View(FloorPlan{}, Pose2{}).distances(), IsEmpty());
}

TEST(RepeatedModules, ProbabilityIsThatTheWheelsHaveSlippedIntoTheCircleAboutIt) {
  View view = in_corridor();
  const std::vector<Alias> aliases = view.see_doors(2, 4).aliases();
  ASSERT_EQ(aliases.size(), 5U);
  const IntegrityParams& slips = view.slips();
  for (const Alias& alias : aliases) {
    EXPECT_DOUBLE_EQ(alias.probability.low / slips.prediction_fault.low,
                     alias.probability.high / slips.prediction_fault.high);
    EXPECT_EQ(alias.turn_rad, 0.0);
  }
  // The normal distribution, summed over the circle: its density at the centre is about the mean.
  const double radius = RepeatedModuleParams{}.capture_m, step = 0.005, variance = slips.slip_m * slips.slip_m;
  double inside = 0.0;
  for (double x = -radius; x <= radius; x += step)
    for (double y = -radius; y <= radius; y += step)
      if (x * x + y * y <= radius * radius)
        inside += std::exp(-(std::pow(kModule_m + x, 2) + y * y) / (2.0 * variance)) * step * step;
  const double expected = slips.prediction_fault.high * inside / (2.0 * std::numbers::pi * variance);
  EXPECT_NEAR(aliases[0].probability.high, expected, 0.15 * expected);
  EXPECT_GT(aliases[0].probability.high, aliases[2].probability.high);
}

TEST(RepeatedModules, ProbabilityIsAtMostThatOfASlip) {
  View view = in_corridor(corridor(8), {.capture_m = 30.0});
  for (const Alias& alias : view.see_doors(2, 4).aliases())
    EXPECT_LE(alias.probability.high, view.slips().prediction_fault.high);
}

}  // namespace
}  // namespace credo::localization
