// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/summarization.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace credo::evidence {

MassFunction summarized(const MassFunction& mass, std::size_t most) {
  if (most == 0) throw std::invalid_argument("a summary needs at least one focal element");
  const Frame& frame = mass.frame();
  FocalSum sum;
  std::vector<Focal> ordered;
  for (const Focal& focal : mass.focals()) {
    if (frame.existing(focal.set).empty()) {
      sum.add(focal.set, focal.mass);
    } else {
      ordered.push_back(focal);
    }
  }
  if (ordered.size() <= most) return mass;
  std::ranges::stable_sort(ordered, std::ranges::greater(), &Focal::mass);
  Focal rest;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    if (i + 1 < most) {
      sum.add(ordered[i].set, ordered[i].mass);
    } else {
      rest = {rest.set | ordered[i].set, rest.mass + ordered[i].mass};
    }
  }
  sum.add(rest.set, rest.mass);
  return sum.mass_function(frame);
}

}  // namespace credo::evidence
