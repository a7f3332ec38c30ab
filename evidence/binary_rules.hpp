// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <optional>
#include <span>

#include "evidence/binary_mass.hpp"
#include "evidence/source_list.hpp"

namespace credo::evidence {

/// The rules of rules.hpp on the frame {YES, NO}, in closed form; conjunctive, dempster and conflict_to_ignorance are
/// in binary_mass.hpp. On two elements the rule of Dubois and Prade and DSmH are conflict_to_ignorance: YES ∪ NO is the
/// frame. All are n-ary and commutative; what is not associative is not to be folded (rules.hpp has the laws).

using BinarySources = SourceList<BinaryMass>;

/// Disjunctive rule (Dubois and Prade 1986): what all sources agree on; at least one is reliable. No conflict arises.
/// \throws std::invalid_argument for no source: what is neutral here, m(∅) = 1, is no BinaryMass
[[nodiscard]] BinaryMass disjunctive(const BinarySources& sources);

/// Mean of the masses. \param weights  none for equal ones; else one for each source, >= 0, not all 0
/// \throws std::invalid_argument for others, and for no source
[[nodiscard]] BinaryMass average(const BinarySources& sources, std::span<const double> weights = {});

/// Murphy's rule (2000): the mean of s sources combined with itself s - 1 times by Dempster's rule. Always has a
/// result; `conflict` is what the mean had with itself. \throws std::invalid_argument for no source
[[nodiscard]] FusedBinaryMass murphy(const BinarySources& sources);

/// The proportional rules give the conflict back to those that caused it. Each has a result at total conflict; no
/// source gives the vacuous mass; `conflict` is what was given back. For two sources PCR5, PCR6, PCR5+ and PCR6+ are
/// one rule, exact and of constant time.

/// PCR2 (Smarandache and Dezert 2005; Li P., eq. (6)): all conflict to YES and NO, in proportion to the sums of their
/// masses over the sources. The vacuous mass is neutral. O(s).
[[nodiscard]] FusedBinaryMass pcr2(const BinarySources& sources);

/// PCR5 (Smarandache and Dezert 2005): each conflicting product in proportion to the product of the masses of the
/// sources that named the same. Also to the frame where a source named it: beyond two sources the vacuous mass is not
/// neutral. Such weights do not factorise over the sources: O(3^s).
/// \throws std::invalid_argument for more than kMaxProducts products of masses > 0: some 16 sources
[[nodiscard]] FusedBinaryMass pcr5(const BinarySources& sources);

/// PCR6 (Martin and Osswald 2006): as PCR5, in proportion to the sum of these masses. Any number of sources, O(s log s)
/// (pcr6_quadrature.hpp); absolute error of a mass below 1e-12.
[[nodiscard]] FusedBinaryMass pcr6(const BinarySources& sources);

/// PCR5+ and PCR6+ (T. Dezert, J. Dezert and Smarandache 2021): nothing goes to the frame, which takes no part in a
/// conflict. So the vacuous mass is neutral. Otherwise as PCR5 and PCR6, with their limits.
[[nodiscard]] FusedBinaryMass pcr5_plus(const BinarySources& sources);
[[nodiscard]] FusedBinaryMass pcr6_plus(const BinarySources& sources);

/// Cautious rule (Denoeux 2008): the smallest weight that a source gives to each simple mass. For reliable sources that
/// may share evidence. Associative, idempotent; total conflict cannot arise. The vacuous mass is not neutral: it takes
/// away what a source has for YES and NO at once.
/// \throws std::invalid_argument for no source, and for a dogmatic one (unknown = 0), which has no weights
[[nodiscard]] OpenBinaryMass cautious(const BinarySources& sources);
/// The same for masses that hold conflict already, as a result of the rule does.
[[nodiscard]] OpenBinaryMass cautious(std::span<const OpenBinaryMass> sources);

/// Bold rule (Denoeux 2008), the disjunctive counterpart: for sources that may share evidence and of which one is
/// reliable. Associative, idempotent.
/// \throws std::invalid_argument for no source, and for one without mass on the empty set, where it is not defined
[[nodiscard]] OpenBinaryMass bold(std::span<const OpenBinaryMass> sources);

/// Takes `part` out of what the conjunctive rule made of it and others: commonalities are divided (Smets 1995).
/// \returns nothing where the quotient is no mass: `part` cannot have been in `whole`
/// \throws std::invalid_argument for a dogmatic part (unknown = 0), whose evidence cannot be taken out
[[nodiscard]] std::optional<OpenBinaryMass> decombine(const OpenBinaryMass& whole, const BinaryMass& part);

/// Contextual discounting (Mercier, Quost and Denoeux 2008): how reliable the source is depends on the truth. What it
/// says for YES is wrong only where the truth is NO, so that it is the reliability there that counts, and vice versa.
/// \param if_yes, if_no  reliability where the truth is YES and where it is NO, in [0, 1]
/// \throws std::invalid_argument for others
[[nodiscard]] constexpr BinaryMass contextual_discount(const BinaryMass& mass, double if_yes, double if_no) {
  check_reliability(if_yes);
  check_reliability(if_no);
  return {.yes = if_no * mass.yes,
          .no = if_yes * mass.no,
          .unknown = mass.unknown + ((1.0 - if_no) * mass.yes + (1.0 - if_yes) * mass.no)};
}

}  // namespace credo::evidence
