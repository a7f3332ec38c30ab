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
  /// Of several arguments: places on the chords are found side by side, what they have there one by one.
  template <class Lanes>
  Lanes operator()(const Lanes& x) const {
    const Lanes places = (x * (1.0 / kStep)).max(0.0).min(static_cast<double>(kSteps));
    return places.unaryExpr([this](double place) {
      const auto i = static_cast<std::size_t>(place);
      return chords_[i].value + (place - static_cast<double>(i)) * chords_[i].rise;
    });
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
  blocks_.reserve(kUsualHypotheses / kLanes);
}

void ProtectionLevel::take(std::span<const FaultHypothesis> hypotheses, const FaultComponent& of) {
  blocks_.clear();
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    const FaultHypothesis& h = hypotheses[i];
    const auto lane = static_cast<Eigen::Index>(i % kLanes);
    if (lane == 0) blocks_.emplace_back();
    blocks_.back().probability[lane] = h.probability.*of.end;
    blocks_.back().separation[lane] = h.*of.separation;
    blocks_.back().inverse_sigma[lane] = 1.0 / h.*of.sigma;
  }
}

/// Probability of an error above a level; part of it where that is more than `enough`.
double ProtectionLevel::excess(double level, double enough) const {
  static const Tail tail;
  double sum = 0.0;
  for (const Block& block : blocks_) {
    const Lanes in_sigmas = (level - block.separation) * block.inverse_sigma;
    sum += (block.probability * tail(in_sigmas)).sum();
    if (sum > enough) break;
  }
  return sum;
}

double ProtectionLevel::operator()(std::span<const FaultHypothesis> hypotheses, const FaultComponent& of, double risk,
                                   double most) {
  take(hypotheses, of);
  constexpr double kGrowth = 1.4, kPrecision = 0.02;
  constexpr double kLeast = 1e-6;
  double low = 0.0, high = std::max(kLeast, 4.0 * hypotheses.front().*of.sigma);
  if (excess(low, risk) <= risk) return 0.0;
  // Far below the level sought, a few hypotheses are enough to tell.
  double at_high = 0.0;
  while ((at_high = excess(high, risk)) > risk) {
    if (high >= most) return std::numeric_limits<double>::infinity();
    low = high;
    high = std::min(most, kGrowth * high);
  }
  const auto log_of = [](double probability) { return std::log(std::max(probability, 1e-300)); };
  const double target = std::log(risk);
  double log_low = log_of(excess(low)), log_high = log_of(at_high);
  while (high - low > kPrecision * high) {
    const double secant = low + (high - low) * (log_low - target) / (log_low - log_high);
    const double between = std::clamp(secant, low + 0.1 * (high - low), high - 0.1 * (high - low));
    const double log_between = log_of(excess(between));
    (log_between > target ? low : high) = between;
    (log_between > target ? log_low : log_high) = log_between;
  }
  return high;
}

}  // namespace credo::localization
