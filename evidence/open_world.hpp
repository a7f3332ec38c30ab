// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// Condensed result of the extended-open-world combination on the frame {P_1 .. P_p, *}: one prediction against p
/// candidates, * = none of them (Clerentin et al., sec. 4.1). Disjunctions are lumped into `unknown`.
/// sum(match) + none + unknown + conflict = 1 while open; = 1 without conflict once normalised.
struct OpenWorldMasses {
  std::vector<double> match;  ///< m(P_i), one for each candidate
  double none = 1.0;          ///< m(*)
  double unknown = 0.0;
  double conflict = 0.0;  ///< of the open combination; kept for information once normalised
};

/// One number for each of {P_1 .. P_p, *}.
struct OpenWorldValues {
  std::vector<double> match;
  double none = 1.0;
};

enum class MatchDecision {
  kMatched,
  kNone,      ///< the prediction matches no candidate
  kUndecided  ///< ambiguous
};

struct OpenWorldDecision {
  MatchDecision kind = MatchDecision::kUndecided;
  int candidate = -1;   ///< of the match; -1 otherwise
  double value = 0.0;   ///< mass or pignistic probability of what leads
  double margin = 0.0;  ///< to the second of {P_1 .. P_p, *}
};

/// Lead in pignistic probability below which a match is ambiguous.
inline constexpr double kMinPignisticMargin = 0.05;

/// Matches one prediction against p candidates. Keeps its memory: no allocation once it has seen the largest p (or
/// after reserve). The evidence about candidate i is a mass on "the prediction is P_i": yes = m_i(P_i), no = m_i(not
/// P_i). Products are prefix/suffix products: O(p), nothing is divided by 1 - m_i(P_i). Call combine first; the
/// references returned are valid until the next combine.
class OpenWorldMatcher {
 public:
  void reserve(std::size_t candidates);

  /// Without candidates all the mass is on *.
  void combine(std::span<const BinaryMass> evidence);

  /// Two candidates are certain, each for itself: nothing is left to normalise. (More than 300 candidates that each
  /// claim a mass of 0.9 underflow and count as such.)
  [[nodiscard]] bool total_conflict() const { return kept_ <= 0.0; }

  /// Unnormalised masses (TBM).
  [[nodiscard]] const OpenWorldMasses& open() const { return open_; }
  /// Divided by what is not in conflict. Bel(P_i) and Bel(*) are these masses. Precondition: !total_conflict().
  [[nodiscard]] const OpenWorldMasses& normalised();
  /// Exact plausibility, normalised: Pl(P_i) = (1 - b_i) prod_{j != i} (1 - a_j) / K. Precondition: !total_conflict().
  [[nodiscard]] const OpenWorldValues& plausibility();
  /// Exact pignistic probability, as if all disjunctions had been kept; O(p^2), no enumeration. Sums to 1.
  /// Precondition: !total_conflict().
  [[nodiscard]] const OpenWorldValues& pignistic();

  /// The paper's: the largest mass of {P_1 .. P_p, *}, ties to the lowest index, * last; none where the lumped
  /// ignorance is larger still; undecided at total conflict.
  [[nodiscard]] OpenWorldDecision decide_by_mass() const;
  /// The default: the largest pignistic probability of {P_1 .. P_p, *}; undecided where it does not lead by
  /// `min_margin`, and at total conflict. The ignorance never competes.
  [[nodiscard]] OpenWorldDecision decide_by_pignistic(double min_margin = kMinPignisticMargin);

 private:
  void prepare_nodes(std::size_t rule);

  std::vector<BinaryMass> evidence_;
  std::vector<double> suffix_;   // suffix_[i]: product of 1 - a over the candidates from i on
  std::vector<double> factors_;  // the same of b + c x at one node
  OpenWorldMasses open_, normalised_;
  OpenWorldValues plausibility_, pignistic_;
  double kept_ = 1.0;     // what is not in conflict
  double all_out_ = 1.0;  // prod (1 - a_i)
  struct Node {
    double x;
    double weight;
  };
  std::vector<Node> nodes_;  // Gauss-Legendre on [0, 1], one rule after the other by their number of nodes
  std::size_t largest_rule_ = 0;
};

/// Weight of giving candidate i to a prediction in a global assignment where leaving it unassigned weighs 0: ln of
/// Pl(P_i) / Pl(*) = ln((1 - b) / (1 - a)). The assignment of the largest sum is the most plausible relation. Only
/// positive weights need be offered. +inf for a = 1, -inf for b = 1.
[[nodiscard]] double assignment_weight(const BinaryMass& evidence);

}  // namespace credo::evidence
