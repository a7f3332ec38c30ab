// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "datasets/format_error.hpp"
#include "datasets/text_file.hpp"
#include "tests/evaluation/campaign_worlds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace credo::evaluation {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const CampaignSpec kSpec{
    .worlds = {"small"}, .first_seed = 5, .seeds = 2, .degradations = {"nominal", "unknown_start"}};

class Campaign : public testing::Test {
 protected:
  [[nodiscard]] CampaignFolder folder(const char* name, const CampaignSpec& spec = kSpec,
                                      const std::string& config = "program: 1\n", bool anew = false) const {
    return CampaignFolder::to_run(temporary_ / name, spec, config, anew);
  }
  [[nodiscard]] std::map<std::string, std::string> run_files(const char* name) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(temporary_ / name / "runs"))
      files[entry.path().filename().string()] = datasets::read_text_file(entry.path());
    return files;
  }
  [[nodiscard]] static std::string complaint(const std::function<void()>& work) {
    try {
      work();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  }
  tests::TemporaryFolder temporary_;
};

TEST_F(Campaign, LeavesTheSameFilesWhateverTheNumberOfThreads) {
  (void)run_campaign(folder("one"), tests::small_world_of, {.threads = 1});
  (void)run_campaign(folder("three"), tests::small_world_of, {.threads = 3});
  EXPECT_EQ(run_files("one").size(), 4U);
  EXPECT_EQ(run_files("one"), run_files("three"));
}

TEST_F(Campaign, GoesOnWhereItStopped) {
  (void)run_campaign(folder("whole"), tests::small_world_of, {});
  const CampaignProgress first = run_campaign(folder("parts"), tests::small_world_of, {.most_runs = 1});
  EXPECT_EQ(first.finished, 1U);
  EXPECT_EQ(run_files("parts").size(), 1U);
  EXPECT_EQ(run_campaign(folder("parts"), tests::small_world_of, {}).finished, 3U);
  EXPECT_EQ(run_files("parts"), run_files("whole"));
  EXPECT_EQ(run_campaign(folder("parts"), tests::small_world_of, {}).missing, 0U);
}

TEST_F(Campaign, ThatIsInterruptedKeepsWhatIsFinishedAndNothingElse) {
  int checks = 0;
  const CampaignWatch interrupted{.check = [&] {
    if (++checks > 15) throw std::runtime_error("stop");
  }};
  EXPECT_EQ(complaint([&] { (void)run_campaign(folder("parts"), tests::small_world_of, {}, interrupted); }), "stop");
  const auto left = run_files("parts");
  EXPECT_LT(left.size(), 4U);
  (void)run_campaign(folder("whole"), tests::small_world_of, {});
  const auto whole = run_files("whole");
  for (const auto& [name, text] : left) EXPECT_EQ(text, whole.at(name));
}

TEST_F(Campaign, FindsOutWhereTheRobotIsAndWhatItWasTold) {
  const CampaignFolder place = folder("a");
  (void)run_campaign(place, tests::small_world_of, {});
  const std::vector<CampaignRun> runs = finished_runs(place);
  ASSERT_EQ(runs.size(), 4U);
  const CampaignRun &told = runs[0], &untold = runs[1];
  EXPECT_EQ(told.key, (RunKey{"small", 5, "nominal"}));
  ASSERT_EQ(told.rows.size(), 9U);
  EXPECT_TRUE(told.rows.front().events.empty());
  EXPECT_TRUE(untold.rows.front().has_event(kToldNothing));
  EXPECT_TRUE(untold.rows.front().decidable.has_value());
  EXPECT_FALSE(untold.rows.back().decidable.has_value());
  EXPECT_NEAR(told.rows.back().travelled_m, 2.4, 0.05);
  EXPECT_NEAR(told.rows.back().sample.truth.x, 3.2, 0.01);
  EXPECT_LT(told.rows.back().sample.position_m(), 0.1);
  const ClassedMatchCounts& matches = told.rows.back().matches;
  EXPECT_GT(matches.total().matches, matches.classes.back().matches) << "points, too";
  EXPECT_GT(matches.classes.back().matches, 0) << "walls, too";
}

