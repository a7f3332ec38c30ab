// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/discounting.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace credo::evidence {

MassFunction discount(const MassFunction& mass, double reliability) {
  check_reliability(reliability);
  FocalSum sum;
  for (const Focal& focal : mass.focals()) sum.add(focal.set, reliability * focal.mass);
  sum.add(mass.frame().all(), 1.0 - reliability);
  return sum.mass_function(mass.frame());
}

MassFunction contextual_discount(const MassFunction& mass, std::span<const double> reliabilities) {
  const Frame& frame = mass.frame();
  if (!frame.is_power_set() || reliabilities.size() != frame.size()) {
    throw std::invalid_argument(
        "contextual discounting needs a frame of Shafer's model and one reliability for each "
        "of its " +
        std::to_string(frame.size()) + " elements");
  }
  constexpr std::size_t kMostFocals = std::size_t{1} << 20;
  FocalSum sum;
  for (const Focal& focal : mass.focals()) sum.add(focal.set, focal.mass);
  for (std::size_t k = 0; k < reliabilities.size(); ++k) {
    check_reliability(reliabilities[k]);
    if (reliabilities[k] == 1.0) continue;
    FocalSum next;
    for (const Focal& term : sum.terms()) {
      next.add(term.set, reliabilities[k] * term.mass);
      next.add(term.set | frame.element(k), (1.0 - reliabilities[k]) * term.mass);
    }
    if (next.terms().size() > kMostFocals) {
      throw std::invalid_argument(
          "contextual discounting would leave more than 2^20 focal elements: give fewer elements a "
          "reliability below 1, or summarize the mass function first");
    }
    sum = std::move(next);
  }
  return sum.mass_function(frame);
}

double reliability_after(double age, double half_life) {
  if (!(age >= 0.0)) throw std::invalid_argument("an age must be >= 0; got " + std::to_string(age));
  if (!(half_life > 0.0)) throw std::invalid_argument("a half-life must be > 0; got " + std::to_string(half_life));
  return std::isinf(half_life) ? 1.0 : std::exp2(-age / half_life);
}

MassFunction decay(const MassFunction& mass, double age, double half_life) {
  return discount(mass, reliability_after(age, half_life));
}

}  // namespace credo::evidence
