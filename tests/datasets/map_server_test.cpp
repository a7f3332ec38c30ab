// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/map_server.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <vector>

#include "datasets/format_error.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace credo::datasets {
namespace {

constexpr const char* kYaml =
    "image: map.png\nresolution: 0.05\norigin: [-1.5, 2.0, 0.1]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: "
    "0.196\n";

OccupancyMap small_map() {
  return {.width = 3,
          .height = 2,
          .resolution_m = 0.05,
          .origin_x_m = -1.5,
          .origin_y_m = 2.25,
          .origin_yaw_rad = 0.0,
          .cells = {0, 100, -1, -1, -1, 100}};
}

/// A PGM and nothing else: the pixels, top row first.
std::vector<int> grey_of_pgm(const std::filesystem::path& file, int& width, int& height) {
  std::istringstream in(read_all(file));
  std::string magic, line;
  int white = 0;
  std::getline(in, magic);
  while (in.peek() == '#') std::getline(in, line);
  in >> width >> height >> white;
  in.get();
  EXPECT_EQ(magic, "P5");
  EXPECT_EQ(white, 255);
  std::vector<int> grey;
  for (int byte = in.get(); byte >= 0; byte = in.get()) grey.push_back(byte);
  return grey;
}

// The trinary rules of the two map servers, written out with what they take for granted.
int ros1_trinary(int grey, double occupied_threshold, double free_threshold) {
  const double occupied = (255 - grey) / 255.0;
  if (occupied > occupied_threshold) return 100;
  if (occupied < free_threshold) return 0;
  return -1;
}
int nav2_trinary(int grey, double occupied_threshold, double free_threshold) {
  const double shade = grey / 255.0, occupied = 1.0 - shade;
  if (occupied_threshold < occupied) return 100;
  if (occupied < free_threshold) return 0;
  return -1;
}

// The same for the other modes.
int nav2_scale(int grey, int alpha, double occupied_threshold, double free_threshold) {
  const double occupied = 1.0 - grey / 255.0;
  if (alpha < 255) return -1;
  if (occupied > occupied_threshold) return 100;
  if (occupied < free_threshold) return 0;
  return static_cast<int>(std::rint((occupied - free_threshold) / (occupied_threshold - free_threshold) * 100.0));
}
int ros1_scale(int grey, int alpha, double occupied_threshold, double free_threshold) {
  const double occupied = (255 - grey) / 255.0;
  if (occupied > occupied_threshold) return 100;
  if (occupied < free_threshold) return 0;
  if (alpha < 1.0) return -1;
  return static_cast<int>(1 + 98 * (occupied - free_threshold) / (occupied_threshold - free_threshold));
}
int nav2_raw(int grey) { return grey <= 100 ? grey : -1; }
int ros1_raw(int grey) { return static_cast<std::int8_t>(grey); }

/// Unknown and every percentage, in one row.
OccupancyMap every_value() {
  OccupancyMap map{.width = 102, .height = 1, .cells = {}};
  for (int value = -1; value <= 100; ++value) map.cells.push_back(static_cast<std::int8_t>(value));
  return map;
}

double yaml_number(const std::string& yaml, const std::string& key) {
  return std::stod(yaml.substr(yaml.find(key + ": ") + key.size() + 2));
}

TEST(MapServer, AScaleIsReadBackByNav2AsItWasAndByRos1WithinOne) {
  const TemporaryFolder folder;
  const OccupancyMap map = every_value();
  write_map(map, folder / "map.yaml", MapMode::kScale);
  const std::string yaml = read_all(folder / "map.yaml");
  EXPECT_NE(yaml.find("image: map.png\nmode: scale\n"), std::string::npos) << yaml;
  const double occupied = yaml_number(yaml, "occupied_thresh"), free = yaml_number(yaml, "free_thresh");
  const cv::Mat picture = cv::imread((folder / "map.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(picture.type(), CV_8UC4);
  const OccupancyMap nav2 = read_map(folder / "map.yaml"), ros1 = read_map(folder / "map.yaml", MapRules::kRos1);
  EXPECT_EQ(nav2, map);
  for (int x = 0; x < map.width; ++x) {
    const auto pixel = picture.at<cv::Vec4b>(0, x);
    EXPECT_EQ(nav2_scale(pixel[0], pixel[3], occupied, free), map.at(x, 0));
    const int there = ros1_scale(pixel[0], pixel[3], occupied, free);
    EXPECT_EQ(ros1.at(x, 0), there);
    const bool an_end = map.at(x, 0) <= 0 || map.at(x, 0) == 100;
    EXPECT_NEAR(there, map.at(x, 0), an_end ? 0 : 1);
  }
}

TEST(MapServer, RawValuesAreReadBackByEveryone) {
  const TemporaryFolder folder;
  const OccupancyMap map = every_value();
  write_map(map, folder / "map.yaml", MapMode::kRaw);
  EXPECT_EQ(read_map(folder / "map.yaml"), map);
  EXPECT_EQ(read_map(folder / "map.yaml", MapRules::kRos1), map);
  int width = 0, height = 0;
  const std::vector<int> grey = grey_of_pgm(folder / "map.pgm", width, height);
  ASSERT_EQ(grey.size(), map.cells.size());
  for (std::size_t i = 0; i < grey.size(); ++i) {
    EXPECT_EQ(nav2_raw(grey[i]), map.cells[i]);
    EXPECT_EQ(ros1_raw(grey[i]), map.cells[i]);
  }
}

TEST(MapServer, WhatIsWrittenIsReadBackByEveryone) {
  const TemporaryFolder folder;
  const OccupancyMap map = small_map();
  write_map(map, folder / "map.yaml");
  EXPECT_EQ(read_map(folder / "map.yaml"), map);
  EXPECT_EQ(read_map(folder / "map.yaml", MapRules::kRos1), map);

  int width = 0, height = 0;
  const std::vector<int> grey = grey_of_pgm(folder / "map.pgm", width, height);
  ASSERT_EQ(width, 3);
  ASSERT_EQ(height, 2);
  ASSERT_EQ(grey.size(), 6u);
  const std::string yaml = read_all(folder / "map.yaml");
  EXPECT_NE(yaml.find("occupied_thresh: 0.65\n"), std::string::npos);
  EXPECT_NE(yaml.find("free_thresh: 0.196\n"), std::string::npos);
  EXPECT_NE(yaml.find("negate: 0\n"), std::string::npos);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      const int pixel = grey[(height - 1 - y) * width + x];
      EXPECT_EQ(ros1_trinary(pixel, 0.65, 0.196), map.at(x, y)) << x << ' ' << y;
      EXPECT_EQ(nav2_trinary(pixel, 0.65, 0.196), map.at(x, y)) << x << ' ' << y;
    }
}

TEST(MapServer, UnknownWouldReadAsFreeWithNav2sOwnThreshold) {
  EXPECT_EQ(nav2_trinary(205, 0.65, 0.25), 0);  // why 0.196 is written
  EXPECT_EQ(nav2_trinary(205, 0.65, 0.196), -1);
}

TEST(MapServer, WritesNothingButTheTwoFiles) {
  const TemporaryFolder folder;
  write_map(small_map(), folder / "map.yaml");
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++files;
    EXPECT_TRUE(entry.path().filename() == "map.yaml" || entry.path().filename() == "map.pgm") << entry.path();
  }
  EXPECT_EQ(files, 2);
}

TEST(MapServer, RefusesToWriteWhatIsNoMap) {
  const TemporaryFolder folder;
  OccupancyMap map = small_map();
  map.cells.pop_back();
  EXPECT_THROW(write_map(map, folder / "map.yaml"), std::invalid_argument);
  map = small_map();
  map.resolution_m = 0.0;
  EXPECT_THROW(write_map(map, folder / "map.yaml"), std::invalid_argument);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THROW(write_map(small_map(), folder / "missing" / "map.yaml"), std::runtime_error);
}

TEST(MapServer, DecidesAGrid) {
  grids::EvidentialGrid grid(grids::Georeference{.resolution_m = 0.1, .origin_x_m = 5.0, .origin_y_m = -1.0});
  const auto seen = [](double empty, double occupied) {
    return evidence::quantise(evidence::log_commonality({empty, occupied, 0.0, 1.0 - empty - occupied}, 0.95));
  };
  grid.add({-2, 3}, seen(0.9, 0.05));
  grid.add({0, 3}, seen(0.05, 0.9));
  grid.add({0, 4}, seen(0.9, 0.0) + seen(0.0, 0.9));
  const OccupancyMap map = to_occupancy(grid);
  EXPECT_EQ(map.width, 3);
  EXPECT_EQ(map.height, 2);
  EXPECT_DOUBLE_EQ(map.origin_x_m, 4.8);
  EXPECT_DOUBLE_EQ(map.origin_y_m, -0.7);
  EXPECT_EQ(map.cells, (std::vector<std::int8_t>{0, -1, 100, -1, -1, -1}));
  const OccupancyMap nothing = to_occupancy(grids::EvidentialGrid{});
  EXPECT_EQ(nothing.cells, std::vector<std::int8_t>{-1});
}

/// A picture of one row through read_map.
std::vector<std::int8_t> read_row(const TemporaryFolder& folder, const cv::Mat& picture, const std::string& yaml) {
  EXPECT_TRUE(cv::imwrite((folder / "map.png").string(), picture));
  folder.write("map.yaml", yaml);
  return read_map(folder / "map.yaml").cells;
}

TEST(MapServer, ReadsTrinaryWithStrictInequalities) {
  const TemporaryFolder folder;
  const cv::Mat grey = (cv::Mat_<std::uint8_t>(1, 6) << 0, 89, 90, 205, 206, 255);
  // (255 - 89)/255 = 0.651, (255 - 90)/255 = 0.647, (255 - 205)/255 = 0.19608, (255 - 206)/255 = 0.192
  EXPECT_EQ(read_row(folder, grey, kYaml), (std::vector<std::int8_t>{100, 100, -1, -1, 0, 0}));
  EXPECT_EQ(read_row(folder, grey, std::string(kYaml).replace(std::string(kYaml).find("negate: 0"), 9, "negate: 1")),
            (std::vector<std::int8_t>{0, -1, -1, 100, 100, 100}));
  EXPECT_EQ(read_row(folder, grey, std::string(kYaml).replace(std::string(kYaml).find("negate: 0"), 9, "negate: true")),
            (std::vector<std::int8_t>{0, -1, -1, 100, 100, 100}));
  // Equal to a threshold is neither.
  const std::string half =
      "image: map.png\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.6\nfree_thresh: 0.4\n";
  const cv::Mat equal = (cv::Mat_<std::uint8_t>(1, 2) << 102, 153);  // exactly 0.6 and 0.4
  EXPECT_EQ(read_row(folder, equal, half), (std::vector<std::int8_t>{-1, -1}));
}

TEST(MapServer, ReadsTheTopRowAsTheLast) {
  const TemporaryFolder folder;
  const cv::Mat grey = (cv::Mat_<std::uint8_t>(2, 2) << 0, 254, 205, 205);
  EXPECT_EQ(read_row(folder, grey, kYaml), (std::vector<std::int8_t>{-1, -1, 100, 0}));
  const OccupancyMap map = read_map(folder / "map.yaml");
  EXPECT_DOUBLE_EQ(map.origin_x_m, -1.5);
  EXPECT_DOUBLE_EQ(map.origin_yaw_rad, 0.1);
}

TEST(MapServer, ReadsScaleAndRaw) {
  const TemporaryFolder folder;
  const cv::Mat grey = (cv::Mat_<std::uint8_t>(1, 5) << 0, 100, 150, 250, 101);
  const auto scaled = read_row(folder, grey, std::string(kYaml) + "mode: scale\n");
  const auto expected = [](int value) {
    return static_cast<std::int8_t>(std::rint(((1.0 - value / 255.0) - 0.196) / (0.65 - 0.196) * 100.0));
  };
  EXPECT_EQ(scaled, (std::vector<std::int8_t>{100, expected(100), expected(150), 0, expected(101)}));
  EXPECT_EQ(read_row(folder, grey, std::string(kYaml) + "mode: raw\n"), (std::vector<std::int8_t>{0, 100, -1, -1, -1}));
}

TEST(MapServer, ReadsTransparency) {
  const TemporaryFolder folder;
  cv::Mat bgra(1, 3, CV_8UC4);
  bgra.at<cv::Vec4b>(0, 0) = {0, 0, 0, 255};      // trinary: (0 + 0 + 0 + 1) / 4 = 0.25 -> occupied 0.75
  bgra.at<cv::Vec4b>(0, 1) = {255, 255, 255, 0};  // 0.75 -> 0.25: neither
  bgra.at<cv::Vec4b>(0, 2) = {255, 255, 255, 255};
  EXPECT_EQ(read_row(folder, bgra, kYaml), (std::vector<std::int8_t>{100, -1, 0}));
  EXPECT_EQ(read_row(folder, bgra, std::string(kYaml) + "mode: scale\n"), (std::vector<std::int8_t>{100, -1, 0}));
}

TEST(MapServer, TheTwoServersDisagreeOnScaleAndRaw) {
  const TemporaryFolder folder;
  cv::Mat bgra(1, 4, CV_8UC4);
  bgra.at<cv::Vec4b>(0, 0) = {0, 0, 0, 0};          // occupied before it is transparent, for ROS 1
  bgra.at<cv::Vec4b>(0, 1) = {150, 150, 150, 128};  // half transparent: nav2 alone calls it unknown
  bgra.at<cv::Vec4b>(0, 2) = {150, 150, 150, 0};
  bgra.at<cv::Vec4b>(0, 3) = {150, 150, 150, 255};
  const double ratio = ((255 - 150) / 255.0 - 0.196) / (0.65 - 0.196);
  const auto rounded = static_cast<std::int8_t>(std::rint(100.0 * ratio)),
             cut = static_cast<std::int8_t>(1 + 98 * ratio);
  const std::string scale = std::string(kYaml) + "mode: scale\n", raw = std::string(kYaml) + "mode: raw\n";
  EXPECT_EQ(read_row(folder, bgra, scale), (std::vector<std::int8_t>{-1, -1, -1, rounded}));
  EXPECT_EQ(read_map(folder / "map.yaml", MapRules::kRos1).cells, (std::vector<std::int8_t>{100, cut, -1, cut}));

  cv::Mat bgr(1, 2, CV_8UC3);
  bgr.at<cv::Vec3b>(0, 0) = {0, 225, 225};  // without blue, which ROS 1 takes for the opacity
  bgr.at<cv::Vec3b>(0, 1) = {150, 150, 150};
  EXPECT_EQ(read_row(folder, bgr, scale), (std::vector<std::int8_t>{rounded, rounded}));
  EXPECT_EQ(read_map(folder / "map.yaml", MapRules::kRos1).cells, (std::vector<std::int8_t>{-1, cut}));

  const cv::Mat grey = (cv::Mat_<std::uint8_t>(1, 5) << 0, 100, 101, 200, 255);
  EXPECT_EQ(read_row(folder, grey, raw), (std::vector<std::int8_t>{0, 100, -1, -1, -1}));
  EXPECT_EQ(read_map(folder / "map.yaml", MapRules::kRos1).cells, (std::vector<std::int8_t>{0, 100, 101, -56, -1}));
  const std::string negated = std::string(raw).replace(raw.find("negate: 0"), 9, "negate: 1");
  EXPECT_EQ(read_row(folder, grey, negated), (std::vector<std::int8_t>{0, 100, -1, -1, -1}));
  EXPECT_EQ(read_map(folder / "map.yaml", MapRules::kRos1).cells, (std::vector<std::int8_t>{-1, -101, -102, 55, 0}));
}

TEST(MapServer, GivesProbabilitiesInPercent) {
  grids::EvidentialGrid grid;
  const auto seen = [](double empty, double occupied) {
    return evidence::quantise(evidence::log_commonality({empty, occupied, 0.0, 1.0 - empty - occupied}, 0.95));
  };
  grid.add({0, 0}, seen(0.9, 0.0));                   // 0.855 empty, the rest unknown
  grid.add({1, 0}, seen(0.9, 0.0) + seen(0.0, 0.9));  // as much for as against
  grid.add({2, 0}, seen(0.1, 0.0));                   // too little to say anything
  const OccupancyMap map = to_probabilities(grid);
  EXPECT_EQ(map.cells, (std::vector<std::int8_t>{7, 50, -1}));
  EXPECT_EQ(to_probabilities(grids::EvidentialGrid{}).cells, std::vector<std::int8_t>{-1});
}

TEST(MapServer, SaysWhereAMapIsWrong) {
  const TemporaryFolder folder;
  ASSERT_TRUE(cv::imwrite((folder / "map.png").string(), cv::Mat(2, 2, CV_8UC1, cv::Scalar(0))));
  const auto expect_error = [&](const std::string& from, const std::string& to, int line, const std::string& word) {
    std::string yaml = kYaml;
    yaml.replace(yaml.find(from), from.size(), to);
    folder.write("map.yaml", yaml);
    try {
      static_cast<void>(read_map(folder / "map.yaml"));
      ADD_FAILURE() << to << " was accepted";
    } catch (const FormatError& error) {
      EXPECT_EQ(error.line(), line) << error.what();
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  expect_error("resolution: 0.05", "resolution: 0", 2, "resolution");
  expect_error("resolution: 0.05", "resolution: nan", 2, "resolution");
  expect_error("resolution: 0.05", "resolutoin: 0.05", 2, "resolution");
  expect_error("[-1.5, 2.0, 0.1]", "[-1.5, 2.0]", 3, "origin");
  expect_error("negate: 0", "negate: 2", 4, "negate");
  expect_error("free_thresh: 0.196", "free_thresh: 0.9", 6, "free_thresh");
  expect_error("free_thresh: 0.196", "free_thresh: 0.65\nmode: scale", 6, "free_thresh");
  expect_error("free_thresh: 0.196", "free_thresh: 0.196\nmode: trinry", 7, "trinary");
  expect_error("image: map.png", "image: other.png", 0, "other.png");
  folder.write("broken.png", "\x89PNG no picture");
  expect_error("image: map.png", "image: broken.png", 0, "broken.png");
  folder.write("empty.pgm", "");
  expect_error("image: map.png", "image: empty.pgm", 0, "empty.pgm");
  EXPECT_THROW(static_cast<void>(read_map(folder / "none.yaml")), FormatError);
}

/// OpenCV would say so on the standard error stream.
TEST(MapServer, ATruncatedPictureIsRefusedQuietly) {
  const TemporaryFolder folder;
  folder.write(
      "map.yaml",
      "image: map.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n");
  for (const char* pgm :
       {"P5\n# a comment\n40 30\n255\n", "P5 40 30 255\n12345", "P5 40 30", "P5\n40 30000000000\n255\n1"}) {
    folder.write("map.pgm", pgm);
    testing::internal::CaptureStderr();
    EXPECT_THROW((void)read_map(folder / "map.yaml"), FormatError) << pgm;
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << pgm;
  }
  folder.write("map.pgm", "P5\n# a comment\n3 2\n255\n123456");
  EXPECT_EQ(read_map(folder / "map.yaml").width, 3);
}

}  // namespace
}  // namespace credo::datasets
