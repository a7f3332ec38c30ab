// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/grid_rules.hpp"

#include <algorithm>
#include <stdexcept>

#include "evidence/binary_cell.hpp"
#include "evidence/binary_mass.hpp"

namespace credo::evidence {
namespace {

// Under the complement, unions become intersections and the overlap becomes ignorance.
GridMass dual(const GridMass& mass) {
  return {.empty = mass.empty, .occupied = mass.occupied, .conflict = mass.unknown, .unknown = mass.conflict};
}

// The products in which some sources name the set and all others the overlap, of each at least one.
double mixed_with_overlap(const GridSources& sources, double GridMass::*set) {
  double mixed = 0.0, only_set = sources[0].*set, only_overlap = sources[0].conflict;
  for (const GridMass& source : sources.span().subspan(1)) {
    mixed = mixed * (source.*set + source.conflict) + only_set * source.conflict + only_overlap * source.*set;
    only_set *= source.*set;
    only_overlap *= source.conflict;
  }
  return mixed;
}

}  // namespace

GridMass disjunctive(const GridSources& sources) {
  GridMass result = GridMass::vacuous();
  for (const GridMass& source : sources) result = dsmc(result, dual(source));
  return dual(result);
}

GridMass average(const GridSources& sources) {
  if (sources.size() == 0) throw std::invalid_argument("an average needs at least one mass; got none");
  const double share = 1.0 / static_cast<double>(sources.size());
  GridMass sum{0.0, 0.0, 0.0, 0.0};
  for (const GridMass& source : sources) {
    sum.empty += share * source.empty;
    sum.occupied += share * source.occupied;
    sum.conflict += share * source.conflict;
    sum.unknown += share * source.unknown;
  }
  return sum;
}

std::optional<FusedGridMass> dempster(const GridSources& sources) {
  Conjunction kept;
  for (const GridMass& source : sources) {
    const std::optional<GridMass> rest = without_conflict(source);
    if (!rest) return std::nullopt;
    kept.add({.yes = rest->occupied, .no = rest->empty, .unknown = rest->unknown});
  }
  const std::optional<FusedBinaryMass> fused = kept.dempster();
  if (!fused) return std::nullopt;
  const BinaryMass& occupied = fused->mass;
  return FusedGridMass{{occupied.no, occupied.yes, 0.0, occupied.unknown}, dsmc(sources.span()).conflict};
}

FusedGridMass conflict_to_ignorance(const GridSources& sources) {
  const GridMass open = dsmc(sources.span());
  return {{open.empty, open.occupied, 0.0, open.unknown + open.conflict}, open.conflict};
}

FusedGridMass dsmh(const GridSources& sources) {
  if (sources.size() == 0) return {};
  const GridMass open = dsmc(sources.span());
  const double empty = mixed_with_overlap(sources, &GridMass::empty);
  const double occupied = mixed_with_overlap(sources, &GridMass::occupied);
  return {{.empty = open.empty + empty,
           .occupied = open.occupied + occupied,
           .conflict = 0.0,
           .unknown = open.unknown + std::max(0.0, open.conflict - empty - occupied)},
          open.conflict};
}

FusedGridMass pcr2(const GridSources& sources) {
  const GridMass open = dsmc(sources.span());
  double empty = 0.0, occupied = 0.0;
  for (const GridMass& source : sources) {
    empty += source.empty;
    occupied += source.occupied;
  }
  if (empty + occupied == 0.0) return conflict_to_ignorance(sources);
  const auto given_back = cell::pcr2<double>({open.occupied, open.empty, open.unknown, open.conflict}, occupied, empty);
  return {{given_back.no, given_back.yes, 0.0, given_back.unknown}, open.conflict};
}

FusedGridMass pcr5(const GridMass& a, const GridMass& b) {
  const auto shared = cell::pcr5<double>({a.occupied, a.empty, a.unknown, 0.0}, {b.occupied, b.empty, b.unknown, 0.0});
  const auto beside_overlap = [&](double of_a, double of_b) { return of_a * b.conflict + a.conflict * of_b; };
  return {{.empty = shared.no + beside_overlap(a.empty, b.empty),
           .occupied = shared.yes + beside_overlap(a.occupied, b.occupied),
           .conflict = 0.0,
           .unknown = shared.unknown + beside_overlap(a.unknown, b.unknown) + a.conflict * b.conflict},
          dsmc(a, b).conflict};
}

}  // namespace credo::evidence
