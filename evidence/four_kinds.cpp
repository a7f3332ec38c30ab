// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/four_kinds.hpp"

#include <cassert>
#include <cmath>

#include "evidence/belief_shapes.hpp"

namespace credo::evidence {
namespace {

constexpr double kTie = 1e-12;

double belief_in(const FourKindMass& mass, int kind) { return kind < 3 ? mass.one[kind] : mass.other; }

}  // namespace

WhichKind which_kind(double deviation, const WhichKindParams& params) {
  if (std::isnan(deviation)) return {};
  const double level = falling(std::abs(deviation), params.level_until, params.level_zero_from);
  const double beyond = params.committed * (1.0 - level);
  return {.one_or_other = {deviation < 0.0 ? beyond : 0.0, deviation > 0.0 ? beyond : 0.0, params.committed * level},
          .unknown = 1.0 - params.committed};
}

WhetherRegular whether_regular(double gap, const WhetherRegularParams& params) {
  if (std::isnan(gap)) return {};
  const double regular = falling(gap, params.regular_until, params.other_from);
  return {.regular = params.committed * regular,
          .other = params.committed * (1.0 - regular),
          .unknown = 1.0 - params.committed};
}

FourKindMass combine(const WhichKind& which, const WhetherRegular& whether) {
  // {i, other} n {0, 1, 2} = {i};  {i, other} n {other} = {other}: never empty.
  FourKindMass result;
  double any = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    result.one[i] = which.one_or_other[i] * whether.regular;
    result.one_or_other[i] = which.one_or_other[i] * whether.unknown;
    any += which.one_or_other[i];
  }
  result.other = (any + which.unknown) * whether.other;
  result.regular = which.unknown * whether.regular;
  result.unknown = which.unknown * whether.unknown;
  return result;
}

int most_believed(const FourKindMass& mass) {
  int best = 0;
  for (int kind = 1; kind < 4; ++kind) {
    if (belief_in(mass, kind) > belief_in(mass, best) + kTie) best = kind;
  }
  return best;
}

BinaryMass belief_in_kind(const FourKindMass& mass, int kind) {
  assert(kind >= 0 && kind < 4);
  const double mixed = mass.one_or_other[0] + mass.one_or_other[1] + mass.one_or_other[2];
  if (kind == 3) {
    return {.yes = mass.other,
            .no = mass.one[0] + mass.one[1] + mass.one[2] + mass.regular,
            .unknown = mixed + mass.unknown};
  }
  BinaryMass result{
      .yes = mass.one[kind], .no = mass.other, .unknown = mass.one_or_other[kind] + mass.regular + mass.unknown};
  for (int other = 0; other < 3; ++other) {
    if (other != kind) result.no += mass.one[other] + mass.one_or_other[other];
  }
  return result;
}

}  // namespace credo::evidence
