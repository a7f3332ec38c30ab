// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign_spec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "datasets/format_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace credo::evaluation {
namespace {

using testing::HasSubstr;

class CampaignFile : public testing::Test {
 protected:
  [[nodiscard]] CampaignSpec read(const std::string& text) const {
    return read_campaign(temporary_.write("c.yaml", "format: credo-campaign/1\n" + text));
  }
  [[nodiscard]] std::string complaint(const std::string& text) const {
    try {
      (void)read(text);
    } catch (const datasets::FormatError& error) {
      return error.what();
    }
    return "none";
  }
  tests::TemporaryFolder temporary_;
};

TEST_F(CampaignFile, NeedsNoMoreThanWorlds) {
  const CampaignSpec spec = read("worlds: [office]\n");
  EXPECT_EQ(spec.worlds, std::vector<std::string>{"office"});
  EXPECT_EQ(spec.degradations, std::vector<std::string>{"nominal"});
  EXPECT_EQ(spec.method, perception::Method::kDefault);
}

TEST_F(CampaignFile, IsReadBackAsItWasWritten) {
  const CampaignSpec spec{.worlds = {"office", "my worlds/a \"b\".yaml", "random:modules"},
                          .first_seed = 7,
                          .seeds = 3,
                          .degradations = {"nominal", "kidnap"},
                          .method = perception::Method::kPaper};
  EXPECT_EQ(read_campaign(temporary_.write("again.yaml", to_yaml(spec))), spec);
}

TEST_F(CampaignFile, SuggestsTheNearestKeyAndDegradation) {
  EXPECT_THAT(complaint("world: [office]\n"), HasSubstr("c.yaml:2: unknown key 'world'; did you mean 'worlds'?"));
  EXPECT_THAT(complaint("worlds: [office]\ndegradations: [nominal,\n  peple]\n"),
              HasSubstr("c.yaml:4: unknown degradation 'peple'; did you mean 'people'?"));
  EXPECT_THAT(complaint("worlds: [office]\nseeds: {fist: 2, count: 3}\n"), HasSubstr("did you mean 'first'?"));
}

TEST_F(CampaignFile, RefusesWhatMakesNoCampaign) {
  EXPECT_THAT(complaint("seeds: {count: 3}\n"), HasSubstr("the key 'worlds' is missing"));
  EXPECT_THAT(complaint("worlds: []\n"), HasSubstr("expected at least one name"));
  EXPECT_THAT(complaint("worlds: [office]\nseeds: {count: 0}\n"), HasSubstr("from 1 to"));
  EXPECT_THAT(complaint("worlds: [a/office.yaml, b/office.yaml]\n"), HasSubstr("names the same runs"));
  EXPECT_THAT(complaint("worlds: [office]\ndegradations: [people, people]\n"), HasSubstr("names the same runs"));
  EXPECT_THAT(complaint("worlds: [a, b]\nseeds: {count: 600000}\n"), HasSubstr("more than 1000000 runs"));
  EXPECT_THAT(complaint("worlds: [office]\nmethod: papr\n"), HasSubstr("did you mean 'paper'?"));
}

TEST(CampaignRuns, TakeTheSeedsOneAfterTheOther) {
  const CampaignSpec spec{.worlds = {"a", "b"}, .first_seed = 5, .seeds = 2, .degradations = {"nominal", "people"}};
  const std::vector<RunKey> runs = runs_of(spec);
  ASSERT_EQ(runs.size(), 8U);
  EXPECT_EQ(runs[0], (RunKey{"a", 5, "nominal"}));
  EXPECT_EQ(runs[1], (RunKey{"a", 5, "people"}));
  EXPECT_EQ(runs[2], (RunKey{"b", 5, "nominal"}));
  EXPECT_EQ(runs[7], (RunKey{"b", 6, "people"}));
}

TEST(CampaignRuns, HaveNamesThatAreFileNames) {
  EXPECT_EQ(name_of({"office", 5, "nominal"}), "office-5-nominal");
  EXPECT_EQ(name_of({"../worlds/my office.yaml", 5, "people"}), "my_office-5-people");
  EXPECT_EQ(name_of({"random:modules", 5, "nominal"}), "random_modules-5-nominal");
}

TEST(ShippedCampaigns, AreRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CREDO_SOURCE_DIR "/bench/campaigns")) {
    EXPECT_FALSE(runs_of(read_campaign(entry.path())).empty()) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 2);
}

}  // namespace
}  // namespace credo::evaluation
