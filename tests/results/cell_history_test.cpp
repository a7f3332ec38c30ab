// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/cell_history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "datasets/format_error.hpp"
#include "results/results_folder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace credo::results {
namespace {

constexpr sensors::Timestamp kSecond = 1'000'000'000;
constexpr grids::Georeference kGround{.resolution_m = 0.05, .origin_x_m = -0.3, .origin_y_m = 0.1};

const std::vector<mapping::CellHistory> kHistory{
    {{-3, 2}, false, 1'600'000'000 * kSecond, 0},
    {{0, 2}, true, 1'600'000'004 * kSecond + 1, 2},
    {{4, 5}, true, 1'600'000'008 * kSecond, 1},
};

TEST(CellHistory, IsReadAsItWasWritten) {
  const tests::TemporaryFolder folder;
  write_cell_history(kHistory, kGround, folder.path() / "history.csv");
  EXPECT_EQ(read_cell_history(folder.path() / "history.csv", kGround), kHistory);
}

TEST(CellHistory, ABadRowIsNamed) {
  const tests::TemporaryFolder folder;
  const auto file = folder.path() / "history.csv";
  const std::string head = "#x [m],y [m],state,since [ns],changes\n";
  for (const char* row : {"0,0,full,1,0\n", "0,0,empty,1.5,0\n", "0,0,empty,1\n", "0,nan,empty,1,0\n"}) {
    write_text(file, head + row);
    EXPECT_THAT([&] { static_cast<void>(read_cell_history(file, kGround)); },
                testing::ThrowsMessage<datasets::FormatError>(testing::HasSubstr("history.csv:2")))
        << row;
  }
}

/// The commonest colour of a column of the map as it is drawn, left margin 16, top 32, 90 pixels per cell.
cv::Vec3b cell_in(const cv::Mat& picture, int column, int row_from_top) {
  return picture.at<cv::Vec3b>(32 + 90 * row_from_top + 45, 16 + 90 * column + 45);
}

TEST(CellHistory, ThePicturesTellTheLaterFromTheEarlierAndTheChangedFromTheOthers) {
  const tests::TemporaryFolder folder;
  write_cell_history_pictures(kHistory, {{-3, 2}, 8, 4}, folder.path());
  const cv::Mat since = cv::imread((folder.path() / "map_since.png").string());
  const cv::Mat changes = cv::imread((folder.path() / "map_changes.png").string());
  ASSERT_FALSE(since.empty() || changes.empty());
  const int first_red = cell_in(since, 0, 3)[2], second_red = cell_in(since, 3, 3)[2],
            last_red = cell_in(since, 7, 0)[2];
  EXPECT_EQ(first_red, 255);  // white
  EXPECT_GT(second_red, last_red);
  EXPECT_EQ(last_red, 0);  // blue
  EXPECT_EQ(cell_in(changes, 0, 3), cv::Vec3b(255, 255, 255));
  EXPECT_GT(cell_in(changes, 7, 0)[0], cell_in(changes, 3, 3)[0]);
  EXPECT_EQ(cell_in(since, 1, 1), cell_in(changes, 1, 1));  // in no state
}

TEST(CellHistory, WithoutASettledCellThereIsNoPicture) {
  const tests::TemporaryFolder folder;
  write_cell_history_pictures({}, {{0, 0}, 3, 3}, folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "map_since.png"));
}

}  // namespace
}  // namespace credo::results
