// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/apps/command.hpp"

namespace {

namespace fs = std::filesystem;
using credo::tests::Answer;
using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class CampaignCommand : public credo::tests::Command {
 protected:
  void SetUp() override {
    write_small_world();
    write("tiny.yaml", "format: credo-campaign/1\nworlds: [small.yaml]\nseeds: {first: 3, count: 2}\n");
  }
};

TEST_F(CampaignCommand, RunsSumsUpAndSaysHowToReplay) {
  const Answer answer = credo("campaign tiny.yaml --out out --threads 2");
  EXPECT_EQ(answer.status, 0) << answer.error;
  EXPECT_THAT(answer.out, AllOf(HasSubstr("2 of 2 runs are finished"), HasSubstr("\nnominal "), HasSubstr("\nall "),
                                HasSubstr("credo simulate small.yaml --seed 3 --out replay/small-3-nominal && "
                                          "credo run replay/small-3-nominal")));
  for (const char* name : {"campaign.yaml", "config.yaml", "summary.csv", "times.csv", "runs/small-4-nominal.csv"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  const json summary = json::parse(read("out/summary.json"));
  EXPECT_EQ(summary["runs_finished"], 2);
  EXPECT_LT(summary["groups"][0]["measures"]["mean_position"]["value"], 0.2);
}

TEST_F(CampaignCommand, MeasuresHowOftenMatchesAreWrong) {
  const Answer answer = credo("campaign tiny.yaml --out out --seeds 1");
  EXPECT_THAT(answer.out, AllOf(HasSubstr("wrong matches by the belief of their track"),
                                ContainsRegex("\n  walls +[1-9][0-9]* +[0-9]+ +[^ ]+  \\[[^ ]+, [^ ]+\\]\n"),
                                ContainsRegex("\n  nominal +[0-9]+ / [0-9]+ ")));
  const json matches = json::parse(read("out/summary.json"))["groups"][0]["matches"];
  ASSERT_TRUE(matches.contains("points_from_0"));
  const json& walls = matches["walls"];
  EXPECT_GT(walls["count"], 0);
  EXPECT_LE(walls["low"], walls["share"]);
  EXPECT_LE(walls["share"], walls["high"]);
}

TEST_F(CampaignCommand, OfThePapersMethodNoBeliefsAreCompared) {
  write("tiny.yaml", read("tiny.yaml") + "method: paper\n");
  EXPECT_THAT(credo("campaign tiny.yaml --out out --seeds 1").out, Not(HasSubstr("by the belief of their track")));
}

TEST_F(CampaignCommand, InPiecesGivesTheSameBytesAsAtOnce) {
  EXPECT_EQ(credo("campaign tiny.yaml --out whole --threads 1").status, 0);
  EXPECT_THAT(credo("campaign tiny.yaml --out parts --threads 1 --limit 1").out, HasSubstr("1 of 2 runs are finished"));
  EXPECT_EQ(credo("campaign tiny.yaml --out parts --threads 2").status, 0);
  for (const char* name : {"campaign.yaml", "config.yaml", "summary.csv", "summary.json", "runs/small-3-nominal.csv",
                           "runs/small-4-nominal.csv"})
    EXPECT_EQ(read(fs::path("whole") / name), read(fs::path("parts") / name)) << name;
}

TEST_F(CampaignCommand, SumsUpAFinishedFolderAgain) {
  const Answer first = credo("campaign tiny.yaml --out out --seeds 1 --format json");
  fs::remove(folder_ / "out/summary.csv");
  const Answer again = credo("campaign --summarize out --format json");
  EXPECT_EQ(again.status, 0) << again.error;
  EXPECT_EQ(again.out, first.out);
  EXPECT_TRUE(fs::exists(folder_ / "out/summary.csv"));
}

TEST_F(CampaignCommand, WhereThereIsNothingToSumUpItSaysHowToMakeIt) {
  fs::create_directories(folder_ / "empty");
  write("other/notes.txt", "x");
  write("bare/campaign.yaml", read("tiny.yaml"));
  struct Case {
    const char *folder, *found;
  };
  for (const Case& c : {Case{"missing", "missing: there is no such folder"},
                        {"empty", "empty: is empty"},
                        {"other", "other: holds no campaign (campaign.yaml is missing)"},
                        {"tiny.yaml", "tiny.yaml: is a file"},
                        {"bare", "bare: no run is finished"}}) {
    const Answer answer = credo("campaign --summarize " + std::string(c.folder));
    EXPECT_EQ(answer.status, 1) << c.folder;
    EXPECT_THAT(answer.error,
                AllOf(HasSubstr(c.found), HasSubstr("credo campaign SPEC --out " + std::string(c.folder))));
    EXPECT_EQ(answer.out, "") << c.folder;
  }
  EXPECT_FALSE(fs::exists(folder_ / "missing"));
  EXPECT_FALSE(fs::exists(folder_ / "bare/summary.csv"));
}

TEST_F(CampaignCommand, SummingUpTakesNothingThatSaysHowToRun) {
  ASSERT_EQ(credo("campaign tiny.yaml --out out --seeds 1").status, 0);
  for (const char* option : {"tiny.yaml", "--out other", "--seeds 1", "--threads 1", "--limit 1", "--force"}) {
    const Answer answer = credo("campaign --summarize out " + std::string(option));
    EXPECT_EQ(answer.status, 2) << option;
    const std::string name = *option == '-' ? std::string(option).substr(0, std::string(option).find(' ')) : "SPEC";
    EXPECT_THAT(answer.error, HasSubstr(name + " says how to run, but --summarize")) << option;
    EXPECT_EQ(answer.out, "") << option;
  }
  EXPECT_FALSE(fs::exists(folder_ / "other"));
  EXPECT_EQ(credo("campaign --summarize out --pictures --format json").status, 0);
}

TEST_F(CampaignCommand, WhatSumsUpFewerOrOtherRunsDoesNotStayBesideNewOnes) {
  const auto pictures = [&] {
    std::set<std::string> names;
    if (!fs::exists(folder_ / "out/pictures")) return names;
    for (const auto& entry : fs::directory_iterator(folder_ / "out/pictures")) names.insert(entry.path().filename());
    return names;
  };
  const std::set<std::string> all{"availability.png", "errors.png", "protection.png"};
  ASSERT_EQ(credo("campaign tiny.yaml --out out --limit 1 --pictures").status, 0);
  EXPECT_EQ(pictures(), all);
  ASSERT_EQ(credo("campaign --summarize out").status, 0);
  EXPECT_EQ(pictures(), all);  // of the same runs
  ASSERT_EQ(credo("campaign tiny.yaml --out out").status, 0);
  EXPECT_EQ(pictures(), std::set<std::string>{});
  ASSERT_EQ(credo("campaign tiny.yaml --out out --pictures").status, 0);
  write("out/pictures/mine.png", "x");
  ASSERT_EQ(credo("campaign tiny.yaml --out out --seeds 1 --force").status, 0);
  EXPECT_EQ(pictures(), std::set<std::string>{"mine.png"});
}

TEST_F(CampaignCommand, RefusesToMixAndSaysWhatToDo) {
  EXPECT_EQ(credo("campaign tiny.yaml --out out --seeds 1").status, 0);
  EXPECT_THAT(credo("campaign tiny.yaml --out out").error, HasSubstr("start anew with --force"));
  write("small.yaml", read("small.yaml") + "\n");
  EXPECT_THAT(credo("campaign tiny.yaml --out out --seeds 1").error, HasSubstr("other world files"));
  EXPECT_EQ(credo("campaign tiny.yaml --out out --seeds 1 --force").status, 0);
}

TEST_F(CampaignCommand, AnUnknownNameIsMetWithItsLineAndTheNearestKnownOne) {
  struct Case {
    const char *lines, *complaint, *nearest;
  };
  for (const Case& c :
       {Case{"worlds:\n  - small.yaml\n  - offfice\n", "spec.yaml:4: offfice: no such world file", "'office'"},
        {"worlds: [randon]\n", "spec.yaml:2: randon: no such world file", "'random'"},
        {"worlds:\n- random:hal\n", "spec.yaml:3: random:hal: no such kind of building", "'random:hall'"},
        {"worlds: [random]\ndegradations:\n- nominal\n- peopel\n", "spec.yaml:5: unknown degradation 'peopel'",
         "'people'"},
        {"worlds: [random]\nmethod: papr\n", "spec.yaml:3: method: expected one of default, paper, found 'papr'",
         "'paper'"}}) {
    write("spec.yaml", std::string("format: credo-campaign/1\n") + c.lines);
    const Answer answer = credo("campaign spec.yaml --out out");
    EXPECT_EQ(answer.status, 1) << c.lines;
    EXPECT_THAT(answer.error, AllOf(HasSubstr(c.complaint), HasSubstr(std::string("did you mean ") + c.nearest)));
    EXPECT_FALSE(fs::exists(folder_ / "out")) << c.lines;
  }
}

TEST_F(CampaignCommand, ComplainsBeforeItBegins) {
  EXPECT_THAT(credo("campaign nowhere --out out").error,
              AllOf(HasSubstr("no such campaign file"), HasSubstr(" nominal")));
  EXPECT_THAT(credo("campaign --out out").error, HasSubstr("expected either SPEC with --out, or --summarize"));
  EXPECT_THAT(credo("campaign tiny.yaml").error, HasSubstr("--out is missing"));
  EXPECT_THAT(credo("campaign tiny.yaml --out out --threads 0").error, HasSubstr("from 1 to"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
