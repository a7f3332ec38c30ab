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

}  // namespace
