// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/logistic_regression.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "evidence/parameter_check.hpp"

namespace credo::evaluation {

LogisticRegression::LogisticRegression(std::size_t weights, const LogisticParams& params)
    : weights_(weights), params_(params) {
  const evidence::ParameterCheck check("logistic regression: ");
  check.positive("ridge", params.ridge);
  check.at_least("most_iterations", params.most_iterations, 1);
}

void LogisticRegression::add(std::span<const Entry> entries, bool occupied, double count) {
  rows_.push_back({entries_.size(), entries_.size() + entries.size(), occupied, count});
  entries_.insert(entries_.end(), entries.begin(), entries.end());
}

LogisticRegression LogisticRegression::pooled(std::span<const std::uint32_t> pools) const {
  LogisticRegression result(std::ranges::max(pools) + std::size_t{1}, params_);
  std::vector<float> counts(result.weights_, 0.0F);
  for (const Row& row : rows_) {
    Row& pooled = result.rows_.emplace_back(row);
    pooled.begin = result.entries_.size();
    for (const Entry& entry : std::span(entries_).subspan(row.begin, row.end - row.begin))
      counts[pools[entry.weight]] += entry.count;
    for (std::uint32_t pool = 0; pool < counts.size(); ++pool)
      if (const float count = std::exchange(counts[pool], 0.0F); count > 0.0F) result.entries_.push_back({pool, count});
    pooled.end = result.entries_.size();
  }
  return result;
}

LogisticRegression::Fit LogisticRegression::fit(std::span<const double> towards) const {
  const auto n = static_cast<Eigen::Index>(weights_);
  constexpr double kSmallStep = 1e-6, kLargestStep = 1.0;
  Eigen::VectorXd centre = Eigen::VectorXd::Zero(n);
  std::ranges::copy(towards, centre.begin());
  Eigen::VectorXd weights = centre;
  double loss = 0.0;
  for (int iteration = 0; iteration < params_.most_iterations; ++iteration) {
    Eigen::VectorXd gradient = params_.ridge * (weights - centre);
    Eigen::MatrixXd hessian = params_.ridge * Eigen::MatrixXd::Identity(n, n);
    loss = 0.0;
    for (const Row& row : rows_) {
      double log_odds = 0.0;
      for (std::size_t e = row.begin; e < row.end; ++e) log_odds += entries_[e].count * weights[entries_[e].weight];
      const double p = 1.0 / (1.0 + std::exp(-log_odds));
      loss += row.count * std::log1p(std::exp(row.occupied ? -log_odds : log_odds));
      const double pull = row.count * (p - (row.occupied ? 1.0 : 0.0)), stiffness = row.count * p * (1.0 - p);
      for (std::size_t e = row.begin; e < row.end; ++e) {
        gradient[entries_[e].weight] += pull * entries_[e].count;
        for (std::size_t f = row.begin; f <= e; ++f)
          hessian(entries_[e].weight, entries_[f].weight) += stiffness * entries_[e].count * entries_[f].count;
      }
    }
    Eigen::VectorXd step = hessian.selfadjointView<Eigen::Lower>().ldlt().solve(-gradient);
    const double largest = step.cwiseAbs().maxCoeff();
    if (largest > kLargestStep) step *= kLargestStep / largest;
    weights += step;
    if (largest < kSmallStep) break;
  }
  return {{weights.begin(), weights.end()}, loss};
}

}  // namespace credo::evaluation
