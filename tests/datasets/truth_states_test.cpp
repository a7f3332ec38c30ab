// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/truth_states.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "datasets/format_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace credo::datasets {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

OccupancyMap map_of(std::vector<std::int8_t> cells) {
  return {
      .width = 2, .height = 1, .resolution_m = 0.05, .origin_x_m = -1.0, .origin_y_m = 2.0, .cells = std::move(cells)};
}

TEST(TruthStates, ComeBackAsTheyWereWritten) {
  const tests::TemporaryFolder folder;
  EXPECT_TRUE(read_truth_states(folder.path()).empty());
  write_truth_states({{100, map_of({0, 0})}, {900, map_of({0, 100})}, {1000, map_of({-1, 0})}}, folder.path());
  const std::vector<TruthState> states = read_truth_states(folder.path());
  ASSERT_EQ(states.size(), 3U);
  EXPECT_EQ(states[0].since, 100);
  EXPECT_EQ(states[1].since, 900);
  EXPECT_EQ(states[1].map, map_of({0, 100}));
  EXPECT_EQ(states[2].map, map_of({-1, 0}));
}

TEST(TruthStates, OfOtherCellsAreRefusedAtTheirLine) {
  const tests::TemporaryFolder folder;
  OccupancyMap shifted = map_of({0, 0});
  shifted.origin_x_m = 0.0;
  write_truth_states({{100, map_of({0, 0})}, {900, shifted}}, folder.path());
  EXPECT_THAT([&] { (void)read_truth_states(folder.path()); },
              ThrowsMessage<FormatError>(testing::AllOf(HasSubstr("data.csv:3:"), HasSubstr("same cells"))));
}

TEST(TruthStates, LieBesideTheirTable) {
  const tests::TemporaryFolder folder;
  write_truth_states({{100, map_of({0, 0})}}, folder.path());
  folder.write("truth_maps/data.csv", "#timestamp [ns],filename\n100,../elsewhere.yaml\n");
  EXPECT_THAT([&] { (void)read_truth_states(folder.path()); },
              ThrowsMessage<FormatError>(HasSubstr("beside this table, found '../elsewhere.yaml'")));
  folder.write("truth_maps/data.csv", "#timestamp [ns],filename\n100,0007.yaml\n");
  EXPECT_THROW((void)read_truth_states(folder.path()), FormatError);
}

}  // namespace
}  // namespace credo::datasets
