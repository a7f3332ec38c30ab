// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/map_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "grids/readout.hpp"
#include "results/results_writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace credo::results {
namespace {

namespace fs = std::filesystem;

class MapFolder : public testing::Test {
 protected:
  void write(const grids::EvidentialGrid& grid, BeliefChannels channels) const {
    ResultsWriter writer(folder_, false);
    EXPECT_TRUE(writer.add_map(grid, {.channels = channels}));
    writer.add_config("format: credo-results/1\n");
    writer.finish();
  }
  static grids::EvidentialGrid example() {
    grids::EvidentialGrid grid(grids::Georeference{.resolution_m = 0.1, .origin_x_m = -1.0, .origin_y_m = 2.0});
    const auto cell = [](double empty, double occupied, double unknown) {
      return evidence::quantise({std::log(empty), std::log(occupied), std::log(unknown)});
    };
    grid.add({-3, 2}, cell(0.9, 0.2, 0.1));
    grid.add({4, 5}, cell(0.3, 0.95, 0.25));
    grid.add({0, 0}, cell(0.5, 0.5, 0.1));
    return grid;
  }
  tests::TemporaryFolder temporary_;
  fs::path folder_ = temporary_ / "run";
};

TEST_F(MapFolder, BringsAMapBackToTheBit) {
  for (const BeliefChannels channels : {BeliefChannels::kNormalized, BeliefChannels::kRaw}) {
    write(example(), channels);
    EXPECT_EQ(read_map_folder(folder_), example());
    fs::remove_all(folder_);
  }
}

TEST_F(MapFolder, OfALargeMapHasNoPictures) {
  grids::EvidentialGrid grid = example();
  grid.add({100'000, 100'000}, {-1, -1, -2});
  EXPECT_FALSE(write_map_folder(grid, temporary_.path()));
  EXPECT_FALSE(fs::exists(temporary_ / "map.yaml"));
  EXPECT_EQ(read_map_folder(temporary_.path()), grid);
}

TEST_F(MapFolder, WritesProbabilitiesWhereAsked) {
  EXPECT_TRUE(write_map_folder(example(), temporary_.path(), {.mode = datasets::MapMode::kScale}));
  EXPECT_EQ(datasets::read_map(temporary_ / "map.yaml"), datasets::to_probabilities(example()));
}

TEST_F(MapFolder, PicturesAloneKeepPlaceMassesAndDecisions) {
  const grids::EvidentialGrid grid = example();
  write(grid, BeliefChannels::kNormalized);
  fs::remove(folder_ / "map.cgrid");
  const grids::EvidentialGrid back = read_map_folder(folder_);
  const grids::CellBox a = grid.bounding_box(), b = back.bounding_box();
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  const Eigen::Vector2d centre = grid.georeference().centre(a.min), centre_back = back.georeference().centre(b.min);
  EXPECT_NEAR((centre - centre_back).norm(), 0.0, 1e-6);
  EXPECT_EQ(grids::decisions(grid, a), grids::decisions(back, b));
  for (const grids::Layer which :
       {grids::Layer::kEmpty, grids::Layer::kOccupied, grids::Layer::kUnknown, grids::Layer::kContested}) {
    const auto x = grids::layer(grid, a, which), y = grids::layer(back, b, which);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], y[i], 1e-4);
  }
}

TEST_F(MapFolder, RefusesPicturesOfRawMassesAndMissingFiles) {
  write(example(), BeliefChannels::kRaw);
  fs::remove(folder_ / "map.cgrid");
  EXPECT_THAT([&] { (void)read_map_folder(folder_); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("--readout raw")));
  fs::remove(folder_ / "map.yaml");
  EXPECT_THROW((void)read_map_folder(folder_), std::runtime_error);
}

}  // namespace
}  // namespace credo::results
