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

}  // namespace
