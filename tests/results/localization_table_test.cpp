// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/localization_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace credo::results {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

LocalizationRow example() {
  LocalizationRow row;
  auto& l = row.localization;
  l.time = 1600022000012766001;
  l.estimate.pose = {1.25, -2.5, 0.125};
  l.estimate.covariance << 1e-4, 2e-6, -3e-7, 2e-6, 4e-4, 5e-8, -3e-7, 5e-8, 6e-5;
  l.belief = {.yes = 0.75, .no = 0.0625, .unknown = 0.1875};
  l.conflict = 0.03125;
  l.status = localization::Status::kUncertain;
  l.detected = 12, l.matched = 9, l.tracked = 14;
  l.reason = "few matches, \"far\" walls";
  return row;
}

class Table : public testing::Test {
 protected:
  std::vector<LocalizationRow> read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_localization(file_);
  }
  tests::TemporaryFolder folder_;
  fs::path file_ = folder_ / "localization.csv";
  std::string header_{kLocalizationHeader};
};

TEST_F(Table, ReadsBackWhatWasWritten) {
  const LocalizationRow row = example();
  const auto rows = read(header_ + to_line(row));
  ASSERT_EQ(rows.size(), 1u);
  const auto& l = rows[0].localization;
  EXPECT_EQ(l.time, row.localization.time);
  EXPECT_EQ(l.estimate, row.localization.estimate);
  EXPECT_EQ(l.belief, row.localization.belief);
  EXPECT_EQ(l.conflict, row.localization.conflict);
  EXPECT_EQ(l.status, row.localization.status);
  EXPECT_EQ(l.detected, 12);
  EXPECT_EQ(l.matched, 9);
  EXPECT_EQ(l.tracked, 14);
  EXPECT_EQ(l.reason, row.localization.reason);
  EXPECT_TRUE(std::isnan(rows[0].localization.protection.position_high_m));
}

TEST_F(Table, KeepsProtectionLevels) {
  LocalizationRow row = example();
  row.localization.protection = {0.125, 0.25, 0.5, 0.75};
  const auto p = read(header_ + to_line(row))[0].localization.protection;
  EXPECT_EQ(p.position_low_m, 0.125);
  EXPECT_EQ(p.heading_high_rad, 0.75);
}

TEST_F(Table, WritesNanForLevelsThatNobodyComputed) { EXPECT_THAT(to_line(example()), HasSubstr(",nan,nan,nan,nan,")); }

TEST_F(Table, IgnoresColumnsThatWereAppended) {
  std::string header = header_, line = to_line(example());
  header.insert(header.size() - 1, ",later");
  line.insert(line.size() - 1, ",42");
  EXPECT_EQ(read(header + line)[0].localization.reason, example().localization.reason);
}

TEST_F(Table, ErrorsNameFileAndLine) {
  std::string line = to_line(example());
  EXPECT_THAT([&] { (void)read("#time,x\n"); }, ThrowsMessage<std::runtime_error>(HasSubstr(".csv:1:")));
  EXPECT_THAT([&] { (void)read(header_ + line + "1,2,3\n"); },
              ThrowsMessage<std::runtime_error>(HasSubstr(".csv:3: expected 23 columns, found 3")));
  std::string odd = line;
  odd.replace(odd.find("uncertain"), 9, "confident");
  EXPECT_THAT([&] { (void)read(header_ + odd); },
              ThrowsMessage<std::runtime_error>(HasSubstr("unknown status 'confident'")));
  std::string word = line;
  word.replace(word.find("1.25"), 4, "left");
  EXPECT_THAT([&] { (void)read(header_ + word); },
              ThrowsMessage<std::runtime_error>(HasSubstr(".csv:2: expected a number in column 2")));
  EXPECT_THROW((void)read_localization("no such file"), std::runtime_error);
}

TEST_F(Table, RefusesWhatCannotBe) {
  const auto with = [this](const char* from, const char* to) {
    std::string line = to_line(example());
    line.replace(line.find(from), std::string(from).size(), to);
    return [this, line] { (void)read(header_ + line); };
  };
  for (const char* bad : {"nan", "inf", "-inf", "1e300"}) {
    EXPECT_THAT(with("1.250000", bad), ThrowsMessage<std::runtime_error>(HasSubstr(".csv:2: expected a number from")));
    EXPECT_THAT(with("1.000000000e-04", bad), ThrowsMessage<std::runtime_error>(HasSubstr("column 5")));
    EXPECT_THAT(with("2.000000000e-06", bad), ThrowsMessage<std::runtime_error>(HasSubstr("column 6")));
    EXPECT_THAT(with("0.750000", bad), ThrowsMessage<std::runtime_error>(HasSubstr("column 11")));
    EXPECT_THAT(with("0.031250", bad), ThrowsMessage<std::runtime_error>(HasSubstr("column 14")));
  }
  EXPECT_THAT(with("1.000000000e-04", "-1"), ThrowsMessage<std::runtime_error>(HasSubstr("column 5")));
  EXPECT_THAT(with("0.750000", "0.5"), ThrowsMessage<std::runtime_error>(HasSubstr("sum to 1")));
  EXPECT_THAT(with(",12,", ",-12,"), ThrowsMessage<std::runtime_error>(HasSubstr("column 16")));
  EXPECT_THAT(with("1600022000012766001", "9223372036854775807"), ThrowsMessage<std::runtime_error>(HasSubstr("time")));
}

TEST_F(Table, RefusesATimeThatRunsBackwards) {
  LocalizationRow later = example();
  later.localization.time += 1;
  EXPECT_THAT([&] { (void)read(header_ + to_line(later) + to_line(example())); },
              ThrowsMessage<std::runtime_error>(HasSubstr(".csv:3: the time is before")));
  EXPECT_EQ(read("\xEF\xBB\xBF" + header_ + to_line(example()) + "\r\n" + to_line(later)).size(), 2u);
}

}  // namespace
}  // namespace credo::results
