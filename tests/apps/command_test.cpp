// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/apps/command.hpp"

namespace {

namespace fs = std::filesystem;
using credo::tests::Answer;
using credo::tests::Command;
using credo::tests::text_of;
using nlohmann::json;
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

TEST_F(Command, ApePrintsEvosBlock) {
  write_fixture();
  const Answer answer = credo("evaluate ape ref.tum est.tum");
  EXPECT_EQ(answer.status, 0) << answer.error;
  EXPECT_EQ(answer.out,
            "Found 5 of max. 5 possible matching timestamps between...\n\tref.tum\nand:\test.tum\n"
            "..with max. time diff.: 0.01 (s) and time offset: 0.0 (s).\n\n"
            "APE w.r.t. translation part (m)\n(not aligned)\n\n"
            "       max\t0.223607\n      mean\t0.133006\n    median\t0.100000\n       min\t0.100000\n"
            "      rmse\t0.141421\n       sse\t0.100000\n       std\t0.048057\n");
}

TEST_F(Command, FlagsAreEvos) {
  write_fixture();
  EXPECT_THAT(credo("evaluate ape ref.tum est.tum -a").out, AllOf(HasSubstr("Umeyama"), HasSubstr("rmse\t0.083684")));
  EXPECT_THAT(credo("evaluate ape ref.tum est.tum --align_origin").out, HasSubstr("rmse\t0.118322"));
  EXPECT_THAT(credo("evaluate ape ref.tum est.tum -r angle_deg").out, HasSubstr("rmse\t2.910265"));
  EXPECT_THAT(credo("evaluate rpe ref.tum est.tum").out, HasSubstr("rmse\t0.134735"));
  EXPECT_THAT(credo("evaluate rpe ref.tum est.tum -r angle_deg").out, HasSubstr("rmse\t3.822105"));
  EXPECT_THAT(credo("evaluate rpe ref.tum est.tum -d 2 -u m --all_pairs --pairs_from_reference").out,
              AllOf(HasSubstr("for delta = 2.0 (m) using all pairs"), HasSubstr("rmse\t0.122836")));
}

TEST_F(Command, JsonIsForMachinesAndTheGateFails) {
  write_fixture();
  const json ape = json::parse(credo("evaluate ape ref.tum est.tum --format json").out);
  EXPECT_NEAR(ape["statistics"]["rmse"].get<double>(), 0.141421, 1e-6);
  EXPECT_EQ(ape["errors"].size(), 5u);
  EXPECT_EQ(credo("evaluate ape ref.tum est.tum --fail_above rmse=0.2").status, 0);
  EXPECT_EQ(credo("evaluate ape ref.tum est.tum --fail_above rmse=0.1").status, 1);
  for (const char* gate : {"mode=1", "rmse", "rmse=", "=1", "rmse=one", "''"}) {
    const Answer answer = credo("evaluate ape ref.tum est.tum --fail_above " + std::string(gate));
    EXPECT_EQ(answer.status, 2) << gate;
    EXPECT_EQ(answer.out, "") << gate;
    EXPECT_THAT(answer.error, HasSubstr("STATISTIC=VALUE")) << gate;
  }
  const json traj = json::parse(credo("evaluate traj est.tum --ref ref.tum --format json").out);
  EXPECT_EQ(traj[0]["poses"], 5);
  EXPECT_NEAR(traj[0]["ape_rmse_m"].get<double>(), 0.141421, 1e-6);
}

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
                           "map.yaml", "map.pgm", "map_belief.tiff", "config.yaml", "calibration.yaml",
                           "pictures/errors.png", "pictures/beliefs.png", "pictures/map.png"}) {
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

TEST_F(Command, IntegrityAndConsistencyPoolRuns) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out lists/data").status, 0);
  ASSERT_EQ(credo("run lists/data --out lists/run").status, 0);
  write("lists/runs.txt", "# twice the same\ndata run\n\ndata\trun  # again\n");
  const json one = json::parse(credo("evaluate integrity lists/data lists/run --format json").out);
  const json two = json::parse(credo("evaluate integrity --runs lists/runs.txt --format json").out);
  EXPECT_EQ(two["runs"], 2);
  EXPECT_EQ(two["placed"]["count"], 2 * one["placed"]["count"].get<int>());
  EXPECT_NEAR(two["figures"]["brier"].get<double>(), one["figures"]["brier"].get<double>(), 1e-12);

  const Answer text = credo("evaluate integrity --runs lists/runs.txt --pictures pictures --fail_above lost=0");
  EXPECT_EQ(text.status, 0) << text.error;
  EXPECT_THAT(text.out, AllOf(StartsWith("Integrity of 2 runs"), HasSubstr("meets [Bel, Pl]")));
  for (const char* name : {"detection", "calibration", "risk"})
    EXPECT_TRUE(fs::exists(folder_ / "pictures" / (std::string(name) + ".png"))) << name;
  EXPECT_THAT(credo("evaluate integrity --runs lists/runs.txt --pictures pictures").error,
              HasSubstr("pictures: is there already"));

  ASSERT_EQ(credo("evaluate nees lists/data lists/run --pictures nees").status, 0);
  for (const char* name : {"anees", "errors"})
    EXPECT_TRUE(fs::exists(folder_ / "nees" / (std::string(name) + ".png"))) << name;
}

