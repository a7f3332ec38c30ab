// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/sensor_matching.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace credo::evidence {
namespace {

/// What the two sides weigh: the probability of YES is yes / (yes + no).
struct Weights {
  double yes;
  double no;
};

Weights weights(const BinaryMass& mass, Matching matching) {
  const double shared = matching == Matching::kPignistic ? 0.5 * mass.unknown : mass.unknown;
  return {mass.yes + shared, mass.no + shared};
}

BinaryMass whether_occupied(const GridMass& mass) {
  const std::optional<GridMass> rest = without_conflict(mass);
  if (!rest) throw std::domain_error("total conflict: there is no mass left to match a probability with");
  return {.yes = rest->occupied, .no = rest->empty, .unknown = rest->unknown};
}

GridMass cell_of(const BinaryMass& occupied, double conflict) {
  const double rest = 1.0 - conflict;
  return {.empty = rest * occupied.no,
          .occupied = rest * occupied.yes,
          .conflict = conflict,
          .unknown = rest * occupied.unknown};
}

void check_range(const char* what, double found, bool holds, const char* expected) {
  if (holds) return;
  std::ostringstream message;
  message << what << ": found " << found << ", expected " << expected;
  throw std::invalid_argument(message.str());
}

void check_conflict(double conflict) {
  check_range("conflict", conflict, conflict >= 0.0 && conflict < 1.0, "a mass in [0, 1)");
}

}  // namespace

double matched_probability(const BinaryMass& mass, Matching matching) {
  const Weights weight = weights(mass, matching);
  return weight.yes / (weight.yes + weight.no);
}

double matched_log_odds(const BinaryMass& mass, Matching matching) {
  const Weights weight = weights(mass, matching);
  return std::log(weight.yes) - std::log(weight.no);
}

double matched_probability(const GridMass& mass, Matching matching) {
  return matched_probability(whether_occupied(mass), matching);
}

double matched_log_odds(const GridMass& mass, Matching matching) {
  return matched_log_odds(whether_occupied(mass), matching);
}

double largest_unknown_with(double probability, Matching matching) {
  check_range("probability", probability, probability >= 0.0 && probability <= 1.0, "a number in [0, 1]");
  const double smaller = std::min(probability, 1.0 - probability);
  return matching == Matching::kPignistic ? 2.0 * smaller : smaller / (1.0 - smaller);
}

BinaryMass mass_with(double probability, double unknown, Matching matching) {
  const double largest = largest_unknown_with(probability, matching);
  if (!(unknown >= 0.0 && unknown <= largest + kMassTolerance)) {
    std::ostringstream message;
    message << "unknown: found " << unknown << ", expected a mass in [0, " << largest
            << "], the most that a mass with the probability " << probability << " can have";
    throw std::invalid_argument(message.str());
  }
  const double kept = std::min(unknown, largest);
  // BetP: y = p - u / 2; PlP: y = p (1 + u) - u. NO likewise, with 1 - p.
  const auto committed = [&](double p, double other) {
    return std::max(0.0, p - kept * (matching == Matching::kPignistic ? 0.5 : other));
  };
  return {.yes = committed(probability, 1.0 - probability),
          .no = committed(1.0 - probability, probability),
          .unknown = kept};
}

BinaryMass most_unknown_with(double probability, Matching matching) {
  return mass_with(probability, largest_unknown_with(probability, matching), matching);
}

GridMass grid_mass_with(double probability, double unknown, double conflict, Matching matching) {
  check_conflict(conflict);
  return cell_of(mass_with(probability, unknown / (1.0 - conflict), matching), conflict);
}

GridMass most_unknown_grid_mass_with(double probability, double conflict, Matching matching) {
  check_conflict(conflict);
  return cell_of(most_unknown_with(probability, matching), conflict);
}

}  // namespace credo::evidence
