// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/protection_level.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace credo::localization {
namespace {

/// exp(-x^2 / 2): at least the probability that a normal error in two dimensions is longer than x standard deviations
/// of the worst of them (Rayleigh), or one in one dimension larger in magnitude. Looked up; the chord of a convex
/// function lies above it.
class Tail {
 public:
  Tail() {
    for (std::size_t i = 0; i <= kSteps; ++i)
      chords_[i].value = std::exp(-0.5 * std::pow(static_cast<double>(i) * kStep, 2));
    for (std::size_t i = 0; i < kSteps; ++i) chords_[i].rise = chords_[i + 1].value - chords_[i].value;
  }
  double operator()(double x) const {
    const double at = std::min(std::max(x * (1.0 / kStep), 0.0), static_cast<double>(kSteps));
    const auto i = static_cast<std::size_t>(at);
    return chords_[i].value + (at - static_cast<double>(i)) * chords_[i].rise;
  }

 private:
  static constexpr std::size_t kSteps = 800;
  static constexpr double kStep = 0.01;
  struct Chord {
    double value = 0.0, rise = 0.0;
  };
  std::array<Chord, kSteps + 1> chords_{};
};

}  // namespace

ProtectionLevel::ProtectionLevel() {
  constexpr std::size_t kUsualHypotheses = 4096;
  terms_.reserve(kUsualHypotheses);
}

/// Probability of an error above a level.
double ProtectionLevel::excess(double level) const {
  static const Tail tail;
  double sum = 0.0;
  for (const Term& term : terms_) sum += term.probability * tail((level - term.separation) * term.inverse_sigma);
  return sum;
}

double ProtectionLevel::operator()(std::span<const FaultHypothesis> hypotheses, const FaultComponent& of, double risk,
                                   double most) {
  terms_.clear();
  for (const FaultHypothesis& h : hypotheses)
    terms_.push_back({h.probability.*of.end, h.*of.separation, 1.0 / h.*of.sigma});
  constexpr double kGrowth = 1.4, kPrecision = 0.02;
  const auto log_excess = [&](double level) { return std::log(std::max(excess(level), 1e-300)); };
  const double target = std::log(risk);
  constexpr double kLeast = 1e-6;
  double low = 0.0, high = std::max(kLeast, 4.0 * hypotheses.front().*of.sigma);
  double log_low = log_excess(low), log_high = 0.0;
  if (log_low <= target) return 0.0;
  while ((log_high = log_excess(high)) > target) {
    if (high >= most) return std::numeric_limits<double>::infinity();
    low = high;
    log_low = log_high;
    high = std::min(most, kGrowth * high);
  }
  while (high - low > kPrecision * high) {
    const double secant = low + (high - low) * (log_low - target) / (log_low - log_high);
    const double between = std::clamp(secant, low + 0.1 * (high - low), high - 0.1 * (high - low));
    const double log_between = log_excess(between);
    (log_between > target ? low : high) = between;
    (log_between > target ? log_low : log_high) = log_between;
  }
  return high;
}

}  // namespace credo::localization
