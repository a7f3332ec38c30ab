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
  const Answer text =
      credo("compare maps data --models li2007,calibrated --rules dempster,pcr2 --out t.csv --pictures p");
  EXPECT_EQ(text.status, 0) << text.error;
  EXPECT_THAT(text.out,
              AllOf(HasSubstr("li2007"), HasSubstr("calibrated"), HasSubstr("pcr2"), HasSubstr("accuracy: of all")));
  EXPECT_TRUE(fs::exists(folder_ / "p" / "maps.png"));
  EXPECT_THAT(read("t.csv"), AllOf(StartsWith("#model,rule,cells"), HasSubstr("\ncalibrated,pcr2,")));
  const json maps =
      json::parse(credo("compare maps data --sensors range --rules dempster,dsmc --format json").out)["maps"];
  ASSERT_EQ(maps.size(), 2u);
  EXPECT_EQ(maps[0]["model"], "laser");
  EXPECT_EQ(maps[0]["accuracy"], maps[1]["accuracy"]);  // of the same sum
  EXPECT_GT(maps[0]["accuracy"], 0.95);
  fs::remove(folder_ / "data" / "truth_map.yaml");
  EXPECT_THAT(credo("compare maps data").error, HasSubstr("data: has no truth_map.yaml"));
  EXPECT_EQ(credo("compare maps data --rules pcr7").status, 2);
}

TEST_F(CompareCommand, ASonarLearnsFromADriveWhoseTruthIsKnown) {
  ASSERT_EQ(credo("simulate demo --out data").status, 0);
  ASSERT_EQ(credo("calibrate sonar data --out weights.yaml").status, 0);
  EXPECT_THAT(read("weights.yaml"), HasSubstr("of 1 datasets"));
  EXPECT_EQ(credo("map data --sensors sonar --model calibrated --sonar-weights weights.yaml --out map").status, 0);
  EXPECT_THAT(read("map/config.yaml"), HasSubstr("model: calibrated"));
  write("weights.yaml", "format: credo-sonar-weights/1\nweights: [1, 2]\n");
  EXPECT_THAT(credo("map data --model calibrated --sonar-weights weights.yaml --out m2").error,
              HasSubstr("weights.yaml:2"));
  EXPECT_THAT(credo("calibrate sonar --out none.yaml").error, HasSubstr("nothing to learn from"));
}

}  // namespace
