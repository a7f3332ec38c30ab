// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/conjunctive.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "evidence/moebius.hpp"

namespace credo::evidence {
namespace {

// The conjunction of the sources one after the other; what meets nothing is counted in conflict and left out, and the
// rest is divided by its sum each time, so that hundreds of opposed sources do not underflow.
struct Running {
  FocalSum kept;
  double share = 1.0;     // of all mass that is in `kept`, which sums to 1
  double conflict = 0.0;  // 1 - share without cancellation
};

void take_in(Running& running, const MassFunction& source) {
  const Frame& frame = source.frame();
  FocalSum next;
  double kept = 0.0, lost = 0.0;
  for (const Focal& b : source.focals()) {
    const Proposition regions = frame.existing(b.set);
    for (const Focal& a : running.kept.terms()) {
      const Proposition both = a.set & regions;
      const double product = a.mass * b.mass;
      if (both.empty()) {
        lost += product;
      } else {
        next.add(both, product);
        kept += product;
      }
    }
  }
  running.conflict += running.share * lost;
  running.share *= kept;
  running.kept.clear();
  if (!(kept > 0.0)) return;
  for (const Focal& term : next.terms()) running.kept.add(term.set, term.mass / kept);
}

Running conjoin(const Sources& sources) {
  Running running;
  running.kept.add(sources.common_frame().existing(sources.common_frame().all()), 1.0);
  for (const MassFunction& source : sources) take_in(running, source);
  return running;
}

// q(A) = Π q_i(A). Nothing where rounding leaves no mass function: then it is found pair by pair.
std::optional<MassFunction> conjoin_dense(const Sources& sources) {
  std::vector<double> product;
  for (const MassFunction& source : sources) {
    std::vector<double> commonality = to_dense(source);
    mass_to_commonality(commonality);
    if (product.empty()) {
      product = std::move(commonality);
    } else {
      std::ranges::transform(product, commonality, product.begin(), std::multiplies<>());
    }
  }
  return from_commonality(sources.common_frame(), std::move(product));
}

}  // namespace

MassFunction conjunctive(const Sources& sources) {
  if (dense_is_faster(sources)) {
    if (std::optional<MassFunction> together = conjoin_dense(sources)) return *std::move(together);
  }
  const Running running = conjoin(sources);
  FocalSum all;
  for (const Focal& term : running.kept.terms()) all.add(term.set, term.mass * running.share);
  all.add(Proposition(), running.conflict);
  return all.mass_function(sources.common_frame());
}

std::optional<Fused> dempster(const Sources& sources) {
  if (dense_is_faster(sources)) {
    // Rounding is relative to 1: where little is left beside the conflict, it is found pair by pair.
    constexpr double kMostConflict = 0.999;
    const std::optional<MassFunction> together = conjoin_dense(sources);
    if (together && together->conflict() < kMostConflict) return normalised(*together);
  }
  const Running running = conjoin(sources);
  if (running.kept.terms().empty()) return std::nullopt;
  return Fused{running.kept.mass_function(sources.common_frame()), running.conflict};
}

std::optional<Fused> condition(const MassFunction& mass, const Proposition& event) {
  return dempster({mass, MassFunction::categorical(mass.frame(), event)});
}

std::optional<MassFunction> decombine(const MassFunction& whole, const MassFunction& part) {
  const Frame frame = Sources{whole, part}.common_frame();
  if (part.is_dogmatic()) throw std::invalid_argument("a dogmatic mass function, m(Θ) = 0, cannot be taken out");
  std::vector<double> quotient = to_dense(whole), divisor = to_dense(part);
  mass_to_commonality(quotient);
  mass_to_commonality(divisor);
  std::ranges::transform(quotient, divisor, quotient.begin(), std::divides<>());
  return from_commonality(frame, std::move(quotient));
}

}  // namespace credo::evidence
