// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/averaging.hpp"

#include <cmath>
#include <stdexcept>

#include "evidence/conjunctive.hpp"

namespace credo::evidence {

double total_weight(std::span<const double> weights, std::size_t sources) {
  if (weights.empty()) return static_cast<double>(sources);
  double total = 0.0;
  for (const double weight : weights) {
    if (!(weight >= 0.0)) throw std::invalid_argument("the weights of an average must be >= 0");
    total += weight;
  }
  if (weights.size() != sources || !(total > 0.0) || std::isinf(total)) {
    throw std::invalid_argument("an average needs one finite weight for each source, not all of them 0");
  }
  return total;
}

MassFunction average(const Sources& sources, std::span<const double> weights) {
  const Frame frame = sources.common_frame();
  const double total = total_weight(weights, sources.size());
  FocalSum sum;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const double share = (weights.empty() ? 1.0 : weights[i]) / total;
    for (const Focal& focal : sources[i].focals()) sum.add(focal.set, share * focal.mass);
  }
  return sum.mass_function(frame);
}

std::optional<Fused> murphy(const Sources& sources) {
  return dempster(std::vector<MassFunction>(sources.size(), average(sources)));
}

}  // namespace credo::evidence
