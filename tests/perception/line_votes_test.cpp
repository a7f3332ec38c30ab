// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/line_votes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "annulus_image.hpp"
#include "geometry/angles.hpp"

namespace credo::perception {
namespace {

using geometry::angle_difference;
using geometry::kTurn;
using test::test_camera;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kBin_rad = 0.0044, kWindow_rad = 0.010, kOwn_rad = 0.006;
constexpr double kShare = 0.5, kChance = 5.0;

/// The votes of a camera's annulus, and the hits they are made of.
class Votes : public ::testing::Test {
 protected:
  explicit Votes(const sensors::OmniCamera& camera = test_camera())
      : camera_(camera),
        annulus_(camera, camera.center_px, evenly_spaced_radii(64.0, 226.0, 2.0), 0.7),
        votes_(annulus_, camera, kBin_rad, camera.horizon_radius_px) {}

  [[nodiscard]] int rows() const { return static_cast<int>(annulus_.rows().size()); }

  /// A step of one sign on every `every`-th row, azimuth = azimuth + slope * lever.
  void add_line(double azimuth, int polarity, int every = 1, double slope = 0.0) {
    for (int row = 0; row < rows(); row += every) add_hit(azimuth + slope * lever(row), polarity, row);
  }
  void add_hit(double azimuth, int polarity, int row) {
    hits_.push_back({.azimuth = static_cast<float>(azimuth < 0.0 ? azimuth + kTurn : azimuth),
                     .sigma = 0.001F,
                     .step = 30.0F * static_cast<float>(polarity),
                     .row = static_cast<std::int16_t>(row)});
  }
  [[nodiscard]] double lever(int row) const {
    return 1.0 / annulus_.rows()[static_cast<std::size_t>(row)].radius_px - 1.0 / camera_.horizon_radius_px;
  }
  std::vector<LinePeak> peaks(double share = kShare) {
    std::stable_sort(hits_.begin(), hits_.end(), [](const EdgeHit& a, const EdgeHit& b) { return a.row < b.row; });
    votes_.count(hits_);
    return votes_.peaks(share, kChance);
  }
  double gather(const LinePeak& peak) { return votes_.gather(peak, kWindow_rad, points_); }
  RadialFit fit(const LinePeak& peak) { return fit_radial_line(points_, gather(peak), 1.0, {}); }
  void use_up(const LinePeak& peak) {
    const RadialFit line = fit(peak);
    votes_.use_up(peak, line, kWindow_rad, kOwn_rad);
  }

  sensors::OmniCamera camera_;
  AnnulusTable annulus_;
  LineVotes votes_;
  std::vector<EdgeHit> hits_;
  RadialPoints points_;
};

TEST_F(Votes, WithoutHitsThereIsNoPeak) { EXPECT_THAT(peaks(), IsEmpty()); }

TEST_F(Votes, PeaksAreOfOneSignAndTheStrongestComesFirst) {
  add_line(1.0, +1, 2);
  add_line(1.0, -1);
  add_line(4.0, +1);
  add_line(4.0, +1);
  const auto found = peaks(0.4);
  ASSERT_THAT(found, SizeIs(3));
  const std::vector<LinePeak> expected{{4.0, +1, 2 * rows()}, {1.0, -1, rows()}, {1.0, +1, (rows() + 1) / 2}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found[i].azimuth, expected[i].azimuth, 1.5 * kBin_rad);
    EXPECT_EQ(found[i].polarity, expected[i].polarity);
    EXPECT_EQ(found[i].votes, expected[i].votes);
  }
}

TEST_F(Votes, ALineOnTooFewRowsIsNoPeak) {
  add_line(1.0, +1, 3);
  EXPECT_THAT(peaks(0.3), SizeIs(1));
  EXPECT_THAT(peaks(0.4), IsEmpty());
}

TEST_F(Votes, ScatteredHitsAreNoPeakALineAmongThemIs) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(0.0, kTurn);
  for (int i = 0; i < 20000; ++i) add_hit(anywhere(random), i % 2 == 0 ? 1 : -1, i % rows());
  EXPECT_THAT(peaks(0.1), IsEmpty()) << "21 of them are expected in three bins, more than 0.1 of the rows";
  add_line(2.0, -1);
  const auto found = peaks(0.1);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].azimuth, 2.0, 1.5 * kBin_rad);
}

