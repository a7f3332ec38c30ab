// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/whole_belief.hpp"

namespace credo::evidence {

std::optional<FusedBinaryMass> whole_from_all_parts(std::span<const BinaryMass> criteria, std::span<const Part> parts,
                                                    FusionRule rule) {
  Conjunction all;
  for (const BinaryMass& criterion : criteria) all.add(criterion);
  for (const Part& part : parts) all.add(discount(part.mass, part.reliability));
  return all.fuse(rule);
}

FusedBinaryMass whole_from_mean_part(std::span<const BinaryMass> criteria, std::span<const Part> parts) {
  Conjunction all;
  for (const BinaryMass& criterion : criteria) all.add(criterion);
  all.add(mean_part(parts));
  return all.conflict_to_ignorance();
}

BinaryMass mean_part(std::span<const Part> parts) {
  if (parts.empty()) return BinaryMass::vacuous();
  BinaryMass sum{.yes = 0.0, .no = 0.0, .unknown = 0.0};
  for (const Part& part : parts) {
    const BinaryMass mass = discount(part.mass, part.reliability);
    sum.yes += mass.yes;
    sum.no += mass.no;
    sum.unknown += mass.unknown;
  }
  const double count = static_cast<double>(parts.size());
  return {.yes = sum.yes / count, .no = sum.no / count, .unknown = sum.unknown / count};
}

}  // namespace credo::evidence