TEST_F(Command, GatesOfIntegrityFailBelowAndWhereNothingIsKnown) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  ASSERT_EQ(credo("run data --out run").status, 0);
  EXPECT_EQ(credo("evaluate integrity data run --fail_below lost=0").status, 0);
  const Answer below = credo("evaluate integrity data run --fail_below lost=0.5");
  EXPECT_EQ(below.status, 1);
  EXPECT_THAT(below.error, HasSubstr("--fail_below lost=0.5: lost is 0.000000"));
  const Answer unknown = credo("evaluate integrity data run --fail_below auroc=0.9");
  EXPECT_EQ(unknown.status, 1);
  EXPECT_THAT(unknown.error, HasSubstr("auroc is not known"));
  EXPECT_EQ(credo("evaluate nees data run --fail_above mean=0").status, 1);
}

TEST_F(Command, AListOfRunsThatCannotBeReadIsNamedWithTheLine) {
  write("half.txt", "# runs\ndata run\ndata\n");
  write("empty.txt", "# none\n");
  for (const char* command : {"integrity", "nees"}) {
    const std::string evaluate = std::string("evaluate ") + command + " --runs ";
    EXPECT_THAT(credo(evaluate + "half.txt").error, HasSubstr("half.txt:3: expected a reference and a result"));
    EXPECT_THAT(credo(evaluate + "empty.txt").error, HasSubstr("empty.txt: lists no run"));
    EXPECT_THAT(credo(evaluate + "missing.txt").error, HasSubstr("missing.txt: cannot be read"));
    EXPECT_EQ(credo(evaluate + "half.txt").status, 1);
  }
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

TEST_F(Command, PosesOfAnotherDriveAreNoMap) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  write("other.tum", "5 0 0 0 0 0 0 1\n6 1 0 0 0 0 0 1\n");
  const Answer answer = credo("map data --poses other.tum --out out");
  EXPECT_EQ(answer.status, 1);
  EXPECT_THAT(answer.error, AllOf(HasSubstr("other.tum from 5.0"), HasSubstr("same drive")));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  write("other.tum", "1600000000 0 0 0 0 0 0 1\n1600000003 1 0 0 0 0 0 1\n");
  const Answer partly = credo("map data --poses other.tum --out out");
  EXPECT_EQ(partly.status, 0) << partly.error;
  EXPECT_THAT(partly.error, AllOf(HasSubstr("warning"), HasSubstr("have no pose near in time")));
  EXPECT_EQ(credo("map data --sensors camera --out out2").status, 2);
}

