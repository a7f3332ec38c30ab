// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace credo::sim {

/// A bijection of 64 bits without visible structure (Steele, Lea, Flood 2014: SplitMix64's finaliser).
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// The seed of one world's draws: worlds of different names are independent under the same seed.
[[nodiscard]] constexpr std::uint64_t seed_of_world(std::uint64_t seed, std::string_view name) {
  for (const char letter : name) seed = mix_bits(seed ^ static_cast<unsigned char>(letter));
  return seed;
}

/// Random numbers that are a function of (seed, stream, index, how many were drawn): every reading has its own stream,
/// so that neither threads nor a sensor more or less changes another reading. Same bytes on every platform with IEEE
/// double and the same log, sqrt and cos.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed, std::uint64_t stream = 0, std::uint64_t index = 0)
      : state_(mix_bits(mix_bits(mix_bits(seed + kGolden) ^ (stream * kGolden + 1)) + index * kGolden)) {}

  constexpr std::uint64_t bits() { return mix_bits(state_ += kGolden); }
  /// In [0, 1).
  constexpr double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  constexpr double uniform(double from, double to) { return from + (to - from) * uniform(); }
  constexpr bool chance(double probability) { return uniform() < probability; }
  /// Standard normal (Box and Muller 1958; the second value is thrown away to keep one draw one step).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }
  double normal(double sigma) { return sigma * normal(); }

 private:
  static constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;
  std::uint64_t state_;
};

/// The streams of a simulation.
enum Stream : std::uint64_t {
  kCalibrationStream = 1,
  kPlanStream,
  kStartStream,
  kOdometryStream,
  kPixelStream,
  kImageStream,
  kDustStream,
  kClutterStream,
  kPeopleStream,
  kBuildingStream,
  kDegradationStream,
  kScanStream = 100,  ///< + index of the range finder
  kSonarStream = 200  ///< + index of the ring
};

}  // namespace credo::sim
