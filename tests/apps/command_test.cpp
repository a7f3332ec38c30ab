// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/apps/command.hpp"

namespace {

namespace fs = std::filesystem;
using credo::tests::Answer;
using credo::tests::Command;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST_F(Command, HelpStartsWithExamples) {
  for (const char* name : {"",
                           "demo",
                           "simulate",
                           "run",
                           "map",
                           "evaluate",
                           "evaluate ape",
                           "evaluate rpe",
                           "evaluate traj",
                           "evaluate score",
                           "evaluate integrity",
                           "evaluate nees",
                           "evaluate map",
                           "compare",
                           "compare localizers",
                           "compare association",
                           "campaign",
                           "info",
                           "reproduce",
                           "reproduce clerentin"}) {
    const Answer answer = credo(std::string(name) + " --help");
    EXPECT_EQ(answer.status, 0) << name;
    EXPECT_THAT(answer.out, StartsWith("Examples:\n  credo ")) << name;
    EXPECT_EQ(answer.error, "") << name;
  }
}

TEST_F(Command, VersionIsSaid) { EXPECT_THAT(credo("--version").out, StartsWith("credo ")); }

TEST_F(Command, WrongUsageEndsWithStatusTwo) {
  for (const char* arguments :
       {"", "fly", "run", "run a --method magic", "evaluate", "evaluate ape one", "run a --resolution -1",
        "evaluate nees one", "evaluate nees", "evaluate integrity one", "evaluate integrity a b --fail_above magic=1",
        "info x --format xml", "reproduce", "reproduce clerentin --seeds 0", "reproduce clerentin --pictures p"}) {
    const Answer answer = credo(arguments);
    EXPECT_EQ(answer.status, 2) << arguments;
    EXPECT_THAT(answer.error, StartsWith("credo: error: ")) << arguments;
    EXPECT_EQ(answer.out, "") << arguments;
  }
}

TEST_F(Command, NumbersOfOptionsAreFiniteAndWithinTheirBounds) {
  write_fixture();
  for (const char* option :
       {"--t_offset nan", "--t_offset inf", "--t_offset 1e300", "--t_max_diff nan", "--t_max_diff -1", "-d nan",
        "-d inf", "-d 1e300", "-d 0", "-d -1", "-t nan", "-t -1", "--n_to_align -2", "--n_to_align 1e99"}) {
    const Answer answer = credo("evaluate rpe ref.tum est.tum " + std::string(option));
    EXPECT_EQ(answer.status, 2) << option;
    EXPECT_THAT(answer.error, AllOf(HasSubstr("expected a "), HasSubstr("found '"))) << option;
  }
  for (const char* arguments :
       {"simulate office --out out --seed -1", "demo --out out --seed -1", "demo --out out --seed 1.5",
        "demo --out out --seed 99999999999999999999", "run data --resolution nan", "map data --resolution inf",
        "run data --moments -1", "evaluate map a b --tolerance nan", "evaluate traj est.tum --t_max_diff nan"}) {
    const Answer answer = credo(arguments);
    EXPECT_EQ(answer.status, 2) << arguments;
    EXPECT_THAT(answer.error, HasSubstr("expected a ")) << arguments;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_EQ(credo("evaluate ape ref.tum est.tum --fail_above rmse=nan").status, 2);
  EXPECT_EQ(credo("evaluate ape ref.tum est.tum --t_offset +0.001").status, 0);
}

TEST_F(Command, UnknownWordsAreMetWithTheNearestKnownOne) {
  struct Case {
    const char *arguments, *nearest;
  };
  for (const Case& c : {Case{"evalute ape a b", "'evaluate'"},
                        {"evaluate scoer a b", "'score'"},
                        {"rum data", "'run'"},
                        {"run data --pictuers x", "'--pictures'"},
                        {"simulate office --ot=x", "'--out'"},
                        {"evaluate ape a b --t_maxdiff 1", "'--t_max_diff'"}}) {
    const Answer answer = credo(c.arguments);
    EXPECT_EQ(answer.status, 2) << c.arguments;
    EXPECT_THAT(answer.error, AllOf(HasSubstr("did you mean"), HasSubstr(c.nearest))) << c.arguments;
  }
}

TEST_F(Command, WrongInputEndsWithStatusOneAndSaysWhere) {
  write("bad.tum", "0 0 0 0 0 0 0 1\n1 0 0 zero 0 0 0 1\n");
  write("ref.tum", "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
  struct Case {
    const char *arguments, *expected;
  };
  for (const Case& c : {Case{"run missing", "missing"},
                        {"info missing", "missing"},
                        {"map missing", "missing"},
                        {"simulate missing --out out", "office"},
                        {"simulate office --kind hall --out out", "--kind is for the world 'random'"},
                        {"evaluate ape ref.tum bad.tum", "bad.tum:2:"},
                        {"evaluate score ref.tum missing", "missing"},
                        {"evaluate map ref.tum missing", "missing"}}) {
    const Answer answer = credo(c.arguments);
    EXPECT_EQ(answer.status, 1) << c.arguments;
    EXPECT_THAT(answer.error, AllOf(StartsWith("credo: error: "), HasSubstr(c.expected))) << c.arguments;
    EXPECT_EQ(answer.out, "") << c.arguments;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Command, APlaceThatCannotBeWrittenToIsNamed) {
  write_small_world();
  write("file", "x");
  for (const char* arguments :
       {"simulate small.yaml --out file/data", "simulate small.yaml --out file", "demo --out file"}) {
    const Answer answer = credo(arguments);
    EXPECT_EQ(answer.status, 1) << arguments;
    EXPECT_THAT(answer.error,
                AllOf(StartsWith("credo: error: "), HasSubstr("file"), Not(HasSubstr("filesystem error"))))
        << arguments;
  }
  EXPECT_EQ(read("file"), "x");
  write_fixture();
  const std::string line =
      "cd '" + folder_.string() + "' && '" CREDO_COMMAND "' evaluate ape ref.tum est.tum >/dev/full 2>.error";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 1);
  EXPECT_THAT(read(".error"), HasSubstr("standard output"));
}

TEST_F(Command, AnInterruptedCommandLeavesNothing) {
  for (const char* signal : {"INT", "TERM"}) {
    const std::string line = "cd '" + folder_.string() + "' && timeout --preserve-status -s " + signal +
                             " 1 '" CREDO_COMMAND "' simulate office --out data 2>.error";
    const int status = WEXITSTATUS(std::system(line.c_str()));
    EXPECT_EQ(status, std::string(signal) == "INT" ? 130 : 143);
    EXPECT_THAT(read(".error"), HasSubstr("interrupted"));
    EXPECT_FALSE(fs::exists(folder_ / "data"));
    EXPECT_FALSE(fs::exists(folder_ / ".data.unfinished"));
  }
}

TEST_F(Command, AnEmptyNameIsWrongUsage) {
  for (const char* arguments : {"run ''", "run data --out ''", "run data --pictures ''", "map ''", "map data --out ''",
                                "simulate ''", "simulate office --out ''", "demo --out ''", "info ''",
                                "evaluate score '' out", "evaluate ape ref.tum ''", "evaluate map data ''"}) {
    const Answer answer = credo(arguments);
    EXPECT_EQ(answer.status, 2) << arguments;
    EXPECT_THAT(answer.error, HasSubstr("found an empty name")) << arguments;
  }
}

TEST_F(Command, OnlyWorldsAreListedAsWorlds) {
  const Answer answer = credo("simulate README --out out");
  EXPECT_EQ(answer.status, 1);
  EXPECT_THAT(answer.error, AllOf(HasSubstr("demo"), HasSubstr("office"), testing::EndsWith("zhu\n")));
  EXPECT_THAT(answer.error.substr(answer.error.find("worlds that")), Not(HasSubstr("README")));
}

}  // namespace
