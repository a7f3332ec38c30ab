// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/disjunctive.hpp"

namespace credo::evidence {

MassFunction disjunctive(const Sources& sources) {
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
