// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/settings_sweep.hpp"

#include <algorithm>
#include <stdexcept>

namespace credo::evaluation {
namespace {

/// The setting that errs least over all seeds but one; the first of equals.
std::size_t best_without(const SweptErrors& errors, std::size_t seed) {
  const auto on_others = [&](const std::vector<double>& by_seed) {
    double sum = 0.0;
    for (std::size_t other = 0; other < by_seed.size(); ++other) sum += other == seed ? 0.0 : by_seed[other];
    return sum;
  };
  const auto best = std::min_element(errors.begin(), errors.end(),
                                     [&](const auto& a, const auto& b) { return on_others(a) < on_others(b); });
  return static_cast<std::size_t>(best - errors.begin());
}

}  // namespace

double median_of(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("a median needs one value or more, found none");
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

std::vector<double> reductions(const SweptErrors& other, const SweptErrors& method) {
  std::vector<double> all;
  for (std::size_t s = 0; s < other.size(); ++s)
    for (std::size_t seed = 0; seed < other[s].size(); ++seed)
      if (other[s][seed] > 0.0) all.push_back(1.0 - method[s][seed] / other[s][seed]);
  return all;
}

OwnBest best_on_other_seeds(const SweptErrors& errors) {
  OwnBest best;
  const std::size_t seeds = errors.empty() ? 0 : errors.front().size();
  if (seeds < 2) return best;
  for (std::size_t seed = 0; seed < seeds; ++seed) {
    const std::size_t chosen = best_without(errors, seed);
    best.error.add(errors[chosen][seed]);
    if (std::find(best.settings.begin(), best.settings.end(), chosen) == best.settings.end())
      best.settings.push_back(chosen);
  }
  return best;
}

}  // namespace credo::evaluation
