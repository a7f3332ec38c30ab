// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <utility>

#include "tests/apps/command.hpp"

namespace {

namespace fs = std::filesystem;
using credo::tests::Answer;
using credo::tests::Command;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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

TEST_F(Command, InstrumentsAreTrustedAsGivenOrAsJudged) {
  write("log", kLogWithSonar);
  ASSERT_EQ(credo("map log --sensors range --out laser").status, 0);
  ASSERT_EQ(credo("map log --out deaf --reliability sonar=0.5,sonar/0=0").status, 0);
  EXPECT_EQ(read("deaf/map_belief.tiff"), read("laser/map_belief.tiff"));
  EXPECT_THAT(read("deaf/config.yaml"), HasSubstr("transducers: [0, 0, 0]"));
  ASSERT_EQ(credo("map log --out given --reliability range=0.9,sonar=0.5,sonar/0/1=0.25").status, 0);
  EXPECT_THAT(read("given/config.yaml"),
              AllOf(HasSubstr("transducers: [0.5, 0.25, 0.5]"), HasSubstr("finders: [0.9]")));
  EXPECT_NE(read("given/map_belief.tiff"), read("laser/map_belief.tiff"));
  write("still.tum", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  EXPECT_EQ(credo("map log --poses still.tum --out judged --reliability judged --rule pcr2").status, 0);
  EXPECT_THAT(read("judged/config.yaml"), Not(HasSubstr("transducers: []")));
  EXPECT_THAT(credo("map log --sensors range --out none --reliability judged").error, HasSubstr("no other to judge"));
  for (const char* wrong : {"sonar", "sonar=2", "sonar=", "sonar=x", "camera=1", "sonar/9=1", "sonar/0/9=1",
                            "range/1=1", "sonar/x=1", "sonar/0/0/0=1", "range/0/0=1", "judged,sonar=1"}) {
    const Answer answer = credo("map log --out none --reliability " + std::string(wrong));
    EXPECT_EQ(answer.status, 1) << wrong;
    EXPECT_THAT(answer.error, HasSubstr("expected judged, or NAME=SHARE")) << wrong;
  }
  EXPECT_FALSE(fs::exists(folder_ / "none"));
}

/// From two places 300 m and 200 m apart: few tiles, but nobody knows before.
TEST_F(Command, InstrumentsThatNeedTooMuchMemoryAreMappedAndNotJudged) {
  const std::string far = "300 200 0 300 200 0 ";
  write("far.log", kLogWithSonar +
                       std::string("ODOM 300 200 0 0 0 0 2 host 2\nSONAR 0.5 3 1.2 1.4 2.5 0 0 0 0 0 1.57 0 0 "
                                   "-1.57 2.1 host 2.1\nFLASER 4 1.5 1.4 1.3 1.2 ") +
                       far + "2.2 host 2.2\nODOM 300 200 0 0 0 0 2.3 host 2.3\n");
  const Answer mapped = credo("map far.log --out mapped --format json");
  ASSERT_EQ(mapped.status, 0) << mapped.error;
  EXPECT_THAT(mapped.error, AllOf(HasSubstr("warning"), HasSubstr("are not judged"), HasSubstr("of the 4 instruments"),
                                  HasSubstr("more than 1 GB")));
  const json report = json::parse(mapped.out);
  EXPECT_TRUE(report["instruments"].empty());
  EXPECT_EQ(std::pair(report["scans"].get<int>(), report["sonar_sweeps"].get<int>()), std::pair(3, 2));
  const Answer large = credo("map far.log --out large --large");
  EXPECT_THAT(large.error, Not(HasSubstr("judged")));
  EXPECT_EQ(read("mapped/map.cgrid"), read("large/map.cgrid"));
  const Answer judged = credo("map far.log --out judged --reliability judged");
  EXPECT_EQ(judged.status, 1);
  EXPECT_THAT(judged.error, AllOf(HasSubstr("--reliability judged"), HasSubstr("coarser --resolution, or give")));
  EXPECT_FALSE(fs::exists(folder_ / "judged"));
}

TEST_F(Command, AMapOfNothingIsSaidToBeOne) {
  write("nothing.log", "FLASER 4 nan nan nan nan 0 0 0 0 0 0 1.2 host 1.2\n");
  const Answer answer = credo("map nothing.log --out out");
  EXPECT_EQ(answer.status, 0) << answer.error;
  EXPECT_THAT(answer.error, HasSubstr("no range could be mapped: 4 are nan"));
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

TEST_F(Command, AnyModelWithAnyRule) {
  ASSERT_EQ(credo("simulate demo --out data").status, 0);
  for (const char* with :
       {"--model zhu --rule adaptive", "--model lip --rule pcr2", "--model su --rule dempster_fold",
        "--model li2006 --printed --rule dsmc", "--rule dempster_float", "--rule changing --sensors range"}) {
    const Answer answer = credo("map data --sensors sonar --force --out map --pictures p " + std::string(with));
    EXPECT_EQ(answer.status, 0) << with << ": " << answer.error;
    EXPECT_TRUE(fs::exists(folder_ / "map" / "map_belief.tiff")) << with;
    EXPECT_TRUE(fs::exists(folder_ / "p" / "map.png")) << with;
  }
  for (const char* picture : {"map_since.png", "map_changes.png"}) EXPECT_TRUE(fs::exists(folder_ / "p" / picture));
  EXPECT_THAT(read("map/config.yaml"), AllOf(HasSubstr("\nrule: changing"), HasSubstr("model: li2007")));
  EXPECT_EQ(credo("map data --rule pcr7 --out none").status, 2);
  write("log", kLogWithSonar);
  EXPECT_THAT(credo("map log --rule pcr2 --out none").error, HasSubstr("give them with --poses"));
}

TEST_F(Command, ACellIsAskedWhatIsKnownOfItAndSinceWhen) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data --seed 3").status, 0);
  const Answer made = credo("map data --rule changing --sensors range --out changing");
  ASSERT_EQ(made.status, 0) << made.error;
  EXPECT_THAT(made.out, HasSubstr("settled cells; credo cell says since when"));
  ASSERT_EQ(credo("map data --sensors range --out sum").status, 0);
  std::istringstream history(read("changing/history.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(history, line) && std::getline(history, line));
  const std::string x = line.substr(0, line.find(',')), rest = line.substr(line.find(',') + 1);
  const std::string there = x + " " + rest.substr(0, rest.find(','));
  const json asked = json::parse(credo("cell changing " + there + " --format json").out);
  EXPECT_THAT(line, HasSubstr("," + asked["since"]["state"].get<std::string>() + ","));
  EXPECT_EQ(asked["state"], asked["since"]["state"]);
  EXPECT_NEAR(asked["BetP"]["empty"].get<double>() + asked["BetP"]["occupied"].get<double>(), 1.0, 1e-6);
  EXPECT_THAT(credo("cell changing " + there).out, HasSubstr(" since "));
  EXPECT_THAT(credo("cell sum " + there).out, AllOf(HasSubstr("DSmP"), Not(HasSubstr("since"))));
  for (const char* map : {"changing", "sum"}) {
    const Answer outside = credo(std::string("cell ") + map + " 5000 0");
    EXPECT_EQ(outside.status, 1);
    EXPECT_THAT(outside.error, HasSubstr("nothing was seen at (5000, 0)"));
  }
  EXPECT_THAT(credo("cell data/dataset.yaml 0 0").error, HasSubstr("expected a map.cgrid"));
}

TEST_F(Command, AMapByARuleIsNoSumToExport) {
  write("log", kLogWithSonar);
  ASSERT_EQ(credo("map log --sensors range --rule pcr2 --out ruled").status, 0);
  EXPECT_THAT(credo("export ruled --out none").error, HasSubstr("ruled: is a map by a rule, which is no sum"));
  EXPECT_FALSE(fs::exists(folder_ / "none"));
  for (const char* command : {"export nowhere --out none", "cell nowhere 0 0"})
    EXPECT_THAT(credo(command).error, HasSubstr("nowhere: is not there")) << command;
}

TEST_F(Command, ACellIsNotAskedOfAMapWhoseFilesDoNotFit) {
  write("log", kLogWithSonar);
  ASSERT_EQ(credo("map log --sensors range --rule pcr2 --out ruled").status, 0);
  ASSERT_EQ(credo("cell ruled 0.5 0").status, 0);
  const std::string where = read("ruled/map.yaml");
  write("ruled/map.yaml", std::regex_replace(where, std::regex(R"((origin: .*), [^,]*\])"), "$1, 0.5]"));
  EXPECT_THAT(credo("cell ruled 0.5 0").error, HasSubstr("map.yaml: the origin's yaw is 0.5"));
  write("ruled/map.yaml", where);
  write("ruled/map.pgm", "P5\n1 1\n255\n0");
  EXPECT_THAT(credo("cell ruled 0.5 0").error, HasSubstr("but map.yaml's picture is 1 x 1"));
}

TEST_F(Command, AnOptionOfAMapThatWouldHaveNoEffectIsRefused) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data --seed 3").status, 0);
  for (const auto& [with, said] :
       {std::pair{"--model su --printed", "one form only of 'su'; there are two of li2007, li2006, lip, bayes"},
        std::pair{"--laser-model calibrated --printed",
                  "one form only of 'calibrated'; there are two of li2006, bayes"},
        std::pair{"--sensors range --model zhu", "--model: is of the sonar, which --sensors range leaves out"},
        std::pair{"--sensors sonar --laser-model bayes", "--laser-model: is of the range finders"},
        std::pair{"--sensors range --sonar-weights nofile", "--sonar-weights: is of the sonar"},
        std::pair{"--sensors sonar --laser-weights nofile", "--laser-weights: is of the range finders"},
        std::pair{"--sonar-weights nofile", "add --model calibrated"},
        std::pair{"--laser-weights nofile", "add --laser-model calibrated"},
        std::pair{"--rule pcr2 --readout raw", "as they are"}, std::pair{"--rule pcr2 --large", "read out at once"}}) {
    const Answer answer = credo(std::string("map data --out none ") + with);
    EXPECT_EQ(answer.status, 1) << with;
    EXPECT_THAT(answer.error, HasSubstr(said));
    EXPECT_FALSE(fs::exists(folder_ / "none"));
  }
}

/// Bayesian masses leave no ignorance and DSmC's hold the conflict: both are read as the maps that they are.
TEST_F(Command, MapsOfEveryRuleAreScoredAndMakePlans) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data --seed 3").status, 0);
  for (const char* rule : {"dsmc", "bayes", "bayes_betp", "dempster_fold"}) {
    ASSERT_EQ(credo(std::string("map data --sensors range --force --out map --rule ") + rule).status, 0);
    const Answer score = credo("evaluate map data map --format json");
    ASSERT_EQ(score.status, 0) << rule << score.error;
    EXPECT_GT(json::parse(score.out)["accuracy"].get<double>(), 0.9) << rule << score.out;
    EXPECT_EQ(credo("plan map --force --out plan.yaml").status, 0) << rule;
  }
}

}  // namespace
