// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <sstream>
#include <stdexcept>

#include "evidence/binary_mass.hpp"
#include "evidence/log_commonality.hpp"

namespace credo::evidence {

/// Dempster's rule as addition: the weights of evidence for YES and for NO (Shafer 1976, ch. 5), v = -ln w with w of
/// the canonical decomposition. Two numbers hold a mass on {YES, NO}; the third of LogCommonality is the conflict,
/// which Dempster's rule forgets. Taking evidence in, merging and taking out again are two additions or subtractions;
/// {0, 0} is the vacuous mass. Nothing underflows and nothing locks, however much evidence there is.
/// A Bayes filter's log-odds are the difference of the two; their sum tells a contested cell from an unseen one.
template <std::floating_point Real>
struct BasicLogEvidence {
  Real yes = 0;  ///< ln(q(YES) / q(Θ)) = ln(1 + m(YES) / m(Θ)) >= 0
  Real no = 0;   ///< the same of NO

  constexpr BasicLogEvidence& operator+=(const BasicLogEvidence& other) {
    yes += other.yes;
    no += other.no;
    return *this;
  }
  constexpr BasicLogEvidence& operator-=(const BasicLogEvidence& other) {
    yes -= other.yes;
    no -= other.no;
    return *this;
  }
  /// Dempster's rule for independent evidence.
  friend constexpr BasicLogEvidence operator+(BasicLogEvidence a, const BasicLogEvidence& b) { return a += b; }
  /// Takes out `b`, which must have been merged into `a` before.
  friend constexpr BasicLogEvidence operator-(BasicLogEvidence a, const BasicLogEvidence& b) { return a -= b; }
  friend constexpr bool operator==(const BasicLogEvidence&, const BasicLogEvidence&) = default;

  template <std::floating_point Other>
  [[nodiscard]] constexpr BasicLogEvidence<Other> as() const {
    return {static_cast<Other>(yes), static_cast<Other>(no)};
  }
};

using LogEvidence = BasicLogEvidence<double>;
using LogEvidenceF = BasicLogEvidence<float>;  ///< sums depend on their order in the last digits

/// The evidence in a mass.
/// \throws std::invalid_argument unless yes >= 0, no >= 0 and unknown > 0: a dogmatic mass is infinite evidence, which no
///         later one could undo; discount it first
template <std::floating_point Real = double>
[[nodiscard]] BasicLogEvidence<Real> log_evidence(const BinaryMass& mass) {
  if (!(mass.yes >= 0.0 && mass.no >= 0.0 && mass.unknown > 0.0 && mass.yes + mass.no <= 1.0 + kMassTolerance)) {
    std::ostringstream message;
    message << "evidence can be added up only of a mass that leaves some ignorance; got yes = " << mass.yes
            << ", no = " << mass.no << ", unknown = " << mass.unknown << ": discount it first";
    throw std::invalid_argument(message.str());
  }
  // Relative to 1 and not by division, which a subnormal ignorance could make infinite.
  const auto weight = [&mass](double committed) {
    return committed < mass.unknown ? std::log1p(committed / mass.unknown)
                                    : std::log(committed + mass.unknown) - std::log(mass.unknown);
  };
  return LogEvidence{weight(mass.yes), weight(mass.no)}.as<Real>();
}

/// The evidence in a cell of a map: YES is occupied, NO is empty. Its conflict is forgotten.
template <std::floating_point Real>
[[nodiscard]] constexpr BasicLogEvidence<Real> log_evidence(const BasicLogCommonality<Real>& cell) {
  return {cell.occupied - cell.unknown, cell.empty - cell.unknown};
}

/// The mass under Dempster's rule: m(YES) = (e^v_yes - 1) / Z, m(NO) = (e^v_no - 1) / Z, m(Θ) = 1 / Z. Exponents are
/// taken relative to the larger, so that any amount of evidence has a mass and total conflict cannot arise. Evidence
/// below 0, as rounding leaves where some was taken out again, counts as 0.
template <std::floating_point Real>
[[nodiscard]] BinaryMass normalised_mass(const BasicLogEvidence<Real>& evidence) {
  const double for_yes = std::max(0.0, static_cast<double>(evidence.yes));
  const double for_no = std::max(0.0, static_cast<double>(evidence.no));
  const double largest = std::max(for_yes, for_no);
  const double yes = -std::exp(for_yes - largest) * std::expm1(-for_yes);
  const double no = -std::exp(for_no - largest) * std::expm1(-for_no);
  const double unknown = std::exp(-largest);
  const double sum = yes + no + unknown;  // >= 1: the larger commonality
  return {.yes = yes / sum, .no = no / sum, .unknown = unknown / sum};
}

/// Pignistic probability of YES.
template <std::floating_point Real>
[[nodiscard]] double pignistic(const BasicLogEvidence<Real>& evidence) {
  return normalised_mass(evidence).pignistic();
}

/// Plausibility transform: Pl(YES) / (Pl(YES) + Pl(NO)), the logistic function of yes - no.
template <std::floating_point Real>
[[nodiscard]] double plausibility_probability(const BasicLogEvidence<Real>& evidence) {
  return 1.0 / (1.0 + std::exp(static_cast<double>(evidence.no) - static_cast<double>(evidence.yes)));
}

}  // namespace credo::evidence
