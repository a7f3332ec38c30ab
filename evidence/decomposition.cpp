// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/decomposition.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "evidence/moebius.hpp"

namespace credo::evidence {

CanonicalDecomposition decompose(const MassFunction& mass) {
  std::vector<double> values = to_dense(mass);
  if (mass.is_dogmatic()) {
    throw std::invalid_argument("a dogmatic mass function, m(Θ) = 0, has no weights: discount it first");
  }
  mass_to_commonality(values);
  for (double& value : values) value = -std::log(value);
  commonality_to_mass(values);
  values.back() = 0.0;
  return {mass.frame(), std::move(values)};
}

MassFunction recompose(const CanonicalDecomposition& decomposition) {
  // ln q(A) = Σ ln w(B) over all B that do not contain A.
  std::vector<double> values = decomposition.log_weights;
  values.back() = 0.0;
  const double all = std::accumulate(values.begin(), values.end(), 0.0);
  mass_to_commonality(values);
  for (double& value : values) value = std::exp(all - value);
  std::optional<MassFunction> mass = from_commonality(decomposition.frame, std::move(values));
  if (!mass) throw std::invalid_argument("these weights are those of no mass function: a mass would be negative");
  return *std::move(mass);
}

MassFunction cautious(const Sources& sources) {
  sources.common_frame();
  CanonicalDecomposition least = decompose(sources[0]);
  for (std::size_t i = 1; i < sources.size(); ++i) {
    const CanonicalDecomposition other = decompose(sources[i]);
    std::ranges::transform(least.log_weights, other.log_weights, least.log_weights.begin(),
                           [](double a, double b) { return std::min(a, b); });
  }
  return recompose(least);
}

MassFunction bold(const Sources& sources) {
  sources.common_frame();
  std::vector<MassFunction> negated;
  for (const MassFunction& source : sources) {
    if (source.is_normal()) throw std::invalid_argument("the bold rule needs mass on ∅ in every source");
    negated.push_back(negation(source));
  }
  return negation(cautious(negated));
}

MassFunction negation(const MassFunction& mass) {
  const Frame& frame = mass.frame();
  if (!frame.is_power_set()) throw std::invalid_argument("complements need a frame of Shafer's model");
  FocalSum negated;
  for (const Focal& focal : mass.focals()) negated.add(frame.all() - focal.set, focal.mass);
  return negated.mass_function(frame);
}

}  // namespace credo::evidence
