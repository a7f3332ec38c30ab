// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/integrity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace credo::evaluation {
namespace {

using localization::Status;
using testing::HasSubstr;

/// Error in x and upper protection level of the position; the heading is right, and its level tight.
Sample sample(double error_m, double level_m, Status status = Status::kLocalized, double yes = 0.9) {
  Sample result;
  auto& l = result.localization;
  l.estimate.pose = {error_m, 0.0, 0.0};
  l.estimate.covariance.diagonal() << 0.01, 0.01, 0.01;
  l.belief = {.yes = yes, .no = 1.0 - yes, .unknown = 0.0};
  l.status = status;
  l.protection = {0.0, level_m, 0.0, 0.01};
  return result;
}

EvaluatedRun run(std::vector<Sample> samples) {
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i].localization.time = static_cast<sensors::Timestamp>(i) * 1'000'000'000;
  return {.name = "", .samples = std::move(samples), .events_known = true};
}

TEST(Integrity, RegionsOfTheDiagramAreThoseOfTheirDefinitions) {
  const std::vector<EvaluatedRun> runs{run({sample(0.1, 0.2), sample(0.1, 0.6), sample(0.3, 0.2), sample(0.6, 0.2),
                                            sample(0.1, 0.2, Status::kUncertain), sample(0.9, 0.7)})};
  const Integrity i = integrity(runs);
  EXPECT_EQ(i.position.in(ProtectionRegion::kNominal).count, 1U);
  EXPECT_EQ(i.position.in(ProtectionRegion::kUnavailable).count, 3U);
  EXPECT_EQ(i.position.in(ProtectionRegion::kMisleading).count, 1U);
  EXPECT_EQ(i.position.in(ProtectionRegion::kHazardous).count, 1U);
  EXPECT_EQ(i.heading.in(ProtectionRegion::kNominal).count, 5U);
  EXPECT_EQ(i.available->count, 3U);
  EXPECT_EQ(i.misleading->count, 2U);
}

TEST(Integrity, PoolsRunsAndCountsPosesThatAreNotInTheMapAsUnavailableOnly) {
  const std::vector<EvaluatedRun> runs{run({sample(9.0, 0.2, Status::kInitializing), sample(0.1, 0.2)}),
                                       run({sample(0.4, 0.6, Status::kLost, 0.1), sample(0.1, 0.2)})};
  const Integrity i = integrity(runs);
  EXPECT_EQ(i.runs, 2);
  EXPECT_EQ(i.placed.count, 3U);
  EXPECT_EQ(i.placed.of, 4U);
  EXPECT_EQ(i.lost.count, 1U);
  EXPECT_EQ(i.lost.of, 3U);
  EXPECT_NEAR(*i.available->share(), 0.5, 1e-12);
  EXPECT_EQ(i.false_alert.count, 0U);
  EXPECT_EQ(i.unnoticed.count, 0U);
  EXPECT_EQ(i.position.points.size(), 3U);
  EXPECT_NEAR(*i.detectors.front().curve.auroc, 1.0, 1e-12);
  EXPECT_NEAR(i.false_alarms.hours, 2.0 / 3600, 1e-12);
}

TEST(Integrity, WithoutAMonitorThereIsNoAvailability) {
  Sample blind = sample(0.1, 0.2);
  blind.localization.protection = {};
  const Integrity i = integrity(std::vector{run({blind})});
  EXPECT_FALSE(i.available);
  EXPECT_TRUE(i.position.points.empty());
  EXPECT_EQ(i.detectors.size(), 3U) << "no protection level";
  EXPECT_THAT(to_text(i), HasSubstr("no integrity monitor"));
}

TEST(Integrity, ALevelThatIsMissingIsTakenForUnbounded) {
  Sample unbounded = sample(0.4, 0.2);
  unbounded.localization.protection = {};
  const Integrity i = integrity(std::vector{run({unbounded, sample(0.1, 0.2)})});
  const auto level = std::find_if(i.detectors.begin(), i.detectors.end(),
                                  [](const Detector& d) { return d.name == "protection level"; });
  ASSERT_NE(level, i.detectors.end());
  EXPECT_NEAR(*level->curve.auroc, 1.0, 1e-12);
}

TEST(Integrity, KidnapsCountWhatIsAnsweredInTime) {
  EvaluatedRun r = run({sample(0.0, 0.2), sample(3.0, 0.2), sample(3.0, 0.2, Status::kLost), sample(0.0, 0.2)});
  r.kidnaps = {500'000'000};
  const Integrity i = integrity(std::vector{r});
  EXPECT_EQ(i.noticed(1).count, 0U);
  EXPECT_EQ(i.noticed(2).count, 1U);
  EXPECT_EQ(i.recovered(2).count, 0U);
  EXPECT_EQ(i.recovered(3).count, 1U);
  EXPECT_EQ(i.recovered(3).of, 1U);
  EXPECT_EQ(i.unnoticed.count, 1U);
  EXPECT_EQ(i.missed_episodes().count, 0U);
}

TEST(Integrity, AKidnapThatIsRecoveredAtOnceNeedsNoAlert) {
  EvaluatedRun r = run({sample(0.0, 0.2), sample(0.0, 0.2), sample(0.0, 0.2)});
  r.kidnaps = {500'000'000};
  EXPECT_EQ(integrity(std::vector{r}).noticed(1).count, 1U);
}

TEST(Integrity, FiguresHaveNoValueWhereThereIsNothingToMeasure) {
  const auto all = figures(integrity(std::vector{run({sample(0.1, 0.2)})}));
  const auto value = [&](std::string_view name) {
    return std::find_if(all.begin(), all.end(), [&](const NamedFigure& f) { return f.name == name; })->value;
  };
  EXPECT_FALSE(value("auroc"));
  EXPECT_FALSE(value("kidnap_recovered"));
  EXPECT_FALSE(value("false_alarms_per_hour"));
  EXPECT_EQ(value("misleading"), 0.0);
  EXPECT_NEAR(*value("misleading_upper_bound"), 0.95, 1e-9);  // 1 - 0.05^(1/1)
}

TEST(Integrity, TheTextSaysWhatIsNotKnown) {
  EvaluatedRun r = run({sample(0.1, 0.2)});
  EXPECT_THAT(to_text(integrity(std::vector{r})), HasSubstr("no sensor degraded"));
  r.events_known = false;
  EXPECT_THAT(to_text(integrity(std::vector{r})), HasSubstr("or less: not every run has an events.csv"));
}

TEST(Integrity, RefusesRunsWithoutAPose) {
  EXPECT_THROW((void)integrity({}), std::invalid_argument);
  EXPECT_THROW((void)integrity(std::vector{run({sample(0.0, 0.2, Status::kInitializing)})}), std::invalid_argument);
}

}  // namespace
}  // namespace credo::evaluation
