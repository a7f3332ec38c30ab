// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/pcr6_quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "evidence/binary_rules.hpp"
#include "tests/evidence/random_masses.hpp"

namespace credo::evidence {
namespace {

using Masses = std::vector<BinaryMass>;

// PCR6 and PCR6+ as they are defined: every product of masses of every source.
BinaryMass enumerated_pcr6(const Masses& sources, bool frame_shares) {
  struct Sum {
    long double yes = 0, no = 0, unknown = 0;
  };
  Sum result;
  const auto visit = [&](auto&& self, std::size_t i, unsigned named, long double product, Sum claimed) -> void {
    if (i < sources.size()) {
      const BinaryMass& source = sources[i];
      Sum next = claimed;
      next.yes += source.yes;
      self(self, i + 1, named & 1u, product * source.yes, next);
      next = claimed;
      next.no += source.no;
      self(self, i + 1, named & 2u, product * source.no, next);
      next = claimed;
      if (frame_shares) next.unknown += source.unknown;
      self(self, i + 1, named, product * source.unknown, next);
      return;
    }
    if (product == 0.0L) return;
    if (named == 1) result.yes += product;
    if (named == 2) result.no += product;
    if (named == 3) result.unknown += product;
    if (named != 0) return;
    const long double all = claimed.yes + claimed.no + claimed.unknown;
    result.yes += product * claimed.yes / all;
    result.no += product * claimed.no / all;
    result.unknown += product * claimed.unknown / all;
  };
  visit(visit, 0, 3u, 1.0L, {});
  return {static_cast<double>(result.yes), static_cast<double>(result.no), static_cast<double>(result.unknown)};
}

RC_GTEST_PROP(Pcr6QuadratureLaws, TwoSourcesHaveOneRuleOfProportion, (const BinaryMass& a, const BinaryMass& b)) {
  const BinaryMass expected = enumerated_pcr6({a, b}, true);
  RC_ASSERT(distance(pcr5({a, b}).mass, expected) < 1e-15);
  RC_ASSERT(pcr6({a, b}).mass == pcr5({a, b}).mass);
  RC_ASSERT(pcr5_plus({a, b}).mass == pcr5({a, b}).mass);
  RC_ASSERT(pcr6_plus({a, b}).mass == pcr5({a, b}).mass);
}

TEST(Pcr6Quadrature, IsEnumerationForThreeToEightSources) {
  MassesOfAllMagnitudes random;
  for (std::size_t count = 3; count <= 8; ++count) {
    for (int k = 0; k < 100; ++k) {
      const Masses sources = random.next(count);
      ASSERT_LT(distance(pcr6(sources).mass, enumerated_pcr6(sources, true)), 1e-12) << count << " sources, " << k;
      ASSERT_LT(distance(pcr6_plus(sources).mass, enumerated_pcr6(sources, false)), 1e-12)
          << count << " sources, " << k;
    }
  }
}

// Another road to the sums: how many of the sources name YES and NO decides everything if all have the same mass.
BinaryMass pcr6_of_equal_sources(const BinaryMass& mass, int count, bool frame_shares) {
  const long double yes = mass.yes, no = mass.no, unknown = mass.unknown;
  long double sum_yes = 0, sum_no = 0, sum_unknown = 0;
  for (int y = 0; y <= count; ++y) {
    for (int n = 0; y + n <= count; ++n) {
      const int u = count - y - n;
      const long double product =
          std::exp(std::lgamma(count + 1.0L) - std::lgamma(y + 1.0L) - std::lgamma(n + 1.0L) - std::lgamma(u + 1.0L)) *
          std::pow(yes, y) * std::pow(no, n) * std::pow(unknown, u);
      if (y == 0 || n == 0) {
        (y > 0 ? sum_yes : n > 0 ? sum_no : sum_unknown) += product;
        continue;
      }
      const long double for_unknown = frame_shares ? u * unknown : 0.0L;
      const long double all = y * yes + n * no + for_unknown;
      sum_yes += product * y * yes / all;
      sum_no += product * n * no / all;
      sum_unknown += product * for_unknown / all;
    }
  }
  return {static_cast<double>(sum_yes), static_cast<double>(sum_no), static_cast<double>(sum_unknown)};
}

TEST(Pcr6Quadrature, IsExactForManyEqualSources) {
  for (const int count : {16, 64, 128}) {
    for (const BinaryMass& mass : {BinaryMass{.5, .3, .2},
                                   {.9, .1, 0.0},
                                   {1e-9, 1.0 - 1e-9, 0.0},
                                   {.01, .02, .97},
                                   {1e-6, 2e-6, 1.0 - 3e-6},
                                   {1e-3, .999 - 1e-9, 1e-9}}) {
      const Masses sources(static_cast<std::size_t>(count), mass);
      EXPECT_LT(distance(pcr6(sources).mass, pcr6_of_equal_sources(mass, count, true)), 1e-12) << count << mass;
      EXPECT_LT(distance(pcr6_plus(sources).mass, pcr6_of_equal_sources(mass, count, false)), 1e-12) << count << mass;
    }
  }
}

// Source by source, in extended precision, with differences where the rule has sums of its own, and by a trapezoidal
// rule whose range and step have nothing in common with those in use.
BinaryMass dense_pcr6(const Masses& sources) {
  const OpenBinaryMass kept = conjunctive(sources);
  long double yes = kept.yes, no = kept.no, unknown = kept.unknown;
  const auto product_of = [&](auto factor, std::size_t without) {
    long double result = 1;
    for (std::size_t j = 0; j < sources.size(); ++j) {
      if (j != without) result *= factor(sources[j]);
    }
    return result;
  };
  const long double step = .25L;
  for (long double y = -33; y < 33; y += step) {
    const long double t = std::exp(y), weight = step * t;
    const auto damped = [t](long double m) { return m * std::exp(-t * m); };
    const auto a = [&](const BinaryMass& m) { return damped(m.yes); };
    const auto b = [&](const BinaryMass& m) { return damped(m.no); };
    const auto u = [&](const BinaryMass& m) { return damped(m.unknown); };
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const BinaryMass& m = sources[i];
      const long double all = product_of([&](const auto& s) { return a(s) + b(s) + u(s); }, i);
      const long double no_no = product_of([&](const auto& s) { return a(s) + u(s); }, i);
      const long double no_yes = product_of([&](const auto& s) { return b(s) + u(s); }, i);
      const long double neither = product_of(u, i);
      yes += weight * m.yes * a(m) * (all - no_no);
      no += weight * m.no * b(m) * (all - no_yes);
      unknown += weight * m.unknown * u(m) * (all - no_no - no_yes + neither);
    }
  }
  return {static_cast<double>(yes), static_cast<double>(no), static_cast<double>(unknown)};
}

TEST(Pcr6Quadrature, IsExactForSixteenAndSixtyFourSources) {
  MassesOfAllMagnitudes random;
  for (int k = 0; k < 5; ++k) {
    const Masses sources = random.next(16);
    EXPECT_LT(distance(pcr6(sources).mass, dense_pcr6(sources)), 1e-12) << k;
  }
  const Masses sources = random.next(64);
  EXPECT_LT(distance(pcr6(sources).mass, dense_pcr6(sources)), 1e-12);
}

}  // namespace
}  // namespace credo::evidence
