// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>

#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// One of the parts that a whole rests on, and how far it is to be relied on for that purpose.
struct Part {
  BinaryMass mass;
  double reliability = 1.0;  ///< in [0, 1]
};

/// Belief in a whole from criteria of its own and from its parts, as Clerentin et al., sec. 4.5, have it for a
/// localization: the criteria and all parts, each discounted by its reliability, fused n-ary. Dempster's rule saturates
/// with many parts; conflict to ignorance falls with their number.
/// \returns nothing at total conflict under Dempster's rule.
[[nodiscard]] std::optional<FusedBinaryMass> whole_from_all_parts(std::span<const BinaryMass> criteria,
                                                                  std::span<const Part> parts, FusionRule rule);

/// The default: the discounted parts are averaged first, then fused with the criteria, the conflict moved to ignorance
/// once. Does not depend on the number of equal parts. No part gives a vacuous mean.
[[nodiscard]] FusedBinaryMass whole_from_mean_part(std::span<const BinaryMass> criteria, std::span<const Part> parts);

/// The same from the mean of the parts.
[[nodiscard]] FusedBinaryMass whole_from_mean(std::span<const BinaryMass> criteria, const BinaryMass& mean);

/// The mean of discounted masses, part by part; vacuous without parts.
class PartMean {
 public:
  void add(const Part& part);
  [[nodiscard]] BinaryMass mean() const;

 private:
  BinaryMass sum_{.yes = 0.0, .no = 0.0, .unknown = 0.0};
  int count_ = 0;
};

/// The mean of the discounted masses; vacuous without parts.
[[nodiscard]] BinaryMass mean_part(std::span<const Part> parts);

}  // namespace credo::evidence
