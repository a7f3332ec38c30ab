// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/measures.hpp"

#include <algorithm>
#include <cmath>

#include "evidence/probability.hpp"

namespace credo::evidence {
namespace {

// Sum of the masses of the focal elements of which `counts` holds, given what exists of them.
template <typename Counts>
double sum_where(const MassFunction& mass, Counts counts) {
  double sum = 0.0;
  for (const Focal& focal : mass.focals()) {
    if (counts(mass.frame().existing(focal.set))) sum += focal.mass;
  }
  return sum;
}

double entropy(const std::vector<double>& probabilities) {
  double bits = 0.0;
  for (const double p : probabilities) {
    if (p > 0.0) bits -= p * std::log2(p);
  }
  return bits;
}

// -Σ m(A) log2 Σ m(B) agreement(A, B)
template <typename Agreement>
double contradiction(const MassFunction& mass, Agreement agreement) {
  const Frame& frame = mass.frame();
  double bits = 0.0;
  for (const Focal& a : mass.focals()) {
    const Proposition set = frame.existing(a.set);
    if (set.empty()) continue;
    double agreed = 0.0;
    for (const Focal& b : mass.focals()) agreed += b.mass * agreement(set, frame.existing(b.set));
    bits -= a.mass * std::log2(std::min(agreed, 1.0));
  }
  return bits;
}

}  // namespace

double belief(const MassFunction& mass, const Proposition& set) {
  const Proposition wanted = mass.frame().existing(set);
  return sum_where(mass, [&](const Proposition& focal) { return !focal.empty() && focal.subset_of(wanted); });
}

double plausibility(const MassFunction& mass, const Proposition& set) {
  const Proposition wanted = mass.frame().existing(set);
  return sum_where(mass, [&](const Proposition& focal) { return focal.meets(wanted); });
}

double commonality(const MassFunction& mass, const Proposition& set) {
  const Proposition wanted = mass.frame().existing(set);
  return sum_where(mass, [&](const Proposition& focal) { return wanted.subset_of(focal); });
}

double implicability(const MassFunction& mass, const Proposition& set) {
  const Proposition wanted = mass.frame().existing(set);
  return sum_where(mass, [&](const Proposition& focal) { return focal.subset_of(wanted); });
}

double nonspecificity(const MassFunction& mass) {
  double bits = 0.0;
  for (const Focal& focal : mass.focals()) {
    const std::size_t regions = mass.frame().cardinality(focal.set);
    if (regions > 0) bits += focal.mass * std::log2(static_cast<double>(regions));
  }
  return bits;
}

double dissonance(const MassFunction& mass) {
  return contradiction(mass, [](const Proposition& a, const Proposition& b) { return a.meets(b) ? 1.0 : 0.0; });
}

double strife(const MassFunction& mass) {
  return contradiction(mass, [](const Proposition& a, const Proposition& b) {
    return static_cast<double>((a & b).count()) / static_cast<double>(a.count());
  });
}

double pignistic_entropy(const MassFunction& mass) { return entropy(pignistic_regions(mass)); }

double jirousek_shenoy_entropy(const MassFunction& mass) {
  return entropy(plausibility_transform(mass)) + nonspecificity(mass);
}

double conflict_between(const MassFunction& a, const MassFunction& b) {
  const Frame frame = Sources{a, b}.common_frame();
  double conflict = 0.0;
  for (const Focal& x : a.focals()) {
    for (const Focal& y : b.focals()) {
      if (frame.existing(x.set & y.set).empty()) conflict += x.mass * y.mass;
    }
  }
  return conflict;
}

double jousselme_distance(const MassFunction& a, const MassFunction& b) {
  const Frame frame = Sources{a, b}.common_frame();
  FocalSum difference;
  for (const Focal& focal : a.focals()) difference.add(frame.existing(focal.set), focal.mass);
  for (const Focal& focal : b.focals()) difference.add(frame.existing(focal.set), -focal.mass);
  double squared = 0.0;
  for (const Focal& x : difference.terms()) {
    for (const Focal& y : difference.terms()) {
      const std::size_t united = (x.set | y.set).count();
      const double similarity =
          united == 0 ? 1.0 : static_cast<double>((x.set & y.set).count()) / static_cast<double>(united);
      squared += x.mass * y.mass * similarity;
    }
  }
  return std::sqrt(std::clamp(0.5 * squared, 0.0, 1.0));
}

}  // namespace credo::evidence
