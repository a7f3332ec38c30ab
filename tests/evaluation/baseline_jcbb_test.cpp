// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/baseline_jcbb.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <functional>
#include <set>
#include <utility>

#include "evaluation/consistency.hpp"
#include "sim/random.hpp"

namespace credo::evaluation {
namespace {

using localization::PoseState;

/// Marks along a line, seen by a robot that knows where it is along it to `sigma`.
struct Line {
  double sigma = 0.5;
  double noise = 0.02;

  [[nodiscard]] PoseState::Matrix covariance() const {
    PoseState::Matrix P = 1e-12 * PoseState::Matrix::Identity();
    P(0, 0) = sigma * sigma;
    return P;
  }
  /// What each sighting may be, as predicted from the origin.
  [[nodiscard]] Pairings pairings(const std::vector<double>& seen, const std::vector<double>& marks,
                                  bool exclusive = true) const {
    Pairings result(seen.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      for (std::size_t j = 0; j < marks.size(); ++j) {
        Pairing p{.landmark = static_cast<int>(j), .exclusive = exclusive, .rows = 1};
        p.residual(0) = seen[i] - marks[j];
        p.by_state(0, 0) = 1.0;
        p.noise(0, 0) = noise * noise;
        p.distance_squared = p.residual(0) * p.residual(0) / (sigma * sigma + noise * noise);
        if (p.distance_squared < chi_square_quantile(0.99, 1)) result[i].push_back(p);
      }
      std::ranges::stable_sort(result[i], {}, &Pairing::distance_squared);
    }
    return result;
  }
};

std::vector<int> landmarks(const Pairings& pairings, const std::vector<int>& chosen) {
  std::vector<int> result;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    result.push_back(chosen[i] < 0 ? -1 : pairings[i][static_cast<std::size_t>(chosen[i])].landmark);
  return result;
}

/// Squared joint distance by the whole covariance at once: -1 for an impossible set.
double joint_distance(const Line& line, const Pairings& pairings, const std::vector<int>& chosen, int& size) {
  std::vector<double> residuals;
  std::set<int> used;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i] < 0) continue;
    const Pairing& p = pairings[i][static_cast<std::size_t>(chosen[i])];
    if (!used.insert(p.landmark).second) return -1.0;
    residuals.push_back(p.residual(0));
  }
  size = static_cast<int>(residuals.size());
  if (size == 0) return 0.0;
  const Eigen::Map<const Eigen::VectorXd> r(residuals.data(), size);
  const Eigen::MatrixXd S = Eigen::MatrixXd::Constant(size, size, line.sigma * line.sigma) +
                            line.noise * line.noise * Eigen::MatrixXd::Identity(size, size);
  return r.dot(S.ldlt().solve(r));
}

TEST(JointCompatibility, OneShiftExplainsAllWhereNearestNeighboursTakeTheNeighbour) {
  const Line line;
  const Pairings pairings = line.pairings({0.6, 1.6, 3.1}, {0.0, 1.0, 2.5});
  EXPECT_NE(landmarks(pairings, nearest_neighbours(pairings)), (std::vector{0, 1, 2}));
  const auto joint = JointCompatibility().associate(pairings, line.covariance());
  EXPECT_EQ(landmarks(pairings, joint), (std::vector{0, 1, 2}));
}

TEST(JointCompatibility, LeavesOutWhatFitsAloneButNotTogether) {
  const Line line;
  const Pairings pairings = line.pairings({0.1, 1.1, 2.9}, {0.0, 1.0, 2.5});
  EXPECT_EQ(landmarks(pairings, JointCompatibility().associate(pairings, line.covariance())), (std::vector{0, 1, -1}));
}

/// Compatible by itself and in all its parts: pruning never loses it.
bool thoroughly_compatible(const Line& line, const Pairings& pairings, std::vector<int> chosen) {
  int size = 0;
  const double distance = joint_distance(line, pairings, chosen, size);
  if (distance < 0.0 || (size > 0 && distance > chi_square_quantile(0.99, size))) return false;
  for (int& one : chosen) {
    const int kept = std::exchange(one, -1);
    if (kept >= 0 && !thoroughly_compatible(line, pairings, chosen)) return false;
    one = kept;
  }
  return true;
}

TEST(JointCompatibility, NoThoroughlyCompatibleSetIsLargerOrAsLargeAndNearer) {
  sim::Random random(1);
  for (int round = 0; round < 60; ++round) {
    const Line line{.sigma = random.uniform(0.1, 0.8), .noise = 0.05};
    std::vector<double> seen, marks;
    for (int i = 0; i < 4; ++i) marks.push_back(random.uniform(0.0, 3.0));
    const double shift = random.normal(line.sigma);
    for (int i = 0; i < 4; ++i) seen.push_back(marks[static_cast<std::size_t>(i)] + shift + random.normal(0.08));
    const Pairings pairings = line.pairings(seen, marks);

    int found_size = 0;
    const auto found = JointCompatibility().associate(pairings, line.covariance());
    const double found_distance = joint_distance(line, pairings, found, found_size);
    ASSERT_GE(found_distance, 0.0);
    if (found_size > 0) {
      EXPECT_LE(found_distance, chi_square_quantile(0.99, found_size) + 1e-6);
    }

    std::vector<int> choice(4, -1);
    const std::function<void(std::size_t)> compare_all = [&](std::size_t i) {
      if (i < 4) {
        for (int k = -1; k < static_cast<int>(pairings[i].size()); ++k) choice[i] = k, compare_all(i + 1);
        return;
      }
      if (!thoroughly_compatible(line, pairings, choice)) return;
      int size = 0;
      const double distance = joint_distance(line, pairings, choice, size);
      EXPECT_LE(size, found_size) << round;
      if (size == found_size) {
        EXPECT_GE(distance, found_distance - 1e-6) << round;
      }
    };
    compare_all(0);
  }
}

TEST(JointCompatibility, GivesAWallToSeveralPiecesOfIt) {
  const Line line;
  const Pairings pairings = line.pairings({0.5, 0.51}, {0.0}, false);
  EXPECT_EQ(landmarks(pairings, JointCompatibility().associate(pairings, line.covariance())), (std::vector{0, 0}));
}

TEST(JointCompatibility, AnswersFromWhatItHasSeenWhereTheTreeIsTooLarge) {
  const Line line{.sigma = 3.0, .noise = 0.5};
  std::vector<double> marks, seen;
  for (int i = 0; i < 24; ++i) marks.push_back(0.3 * i), seen.push_back(0.3 * i + 0.4);
  const Pairings pairings = line.pairings(seen, marks);
  const auto joint =
      JointCompatibility({.probability = 0.99, .most_nodes = 500}).associate(pairings, line.covariance());
  int size = 0;
  EXPECT_GE(joint_distance(line, pairings, joint, size), 0.0);
  EXPECT_GT(size, 12);
}

TEST(NearestNeighbours, TheNearestGetsAMarkThatSeveralWant) {
  const Line line;
  const Pairings pairings = line.pairings({0.2, 0.1}, {0.0});
  EXPECT_EQ(landmarks(pairings, nearest_neighbours(pairings)), (std::vector{-1, 0}));
}

TEST(NearestNeighbours, WithoutObservationsThereIsNothing) {
  EXPECT_TRUE(nearest_neighbours({}).empty());
  EXPECT_TRUE(JointCompatibility().associate({}, PoseState::Matrix::Identity()).empty());
}

}  // namespace
}  // namespace credo::evaluation
