// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace credo::evaluation {
namespace {

using localization::Status;
using testing::HasSubstr;
using testing::StartsWith;

/// An acquisition that is `error_m` off in x.
CampaignRow row(double error_m, Status status = Status::kLocalized, double yes = 0.9) {
  CampaignRow row;
  row.sample.localization.estimate.pose.x = error_m;
  row.sample.localization.estimate.covariance.diagonal() << 0.01, 0.01, 0.01;
  row.sample.localization.belief = {.yes = yes, .no = 0.0, .unknown = 1.0 - yes};
  row.sample.localization.status = status;
  row.sample.localization.protection = {0.1, 0.2, 0.01, 0.02};
  return row;
}

CampaignRow with_event(CampaignRow row, std::string_view event, std::optional<bool> decidable = true) {
  row.events.emplace_back(event);
  row.decidable = decidable;
  return row;
}

const CampaignSpec kSpec{.worlds = {"a"}, .first_seed = 1, .seeds = 4, .degradations = {"nominal", "kidnap"}};

CampaignRun run_of(std::uint64_t seed, std::vector<CampaignRow> rows, const std::string& degradation = "nominal") {
  return {.key = {"a", seed, degradation}, .rows = std::move(rows), .refused = ""};
}

Measure measure_of(const std::vector<CampaignRun>& runs, const char* name) {
  return summarise(kSpec, runs).groups.back().measure(name);
}

double value_of(const std::vector<CampaignRun>& runs, const char* name) {
  return measure_of(runs, name).estimate->value;
}

TEST(CampaignSummary, AveragesOverAcquisitionsOfAllRuns) {
  const std::vector<CampaignRun> runs{run_of(1, {row(0.01), row(0.03)}), run_of(2, {row(0.08)})};
  EXPECT_NEAR(value_of(runs, "mean_position"), 0.04, 1e-12);
  EXPECT_NEAR(value_of(runs, "p95_position"), 0.08, 1e-12);
  EXPECT_EQ(measure_of(runs, "mean_position").cases, 3);
}

TEST(CampaignSummary, ErrorsAreOfPosesInTheMapOnly) {
  const std::vector<CampaignRun> runs{run_of(1, {row(7.0, Status::kInitializing), row(0.02)})};
  EXPECT_NEAR(value_of(runs, "mean_position"), 0.02, 1e-12);
  EXPECT_EQ(value_of(runs, "lost"), 0.0);
  EXPECT_EQ(value_of(runs, "available"), 0.5);
  EXPECT_EQ(value_of(runs, "false_alert"), 0.0);
}

TEST(CampaignSummary, UsesTheWordsOfEveryTable) {
  CampaignRow degraded = row(0.1, Status::kUncertain);
  degraded.sample.degraded = true;
  const std::vector<CampaignRun> runs{
      run_of(1, {row(0.01), row(0.26), row(0.31), row(0.1, Status::kUncertain), degraded, row(0.5, Status::kLost, 0.1),
                 row(0.3, Status::kLocalized, 0.8), row(0.19), row(0.21), row(0.05)})};
  EXPECT_NEAR(value_of(runs, "lost"), 0.4, 1e-12);
  EXPECT_NEAR(value_of(runs, "false_alert"), 0.1, 1e-12);
  EXPECT_NEAR(value_of(runs, "confidently_wrong"), 0.1, 1e-12);
  EXPECT_NEAR(value_of(runs, "confidently_right"), 0.5, 1e-12);
  EXPECT_NEAR(value_of(runs, "available"), 0.7, 1e-12);
  EXPECT_NEAR(value_of(runs, "misleading"), 0.4, 1e-12);  // 0.26, 0.31, 0.3 and 0.21 are above 0.2
}

TEST(CampaignSummary, WithoutProtectionLevelsNothingIsAvailable) {
  CampaignRow unmonitored = row(0.01);
  unmonitored.sample.localization.protection = {};
  EXPECT_EQ(value_of({run_of(1, {unmonitored})}, "available"), 0.0);
}

TEST(CampaignSummary, CountsWrongMatchesAmongAll) {
  CampaignRow a = row(0.0), b = row(0.0);
  a.matches.classes = {{{.matches = 3, .wrong = 1}, {.matches = 7, .wrong = 0}}};
  b.matches.classes.back() = {.matches = 30, .wrong = 0};
  EXPECT_NEAR(value_of({run_of(1, {a}), run_of(2, {b})}, "wrong_matches"), 1.0 / 40, 1e-12);
}

TEST(CampaignSummary, CountsMatchesByClassInEveryGroup) {
  CampaignRow a = row(0.0), b = row(0.0);
  a.matches.classes = {{{.matches = 3, .wrong = 1}, {.matches = 7, .wrong = 0}}};
  b.matches.classes = {{{.matches = 4, .wrong = 2}}};
  const CampaignSummary summary = summarise(kSpec, std::vector{run_of(1, {a, a}), run_of(1, {b}, "kidnap")});
  EXPECT_EQ(summary.groups[0].matches.classes[0], (MatchCounts{.matches = 6, .wrong = 2}));
  EXPECT_EQ(summary.groups[0].matches.classes[1], (MatchCounts{.matches = 14, .wrong = 0}));
  EXPECT_EQ(summary.groups[1].matches.classes[0], (MatchCounts{.matches = 4, .wrong = 2}));
  EXPECT_EQ(summary.groups[2].matches.classes[0], (MatchCounts{.matches = 10, .wrong = 4}));
  EXPECT_EQ(summary.groups[2].matches.classes.back(), MatchCounts{});
}

TEST(CampaignSummary, CountsFaultsWhereNothingElseSpeaksAgainstThePose) {
  CampaignRow trusted = row(0.0), doubted = row(0.0), together = row(0.0);
  trusted.matches.classes = {{{.matches = 8, .wrong = 2}}};
  trusted.matches.classes.back() = {.matches = 1, .wrong = 1};  // a wall is no point
  together.matches.classes = {{{.matches = 4, .wrong = 2}, {.matches = 4, .wrong = 1}}};
  doubted.matches.classes = {{{.matches = 5, .wrong = 5}}};
  doubted.sample.localization.status = localization::Status::kUncertain;
  const std::vector runs{run_of(1, {trusted, together, doubted, doubted, row(0.0)})};
  EXPECT_EQ(summarise(kSpec, runs).groups[0].matches.total(), (MatchCounts{.matches = 17, .wrong = 6}));
  EXPECT_DOUBLE_EQ(value_of(runs, "points_together"), 0.5);
}

TEST(CampaignSummary, AKidnappedRobotMustNoticeAndRecover) {
  const CampaignRow away = row(2.0), lost = row(2.0, Status::kLost), right = row(0.0);
  const auto kidnapped = with_event(away, kKidnapped);
  const std::vector<CampaignRun> runs{
      run_of(1, {right, kidnapped, away, lost, right}),         // noticed as the third, recovered
      run_of(2, {right, kidnapped, away, away, lost, right}),   // noticed too late
      run_of(3, {right, kidnapped, lost}),                      // the drive ends before anything is decided
      run_of(4, {with_event(away, kKidnapped, false), away})};  // not to be told from another place
  EXPECT_EQ(measure_of(runs, "displaced_alert").cases, 3);
  EXPECT_NEAR(value_of(runs, "displaced_alert"), 2.0 / 3, 1e-12);
  EXPECT_EQ(measure_of(runs, "displaced_recovered").cases, 2);
  EXPECT_NEAR(value_of(runs, "displaced_recovered"), 1.0, 1e-12);
}

TEST(CampaignSummary, RecoveryAfterTheTenthComesTooLate) {
  std::vector<CampaignRow> rows(10, row(2.0, Status::kLost));
  rows[0] = with_event(rows[0], kToldWrong);
  rows.push_back(row(0.0));
  EXPECT_EQ(value_of({run_of(1, rows)}, "displaced_recovered"), 0.0);
  rows.erase(rows.begin() + 5);
  EXPECT_EQ(value_of({run_of(1, rows)}, "displaced_recovered"), 1.0);
}

TEST(CampaignSummary, AStartThatIsNotToldIsToBeFoundAndNeverGuessed) {
  const CampaignRow start = with_event(row(9.0, Status::kInitializing), kToldNothing);
  CampaignRow late = row(0.0);
  late.travelled_m = 5.1;
  const std::vector<CampaignRun> runs{run_of(1, {start, row(0.0)}), run_of(2, {start, late}),
                                      run_of(3, {start, row(3.0), row(0.0)}),
                                      run_of(4, {with_event(start, "", false), row(3.0)})};
  EXPECT_NEAR(value_of(runs, "start_never_wrong"), 2.0 / 3, 1e-12);
  EXPECT_NEAR(value_of(runs, "start_resolved"), 2.0 / 3, 1e-12);
  EXPECT_EQ(measure_of(runs, "start_resolved").cases, 3);
  EXPECT_EQ(value_of(runs, "start_undecidable_never_wrong"), 0.0);
}

TEST(CampaignSummary, ConsistencyIsByIndexOverRunsOfOneWorld) {
  // NEES 1 and 9: their mean of 5 is inside the bounds of 2 runs (0.41 to 14.4 / 2), that of 100 and 100 is not.
  const std::vector<CampaignRun> runs{run_of(1, {row(0.1), row(1.0)}), run_of(2, {row(0.3), row(1.0)})};
  EXPECT_NEAR(value_of(runs, "anees_inside"), 0.5, 1e-12);
  EXPECT_NEAR(value_of(runs, "nees"), (1.0 + 9.0 + 100.0 + 100.0) / 4, 1e-9);
  EXPECT_FALSE(measure_of({runs[0]}, "anees_inside").estimate);
}

TEST(CampaignSummary, GroupsByDegradationAndListsTheWorstFirst) {
  const std::vector<CampaignRun> runs{run_of(1, {row(0.01)}),
                                      run_of(1, {row(0.02), row(0.4)}, "kidnap"),
                                      run_of(2, {row(0.04, Status::kLost)}),
                                      {.key = {"a", 3, "nominal"}, .rows = {}, .refused = "no room"}};
  const CampaignSummary summary = summarise(kSpec, runs);
  ASSERT_EQ(summary.groups.size(), 3U);
  EXPECT_EQ(summary.groups[0].name, "nominal");
  EXPECT_EQ(summary.groups[0].runs, 2);
  EXPECT_EQ(summary.groups[0].refused, 1);
  EXPECT_EQ(summary.groups[1].misleading, 1);
  EXPECT_EQ(summary.groups[2].acquisitions, 4);
  EXPECT_EQ(summary.runs_wanted, 8U);
  ASSERT_EQ(summary.worst.size(), 3U);
  EXPECT_EQ(summary.worst[0].key.degradation, "kidnap");
  EXPECT_EQ(summary.worst[0].lost, 1);
  EXPECT_EQ(summary.worst[1].key.seed, 2U);
  EXPECT_EQ(summary.refused.front().refused, "no room");
}

TEST(CampaignSummary, IsATableOfNumbersAndEmptyFields) {
  CampaignRow only = row(0.01);
  only.matches.classes.back() = {.matches = 10, .wrong = 1};
  const std::string csv = to_csv(summarise(kSpec, std::vector{run_of(1, {only})}));
  EXPECT_THAT(csv, StartsWith("#group,runs,refused,acquisitions,mean_position [m],mean_position_low,"));
  EXPECT_THAT(csv, HasSubstr("\nnominal,1,0,1,0.01,,,"));
  EXPECT_THAT(csv, HasSubstr("\nkidnap,0,0,0,,,,"));
  EXPECT_THAT(csv, HasSubstr(",walls,wrong_walls,wrong_walls_share,wrong_walls_low,wrong_walls_high\n"));
  EXPECT_THAT(csv, HasSubstr(",0,0,,,,10,1,0.1,0.00252858,0.445016\n"));
  EXPECT_THAT(csv, HasSubstr(",0,0,,,,0,0,,,\n"));
}

}  // namespace
}  // namespace credo::evaluation
