// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/disjunctive.hpp"

#include "evidence/conjunctive.hpp"
#include "evidence/decomposition.hpp"
#include "evidence/moebius.hpp"

namespace credo::evidence {
namespace {

// De Morgan: ¬(¬A ∩ ¬B) = A ∪ B. The conjunctive rule has the transforms.
MassFunction disjoin_dense(const Sources& sources) {
  std::vector<MassFunction> negated;
  for (const MassFunction& source : sources) negated.push_back(negation(source));
  return negation(conjunctive(negated));
}

}  // namespace

MassFunction disjunctive(const Sources& sources) {
  if (dense_is_faster(sources)) return disjoin_dense(sources);
  const Frame frame = sources.common_frame();
  FocalSum united;
  united.add(Proposition(), 1.0);
  for (const MassFunction& source : sources) {
    FocalSum next;
    for (const Focal& a : united.terms()) {
      for (const Focal& b : source.focals()) next.add(a.set | frame.existing(b.set), a.mass * b.mass);
    }
    united = std::move(next);
  }
  return united.mass_function(frame);
}

}  // namespace credo::evidence
