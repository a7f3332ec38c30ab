// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/settings_sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace credo::evaluation {
namespace {

using ::testing::ElementsAre;

TEST(SettingsSweep, ASettingIsNotChosenByTheSeedThatItIsJudgedBy) {
  // Each seed's own best errs 0 on it, and most on the others.
  const OwnBest best = best_on_other_seeds({{0.0, 9.0, 9.0}, {9.0, 0.0, 9.0}, {4.0, 4.0, 6.0}});
  EXPECT_THAT(best.settings, ElementsAre(1, 0, 2));
  EXPECT_EQ(best.error.count, 3);
  EXPECT_NEAR(best.error.mean(), (9.0 + 9.0 + 6.0) / 3.0, 1e-12);
}

TEST(SettingsSweep, WithOneSeedThereIsNothingToChooseBy) {
  const OwnBest best = best_on_other_seeds({{3.0}, {2.0}});
  EXPECT_EQ(best.error.count, 0);
  EXPECT_TRUE(best.settings.empty());
}

TEST(SettingsSweep, ReductionsAreOfWhatTheOtherErrs) {
  EXPECT_THAT(reductions({{10.0, 0.0}, {20.0, 4.0}}, {{5.0, 1.0}, {25.0, 3.0}}), ElementsAre(0.5, -0.25, 0.25));
  EXPECT_EQ(median_of({0.5, -0.25, 0.25}), 0.25);
  EXPECT_EQ(median_of({4.0, 1.0}), 2.5);
  EXPECT_THROW((void)median_of({}), std::invalid_argument);
}

}  // namespace
}  // namespace credo::evaluation
