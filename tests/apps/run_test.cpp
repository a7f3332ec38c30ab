// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/apps/command.hpp"

namespace {

namespace fs = std::filesystem;
using credo::tests::Answer;
using credo::tests::Command;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

TEST_F(Command, TheWholeWayOfTheData) {
  write_small_world();
  Answer answer = credo("simulate small.yaml --out data --seed 3");
  ASSERT_EQ(answer.status, 0) << answer.error;
  EXPECT_THAT(credo("simulate small.yaml --out data").error, HasSubstr("data"));
  answer = credo("run data --out first --pictures first/pictures --moments 1");
  ASSERT_EQ(answer.status, 0) << answer.error;
  EXPECT_THAT(answer.out,
              AllOf(HasSubstr("mean position error"), HasSubstr("confidently wrong"), HasSubstr("per pair")));
  for (const char* name : {"trajectory.tum", "localization.csv", "tracks.csv", "primitives.csv", "radial_lines.csv",
                           "map.yaml", "map.pgm", "map_belief.tiff", "map.cgrid", "config.yaml", "calibration.yaml",
                           "pictures/errors.png", "pictures/beliefs.png", "pictures/map.png", "pictures/map_relief.png",
                           "pictures/map_occupied.png", "pictures/map_dsmp.png"}) {
    EXPECT_TRUE(fs::exists(folder_ / "first" / name)) << name;
  }
  const json info = json::parse(credo("info data --format json").out);
  EXPECT_EQ(info["kind"], "dataset");
  const json score = json::parse(credo("evaluate score data first --format json").out);
  EXPECT_EQ(score["acquisitions"], info["acquisitions"]);
  EXPECT_LT(score["mean_position_m"].get<double>(), 0.1);
  const json again = json::parse(credo("run data --out second --format json").out);
  EXPECT_NEAR(again["score"]["mean_position_m"].get<double>(), score["mean_position_m"].get<double>(), 1e-6);
  for (const char* name : {"localization.csv", "trajectory.tum", "map.pgm", "map_belief.tiff", "config.yaml"}) {
    EXPECT_EQ(read(fs::path("first") / name), read(fs::path("second") / name)) << name;
  }
  EXPECT_THAT(credo("evaluate ape data first").out, HasSubstr("(not aligned)"));
  EXPECT_THAT(credo("evaluate nees data first data second").out, HasSubstr("over 2 runs"));
  EXPECT_GT(json::parse(credo("evaluate map data first --format json").out)["accuracy"].get<double>(), 0.7);
  EXPECT_EQ(json::parse(credo("map data --out true_map --format json").out)["poses"], "ground truth");
  EXPECT_GT(json::parse(credo("evaluate map data true_map --format json").out)["accuracy"].get<double>(), 0.8);
  EXPECT_EQ(credo("map data --out own_map --poses first/trajectory.tum").status, 0);
}

TEST_F(Command, ResultsAreReplacedOnlyByForce) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  ASSERT_EQ(credo("run data --out out").status, 0);
  const Answer refused = credo("run data --out out");
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.error, HasSubstr("--force"));
  EXPECT_EQ(credo("run data --out out --force").status, 0);
  write("mine/thesis.tex", "x");
  EXPECT_EQ(credo("run data --out mine --force").status, 1);
  EXPECT_TRUE(fs::exists(folder_ / "mine/thesis.tex"));
}

TEST_F(Command, ABadRowIsNamedAndNothingIsWritten) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  std::ofstream(folder_ / "data/odometry0/data.csv", std::ios::app) << "5,0,nan\n";
  const Answer answer = credo("run data --out out");
  EXPECT_EQ(answer.status, 1);
  EXPECT_THAT(answer.error, HasSubstr("odometry0/data.csv:"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_FALSE(fs::exists(folder_ / ".out.unfinished"));
}

TEST_F(Command, WithoutAFloorPlanPosesAreEgoMotionAndThereIsAMap) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  fs::remove(folder_ / "data/floor_plan.yaml");
  const Answer answer = credo("run data --out out --format json");
  ASSERT_EQ(answer.status, 0) << answer.error;
  const json report = json::parse(answer.out);
  EXPECT_EQ(report["status"].size(), 1u);
  EXPECT_EQ(report["status"]["initializing"], report["acquisitions"]);
  EXPECT_GT(report["mapped"]["scans"].get<int>(), 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/map.pgm"));
}

TEST_F(Command, ANameThatIsAPathBecomesAFolderOfThatName) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  const std::string yaml = read("data/dataset.yaml");
  for (const auto& [name, folder] : {std::pair{"a/../../b", "results/a_.._.._b"}, {"..", "results/_.."}}) {
    write("data/dataset.yaml",
          std::regex_replace(yaml, std::regex("\nname: .*"), "\nname: \"" + std::string(name) + "\""));
    const Answer answer = credo("run data");
    EXPECT_EQ(answer.status, 0) << answer.error;
    EXPECT_TRUE(fs::exists(folder_ / folder / "config.yaml")) << name;
  }
}

TEST_F(Command, ARefusedRunLeavesNoFolder) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  EXPECT_EQ(credo("run data --resolution 9 --out new/newer/run").status, 1);
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

TEST_F(Command, PicturesInsideTheResultsStayAndAFailureLeavesNone) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  ASSERT_EQ(credo("map data --out out --pictures out/pictures").status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/pictures/map.png"));
  EXPECT_TRUE(fs::exists(folder_ / "out/map.yaml"));
  ASSERT_EQ(credo("map data --out out2 --pictures elsewhere").status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "elsewhere/map.png"));
  write("one.tum", "5 0 0 0 0 0 0 1\n");
  EXPECT_EQ(credo("map data --poses one.tum --out out3 --pictures nowhere").status, 1);
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(Command, PicturesOfOlderResultsDoNotStayBesideNewOnes) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  const auto pictures = [&](const char* folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / folder)) names.insert(entry.path().filename());
    return names;
  };
  ASSERT_EQ(credo("run data --out out --pictures beside --moments 3").status, 0);
  EXPECT_EQ(pictures("beside").size(), 18u);
  for (const char* name : {"beside/notes.txt", "beside/planet_7.png", "beside/scan_of_mine.png"}) write(name, "x");
  ASSERT_EQ(credo("run data --out out --pictures beside --moments 1 --force").status, 0);
  EXPECT_EQ(pictures("beside").size(), 17u);
  ASSERT_EQ(credo("map data --out out --pictures beside --force").status, 0);
  EXPECT_EQ(pictures("beside"),
            (std::set<std::string>{"map.png", "map_conflict.png", "map_contested.png", "map_dsmp.png", "map_empty.png",
                                   "map_occupied.png", "map_pignistic.png", "map_plausibility.png", "map_relief.png",
                                   "map_unknown.png", "notes.txt", "planet_7.png", "scan_of_mine.png"}));
  ASSERT_EQ(credo("map data --out out --pictures out/pictures --force").status, 0);
  ASSERT_EQ(credo("map data --out out --force").status, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/pictures"));
}

}  // namespace
