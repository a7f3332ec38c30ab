// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/dataset_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <stdexcept>

#include "datasets/acquisitions.hpp"
#include "datasets/floor_plan_file.hpp"
#include "tests/datasets/small_dataset.hpp"

namespace credo::datasets {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

bool is_empty(const TemporaryFolder& folder) { return std::filesystem::is_empty(folder.path()); }

std::map<std::string, std::string> all_files(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().lexically_relative(folder)] = read_all(entry.path());
  return files;
}

TEST(DatasetWriter, WithoutFinishLeavesNothing) {
  const TemporaryFolder folder;
  {
    DatasetWriter writer(folder / "set", small_header());
    writer.add_odometry({kStart, {}});
    EXPECT_FALSE(std::filesystem::exists(folder / "set"));
    EXPECT_FALSE(is_empty(folder));
  }
  EXPECT_TRUE(is_empty(folder));
}

TEST(DatasetWriter, GivesTheSameBytesAgain) {
  const TemporaryFolder folder;
  write_small_dataset(folder / "a");
  write_small_dataset(folder / "b");
  EXPECT_EQ(all_files(folder / "a"), all_files(folder / "b"));
}

TEST(DatasetWriter, RefusesATargetThatIsThere) {
  const TemporaryFolder folder;
  write_small_dataset(folder / "set");
  EXPECT_THAT([&] { write_small_dataset(folder / "set"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is there already")));
  DatasetHeader header = small_header();
  header.name = "another";
  write_small_dataset(folder / "set", header, {.overwrite = true});
  EXPECT_EQ(Dataset::open(folder / "set").header.name, "another");
  folder.write("precious/thesis.txt", "ten years of work");
  EXPECT_THAT([&] { write_small_dataset(folder / "precious", header, {.overwrite = true}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is no dataset")));
  EXPECT_EQ(read_all(folder / "precious/thesis.txt"), "ten years of work");
}

TEST(DatasetWriter, RefusesAHeaderThatNoReaderWouldTake) {
  const TemporaryFolder folder;
  const auto with = [&](auto change) {
    DatasetHeader header = small_header();
    change(header);
    return [&folder, header] { DatasetWriter writer(folder / "set", header); };
  };
  EXPECT_THAT(with([](DatasetHeader& h) { h.rig.range_finders[0].count = 0; }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("would not be accepted")));
  EXPECT_THROW(with([](DatasetHeader& h) { h.floor_plan->walls.clear(); })(), std::invalid_argument);
  EXPECT_THROW(with([](DatasetHeader& h) { h.rig.camera->center_px.x() = std::nan(""); })(), std::invalid_argument);
  EXPECT_TRUE(is_empty(folder));
}

TEST(DatasetWriter, RefusesRowsThatDoNotFit) {
  const TemporaryFolder folder;
  DatasetWriter writer(folder / "set", small_header());
  EXPECT_THROW(writer.add_scan({kStart, 0, {1.0F}}), std::invalid_argument);
  EXPECT_THROW(writer.add_scan({kStart, 2, {1.0F, 1.0F, 1.0F}}), std::invalid_argument);
  EXPECT_THROW(writer.add_sonar({kStart, -1, {1.0F, 1.0F}}), std::invalid_argument);
  EXPECT_THROW(writer.add_odometry({kStart, {std::nan(""), 0.0, 0.0}}), std::invalid_argument);
  EXPECT_THROW(writer.add_image(kStart, cv::Mat(10, 10, CV_8UC1)), std::invalid_argument);
  EXPECT_THROW(writer.add_image(kStart, cv::Mat(24, 32, CV_16UC1)), std::invalid_argument);
  EXPECT_THROW(writer.add_event({kStart, "two\nlines"}), std::invalid_argument);
  writer.add_truth({kStart, {}});
  EXPECT_THROW(writer.add_truth({kStart - 1, {}}), std::invalid_argument);
  writer.finish();
  EXPECT_TRUE(std::filesystem::exists(folder / "set/groundtruth0/data.csv"));
}

TEST(DatasetWriter, ColourImagesAndMissingOnesComeBack) {
  const TemporaryFolder folder;
  DatasetWriter writer(folder / "set", small_header());
  writer.add_image(kStart, cv::Mat(24, 32, CV_8UC3, cv::Scalar(0, 0, 255)));
  writer.add_image(kStart + 1, cv::Mat());
  writer.add_image(kStart + 1, cv::Mat(24, 32, CV_8UC1, cv::Scalar(9)));
  writer.add_image(kStart + 1, cv::Mat(24, 32, CV_8UC1, cv::Scalar(10)));
  writer.finish();
  const Dataset dataset = Dataset::open(folder / "set");
  ASSERT_EQ(dataset.images.size(), 4U);
  const Acquisitions acquisitions(dataset);
  EXPECT_EQ(acquisitions.read(0).image->pixels.at<unsigned char>(0, 0), 76);  // 0.299 * 255
  EXPECT_EQ(acquisitions.read(1).image->pixels.at<unsigned char>(0, 0), 10);
}

TEST(FloorPlanFile, ComesBackAsItWent) {
  const TemporaryFolder folder;
  const geometry::FloorPlan plan{
      .walls = {{{-1.25, 0.000001}, {3.0, 1e5}}, {{0.1, 0.2}, {0.3, 0.4}}}, .verticals = {}, .uncertainty_m = 0.01};
  write_floor_plan(folder / "plan.yaml", plan);
  EXPECT_EQ(read_floor_plan(folder / "plan.yaml"), plan);
  EXPECT_THROW(write_floor_plan(folder / "plan.yaml", geometry::FloorPlan{}), std::invalid_argument);
  EXPECT_EQ(read_floor_plan(folder / "plan.yaml"), plan);
  EXPECT_THROW(write_floor_plan(folder / "nowhere/plan.yaml", plan), std::runtime_error);
}

}  // namespace
}  // namespace credo::datasets
