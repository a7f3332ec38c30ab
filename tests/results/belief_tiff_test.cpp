// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/belief_tiff.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace credo::results {
namespace {

class BeliefTiff : public ::testing::Test {
 protected:
  [[nodiscard]] std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  tests::TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path();
  std::filesystem::path file_ = folder_ / "map_belief.tiff";
};

BeliefImage numbered(int width, int height) {
  BeliefImage image{.width = width, .height = height, .pixels = {}};
  for (int i = 0; i < width * height; ++i) {
    const float v = static_cast<float>(i);
    image.pixels.push_back({v, v + 0.25F, v + 0.5F, -v});
  }
  return image;
}

/// The first directory as the TIFF 6.0 specification has it, independent of the room's own reader. Little-endian
/// machine.
std::map<int, std::vector<std::uint32_t>> directory(const std::string& bytes) {
  const auto at = [&](std::size_t place, int size) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + place, static_cast<std::size_t>(size));
    return value;
  };
  EXPECT_EQ(bytes.substr(0, 4), std::string("II\x2a\0", 4));
  const std::size_t place = at(4, 4);
  EXPECT_EQ(place % 2, 0u);
  std::map<int, std::vector<std::uint32_t>> fields;
  std::uint32_t last = 0;
  for (std::uint32_t i = 0; i < at(place, 2); ++i) {
    const std::size_t field = place + 2 + 12 * i;
    const std::uint32_t tag = at(field, 2), type = at(field + 2, 2), count = at(field + 4, 4);
    EXPECT_GT(tag, last) << "fields must be in ascending order";
    last = tag;
    const int size = type == 3 ? 2 : type == 4 ? 4 : 1;
    const std::size_t values = count * static_cast<std::uint32_t>(size) <= 4 ? field + 8 : at(field + 8, 4);
    for (std::uint32_t k = 0; k < count; ++k)
      fields[static_cast<int>(tag)].push_back(at(values + k * static_cast<std::size_t>(size), size));
  }
  return fields;
}

TEST_F(BeliefTiff, IsABaselineTiffOfFourFloatChannels) {
  const BeliefImage image = numbered(5, 3);
  write_belief_tiff(image, file_);
  const std::string data = bytes();
  auto fields = directory(data);
  using Values = std::vector<std::uint32_t>;
  EXPECT_EQ(fields[256], Values{5});
  EXPECT_EQ(fields[257], Values{3});
  EXPECT_EQ(fields[258], (Values{32, 32, 32, 32}));
  EXPECT_EQ(fields[259], Values{1});
  EXPECT_EQ(fields[277], Values{4});
  EXPECT_EQ(fields[278], Values{3});
  EXPECT_EQ(fields[279], Values{5 * 3 * 16});
  EXPECT_EQ(fields[284], Values{1});
  EXPECT_EQ(fields[338], (Values{0, 0, 0}));
  EXPECT_EQ(fields[339], (Values{3, 3, 3, 3}));
  ASSERT_EQ(fields[273].size(), 1u);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    std::array<float, 4> pixel{};
    std::memcpy(pixel.data(), data.data() + fields[273][0] + 16 * i, 16);
    EXPECT_EQ(pixel, image.pixels[i]) << i;
  }
}

TEST_F(BeliefTiff, AnotherLibraryFindsTheSameFloats) {
  const BeliefImage image = numbered(7, 4);
  write_belief_tiff(image, file_);
  const cv::Mat read = cv::imread(file_.string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.type(), CV_32FC4);
  ASSERT_EQ(read.cols, 7);
  ASSERT_EQ(read.rows, 4);
  // OpenCV takes four channels for red, green, blue and opacity, and hands them out as blue, green, red and opacity.
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 7; ++x) {
      const auto pixel = read.at<cv::Vec4f>(y, x);
      const auto& expected = image.pixels[static_cast<std::size_t>(y) * 7 + static_cast<std::size_t>(x)];
      EXPECT_EQ(pixel[2], expected[0]);
      EXPECT_EQ(pixel[1], expected[1]);
      EXPECT_EQ(pixel[0], expected[2]);
      EXPECT_EQ(pixel[3], expected[3]);
    }
}

