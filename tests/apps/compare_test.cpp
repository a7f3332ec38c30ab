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
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class CompareCommand : public Command {};

TEST_F(CompareCommand, LocalizersAreComparedOnTheSameReadings) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  const Answer text = credo("compare localizers data --out table.csv --pictures pictures");
  EXPECT_EQ(text.status, 0) << text.error;
  EXPECT_THAT(text.out, AllOf(StartsWith("small: "), HasSubstr("EKF, JCBB"), HasSubstr("ICP, oracle start"),
                              HasSubstr("misleading: available, yet")));
  EXPECT_TRUE(fs::exists(folder_ / "pictures" / "errors_data.png"));
  EXPECT_THAT(credo("compare localizers data --pictures pictures").error, HasSubstr("pictures: is there already"));
  EXPECT_THAT(read("table.csv"), AllOf(StartsWith("dataset,localizer,"), HasSubstr("\nsmall,\"Credo, paper\",")));

  const json tables = json::parse(credo("compare localizers data data --format json").out);
  ASSERT_EQ(tables.size(), 3u);  // the third: all together
  const json& credos = tables[2]["localizers"].back();
  EXPECT_EQ(credos["localizer"], "Credo");
  EXPECT_EQ(credos["acquisitions"], 2 * tables[0]["localizers"].back()["acquisitions"].get<int>());
  EXPECT_LT(credos["mean_position_m"], 0.05);
  for (const json& line : tables[0]["localizers"])
    EXPECT_TRUE(line.contains("mean_position_m") || line.contains("note")) << line;
}

TEST_F(CompareCommand, AssociationsAreComparedOnTheSamePredictions) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  const json tables = json::parse(credo("compare association data --format json").out);
  for (const json& method : tables[0]["methods"]) EXPECT_GT(method["right"], 0) << method;
  EXPECT_THAT(credo("compare association data").out, AllOf(HasSubstr("JPDA"), HasSubstr("wrong share: ")));
}

TEST_F(CompareCommand, WhatCannotBeComparedSaysWhatItLacks) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  fs::remove_all(folder_ / "data" / "groundtruth0");
  for (const char* what : {"localizers", "association"}) {
    const Answer answer = credo("compare " + std::string(what) + " data");
    EXPECT_EQ(answer.status, 1) << what;
    EXPECT_THAT(answer.error, HasSubstr("data: the dataset has no ground truth")) << what;
  }
}

TEST_F(CompareCommand, MapsAreComparedOnTheSameReadings) {
  ASSERT_EQ(credo("simulate demo --out data").status, 0);
  const Answer text = credo(
      "compare maps data --sensors sonar --models li2007,calibrated --rules dempster,pcr2 --out t.csv --pictures p");
  EXPECT_EQ(text.status, 0) << text.error;
  EXPECT_THAT(text.out,
              AllOf(HasSubstr("li2007"), HasSubstr("calibrated"), HasSubstr("pcr2"), HasSubstr("accuracy: of all")));
  EXPECT_TRUE(fs::exists(folder_ / "p" / "maps.png"));
  EXPECT_THAT(read("t.csv"), AllOf(StartsWith("#model,rule,cells"), HasSubstr("\ncalibrated,pcr2,")));
  const json maps =
      json::parse(credo("compare maps data --models li2007 --rules dempster,dsmc --format json").out)["maps"];
  ASSERT_EQ(maps.size(), 10u);  // of the sonar first, then the laser's models
  EXPECT_EQ(maps[0]["model"], "li2007");
  const char* laser_models[] = {"laser li2006_printed", "laser li2006", "laser bayes", "laser calibrated"};
  for (std::size_t k = 0; k < 4; ++k) {
    const json &dempster = maps[2 + 2 * k], &dsmc = maps[3 + 2 * k];
    EXPECT_EQ(dempster["model"], laser_models[k]);
    EXPECT_EQ(dempster["accuracy"], dsmc["accuracy"]);  // of the same sum
    EXPECT_GT(dempster["accuracy"], 0.95) << laser_models[k];
  }
  fs::remove(folder_ / "data" / "truth_map.yaml");
  EXPECT_THAT(credo("compare maps data").error, HasSubstr("data: has no truth_map.yaml"));
  EXPECT_EQ(credo("compare maps data --rules pcr7").status, 2);
}

TEST_F(CompareCommand, AnOlderFileIsReplacedOnlyIfForced) {
  ASSERT_EQ(credo("simulate demo --out data").status, 0);
  for (const char* command : {"compare maps data --sensors sonar --models li2007 --rules dempster --out out.csv",
                              "compare localizers data --out out.csv", "calibrate sonar data --out out.csv"}) {
    write("out.csv", "older");
    const Answer refused = credo(command);
    EXPECT_EQ(refused.status, 1) << command;
    EXPECT_THAT(refused.error, HasSubstr("out.csv: is there already")) << command;
    EXPECT_EQ(read("out.csv"), "older") << command;
    EXPECT_EQ(credo(std::string(command) + " --force").status, 0) << command;
    EXPECT_NE(read("out.csv"), "older") << command;
  }
}