TEST_F(Votes, ALineAcrossTheEndOfTheTurnIsOne) {
  for (int row = 0; row < rows(); ++row) add_hit(row % 2 == 0 ? 0.0008 : -0.0012, +1, row);
  const auto found = peaks(0.8);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(angle_difference(found[0].azimuth, 0.0), 0.0, 1.5 * kBin_rad);
  const RadialFit line = fit(found[0]);
  EXPECT_THAT(points_, SizeIs(static_cast<std::size_t>(rows())));
  EXPECT_NEAR(angle_difference(found[0].azimuth + line.azimuth, -0.0002), 0.0, 1e-4);
  use_up(found[0]);
  gather(found[0]);
  EXPECT_THAT(points_, IsEmpty());
}

TEST_F(Votes, GathersTheHitsOfThePeaksSignByRow) {
  add_line(1.001, +1, 1, 0.2);
  add_line(1.003, -1);
  add_line(1.050, +1);
  const auto found = peaks();
  const auto peak = std::find_if(found.begin(), found.end(), [](const LinePeak& p) {
    return p.polarity > 0 && std::abs(p.azimuth - 1.001) < 2.0 * kBin_rad;
  });
  ASSERT_NE(peak, found.end());
  const double median = gather(*peak);
  ASSERT_THAT(points_, SizeIs(static_cast<std::size_t>(rows())));
  for (int row = 0; row < rows(); ++row) {
    const RadialPoint point = points_[static_cast<std::size_t>(row)];
    EXPECT_EQ(point.row, row);
    EXPECT_EQ(point.step, 30.0);
    EXPECT_DOUBLE_EQ(point.lever, lever(row));
    EXPECT_NEAR(peak->azimuth + point.azimuth, 1.001 + 0.2 * lever(row), 1e-6);
  }
  EXPECT_NEAR(peak->azimuth + median, 1.001, 0.001);
}

TEST_F(Votes, HitsThatAreUsedUpAreNotFoundTwice) {
  add_line(1.000, +1);
  add_line(1.0175, +1);  // in the window of the other, and a line of its own
  const auto found = peaks();
  ASSERT_THAT(found, SizeIs(2));
  use_up(found[0]);
  EXPECT_EQ(gather(found[0]), 0.0);
  EXPECT_THAT(points_, IsEmpty());
  gather(found[1]);
  EXPECT_THAT(points_, SizeIs(static_cast<std::size_t>(rows())));
  EXPECT_THAT(peaks(), SizeIs(2)) << "counted anew, nothing is used";
  gather(found[0]);
  EXPECT_GE(points_.size(), static_cast<std::size_t>(rows()));
}

TEST_F(Votes, DirectionsAreThoseOfTheAzimuthAndOfTheCamera) {
  for (const double azimuth : {0.0, 1.0, -2.0, 6.2, 7.0}) {
    const Eigen::Vector2d expected(std::cos(azimuth), std::sin(azimuth));
    const LineVotes::Direction& found = votes_.direction(azimuth);
    EXPECT_LT((found.in_base - expected).norm(), kBin_rad);
    EXPECT_LT((found.in_image - camera_.image_direction(azimuth)).norm(), kBin_rad);
  }
}

/// The camera's right half, azimuths around 0, is masked beyond a radius of 145 px.
class VotesOfAMaskedCamera : public Votes {
 protected:
  VotesOfAMaskedCamera() : Votes(masked()) {}
  static sensors::OmniCamera masked() {
    sensors::OmniCamera camera = test_camera();
    camera.mask = cv::Mat(camera.height_px, camera.width_px, CV_8UC1);
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        const Eigen::Vector2d from_center = Eigen::Vector2d(u, v) - camera.center_px;
        camera.mask.at<std::uint8_t>(v, u) = from_center.x() > 0.0 && from_center.norm() > 145.0 ? 0 : 255;
      }
    }
    return camera;
  }
};

TEST_F(VotesOfAMaskedCamera, AskForTheShareOfTheRowsThatCanBeSeen) {
  EXPECT_EQ(votes_.usable_rows(3.0), rows());
  EXPECT_NEAR(votes_.usable_rows(0.2), (145.0 - 64.0) / 2.0, 2.0);
  for (const double azimuth : {0.2, 3.0}) {
    for (int row = 0; row < 38; ++row) add_hit(azimuth, +1, row);
  }
  const auto found = peaks(0.8);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].azimuth, 0.2, 1.5 * kBin_rad);
}

}  // namespace
}  // namespace credo::perception
