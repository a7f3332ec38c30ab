// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/pose_blur.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>

#include "geometry/angles.hpp"
#include "geometry/principal_axes.hpp"
#include "mapping/pose_reliability.hpp"

namespace credo::mapping {
namespace {

using evidence::Believed;
using evidence::FixedLogCommonality;
using geometry::PoseEstimate;

constexpr double kPairsPerCell = 4.0;  // of spread: poses half a cell apart in the middle, one cell at 1-sigma
constexpr double kFewestPairs = 4.0;   // as many have a covariance of full rank

/// By Newton's method from the middle: it nears the quantile from one side.
double normal_quantile(double probability) {
  double x = 0.0;
  for (int step = 0; step < 20; ++step) {
    const double below = 0.5 * std::erfc(-x / std::numbers::sqrt2);
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
    x -= (below - probability) / density;
  }
  return x;
}

/// Lower triangle L with L L' = covariance; what has no variance has a column of zeros.
Eigen::Matrix3d root(const Eigen::Matrix3d& covariance) {
  Eigen::Matrix3d lower = Eigen::Matrix3d::Zero();
  for (int j = 0; j < 3; ++j) {
    const double pivot = covariance(j, j) - lower.row(j).head(j).squaredNorm();
    if (!(pivot > 0.0)) continue;
    lower(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < 3; ++i)
      lower(i, j) = (covariance(i, j) - lower.row(i).head(j).dot(lower.row(j).head(j))) / lower(j, j);
  }
  return lower;
}

/// One of each pair of points of a normal distribution, the other being its mirror image: even along any direction
/// (additive recurrence of the root of x^4 = x + 1, Roberts 2018), with the covariance 1 exactly.
std::vector<Eigen::Vector3d> normal_points(int pairs) {
  constexpr double kRoot = 1.2207440846057596;
  std::vector<Eigen::Vector3d> points;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int k = 0; k < pairs; ++k) {
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis) {
      const double place = 0.5 + (k + 0.5) * std::pow(kRoot, -(axis + 1));
      point[axis] = normal_quantile(place - std::floor(place));
    }
    covariance += point * point.transpose() / pairs;
    points.push_back(point);
  }
  const Eigen::Matrix3d lower = root(covariance);
  for (Eigen::Vector3d& point : points) lower.triangularView<Eigen::Lower>().solveInPlace(point);
  return points;
}

/// Of the ranges that can be mapped; 0 where there is none. [m]
double farthest(std::span<const float> ranges_m, double range_max_m) {
  double result = 0.0;
  for (const float range_m : ranges_m)
    if (range_m <= range_max_m) result = std::max(result, static_cast<double>(range_m));
  return result;
}

void add_channel(std::vector<double>& sums, std::span<const std::int32_t> channel) {
  // Neighbours often say the same: their exponential is kept.
  std::int32_t last = 0;
  double lacking = 0.0;
  for (std::size_t i = 0; i < channel.size(); ++i) {
    if (channel[i] == 0) continue;
    if (channel[i] != last) {
      last = channel[i];
      lacking = -std::expm1(last * FixedLogCommonality::kUnit);
    }
    sums[i] += lacking;
  }
}

}  // namespace

std::vector<Believed<PoseEstimate>> poses_for_blur(const Believed<PoseEstimate>& T_map_base,
                                                   std::span<const float> ranges_m, double range_max_m,
                                                   double resolution_m, const PoseBlurParams& params) {
  require_usable(T_map_base.value);
  if (!(params.from_cells > 0.0 && params.most_cells > 0.0 && std::isfinite(params.most_cells)))
    throw std::invalid_argument("from_cells and most_cells of the blur must be above 0, and most_cells finite");
  const auto& [pose, covariance] = T_map_base.value;
  if (covariance.isZero(0.0)) return {};
  const double farthest_m = farthest(ranges_m, range_max_m);
  const double variance_m2 =
      geometry::largest_variance(covariance.topLeftCorner<2, 2>()) + covariance(2, 2) * farthest_m * farthest_m;
  const double spread_cells = std::sqrt(variance_m2) / resolution_m;
  if (!(spread_cells > params.from_cells)) return {};

  const double blurring_cells = std::min(spread_cells, params.most_cells);
  const double share = (blurring_cells / spread_cells) * (blurring_cells / spread_cells);
  const Eigen::Matrix3d lower = root(share * covariance);
  const PoseEstimate rest{pose, (1.0 - share) * covariance};
  std::vector<Believed<PoseEstimate>> poses;
  for (const Eigen::Vector3d& point :
       normal_points(static_cast<int>(std::max(kFewestPairs, std::ceil(kPairsPerCell * blurring_cells)))))
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector3d error = side * (lower * point);
      poses.push_back({rest, T_map_base.belief});
      poses.back().value.pose = {pose.x + error.x(), pose.y + error.y(), geometry::wrap_angle(pose.theta + error.z())};
    }
  return poses;
}

void EvidenceMean::add(const grids::EvidentialGrid& from_one_pose) {
  ++poses_;
  for (const auto& [index, tile] : from_one_pose.tiles()) {
    Sums& sums = tiles_[index];
    for (std::vector<double>* channel : {&sums.empty, &sums.occupied, &sums.unknown})
      channel->resize(grids::Tile::kCells, 0.0);
    add_channel(sums.empty, tile.empty);
    add_channel(sums.occupied, tile.occupied);
    add_channel(sums.unknown, tile.unknown);
  }
}

void EvidenceMean::combine_into(grids::EvidentialGrid& grid) const {
  const auto log_mean = [this](double lacking) { return std::min(0.0, std::log1p(-lacking / poses_)); };
  for (const auto& [index, sums] : tiles_) {
    for (int place = 0; place < grids::Tile::kCells; ++place) {
      if (sums.unknown[place] == 0.0) continue;
      grid.add(grids::cell_of(index, place), evidence::quantise({.empty = log_mean(sums.empty[place]),
                                                                 .occupied = log_mean(sums.occupied[place]),
                                                                 .unknown = log_mean(sums.unknown[place])}));
    }
  }
}

}  // namespace credo::mapping
