// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/random.hpp"

namespace credo::evaluation {
namespace {

constexpr double kConfidence = 0.95;
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// Draws as many clusters as there are, with replacement.
void draw(sim::Random& random, std::vector<int>& weights) {
  std::fill(weights.begin(), weights.end(), 0);
  for (std::size_t i = 0; i < weights.size(); ++i) ++weights[random.bits() % weights.size()];
}

}  // namespace

std::optional<double> ClusteredRatio::operator()(Weights weights) const {
  double numerator = 0.0, denominator = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    numerator += weights[i] * numerators[i];
    denominator += weights[i] * denominators[i];
  }
  if (denominator == 0.0) return std::nullopt;
  return numerator / denominator;
}

ClusteredValues::ClusteredValues(std::vector<ClusteredValue> values) : values_(std::move(values)) {
  std::stable_sort(values_.begin(), values_.end(),
                   [](const ClusteredValue& a, const ClusteredValue& b) { return a.value < b.value; });
}

long ClusteredValues::total(Weights weights) const {
  long sum = 0;
  for (const ClusteredValue& v : values_) sum += weights[v.cluster];
  return sum;
}

std::optional<double> ClusteredValues::quantile(double share, Weights weights) const {
  const double wanted = share * static_cast<double>(total(weights));
  long sum = 0;
  for (const ClusteredValue& v : values_) {
    sum += weights[v.cluster];
    if (sum > 0 && static_cast<double>(sum) >= wanted) return v.value;
  }
  return std::nullopt;
}

std::optional<double> ClusteredValues::auroc(Weights weights) const {
  double wins = 0.0, good = 0.0, bad = 0.0;
  for (std::size_t begin = 0, end = 0; begin < values_.size(); begin = end) {
    double good_here = 0.0, bad_here = 0.0;
    for (; end < values_.size() && values_[end].value == values_[begin].value; ++end)
      (values_[end].good ? good_here : bad_here) += weights[values_[end].cluster];
    wins += good_here * (bad + 0.5 * bad_here);
    good += good_here;
    bad += bad_here;
  }
  if (good == 0.0 || bad == 0.0) return std::nullopt;
  return wins / (good * bad);
}

std::optional<double> ClusteredValues::calibration_error(Weights weights, int bins) const {
  const long count = total(weights);
  if (count == 0) return std::nullopt;
  double error = 0.0, excess = 0.0;  // of the bins before, and of probability over truth in this one
  long position = 0;
  int bin = 0;
  for (const ClusteredValue& v : values_) {
    for (long left = weights[v.cluster]; left > 0;) {
      while (position == count * (bin + 1) / bins) error += std::abs(std::exchange(excess, 0.0)), ++bin;
      const long taken = std::min(left, count * (bin + 1) / bins - position);
      excess += static_cast<double>(taken) * (v.value - (v.good ? 1.0 : 0.0));
      position += taken;
      left -= taken;
    }
  }
  return (error + std::abs(excess)) / static_cast<double>(count);
}

std::optional<Estimate> bootstrap(std::size_t clusters, const std::function<std::optional<double>(Weights)>& statistic,
                                  const BootstrapParams& params) {
  std::vector<int> weights(clusters, 1);
  const std::optional<double> value = statistic(weights);
  if (!value) return std::nullopt;
  sim::Random random(params.seed);
  std::vector<double> resampled;
  for (int i = 0; i < params.resamples; ++i) {
    draw(random, weights);
    if (const auto other = statistic(weights)) resampled.push_back(*other);
  }
  std::sort(resampled.begin(), resampled.end());
  if (clusters < 2 || resampled.empty()) return Estimate{*value, kNotKnown, kNotKnown};
  const auto tail = static_cast<std::size_t>(0.5 * (1.0 - kConfidence) * static_cast<double>(resampled.size()));
  return Estimate{*value, resampled[tail], resampled[resampled.size() - 1 - tail]};
}

}  // namespace credo::evaluation
