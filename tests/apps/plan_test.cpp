// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "datasets/floor_plan_file.hpp"
#include "tests/apps/command.hpp"

namespace {

namespace datasets = credo::datasets;
using credo::tests::Answer;
using credo::tests::Command;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

TEST_F(Command, APlanIsMadeOfAMapInAnyForm) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  ASSERT_EQ(credo("map data --out map --map-mode scale").status, 0);
  EXPECT_THAT(read("map/map.yaml"), HasSubstr("mode: scale"));
  const json made = json::parse(credo("plan map --out of_folder.yaml --format json").out);
  EXPECT_GT(made["walls"].get<int>(), 3);
  EXPECT_EQ(datasets::read_floor_plan(folder_ / "of_folder.yaml").walls.size(), made["walls"].get<std::size_t>());
  ASSERT_EQ(credo("plan map/map.cgrid --out of_file.yaml").status, 0);
  EXPECT_EQ(read("of_file.yaml"), read("of_folder.yaml"));
  const Answer truth = credo("plan data/truth_map.yaml --out of_picture.yaml");
  EXPECT_EQ(truth.status, 0) << truth.error;
  EXPECT_THAT(truth.out, HasSubstr("floor plan: of_picture.yaml ("));

  const Answer again = credo("plan map --out of_folder.yaml");
  EXPECT_EQ(again.status, 1);
  EXPECT_THAT(again.error, HasSubstr("of_folder.yaml: is there already: choose another file with --out"));
  EXPECT_EQ(credo("plan map --out of_folder.yaml --force").status, 0);
  EXPECT_THAT(credo("plan map --out none.yaml --shortest 900").error, HasSubstr("try a lower --shortest"));
  EXPECT_THAT(credo("plan data/sensors.csv --out none.yaml").error, HasSubstr("there is no such file"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none.yaml"));
}

TEST_F(Command, AMapFileTellsWhatItHoldsAndIsReadInParts) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  ASSERT_EQ(credo("map data --out map").status, 0);
  const json info = json::parse(credo("info map/map.cgrid --format json").out);
  EXPECT_EQ(info["kind"], "evidential map");
  EXPECT_GT(info["seen_cells"].get<int>(), 1000);
  EXPECT_EQ(info["saturated_tiles"], 0);
  EXPECT_GT(info["bytes_per_seen_cell"]["memory"].get<double>(), 11.9);
  EXPECT_EQ(json::parse(credo("info map --format json").out), info);

  const json whole = json::parse(credo("plan map --out whole.yaml --format json").out);
  const json all = json::parse(credo("plan map --region -90 -90 90 90 --out all.yaml --format json").out);
  EXPECT_EQ(all["length_m"], whole["length_m"]);
  EXPECT_THAT(credo("plan map --region 900 900 910 910 --out none.yaml").error, HasSubstr("no wall"));
  EXPECT_THAT(credo("plan data/truth_map.yaml --region 0 0 1 1 --out none.yaml").error,
              HasSubstr("expected a map.cgrid"));
}

TEST_F(Command, ARegionOfAMapIsAMapOfItsOwn) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  ASSERT_EQ(credo("map data --out map").status, 0);
  const json part =
      json::parse(credo("export map --region 1 2.5 3 1 --map-mode scale --out part --pictures p --format json").out);
  EXPECT_EQ(part["width"], 41);  // 2 m, and both edges
  EXPECT_EQ(part["height"], 31);
  EXPECT_THAT(read("part/map.yaml"), AllOf(HasSubstr("mode: scale"), HasSubstr("origin: [1")));
  EXPECT_THAT(read("part/config.yaml"), HasSubstr("region_m: [1, 2.5, 3, 1]"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "p/map_relief.png"));
  EXPECT_EQ(credo("cell part 2 2").out, credo("cell map 2 2").out);
  EXPECT_EQ(credo("cell part/map.cgrid 2 2").out, credo("cell map 2 2").out);
  EXPECT_EQ(credo("export map/map.cgrid --out whole").status, 0);
  EXPECT_EQ(read("whole/map.cgrid"), read("map/map.cgrid"));
  EXPECT_EQ(read("whole/map_belief.tiff"), read("map/map_belief.tiff"));

  EXPECT_THAT(credo("export map --out whole").error, HasSubstr("--force"));
  EXPECT_EQ(credo("export map --out whole --force").status, 0);
  EXPECT_THAT(credo("export map --region 900 900 910 910 --out none").error, HasSubstr("nothing was seen"));
  EXPECT_THAT(credo("export data --out none").error, HasSubstr("expected a map.cgrid"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none"));
}

TEST_F(Command, AMapTellsItsWallsToo) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  ASSERT_EQ(credo("map data --out map").status, 0);
  const json score = json::parse(credo("evaluate map data map --format json").out);
  EXPECT_GT(score["walls"]["reached_m"].get<double>(), 5.0);
  EXPECT_GE(score["walls"]["torn"].get<int>(), 0);
  EXPECT_GT(score["plan"]["precision"].get<double>(), 0.5);
  EXPECT_THAT(credo("evaluate map data map").out, AllOf(HasSubstr("falsely joined"), HasSubstr("walls as a plan: ")));
}

TEST_F(Command, ADamagedMapIsRefusedByName) {
  write_small_world();
  ASSERT_EQ(credo("simulate small.yaml --out data").status, 0);
  ASSERT_EQ(credo("map data --out map").status, 0);
  std::filesystem::resize_file(folder_ / "map/map.cgrid", 500);
  const Answer answer = credo("evaluate map data map");
  EXPECT_EQ(answer.status, 1);
  EXPECT_THAT(answer.error, HasSubstr("map.cgrid: is cut short: has 500 bytes"));
}

}  // namespace
