// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "datasets/dataset.hpp"
#include "datasets/truth_states.hpp"
#include "tests/apps/command.hpp"

namespace {

namespace fs = std::filesystem;
using credo::tests::Answer;
using credo::tests::Command;
using testing::HasSubstr;

constexpr const char* kChangingWorld = R"(format: credo-world/1
building:
  rooms: [{outline: [[0, 0], [4, 0], [4, 3], [0, 3]]}]
changes:
  - {when: 1, put: {at: [3, 2], size: [0.4, 0.4]}}
  - {when: 2, take: [3, 2]}
path: {lanes: {start: [0.6, 0.6], spacing: 1.5}}
drive: {duration: 3}
sensors:
  range_finders: [{preset: opensimple, rate: 5}]
)";

TEST_F(Command, ASimulatedWorldThatChangesLeavesTheTruthOfEachState) {
  write("changing.yaml", kChangingWorld);
  const Answer answer = credo("simulate changing.yaml --out data");
  ASSERT_EQ(answer.status, 0) << answer.error;
  const auto dataset = credo::datasets::Dataset::open(folder_ / "data");
  const auto states = credo::datasets::read_truth_states(folder_ / "data");
  ASSERT_EQ(states.size(), 3U);
  ASSERT_EQ(dataset.events.size(), 2U);
  EXPECT_EQ(dataset.events[0].name, "obstacle_added");
  EXPECT_EQ(dataset.events[0].time, states[1].since);
  EXPECT_EQ(dataset.events[1].time, states[2].since);
  EXPECT_NE(states[0].map, states[1].map);
  EXPECT_EQ(states[0].map, states[2].map);
  EXPECT_EQ(credo::datasets::read_map(*dataset.truth_map), states[2].map);
  EXPECT_TRUE(dataset.remarks.empty());
}

TEST_F(Command, AWorldThatStaysHasOneTruth) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  EXPECT_FALSE(fs::exists(folder_ / "data/truth_maps"));
  EXPECT_TRUE(fs::exists(folder_ / "data/truth_map.yaml"));
}

TEST_F(Command, BrokenTruthOfAChangingWorldIsNamed) {
  write("changing.yaml", kChangingWorld);
  ASSERT_EQ(credo("simulate changing.yaml --out data").status, 0);
  fs::remove(folder_ / "data/truth_maps/0001.pgm");
  const Answer answer = credo("info data");
  EXPECT_EQ(answer.status, 1);
  EXPECT_THAT(answer.error, HasSubstr("0001"));
}

}  // namespace
