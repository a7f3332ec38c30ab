// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/apps/command.hpp"

namespace {

namespace fs = std::filesystem;
using credo::tests::Answer;
using credo::tests::Command;
using credo::tests::text_of;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class ReproduceCommand : public Command {};

TEST_F(ReproduceCommand, APaperThatCannotBeReproducedIsMetWithThoseThatCan) {
  const Answer answer = credo("reproduce radar");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.error, AllOf(HasSubstr("'radar'"), HasSubstr("there are: clerentin")));
}

TEST_F(ReproduceCommand, TheMappingPapersAreReproducedToTheByte) {
  for (const char* paper : {"sonar", "multi-robot"}) {
    const std::string command = std::string("reproduce ") + paper + " --seeds 1";
    const Answer text = credo(command + " --out out --force --pictures p");
    ASSERT_EQ(text.status, 0) << text.error;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "p" / "maps.png"));
    EXPECT_EQ(credo(command).out, read("out/report.txt"));
    const json report = json::parse(read("out/report.json"));
    EXPECT_GE(report["tables"].size(), 2u);
  }
}

TEST_F(ReproduceCommand, SonarAndLaserTogetherAreReproduced) {
  const Answer answer = credo("reproduce sonar-laser --seeds 1 --format json");
  ASSERT_EQ(answer.status, 0) << answer.error;
  const json report = json::parse(answer.out);
  const json& rows = report["tables"][0]["rows"];
  const auto accuracy = [&](const std::string& name) {
    for (const json& row : rows)
      if (row["name"] == name) return row["accuracy %"]["mean"].get<double>();
    ADD_FAILURE() << "no row " << name;
    return 0.0;
  };
  EXPECT_GT(accuracy("both, DSmT, resolved, discounted"), accuracy("sonar, resolved"));
}

TEST_F(ReproduceCommand, OfOneSeedNoSettingIsCalledTheBest) {
  const Answer answer = credo("reproduce improved-ds --seeds 1 --format json");
  ASSERT_EQ(answer.status, 0) << answer.error;
  const json report = json::parse(answer.out);
  const json& claim = report["tables"][0];
  EXPECT_GE(claim["rows"][0]["median %"]["mean"].get<double>(), 20.0);
  const json& best = report["tables"][1];
  EXPECT_THAT(best["title"].get<std::string>(), HasSubstr("chosen on the other seeds"));
  ASSERT_EQ(best["rows"].size(), 4u);
  for (const json& row : best["rows"]) EXPECT_TRUE(row["wrong"].is_null()) << row;
}

TEST_F(ReproduceCommand, ReproducePutsThePaperBesideBothMethodsOnTheSameReadings) {
  write_small_world();
  const std::string clerentin = "reproduce clerentin --seed 3 --seeds 2 --ways small.yaml";
  const Answer text = credo(clerentin);
  ASSERT_EQ(text.status, 0) << text.error;
  EXPECT_THAT(text.out, AllOf(HasSubstr("mean position error [cm]"), HasSubstr("table 1"), HasSubstr("m_l(YES)")));
  EXPECT_EQ(credo(clerentin).out, text.out);

  const json report = json::parse(credo(clerentin + " --format json").out);
  EXPECT_EQ(report["printed"]["mean_position_cm"], "13");
  const json& method = report["method_default"];
  EXPECT_EQ(method["acquisitions"].size(), 2 * report["acquisitions_per_seed"].get<std::size_t>());
  EXPECT_LT(method["figures"]["mean_position_cm"]["mean"].get<double>(), 5.0);
  // What was played in memory is what a dataset of the same seed gives.
  ASSERT_EQ(credo("simulate small.yaml --seed 3 --out data").status, 0);
  const json alone = json::parse(credo("reproduce clerentin --seed 3 --seeds 1 --ways small.yaml --format json").out);
  for (const char* name : {"paper", "default"}) {
    const Answer run = credo(std::string("run data --force --out run --format json --method ") + name);
    const json in_memory = alone[std::string("method_") + name]["figures"]["mean_position_cm"]["mean"];
    const double on_disk = json::parse(run.out)["score"]["mean_position_m"].get<double>();
    EXPECT_NEAR(0.01 * in_memory.get<double>(), on_disk, 1e-3) << name;
  }
}

TEST_F(ReproduceCommand, ThePageOfTheReproductionsShowsTheTableThatReproducePrints) {
  write_small_world();
  const std::string printed = credo("reproduce clerentin --seeds 1 --ways small.yaml").out;
  const std::string page = text_of(CREDO_SOURCE_DIR "/docs/reproduce.md");
  std::istringstream table(page.substr(page.find("mean position error [cm]")));
  int lines = 0;
  for (std::string line; std::getline(table, line) && line != "```"; ++lines) {
    constexpr std::size_t kWordsAndPaper = 63;  // what stands before our own numbers
    EXPECT_THAT(printed, HasSubstr(line.substr(0, kWordsAndPaper)));
  }
  EXPECT_GT(lines, 20);
}

TEST_F(ReproduceCommand, ReproduceLeavesAReportAndPictures) {
  write_small_world();
  const std::string command = "reproduce clerentin --seeds 1 --ways small.yaml --out out --pictures out/pictures";
  const Answer answer = credo(command);
  ASSERT_EQ(answer.status, 0) << answer.error;
  EXPECT_THAT(answer.out, StartsWith(read("out/report.txt")));
  EXPECT_EQ(json::parse(read("out/report.json"))["paper"], "clerentin");
  for (const char* name : {"positions_paper", "positions_default", "beliefs"})
    EXPECT_TRUE(fs::exists(folder_ / "out/pictures" / (std::string(name) + ".png"))) << name;
  EXPECT_EQ(credo(command).status, 1);
  EXPECT_EQ(credo(command + " --force").status, 0);
}

TEST_F(ReproduceCommand, AFolderOfTheNameOfAWayDoesNotHideIt) {
  fs::create_directories(folder_ / "corridor_end");
  fs::create_directories(folder_ / "random");
  const Answer answer = credo("reproduce clerentin --seeds 1 --ways corridor_end");
  EXPECT_EQ(answer.status, 0) << answer.error;
  EXPECT_EQ(credo("simulate random --out drawn").status, 0);
  fs::create_directories(folder_ / "mine");
  EXPECT_THAT(credo("reproduce clerentin --seeds 1 --ways mine").error,
              HasSubstr("mine: is a folder; expected a world file"));
}

}  // namespace
