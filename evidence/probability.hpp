// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// Probabilities made of belief, to decide or to compare with. All divide m(∅) out first.
/// All: \throws std::domain_error at m(∅) = 1, where nothing is left to decide on

/// BetP(A): every mass is shared equally among the Venn regions of its proposition; on a power set Smets' pignistic
/// probability, else its generalisation by the DSm cardinality (Dezert, Smarandache and Daniel 2004).
[[nodiscard]] double pignistic(const MassFunction& mass, const Proposition& set);
/// BetP of every Venn region that exists; sums to 1. On a power set of the elements. \returns size region_count()
[[nodiscard]] std::vector<double> pignistic_regions(const MassFunction& mass);

/// DSmP_ε(A) (Dezert and Smarandache 2008): every mass is shared among the regions of its proposition in proportion to
/// what these were given alone, plus ε each; 0/0 takes its limit, the pignistic share.
/// \param epsilon  >= 0, finite. \throws std::invalid_argument for another
[[nodiscard]] double dsmp(const MassFunction& mass, const Proposition& set, double epsilon);
[[nodiscard]] std::vector<double> dsmp_regions(const MassFunction& mass, double epsilon);  ///< as pignistic_regions

/// Normalised plausibilities of the elements (Cobb and Shenoy 2006); combining by Dempster's rule multiplies them.
/// Power sets only. \returns size n. \throws std::invalid_argument on another model
[[nodiscard]] std::vector<double> plausibility_transform(const MassFunction& mass);

/// What is maximised.
enum class Criterion {
  kBelief,  ///< the cautious choice
  kPlausibility,
  kPignistic
};

/// The choice among propositions, with what it takes to refuse it.
struct Decision {
  bool rejected = true;
  std::size_t choice = 0;  ///< index of what leads; the lowest of equal ones
  double value = 0.0;
  double margin = 0.0;  ///< lead over the second; the value itself where there is none
};

struct DecisionParams {
  Criterion criterion = Criterion::kPignistic;
  double min_value = 0.0;   ///< a smaller value is rejected
  double min_margin = 0.0;  ///< so is a smaller lead
};

/// The best of the candidates. At m(∅) = 1 rejected, with value 0.
/// \throws std::invalid_argument if there is no candidate
[[nodiscard]] Decision decide(const MassFunction& mass, std::span<const Proposition> candidates,
                              const DecisionParams& params = {});
[[nodiscard]] inline Decision decide(const MassFunction& mass, std::initializer_list<Proposition> candidates,
                                     const DecisionParams& params = {}) {
  return decide(mass, std::span(candidates.begin(), candidates.size()), params);
}
/// Among the elements of the frame.
[[nodiscard]] Decision decide(const MassFunction& mass, const DecisionParams& params = {});

}  // namespace credo::evidence
