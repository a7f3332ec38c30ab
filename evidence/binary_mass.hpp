// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <initializer_list>
#include <iosfwd>
#include <optional>
#include <span>

#include "evidence/reliability.hpp"

namespace credo::evidence {

inline constexpr double kMassTolerance = 1e-9;  ///< by which masses that are given may sum to more than 1

/// A mass function on the two-element frame {YES, NO}: the belief in one assertion. yes + no + unknown = 1; `unknown`
/// is the mass of the whole frame (ignorance). The members are not checked: set all three, or use `from`, which gives
/// the rest to ignorance.
struct BinaryMass {
  double yes = 0.0;
  double no = 0.0;
  double unknown = 1.0;

  [[nodiscard]] static constexpr BinaryMass vacuous() { return {}; }
  /// From the two committed masses; the rest is ignorance.
  /// \throws std::invalid_argument unless yes >= 0, no >= 0 and yes + no <= 1 (tolerance 1e-9: masses that exceed 1 by
  ///         less are divided by their sum).
  [[nodiscard]] static BinaryMass from(double yes, double no);

  [[nodiscard]] constexpr double belief() const { return yes; }
  [[nodiscard]] constexpr double plausibility() const { return yes + unknown; }
  /// Pignistic probability of YES.
  [[nodiscard]] constexpr double pignistic() const { return yes + 0.5 * unknown; }

  friend constexpr bool operator==(const BinaryMass&, const BinaryMass&) = default;
};

/// What the conjunctive rule leaves before anything is done about the conflict: masses and the mass of the empty set.
struct OpenBinaryMass {
  double yes = 0.0;
  double no = 0.0;
  double unknown = 1.0;
  double conflict = 0.0;

  friend constexpr bool operator==(const OpenBinaryMass&, const OpenBinaryMass&) = default;
};

/// A mass function and the conflict that was met (and moved or divided out) on the way to it.
struct FusedBinaryMass {
  BinaryMass mass;
  double conflict = 0.0;

  friend constexpr bool operator==(const FusedBinaryMass&, const FusedBinaryMass&) = default;
};

/// What is done with the conflict that the conjunctive rule leaves.
enum class FusionRule {
  kDempster,            ///< divided out
  kConflictToIgnorance  ///< moved to the frame, once (Yager; Clerentin et al., sec. 3.1)
};

/// Sources taken in one after the other without storing them, and the rules that are read from their conjunction. Sums
/// of products of masses only: nothing is subtracted, so masses are never negative and small ones keep their digits.
class Conjunction {
 public:
  void add(const BinaryMass& source);

  [[nodiscard]] OpenBinaryMass open() const;
  [[nodiscard]] std::optional<FusedBinaryMass> dempster() const;
  [[nodiscard]] FusedBinaryMass conflict_to_ignorance() const;
  [[nodiscard]] std::optional<FusedBinaryMass> fuse(FusionRule rule) const;

 private:
  // What is not in conflict, in units of unit_: the conjunction of hundreds of opposed sources would underflow.
  double yes_ = 0.0, no_ = 0.0, unknown_ = 1.0;
  double unit_ = 1.0;
  double conflict_ = 0.0;
};

/// Unnormalised conjunctive rule of any number of sources (TBM): associative, commutative, the vacuous mass is neutral.
/// No source gives the vacuous mass.
[[nodiscard]] OpenBinaryMass conjunctive(std::span<const BinaryMass> sources);
[[nodiscard]] OpenBinaryMass conjunctive(std::initializer_list<BinaryMass> sources);

/// Dempster's rule: the conjunctive rule divided by the sum of what is not in conflict (not by 1 - conflict, which has
/// no digits left near total conflict).
/// \returns nothing at total conflict.
[[nodiscard]] std::optional<FusedBinaryMass> dempster(std::span<const BinaryMass> sources);
[[nodiscard]] std::optional<FusedBinaryMass> dempster(std::initializer_list<BinaryMass> sources);

/// Conflict to ignorance (Yager), n-ary: all sources at once, then the conflict is moved to the frame, once. Not
/// associative: folding it gives another result. Total conflict gives the vacuous mass with conflict 1.
[[nodiscard]] FusedBinaryMass conflict_to_ignorance(std::span<const BinaryMass> sources);
[[nodiscard]] FusedBinaryMass conflict_to_ignorance(std::initializer_list<BinaryMass> sources);

/// One of the two rules above, n-ary.
/// \returns nothing at total conflict under Dempster's rule.
[[nodiscard]] std::optional<FusedBinaryMass> fuse(std::span<const BinaryMass> sources, FusionRule rule);
[[nodiscard]] std::optional<FusedBinaryMass> fuse(std::initializer_list<BinaryMass> sources, FusionRule rule);

/// Classical (Shafer) discounting: committed masses are multiplied by `reliability`, the rest is ignorance.
/// \param reliability  in [0, 1]; 1 keeps the mass, 0 makes it vacuous
/// \throws std::invalid_argument for another
[[nodiscard]] constexpr BinaryMass discount(const BinaryMass& mass, double reliability) {
  check_reliability(reliability);
  return {.yes = reliability * mass.yes,
          .no = reliability * mass.no,
          .unknown = (1.0 - reliability) + reliability * mass.unknown};
}

std::ostream& operator<<(std::ostream& out, const BinaryMass& mass);
std::ostream& operator<<(std::ostream& out, const OpenBinaryMass& mass);

}  // namespace credo::evidence
