// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/probability.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "evidence/measures.hpp"

namespace credo::evidence {
namespace {

double kept_mass(const MassFunction& mass) {
  double kept = 0.0;
  for (const Focal& focal : mass.focals()) {
    if (mass.frame().cardinality(focal.set) > 0) kept += focal.mass;
  }
  if (!(kept > 0.0)) throw std::domain_error("total conflict: there is no mass left to make a probability of");
  return kept;
}

// Every mass is shared among the regions of its proposition in proportion to `weights`, one of each region; equally
// where all of them are 0.
std::vector<double> shared(const MassFunction& mass, const std::vector<double>& weights) {
  const double kept = kept_mass(mass);
  std::vector<double> result(weights.size());
  for (const Focal& focal : mass.focals()) {
    const Proposition set = mass.frame().existing(focal.set);
    double sum = 0.0;
    for (std::size_t r = 0; r < weights.size(); ++r) sum += set.contains(r) ? weights[r] : 0.0;
    for (std::size_t r = 0; r < weights.size(); ++r) {
      if (!set.contains(r)) continue;
      const double share = sum > 0.0 ? weights[r] / sum : 1.0 / static_cast<double>(set.count());
      result[r] += focal.mass / kept * share;
    }
  }
  return result;
}

double sum_of(const std::vector<double>& regions, const Proposition& set) {
  double sum = 0.0;
  for (std::size_t r = 0; r < regions.size(); ++r) sum += set.contains(r) ? regions[r] : 0.0;
  return sum;
}

}  // namespace

double pignistic(const MassFunction& mass, const Proposition& set) {
  const Proposition wanted = mass.frame().existing(set);
  const double kept = kept_mass(mass);
  double sum = 0.0;
  for (const Focal& focal : mass.focals()) {
    const Proposition regions = mass.frame().existing(focal.set);
    if (regions.empty()) continue;
    sum += focal.mass * static_cast<double>((regions & wanted).count()) / static_cast<double>(regions.count());
  }
  return sum / kept;
}

std::vector<double> pignistic_regions(const MassFunction& mass) {
  return shared(mass, std::vector<double>(mass.frame().region_count()));
}

double dsmp(const MassFunction& mass, const Proposition& set, double epsilon) {
  return sum_of(dsmp_regions(mass, epsilon), mass.frame().existing(set));
}

std::vector<double> dsmp_regions(const MassFunction& mass, double epsilon) {
  if (!(epsilon >= 0.0) || std::isinf(epsilon)) {
    throw std::invalid_argument("the epsilon of DSmP must be finite and >= 0; got " + std::to_string(epsilon));
  }
  const double unit = std::max(1.0, epsilon);  // in which no sum overflows
  std::vector<double> weights(mass.frame().region_count(), epsilon / unit);
  for (const Focal& focal : mass.focals()) {
    const Proposition set = mass.frame().existing(focal.set);
    if (set.count() != 1) continue;
    for (std::size_t r = 0; r < weights.size(); ++r) weights[r] += set.contains(r) ? focal.mass / unit : 0.0;
  }
  return shared(mass, weights);
}

std::vector<double> plausibility_transform(const MassFunction& mass) {
  const Frame& frame = mass.frame();
  if (!frame.is_power_set()) throw std::invalid_argument("the plausibility transform needs a frame of Shafer's model");
  kept_mass(mass);
  std::vector<double> result(frame.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < frame.size(); ++i) sum += result[i] = plausibility(mass, frame.element(i));
  for (double& each : result) each /= sum;
  return result;
}

Decision decide(const MassFunction& mass, std::span<const Proposition> candidates, const DecisionParams& params) {
  if (candidates.empty()) throw std::invalid_argument("a decision needs at least one candidate");
  const std::optional<Fused> open = normalised(mass);
  if (!open) return {};
  const auto value = [&](const Proposition& candidate) {
    switch (params.criterion) {
      case Criterion::kBelief: return belief(open->mass, candidate);
      case Criterion::kPlausibility: return plausibility(open->mass, candidate);
      case Criterion::kPignistic: break;
    }
    return pignistic(open->mass, candidate);
  };
  Decision best{.rejected = false, .choice = 0, .value = -1.0};
  double second = 0.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double each = value(candidates[i]);
    if (each > best.value) {
      if (i > 0) second = best.value;
      best.choice = i;
      best.value = each;
    } else if (each > second) {
      second = each;
    }
  }
  best.margin = best.value - second;
  best.rejected = !(best.value >= params.min_value && best.margin >= params.min_margin);
  return best;
}

Decision decide(const MassFunction& mass, const DecisionParams& params) {
  std::vector<Proposition> elements;
  for (std::size_t i = 0; i < mass.frame().size(); ++i) elements.push_back(mass.frame().element(i));
  return decide(mass, elements, params);
}

}  // namespace credo::evidence
