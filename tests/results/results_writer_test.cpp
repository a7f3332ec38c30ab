// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/results_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "results/results_folder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace credo::results {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

class Results : public testing::Test {
 protected:
  [[nodiscard]] fs::path target() const { return folder_ / "run"; }
  [[nodiscard]] std::string text(const char* name) const {
    std::ostringstream out;
    out << std::ifstream(target() / name).rdbuf();
    return out.str();
  }
  [[nodiscard]] std::vector<std::string> names(const fs::path& where) const {
    std::vector<std::string> result;
    for (const auto& entry : fs::directory_iterator(where)) result.push_back(entry.path().filename().string());
    std::sort(result.begin(), result.end());
    return result;
  }
  void write(bool replace) const {
    ResultsWriter writer(target(), replace);
    writer.add_config("format: credo-results/1\n");
    writer.finish();
  }

  tests::TemporaryFolder temporary_;
  fs::path folder_ = temporary_.path();
};

localization::Localization pose(sensors::Timestamp time, double x) {
  localization::Localization l;
  l.time = time;
  l.estimate.pose = {x, 0.5, 0.0};
  return l;
}

TEST_F(Results, TablesHaveTheirColumnsAndTimesKeepTheirNanoseconds) {
  perception::Scene scene;
  scene.time = 1600000000000000007;
  scene.radial_lines.push_back({.azimuth = 0.5, .sigma = 0.001, .contrast = 20.0, .polarity = -1});
  perception::Primitive bearing, edge;
  bearing.azimuth = 0.25;
  bearing.bearing_only = true;
  edge.type = perception::PrimitiveType::kEdge;
  edge.azimuth = 1.5;
  edge.range_m = 2.0;
  edge.endpoint_case = 5;
  scene.primitives = {bearing, edge};
  tracking::Track track;
  track.id = 4;
  track.type = perception::PrimitiveType::kEdge;
  track.landmark = 17;
  ResultsWriter writer(target(), false);
  writer.add(scene, pose(scene.time, 1.0), std::vector{track});
  writer.add_config("format: credo-results/1\n");
  writer.finish();
  EXPECT_EQ(text("trajectory.tum"), "1600000000.000000007 1.000000 0.500000 0 0 0 0.000000000 1.000000000\n");
  EXPECT_THAT(text("localization.csv"), StartsWith(std::string(kLocalizationHeader) + "1600000000000000007,1.000000,"));
  EXPECT_THAT(text("tracks.csv"),
              EndsWith("1600000000000000007,4,edge,0.000000000,0.000000,0.000000,1.000000,tracked,17,0.000000000\n"));
  EXPECT_THAT(text("primitives.csv"), HasSubstr("\n1600000000000000007,0,other,0.250000000,nan,nan,nan,"));
  EXPECT_THAT(text("primitives.csv"), EndsWith(",0.000000,5\n"));
  EXPECT_THAT(text("radial_lines.csv"), EndsWith("\n1600000000000000007,0.500000000,0.001000000,20.000,-1\n"));
  EXPECT_FALSE(fs::exists(target() / "hypotheses.csv"));
}

TEST_F(Results, HypothesesAppearWhereThereIsMoreThanOne) {
  localization::Localization l = pose(5, 1.0);
  l.hypotheses = {{{1, 2, 3}, 0.5, 0.75}, {{4, 5, 6}, 0.25, 0.5}};
  ResultsWriter writer(target(), false);
  writer.add({}, pose(4, 0.0), {});
  writer.add({}, l, {});
  writer.add_config("");
  writer.finish();
  EXPECT_EQ(text("hypotheses.csv"),
            "#timestamp [ns],x,y,theta,bel,pl\n5,1.000000,2.000000,3.000000000,0.500000,0.750000\n"
            "5,4.000000,5.000000,6.000000000,0.250000,0.500000\n");
}

TEST_F(Results, NothingIsFoundBeforeItIsWhole) {
  {
    ResultsWriter writer(target(), false);
    writer.add({}, pose(1, 0.0), {});
    EXPECT_FALSE(fs::exists(target()));
  }
  EXPECT_TRUE(names(folder_).empty());
}

TEST_F(Results, AnotherRunIsReplacedOnlyWhenAsked) {
  write(false);
  EXPECT_THAT([&] { write(false); }, ThrowsMessage<std::runtime_error>(HasSubstr("--force")));
  std::ofstream(target() / "old") << "x";
  write(true);
  EXPECT_FALSE(fs::exists(target() / "old"));
  EXPECT_EQ(names(folder_), std::vector<std::string>{"run"});
}

TEST_F(Results, AFolderThatCredoDidNotWriteIsNeverReplaced) {
  fs::create_directories(target());
  std::ofstream(target() / "thesis.tex") << "x";
  EXPECT_THAT([&] { write(true); }, ThrowsMessage<std::runtime_error>(HasSubstr("not written by credo")));
  EXPECT_TRUE(fs::exists(target() / "thesis.tex"));
}

TEST_F(Results, AnEmptyFolderAndATrailingSlashAreNoObstacle) {
  fs::create_directories(target());
  ResultsWriter writer(target() / "", false);
  writer.finish();
  EXPECT_TRUE(fs::exists(target() / "localization.csv"));
}

TEST(WriteText, TellsAFullDiskFromAPlaceThatIsNotThere) {
  const auto complaint_at = [](const fs::path& file) { return [file] { write_text(file, "x"); }; };
  EXPECT_THAT(complaint_at("/dev/full"), ThrowsMessage<std::runtime_error>(EndsWith("No space left on device")));
  EXPECT_THAT(complaint_at("/no/such/file"), ThrowsMessage<std::runtime_error>(EndsWith("No such file or directory")));
}

}  // namespace
}  // namespace credo::results