TEST_F(BeliefTiff, IsReadBack) {
  write_belief_tiff(numbered(9, 2), file_);
  EXPECT_EQ(read_belief_tiff(file_), numbered(9, 2));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);  // nothing temporary is left
}

TEST_F(BeliefTiff, RefusesFilesOfAnotherKind) {
  EXPECT_THROW(static_cast<void>(read_belief_tiff(file_)), std::runtime_error);
  const auto refuses = [&](const std::string& content) {
    std::ofstream(file_, std::ios::binary) << content;
    EXPECT_THROW(static_cast<void>(read_belief_tiff(file_)), std::runtime_error);
  };
  refuses("");
  refuses("no picture at all");
  write_belief_tiff(numbered(4, 4), file_);
  const std::string whole = bytes();
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{9}}) refuses(whole.substr(0, size));
  std::string compressed = whole;  // the value of tag 259
  compressed.replace(compressed.find(std::string("\x03\x01\x03\x00\x01\x00\x00\x00", 8)) + 8, 1, "\x05");
  refuses(compressed);
  ASSERT_TRUE(cv::imwrite(file_.string(), cv::Mat(3, 3, CV_8UC1, cv::Scalar(7))));
  EXPECT_THROW(static_cast<void>(read_belief_tiff(file_)), std::runtime_error);
}

TEST_F(BeliefTiff, RefusesToWriteWhatIsNoPicture) {
  BeliefImage image = numbered(3, 3);
  image.pixels.pop_back();
  EXPECT_THROW(write_belief_tiff(image, file_), std::invalid_argument);
  EXPECT_THROW(write_belief_tiff(BeliefImage{}, file_), std::invalid_argument);
  EXPECT_THROW(write_belief_tiff(numbered(2, 2), folder_ / "missing" / "map.tiff"), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST(BeliefImage, HoldsTheMassesOfTheGridTopRowFirst) {
  grids::EvidentialGrid grid;
  const auto seen = [](double empty, double occupied) {
    return evidence::quantise(evidence::log_commonality({empty, occupied, 0.0, 1.0 - empty - occupied}, 0.9));
  };
  grid.add({3, 7}, seen(0.8, 0.1));
  grid.add({4, 8}, seen(0.8, 0.0) + seen(0.0, 0.8));
  const BeliefImage image = belief_image(grid);
  ASSERT_EQ(image.width, 2);
  ASSERT_EQ(image.height, 2);
  const auto& [top_left, top_right, low_left, low_right] =
      std::tie(image.pixels[0], image.pixels[1], image.pixels[2], image.pixels[3]);
  EXPECT_EQ(top_left, (std::array<float, 4>{0.0F, 0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(low_right, top_left);
  EXPECT_NEAR(low_left[0], 0.72, 0.02);
  EXPECT_NEAR(low_left[0] + low_left[1] + low_left[3], 1.0F, 1e-6F);
  EXPECT_NEAR(top_right[2], 1.0F, 1e-5F);  // as much for as against
  EXPECT_NEAR(top_right[0], top_right[1], 1e-6F);

  const BeliefImage raw = belief_image(grid, BeliefChannels::kRaw);
  const auto& contested = raw.pixels[1];
  EXPECT_NEAR(contested[2], 0.72F * 0.72F, 1e-4F);  // mass of the conflict
  EXPECT_NEAR(contested[0] + contested[1] + contested[2] + contested[3], 1.0F, 1e-6F);
  EXPECT_EQ(belief_image(grids::EvidentialGrid{}).pixels,
            (std::vector<std::array<float, 4>>{{0.0F, 0.0F, 0.0F, 1.0F}}));
}

}  // namespace
}  // namespace credo::results
