// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <gtest/gtest.h>

#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "evidence/binary_mass.hpp"
#include "evidence/grid_mass.hpp"

/// Random masses for RapidCheck: shares of small integers, so that zeros, certainties and ties are frequent.
namespace rc {

inline Gen<std::vector<int>> shares(std::size_t count) {
  return gen::suchThat(gen::container<std::vector<int>>(count, gen::oneOf(gen::inRange(0, 4), gen::inRange(0, 1000))),
                       [](const std::vector<int>& share) {
                         int sum = 0;
                         for (const int value : share) sum += value;
                         return sum > 0;
                       });
}

template <>
struct Arbitrary<credo::evidence::BinaryMass> {
  static Gen<credo::evidence::BinaryMass> arbitrary() {
    return gen::map(shares(3), [](const std::vector<int>& share) {
      const double sum = share[0] + share[1] + share[2];
      return credo::evidence::BinaryMass{share[0] / sum, share[1] / sum, share[2] / sum};
    });
  }
};

template <>
struct Arbitrary<credo::evidence::GridMass> {
  static Gen<credo::evidence::GridMass> arbitrary() {
    return gen::map(shares(4), [](const std::vector<int>& share) {
      const double sum = share[0] + share[1] + share[2] + share[3];
      return credo::evidence::GridMass{share[0] / sum, share[1] / sum, share[2] / sum, share[3] / sum};
    });
  }
};

}  // namespace rc

namespace credo::evidence {

inline double total(const BinaryMass& m) { return m.yes + m.no + m.unknown; }
inline double total(const OpenBinaryMass& m) { return m.yes + m.no + m.unknown + m.conflict; }
inline double total(const GridMass& m) { return m.empty + m.occupied + m.conflict + m.unknown; }

inline double distance(const BinaryMass& a, const BinaryMass& b) {
  return std::max({std::abs(a.yes - b.yes), std::abs(a.no - b.no), std::abs(a.unknown - b.unknown)});
}
inline double distance(const GridMass& a, const GridMass& b) {
  return std::max({std::abs(a.empty - b.empty), std::abs(a.occupied - b.occupied), std::abs(a.conflict - b.conflict),
                   std::abs(a.unknown - b.unknown)});
}

// Masses of every magnitude from 1e-9 on, some of them 0 or 1.
class MassesOfAllMagnitudes {
 public:
  BinaryMass next() {
    std::array<double, 3> raw{};
    double sum = 0.0;
    for (double& value : raw) sum += value = magnitude();
    if (sum == 0.0) return BinaryMass::vacuous();
    return {raw[0] / sum, raw[1] / sum, raw[2] / sum};
  }
  std::vector<BinaryMass> next(std::size_t count) {
    std::vector<BinaryMass> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(next());
    return result;
  }

 private:
  double magnitude() {
    switch (random_() % 6) {
      case 0: return 0.0;
      case 1: return 1.0;
      case 2: return std::pow(10.0, -9.0 * uniform());
      default: return uniform();
    }
  }
  double uniform() { return static_cast<double>(random_()) / static_cast<double>(std::mt19937::max()); }

  std::mt19937 random_{11};
};

}  // namespace credo::evidence