/// A laser and three transducers; the robot stands still in a corner.
constexpr const char* kLogWithSonar =
    "ODOM 0 0 0 0 0 0 1 host 1\nSONAR 0.5 3 1.2 1.4 2.5 0 0 0 0 0 1.57 0 0 -1.57 1.1 host 1.1\n"
    "FLASER 4 1.5 1.4 1.3 1.2 0 0 0 0 0 0 1.2 host 1.2\n"
    "ODOM 0 0 0 0 0 0 1.3 host 1.3\nFLASER 4 1.5 1.4 1.3 1.2 0 0 0 0 0 0 1.4 host 1.4\n";

TEST_F(Command, OfALogOnlyTheSensorsAskedForAreMapped) {
  write("log", kLogWithSonar);
  const auto mapped = [&](const std::string& sensors) {
    const Answer answer = credo("map log --force --out out --format json --sensors " + sensors);
    EXPECT_EQ(answer.status, 0) << sensors << ": " << answer.error;
    const json report = json::parse(answer.out, nullptr, false);
    return answer.status == 0 ? std::pair(report["scans"].get<int>(), report["sonar_sweeps"].get<int>())
                              : std::pair(-1, -1);
  };
  EXPECT_EQ(mapped("range"), std::pair(2, 0));
  EXPECT_EQ(mapped("sonar"), std::pair(0, 1));
  EXPECT_EQ(mapped("range,sonar"), std::pair(2, 1));
  write("blind.log", "FLASER 4 1.5 1.4 1.3 1.2 0 0 0 0 0 0 1.2 host 1.2\n");
  for (const char* more : {"", " --poses blind.tum"}) {
    write("blind.tum", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
    const Answer answer = credo("map blind.log --sensors sonar --out none" + std::string(more));
    EXPECT_EQ(answer.status, 1) << more;
    EXPECT_THAT(answer.error, HasSubstr("blind.log: holds no reading of the sensors")) << more;
    EXPECT_FALSE(fs::exists(folder_ / "none")) << more;
  }
}

TEST_F(Command, ALogThatFillsTheRangeOfItsCellsIsMappedWithAWarning) {
  std::string log;
  for (int k = 0; k < 1000; ++k) {  // the same wall, seen from two places in turn
    const std::string x = k % 2 == 0 ? "0" : "0.5", time = std::to_string(1.0 + 0.1 * k);
    log += "FLASER 4 2 2 2 2 " + x + " 0 0 " + x + " 0 0 " + time + " host " + time + '\n';
  }
  write("log", log);
  const Answer answer = credo("map log --out out");
  EXPECT_EQ(answer.status, 0) << answer.error;
  EXPECT_THAT(answer.error, HasSubstr("tiles of the map have a cell that has reached the end of its range"));
}

TEST_F(Command, AResolutionTooFineForTheSensorsIsRefused) {
  write_small_world();
  write("small.yaml", std::regex_replace(read("small.yaml"), std::regex("opensimple,"), "opensimple, range_max: 8,"));
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  for (const char* command : {"run", "map"}) {
    const Answer answer = credo(std::string(command) + " data --resolution 0.0015 --out out");
    EXPECT_EQ(answer.status, 1) << command;
    EXPECT_THAT(answer.error, AllOf(HasSubstr("data: range finder"), HasSubstr("choose one between"))) << command;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << command;
  }
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
  EXPECT_EQ(pictures("beside").size(), 9u);
  for (const char* name : {"beside/notes.txt", "beside/planet_7.png", "beside/scan_of_mine.png"}) write(name, "x");
  ASSERT_EQ(credo("run data --out out --pictures beside --moments 1 --force").status, 0);
  EXPECT_EQ(pictures("beside").size(), 8u);
  ASSERT_EQ(credo("map data --out out --pictures beside --force").status, 0);
  EXPECT_EQ(pictures("beside"), (std::set<std::string>{"map.png", "notes.txt", "planet_7.png", "scan_of_mine.png"}));
  ASSERT_EQ(credo("map data --out out --pictures out/pictures --force").status, 0);
  ASSERT_EQ(credo("map data --out out --force").status, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/pictures"));
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

TEST_F(Command, AnEmptyNameIsWrongUsage) {
  for (const char* arguments : {"run ''", "run data --out ''", "run data --pictures ''", "map ''", "map data --out ''",
                                "simulate ''", "simulate office --out ''", "demo --out ''", "info ''",
                                "evaluate score '' out", "evaluate ape ref.tum ''", "evaluate map data ''"}) {
    const Answer answer = credo(arguments);
    EXPECT_EQ(answer.status, 2) << arguments;
    EXPECT_THAT(answer.error, HasSubstr("found an empty name")) << arguments;
  }
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

TEST_F(Command, OnlyWorldsAreListedAsWorlds) {
  const Answer answer = credo("simulate README --out out");
  EXPECT_EQ(answer.status, 1);
  EXPECT_THAT(answer.error, AllOf(HasSubstr("demo"), HasSubstr("office"), testing::EndsWith("office\n")));
  EXPECT_THAT(answer.error.substr(answer.error.find("worlds that")), Not(HasSubstr("README")));
}

TEST_F(Command, AMapThatWouldOutgrowItsLimitIsRefusedBeforeTheWork) {
  write_small_world();
  write("small.yaml", std::regex_replace(std::regex_replace(read("small.yaml"), std::regex("outline: .*\n"),
                                                            "outline: [[0, 0], [24, 0], [24, 6], [0, 6]]\n"),
                                         std::regex("path: .*\n"), "path: [[1, 2], [23, 2], [23, 4], [1, 4]]\n"));
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
#ifdef __SANITIZE_ADDRESS__
  const std::string limit;  // the sanitizer's own memory does not fit
#else
  const std::string limit = "ulimit -v 700000 && ";
#endif
  const std::string limited = "cd '" + folder_.string() + "' && " + limit +
                              "'" CREDO_COMMAND "' map data --resolution 0.001 --sensors range --out out/map 2>.error";
  EXPECT_EQ(WEXITSTATUS(std::system(limited.c_str())), 1);
  EXPECT_THAT(read(".error"), AllOf(HasSubstr("data: the readings are from "),
                                    HasSubstr("67108864 cells that a map may have at a resolution of 0.001 m"),
                                    HasSubstr("choose one of 0.002 m or coarser")));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Command, ATruncatedTrueMapIsFoundByInfoAndEvaluation) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  ASSERT_EQ(credo("map data --out map").status, 0);
  fs::resize_file(folder_ / "data/truth_map.pgm", fs::file_size(folder_ / "data/truth_map.pgm") / 2);
  for (const char* arguments : {"info data", "evaluate map data map"}) {
    const Answer answer = credo(arguments);
    EXPECT_EQ(answer.status, 1) << arguments;
    EXPECT_THAT(answer.error, AllOf(StartsWith("credo: error: "), HasSubstr("truth_map.pgm: the picture is cut short")))
        << arguments;
  }
}

TEST_F(Command, PosesRelativeToTheStartHaveNoScore) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  ASSERT_EQ(credo("run data --out good").status, 0);
  std::string far;
  for (int i = 0; i < 10000; ++i) far += std::to_string(1600000000.0 + 0.01 * i) + " 90 0 0 0 0 0 1\n";
  write("far.tum", far);
  const Answer elsewhere = credo("evaluate score far.tum good --format json");
  EXPECT_EQ(elsewhere.status, 0) << elsewhere.error;
  EXPECT_THAT(elsewhere.error, HasSubstr("is far.tum the truth of good?"));
  EXPECT_EQ(credo("evaluate score data good").error, "");
  fs::remove(folder_ / "data/floor_plan.yaml");
  ASSERT_EQ(credo("run data --out relative").status, 0);
  const Answer answer = credo("evaluate score data relative");
  EXPECT_EQ(answer.status, 1);
  EXPECT_EQ(answer.out, "");
  EXPECT_THAT(answer.error, AllOf(HasSubstr("relative: all acquisitions are initializing"), HasSubstr("evaluate rpe")));
}

TEST_F(Command, ARefusedRunLeavesNoFolder) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  EXPECT_EQ(credo("run data --resolution 9 --out new/newer/run").status, 1);
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

}  // namespace
