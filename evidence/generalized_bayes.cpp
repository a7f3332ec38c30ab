// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/generalized_bayes.hpp"

#include <stdexcept>
#include <string>

#include "evidence/moebius.hpp"

namespace credo::evidence {

MassFunction generalized_bayes(const Frame& frame, std::span<const double> plausibilities) {
  if (!frame.is_power_set() || frame.size() > kMaxDenseElements || plausibilities.size() != frame.size()) {
    throw std::invalid_argument("the generalized Bayesian theorem needs a frame of Shafer's model with at most " +
                                std::to_string(kMaxDenseElements) + " elements and one plausibility for each of its " +
                                std::to_string(frame.size()) + "; got " + std::to_string(plausibilities.size()));
  }
  FocalSum sum;
  sum.add(Proposition(), 1.0);
  for (std::size_t k = 0; k < plausibilities.size(); ++k) {
    const double likely = plausibilities[k];
    if (!(likely >= 0.0 && likely <= 1.0)) {
      throw std::invalid_argument("the plausibility where the truth is " + frame.name(k) + " must be in [0, 1]; got " +
                                  std::to_string(likely));
    }
    FocalSum next;  // with element k, and without
    for (const Focal& term : sum.terms()) {
      if (likely > 0.0) next.add(term.set | frame.element(k), term.mass * likely);
      if (likely < 1.0) next.add(term.set, term.mass * (1.0 - likely));
    }
    sum = std::move(next);
  }
  return sum.mass_function(frame);
}

}  // namespace credo::evidence
