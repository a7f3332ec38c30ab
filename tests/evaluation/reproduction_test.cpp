// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/reproduction.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "geometry/angles.hpp"
#include "tests/evaluation/drives.hpp"

namespace credo::evaluation {
namespace {

using perception::PrimitiveType;
using test::moments_of;
using test::seen;
using tracking::TrackState;

constexpr evidence::BinaryMass kSure{.yes = 0.9, .no = 0.0, .unknown = 0.1};

/// Two acquisitions, 10 cm and 2 m off, the second one believed less and with fewer landmarks.
ReproducedDrive two_acquisitions() {
  ReproducedDrive drive;
  drive.history = moments_of(std::vector{seen(PrimitiveType::kEdge, kSure)}, 2);
  drive.history[0].localization.estimate.pose = {0.1, 0.0, geometry::to_radians(1.0)};
  drive.history[0].localization.belief = {.yes = 0.8, .no = 0.0, .unknown = 0.2};
  drive.history[1].localization.estimate.pose = {0.0, 2.0, geometry::to_radians(-3.0)};
  drive.history[1].localization.belief = {.yes = 0.2, .no = 0.0, .unknown = 0.8};
  return drive;
}

TEST(Reproduction, FiguresAreOverAllAcquisitionsOfAllDrives) {
  const std::vector<ReproducedDrive> drives(2, two_acquisitions());
  const ReproducedFigures figures = reproduced_figures(drives);
  EXPECT_EQ(figures.acquisitions, 4);
  EXPECT_NEAR(figures.mean_position_m, 1.05, 1e-12);
  EXPECT_NEAR(figures.mean_heading_rad, geometry::to_radians(2.0), 1e-12);
  EXPECT_EQ(figures.within_m.count, 2);
  EXPECT_NEAR(figures.within_m.mean(), 0.1, 1e-12);
  EXPECT_NEAR(figures.mean_belief_yes, 0.5, 1e-12);
}

TEST(Reproduction, BeliefFollowsTheTracksWhereItIsLargerWithMoreOfThem) {
  std::vector<ReproducedDrive> drives{two_acquisitions()};
  drives.front().history.push_back(drives.front().history[0]);  // one, none and two landmarks: the median is one
  drives.front().history[2].tracks.push_back(seen(PrimitiveType::kWall, kSure));
  EXPECT_EQ(reproduced_figures(drives).belief_follows_tracks, 1.0);
  drives.front().history[1].localization.belief.yes = 0.9;
  EXPECT_EQ(reproduced_figures(drives).belief_follows_tracks, 0.0);
  for (results::Moment& moment : drives.front().history) moment.tracks.clear();
  EXPECT_FALSE(reproduced_figures(drives).belief_follows_tracks);
}

TEST(Reproduction, WithoutAcquisitionsThereIsNoFigure) {
  EXPECT_THROW((void)reproduced_figures({}), std::logic_error);
  EXPECT_THROW((void)Spread{}.mean(), std::logic_error);
}

TEST(Reproduction, MassesAreThoseOfPrimitivesWithASegment) {
  perception::Scene scene;
  scene.primitives.resize(3);
  scene.primitives[0].type = scene.primitives[1].type = PrimitiveType::kWall;
  scene.primitives[0].existence = {.yes = 0.5, .no = 0.0, .unknown = 0.5};
  scene.primitives[1].existence = {.yes = 0.1, .no = 0.2, .unknown = 0.7};
  scene.primitives[2].bearing_only = true;
  ReproducedDrive drive;
  drive.see(scene);
  const MassSpread& walls = drive.masses[static_cast<std::size_t>(PrimitiveType::kWall)];
  EXPECT_EQ(walls.yes.count, 2);
  EXPECT_EQ(walls.yes.lowest, 0.1);
  EXPECT_EQ(walls.yes.highest, 0.5);
  EXPECT_EQ(walls.without_no, 1);
  EXPECT_EQ(drive.masses[static_cast<std::size_t>(PrimitiveType::kOther)].yes.count, 0);
}

/// A track that is seen `sightings` times and then missed as long as it is believed.
std::vector<results::TrackSample> life(PrimitiveType type, int sightings) {
  std::vector<results::TrackSample> samples(static_cast<std::size_t>(sightings), seen(type, kSure));
  for (auto miss = evidence::miss_track(kSure); miss->keep; miss = evidence::miss_track(samples.back().existence)) {
    samples.push_back(seen(type, miss->mass));
    samples.back().state = TrackState::kMissed;
  }
  return samples;
}

TEST(Reproduction, TheLossOfLandmarksThatWereSeenLongEnoughIsCounted) {
  for (const int sightings : {4, 5}) {
    std::vector<ReproducedDrive> drives(1);
    drives.front().history = moments_of(life(PrimitiveType::kEdge, sightings), 20);
    const Spread until_lost = reproduced_figures(drives).until_lost;
    EXPECT_EQ(until_lost.count, sightings == 5 ? 1 : 0);
    EXPECT_EQ(until_lost.sum, sightings == 5 ? 5.0 : 0.0);
  }
}

TEST(Reproduction, TheLifeLikeFigure21IsThatOfAnEdgeSeenAboutSevenTimesAndLost) {
  results::History history = moments_of(life(PrimitiveType::kEdge, 9), 20);
  const auto add = [&](int id, PrimitiveType type, int sightings) {
    const std::vector<results::TrackSample> samples = life(type, sightings);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      history[i].tracks.push_back(samples[i]);
      history[i].tracks.back().id = id;
    }
  };
  add(4, PrimitiveType::kEdge, 6);
  add(5, PrimitiveType::kCorner, 7);
  EXPECT_EQ(life_like_figure_21(history)->id, 4);
  EXPECT_FALSE(life_like_figure_21(moments_of(life(PrimitiveType::kCorner, 7), 20)));
  EXPECT_FALSE(life_like_figure_22(history));
}

}  // namespace
}  // namespace credo::evaluation
