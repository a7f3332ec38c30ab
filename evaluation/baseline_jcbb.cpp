// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/baseline_jcbb.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "evaluation/consistency.hpp"

namespace credo::evaluation {
namespace {

using localization::PoseState;

/// What a set of pairings makes of the prediction. The joint distance of the set grows by the innovation of each new
/// pairing under the filter that has taken in the others: the incremental form of Neira and Tardos 2001, eq. (20),
/// without the growing inverse.
struct JointHypothesis {
  PoseState::Vector error = PoseState::Vector::Zero();
  PoseState::Matrix covariance;
  double distance_squared = 0.0;
  std::size_t degrees = 0;
  int size = 0;

  [[nodiscard]] JointHypothesis with(const Pairing& pairing) const {
    const PoseState::Jacobian& J = pairing.by_state;
    const PoseState::Jacobian JP = J * covariance;
    const Eigen::Matrix2d inverse = (JP * J.transpose() + pairing.noise).inverse();
    const Eigen::Vector2d innovation = pairing.residual + J * error;
    const Eigen::Matrix<double, PoseState::kSize, 2> gain = JP.transpose() * inverse;
    JointHypothesis next = *this;
    next.error -= gain * innovation;
    next.covariance -= gain * JP;
    next.distance_squared += innovation.dot(inverse * innovation);
    next.degrees += static_cast<std::size_t>(pairing.rows);
    ++next.size;
    return next;
  }
};

/// Depth first, so that the bound bites early: those with the fewest landmarks to choose from come first.
std::vector<std::size_t> by_choice(const Pairings& pairings) {
  std::vector<std::size_t> order(pairings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return pairings[i].empty(); });
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (pairings[a].size() != pairings[b].size()) return pairings[a].size() < pairings[b].size();
    return pairings[a].front().distance_squared < pairings[b].front().distance_squared;
  });
  return order;
}

struct Search {
  const Pairings& pairings;
  std::vector<std::size_t> order;
  const std::vector<double>& limits;
  int nodes_left;
  std::vector<int> chosen;  ///< by observation
  std::set<tracking::LandmarkId> taken;
  std::vector<int> best;
  int best_size = 0;
  double best_distance = 0.0;

  void descend(std::size_t depth, const JointHypothesis& hypothesis) {
    const int reachable = hypothesis.size + static_cast<int>(order.size() - depth);
    if (reachable < best_size || (reachable == best_size && hypothesis.distance_squared >= best_distance)) return;
    if (depth == order.size()) {
      best = chosen;
      best_size = hypothesis.size;
      best_distance = hypothesis.distance_squared;
      return;
    }
    const std::size_t observation = order[depth];
    for (std::size_t k = 0; k < pairings[observation].size(); ++k) {
      const Pairing& pairing = pairings[observation][k];
      if (pairing.exclusive && taken.contains(pairing.landmark)) continue;
      if (--nodes_left < 0) return;
      const JointHypothesis next = hypothesis.with(pairing);
      if (next.distance_squared > limits[next.degrees]) continue;
      chosen[observation] = static_cast<int>(k);
      if (pairing.exclusive) taken.insert(pairing.landmark);
      descend(depth + 1, next);
      if (pairing.exclusive) taken.erase(pairing.landmark);
      chosen[observation] = -1;
    }
    descend(depth + 1, hypothesis);
  }
};

}  // namespace

std::vector<int> nearest_neighbours(const Pairings& pairings) {
  std::vector<int> chosen(pairings.size(), -1);
  std::map<tracking::LandmarkId, std::size_t> owners;
  for (std::size_t i = 0; i < pairings.size(); ++i) {
    if (pairings[i].empty()) continue;
    const Pairing& nearest = pairings[i].front();
    chosen[i] = 0;
    if (!nearest.exclusive) continue;
    const auto [owner, free] = owners.try_emplace(nearest.landmark, i);
    if (free) continue;
    const bool nearer = nearest.distance_squared < pairings[owner->second].front().distance_squared;
    chosen[nearer ? owner->second : i] = -1;
    if (nearer) owner->second = i;
  }
  return chosen;
}

void JointCompatibility::reach(std::size_t degrees) {
  while (limits_.size() <= degrees)
    limits_.push_back(chi_square_quantile(params_.probability, static_cast<double>(limits_.size())));
}

std::vector<int> JointCompatibility::associate(const Pairings& pairings, const PoseState::Matrix& covariance) {
  reach(2 * pairings.size());
  Search search{.pairings = pairings,
                .order = by_choice(pairings),
                .limits = limits_,
                .nodes_left = params_.most_nodes,
                .chosen = std::vector<int>(pairings.size(), -1),
                .taken = {},
                .best = std::vector<int>(pairings.size(), -1)};
  JointHypothesis nothing;
  nothing.covariance = covariance;
  search.descend(0, nothing);
  return search.best;
}

}  // namespace credo::evaluation
