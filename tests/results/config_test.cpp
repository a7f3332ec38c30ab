// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "results/fields.hpp"

namespace credo::results {
namespace {

using testing::HasSubstr;

enum class Colour { kRed, kDarkBlue };

struct Inner {
  double yes = 0.25;
  double no = 0.5;
};

struct Sample {
  double range_m = 1.5;
  int count = 3;
  bool absolute = false;
  Colour colour = Colour::kDarkBlue;
  Inner inner;
  std::array<double, 2> pair{1.0, 2.0};
  [[nodiscard]] static Sample other() { return {}; }
};

TEST(Fields, AreCountedAndNamed) {
  static_assert(fields::count<Sample>() == 6);
  static_assert(fields::count<Inner>() == 2);
  static_assert(fields::name<Sample, 0>() == "range_m");
  static_assert(fields::name<Sample, 5>() == "pair");
  static_assert(fields::enumerator<Colour::kDarkBlue>() == "kDarkBlue");
  static_assert(fields::enumerator<static_cast<Colour>(7)>().empty());
  std::set<std::string> names;
  fields::for_each(Sample{}, [&](std::string_view name, const auto&) { names.emplace(name); });
  EXPECT_EQ(names, (std::set<std::string>{"range_m", "count", "absolute", "colour", "inner", "pair"}));
}

TEST(Config, HoldsParametersOfEveryComponentAsUsed) {
  RunConfig config{.version = "1.2.3", .dataset = "say \"hello\""};
  config.mapper.scan.max_range_m = 12.5;
  config.localizer.constant_velocity.translation_sigma_m = 0.125;
  config.localizer.tracker.method = perception::Method::kPaper;
  const std::string yaml = to_yaml(config);
  EXPECT_THAT(yaml, HasSubstr("format: credo-results/1\n"));
  EXPECT_THAT(yaml, HasSubstr("credo: 1.2.3\n"));
  EXPECT_THAT(yaml, HasSubstr("dataset: \"say \\\"hello\\\"\"\n"));
  EXPECT_THAT(yaml, HasSubstr("    max_range_m: 12.5\n"));
  EXPECT_THAT(yaml, HasSubstr("translation_sigma_m: 0.125"));
  EXPECT_THAT(yaml, HasSubstr("  tracker:\n    method: paper\n"));
  EXPECT_THAT(yaml, HasSubstr("belief_yes: >-\n"));
  EXPECT_THAT(yaml, HasSubstr("min_pignistic: 0.5"));
  EXPECT_THAT(yaml, testing::Not(HasSubstr("unknown_enumerator")));
}

TEST(Config, IsTheSameForTheSameParameters) { EXPECT_EQ(to_yaml(RunConfig{}), to_yaml(RunConfig{})); }

TEST(Config, OfAMapSaysWhereThePosesCameFrom) {
  EXPECT_THAT(to_yaml(mapping::TrajectoryMappingParams{}, "1", "log", "ground truth"),
              HasSubstr("map_poses: \"ground truth\""));
}

}  // namespace
}  // namespace credo::results
