// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/apps/command.hpp"

namespace {

namespace fs = std::filesystem;
using credo::tests::Answer;
using credo::tests::Command;
using nlohmann::json;
using testing::HasSubstr;

TEST_F(Command, WithoutAFloorPlanARunTellsTheMotionAndMaps) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data --seed 3").status, 0);
  fs::remove(folder_ / "data" / "floor_plan.yaml");
  const Answer answer = credo("run data --out results");
  ASSERT_EQ(answer.status, 0) << answer.error;
  EXPECT_THAT(read("results/localization.csv"), HasSubstr(",initializing,"));
  EXPECT_TRUE(fs::exists(folder_ / "results" / "map.pgm"));
  const json ape = json::parse(credo("evaluate ape data results --align_origin --format json").out);
  EXPECT_LT(ape["statistics"]["rmse"].get<double>(), 0.1) << ape;
}

TEST_F(Command, EgoMotionMapsWithoutPoses) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data --seed 3").status, 0);
  const Answer answer = credo("map data --poses ego --out map --format json");
  ASSERT_EQ(answer.status, 0) << answer.error;
  const json report = json::parse(answer.out);
  EXPECT_EQ(report["poses"], "ego-motion");
  EXPECT_GT(report["scans"].get<int>(), 0);
  const json score = json::parse(credo("evaluate map data map --format json").out);
  EXPECT_GT(score["accuracy"].get<double>(), 0.9) << score;
}

TEST_F(Command, EgoMotionTakesTheLinesOfAHoughTransform) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data --seed 3").status, 0);
  ASSERT_EQ(credo("map data --poses ego --out segments").status, 0);
  const Answer answer = credo("map data --poses ego --lines hough --out hough");
  ASSERT_EQ(answer.status, 0) << answer.error;
  EXPECT_NE(read("hough/map.pgm"), read("segments/map.pgm"));
  EXPECT_THAT(credo("map data --lines hough --out none").error, HasSubstr("it goes with --poses ego"));
}

TEST_F(Command, APoseIsSetByHandDuringTheDrive) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data --seed 3").status, 0);
  const Answer late = credo("run data --out late --pose-at 9999 1 1 0");
  EXPECT_EQ(late.status, 1);
  EXPECT_THAT(late.error, HasSubstr("found the time 9999.000000000 s, expected one of the drive"));
  EXPECT_FALSE(fs::exists(folder_ / "late"));
  EXPECT_NE(credo("run data --out short --pose-at 1 1 1").status, 0);
  EXPECT_THAT(credo("run data --out none --pose-at 1 1 nan 0").error, HasSubstr("expected a number"));
  ASSERT_EQ(credo("run data --out usual").status, 0);
  const std::string third = read("usual/trajectory.tum");
  const std::string time = third.substr(0, third.find(' '));
  const Answer set = credo("run data --out set --pose-at " + time + " 3.0 -1.5 0.5 --pose-at " + time + " 1 1 0");
  ASSERT_EQ(set.status, 0) << set.error;
}

}  // namespace
