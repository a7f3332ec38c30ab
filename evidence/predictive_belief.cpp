// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/predictive_belief.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace credo::evidence {
namespace {

/// The continued fraction of the incomplete beta function, 1/(1 + d1/(1 + d2/(1 + ...))), DLMF 8.17.22, by the modified
/// Lentz method. Converges fast for x < (a + 1) / (a + b + 2), in O(sqrt(max(a, b))) terms.
double beta_fraction(double x, double a, double b) {
  constexpr int kMaxTerms = 100'000;  // enough for 1e9 trials
  double numerator = 1.0;
  double inverse_denominator = 0.0;
  double value = 1.0;
  for (int term = 1; term < kMaxTerms; ++term) {
    const double m = term / 2;
    const double d = term % 2 == 1 ? -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
                                   : m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    inverse_denominator = 1.0 / (1.0 + d * inverse_denominator);
    numerator = 1.0 + d / numerator;
    const double factor = numerator * inverse_denominator;
    value *= factor;
    if (std::abs(factor - 1.0) < 1e-15) break;
  }
  return 1.0 / value;
}

/// std::lgamma without the sign that it leaves in a global variable.
double log_gamma(double x) {
  int sign = 0;
  return lgamma_r(x, &sign);
}

/// I_x(a, b), the regularised incomplete beta function. x in (0, 1).
double incomplete_beta(double x, double a, double b) {
  const double front = std::exp(log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1.0) / (a + b + 2.0)) return front / a * beta_fraction(x, a, b);
  return 1.0 - front / b * beta_fraction(1.0 - x, b, a);
}

/// The probability with which so many successes, or more, are just as rare as `tail`: the lower bound of Clopper and
/// Pearson. P(X >= k) = I_p(k, n - k + 1) grows with p: bisected until the doubles are neighbours.
double lower_bound_of_probability(double successes, double trials, double tail) {
  if (successes == 0.0) return 0.0;
  double low = 0.0;
  double high = 1.0;
  for (double middle = 0.5; low < middle && middle < high; middle = 0.5 * (low + high)) {
    (incomplete_beta(middle, successes, trials - successes + 1.0) < tail ? low : high) = middle;
  }
  return low;
}

}  // namespace

BinaryMass predictive_belief(std::size_t successes, std::size_t trials, double confidence) {
  if (!(confidence > 0.0 && confidence < 1.0)) {
    std::ostringstream message;
    message << "confidence: found " << confidence << ", expected a number between 0 and 1";
    throw std::invalid_argument(message.str());
  }
  if (successes > trials) {
    throw std::invalid_argument("successes: found " + std::to_string(successes) + ", expected at most the " +
                                std::to_string(trials) + " trials");
  }
  const auto k = static_cast<double>(successes);
  const auto n = static_cast<double>(trials);
  const double tail = 0.5 * (1.0 - confidence);
  return BinaryMass::from(lower_bound_of_probability(k, n, tail), lower_bound_of_probability(n - k, n, tail));
}

}  // namespace credo::evidence
