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
  return whole_from_mean(criteria, mean_part(parts));
}

FusedBinaryMass whole_from_mean(std::span<const BinaryMass> criteria, const BinaryMass& mean) {
  Conjunction all;
  for (const BinaryMass& criterion : criteria) all.add(criterion);
  all.add(mean);
  return all.conflict_to_ignorance();
}

void PartMean::add(const Part& part) {
  const BinaryMass mass = discount(part.mass, part.reliability);
  sum_.yes += mass.yes;
  sum_.no += mass.no;
  sum_.unknown += mass.unknown;
  ++count_;
}

BinaryMass PartMean::mean() const {
  if (count_ == 0) return BinaryMass::vacuous();
  return {.yes = sum_.yes / count_, .no = sum_.no / count_, .unknown = sum_.unknown / count_};
}

BinaryMass mean_part(std::span<const Part> parts) {
  PartMean sum;
  for (const Part& part : parts) sum.add(part);
  return sum.mean();
}

}  // namespace credo::evidence