/// There is no dataset, which nobody has looked for yet.
TEST_F(CompareCommand, WhereNoFileCanBeIsSaidBeforeTheWork) {
  fs::create_directory(folder_ / "folder");
  for (const std::string command :
       {"calibrate laser none", "compare maps none", "compare localizers none", "plan none"}) {
    for (const char* more : {"", " --force"}) {
      const Answer nowhere = credo(command + " --out missing/table" + more);
      EXPECT_EQ(nowhere.status, 1) << command;
      EXPECT_THAT(nowhere.error, HasSubstr("missing/table: cannot be written: missing is no folder")) << command;
      EXPECT_THAT(credo(command + " --out folder" + more).error, HasSubstr("folder: is a folder")) << command;
    }
    EXPECT_THAT(credo(command + " --out folder/").error, HasSubstr("folder/: is a folder")) << command;
    EXPECT_THAT(credo(command + " --out folder/table").error, HasSubstr("none")) << command;
  }
}

TEST_F(CompareCommand, OptionsThatWouldHaveNoEffectAreRefused) {
  for (const auto& [with, said] :
       {std::pair{"--sensors range --models zhu", "--models: is of the sonar, which --sensors range leaves out"},
        std::pair{"--sensors range --printed", "--printed: is of the sonar"},
        std::pair{"--sensors range --sonar-weights nofile", "--sonar-weights: is of the sonar"},
        std::pair{"--sensors sonar --laser-models bayes", "--laser-models: is of the range finders"},
        std::pair{"--laser-models li2006 --laser-weights nofile", "add --laser-models calibrated"},
        std::pair{"--models li2007,zhu --sonar-weights nofile", "not of 'li2007', 'zhu': add --models calibrated"},
        std::pair{"--models su,zhu --printed", "one form only of 'su', 'zhu'"}}) {
    const Answer answer = credo(std::string("compare maps none ") + with);
    EXPECT_EQ(answer.status, 1) << with;
    EXPECT_THAT(answer.error, HasSubstr(said));
  }
  EXPECT_THAT(credo("compare maps none --models su,bayes --printed").error, HasSubstr("has no truth_map.yaml"));
}

TEST_F(CompareCommand, ASonarLearnsFromADriveWhoseTruthIsKnown) {
  ASSERT_EQ(credo("simulate demo --out data").status, 0);
  ASSERT_EQ(credo("calibrate sonar data --out weights.yaml").status, 0);
  EXPECT_THAT(read("weights.yaml"), HasSubstr(" cells of 1 dataset'"));
  EXPECT_EQ(credo("map data --sensors sonar --model calibrated --sonar-weights weights.yaml --out map").status, 0);
  EXPECT_THAT(read("map/config.yaml"), HasSubstr("model: calibrated"));
  write("weights.yaml", "format: credo-sonar-weights/1\nweights: [1, 2]\n");
  EXPECT_THAT(credo("map data --model calibrated --sonar-weights weights.yaml --out m2").error,
              HasSubstr("weights.yaml:2"));
  EXPECT_THAT(credo("calibrate sonar --out none.yaml").error, HasSubstr("nothing to learn from"));
}

TEST_F(CompareCommand, ALaserLearnsFromADriveWhoseTruthIsKnown) {
  ASSERT_EQ(credo("simulate demo --out data").status, 0);
  ASSERT_EQ(credo("calibrate laser data --out weights.yaml").status, 0);
  EXPECT_THAT(read("weights.yaml"),
              AllOf(StartsWith("format: credo-laser-weights/1"), HasSubstr(" cells of 1 dataset'")));
  const std::string with = "map data --sensors range --laser-model calibrated --laser-weights weights.yaml --out ";
  EXPECT_EQ(credo(with + "map").status, 0);
  EXPECT_THAT(read("map/config.yaml"),
              AllOf(HasSubstr("model: calibrated"), HasSubstr("alone:"), HasSubstr("free_weight: ")));
  const std::string learned = read("weights.yaml");
  const auto spoilt = [&](const std::string& key, const std::string& line) {
    std::string text = learned;
    const std::size_t begin = text.find(key + ":");
    write("weights.yaml", text.replace(begin, text.find('\n', begin) - begin, line));
    return credo(with + "m2").error;
  };
  EXPECT_THAT(spoilt("half_width", "half_width: {least: 3, sigmas: 0}"),
              HasSubstr("weights.yaml:4: half_width may not be above free_margin"));
  EXPECT_THAT(spoilt("free_weight", "free_weight: -1"), HasSubstr("weights.yaml:6"));
  EXPECT_THAT(spoilt("free_weight", "weight: 1"), HasSubstr("weights.yaml:6"));
  EXPECT_THAT(spoilt("alone", "by_itself:"), HasSubstr("by_itself"));
  EXPECT_EQ(credo("map data --laser-model li2007").status, 2);
  EXPECT_THAT(credo("calibrate laser --out none.yaml").error, HasSubstr("nothing to learn from"));
}

}  // namespace