TEST_F(Campaign, RunFilesKeepTheMatchesOfEachClassApart) {
  CampaignRow row;
  row.sample.localization.estimate.covariance.setIdentity();
  row.matches.classes = {{{.matches = 9, .wrong = 3}, {.matches = 8, .wrong = 2}, {.matches = 7, .wrong = 1}, {6, 0}}};
  const RunKey key{"small", 5, "nominal"};
  write_run(temporary_ / "run.csv", {.key = key, .rows = {row}, .refused = ""});
  EXPECT_EQ(read_run(temporary_ / "run.csv", key).rows.front().matches.classes, row.matches.classes);
  EXPECT_THAT(
      datasets::read_text_file(temporary_ / "run.csv"),
      testing::AllOf(HasSubstr(fault_class_name(1) + ",wrong_" + fault_class_name(1)), HasSubstr("9,3,8,2,7,1,6,0")));
}

TEST_F(Campaign, AWorldThatCannotBeMadeIsARefusedRun) {
  const CampaignSpec spec{.worlds = {"broken", "small"}, .seeds = 1};
  const CampaignFolder place = folder("a", spec);
  EXPECT_EQ(run_campaign(place, tests::small_world_of, {}).finished, 2U);
  const std::vector<CampaignRun> runs = finished_runs(place);
  EXPECT_EQ(runs[0].refused, "no way through");
  EXPECT_TRUE(runs[0].rows.empty());
  EXPECT_TRUE(runs[1].refused.empty());
}

TEST_F(Campaign, ReportsProgressUpToTheEnd) {
  std::vector<double> shares;
  const CampaignWatch watch{.progress = [&](const CampaignProgress& p) { shares.push_back(p.share); }};
  (void)run_campaign(folder("a"), tests::small_world_of, {.threads = 2}, watch);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_NEAR(shares.back(), 1.0, 1e-9);
}

TEST_F(Campaign, NotesTimesBesideWhatIsTheSameEveryTime) {
  double now = 0.0;
  const CampaignFolder place = folder("a");
  (void)run_campaign(place, tests::small_world_of, {}, {.thread_seconds = [&] { return now += 0.25; }});
  const auto times = times_of(place);
  EXPECT_EQ(times.size(), 4U);
  EXPECT_NEAR(times.at("small-5-nominal"), 0.25, 1e-6);
}

TEST_F(Campaign, IsNotMixedWithAnother) {
  (void)run_campaign(folder("a"), tests::small_world_of, {.most_runs = 1});
  CampaignSpec other = kSpec;
  other.seeds = 3;
  EXPECT_THAT(complaint([&] { (void)folder("a", other); }),
              testing::AllOf(HasSubstr("another specification"), HasSubstr("--force")));
  EXPECT_THAT(complaint([&] { (void)folder("a", kSpec, "program: 2\n"); }), HasSubstr("another program"));
  EXPECT_EQ(run_files("a").size(), 1U);
  (void)folder("a", other, "program: 2\n", true);
  EXPECT_EQ(run_files("a").size(), 0U);
}

TEST_F(Campaign, NeverTakesAFolderOfSomethingElse) {
  temporary_.write("other/letter.txt", "dear");
  EXPECT_THAT(complaint([&] { (void)folder("other", kSpec, "", true); }), HasSubstr("holds no campaign"));
  EXPECT_TRUE(fs::exists(temporary_ / "other/letter.txt"));
  EXPECT_THAT(complaint([&] { (void)CampaignFolder::to_read(temporary_ / "other"); }),
              testing::AllOf(HasSubstr("holds no campaign"), HasSubstr("credo campaign SPEC --out")));
}

TEST_F(Campaign, RunFilesAreReadWithSuspicion) {
  const CampaignFolder place = folder("a");
  (void)run_campaign(place, tests::small_world_of, {.most_runs = 1});
  const fs::path file = place.file_of({"small", 5, "nominal"});
  std::string text = datasets::read_text_file(file);
  text.replace(text.find(",0,,\n"), 5, ",x,,\n");
  datasets::write_file_whole(file, text);
  EXPECT_THAT(complaint([&] { (void)finished_runs(place); }), HasSubstr("expected a number in column 'degraded'"));
}

}  // namespace
}  // namespace credo::evaluation
