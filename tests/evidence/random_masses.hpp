// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <gtest/gtest.h>

#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
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

}  // namespace credo::evidence
