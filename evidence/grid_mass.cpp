// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/grid_mass.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "evidence/binary_mass.hpp"

namespace credo::evidence {
namespace {

// An element as the set of its Venn regions. Intersection is AND, union is OR, DSm cardinality the number of bits.
constexpr unsigned kOverlap = 1, kOnlyEmpty = 2, kOnlyOccupied = 4;

struct RegionMass {
  unsigned regions;
  double mass;
};

unsigned existing_regions(GridModel model) {
  return model == GridModel::kFree ? kOverlap | kOnlyEmpty | kOnlyOccupied : kOnlyEmpty | kOnlyOccupied;
}

unsigned regions_of(GridElement element, GridModel model) {
  switch (element) {
    case GridElement::kEmpty: return (kOverlap | kOnlyEmpty) & existing_regions(model);
    case GridElement::kOccupied: return (kOverlap | kOnlyOccupied) & existing_regions(model);
    case GridElement::kConflict: return kOverlap & existing_regions(model);
    case GridElement::kUnknown: break;
  }
  return existing_regions(model);
}

std::array<RegionMass, 4> focals(const GridMass& mass, GridModel model) {
  return {{{regions_of(GridElement::kEmpty, model), mass.empty},
           {regions_of(GridElement::kOccupied, model), mass.occupied},
           {regions_of(GridElement::kConflict, model), mass.conflict},
           {regions_of(GridElement::kUnknown, model), mass.unknown}}};
}

GridMass divided(const GridMass& mass, GridModel model) {
  if (model == GridModel::kFree) return mass;
  const std::optional<GridMass> rest = without_conflict(mass);
  if (!rest) throw std::domain_error("total conflict: there is no mass left to make a probability of");
  return *rest;
}

}  // namespace

GridMass GridMass::from(double empty, double occupied, double conflict) {
  const double sum = empty + occupied + conflict;
  if (!(empty >= 0.0 && occupied >= 0.0 && conflict >= 0.0 && sum <= 1.0 + kMassTolerance)) {
    std::ostringstream message;
    message << "not a mass: empty = " << empty << ", occupied = " << occupied << ", conflict = " << conflict
            << "; all must be >= 0 and sum to at most 1";
    throw std::invalid_argument(message.str());
  }
  if (sum > 1.0) return {empty / sum, occupied / sum, conflict / sum, 0.0};
  return {empty, occupied, conflict, 1.0 - sum};
}

GridMass dsmc(const GridMass& a, const GridMass& b) {
  return {.empty = a.empty * (b.empty + b.unknown) + a.unknown * b.empty,
          .occupied = a.occupied * (b.occupied + b.unknown) + a.unknown * b.occupied,
          .conflict = a.conflict * (b.empty + b.occupied + b.conflict + b.unknown) +
                      (a.empty + a.occupied + a.unknown) * b.conflict + a.empty * b.occupied + a.occupied * b.empty,
          .unknown = a.unknown * b.unknown};
}

GridMass dsmc(std::span<const GridMass> sources) {
  GridMass result = GridMass::vacuous();
  for (const GridMass& source : sources) result = dsmc(result, source);
  return result;
}

std::optional<GridMass> without_conflict(const GridMass& mass) {
  const double kept = mass.empty + mass.occupied + mass.unknown;
  if (!(kept > 0.0)) return std::nullopt;
  return GridMass{mass.empty / kept, mass.occupied / kept, 0.0, mass.unknown / kept};
}

double belief(const GridMass& mass, GridElement element, GridModel model) {
  const unsigned wanted = regions_of(element, model);
  double sum = 0.0;
  for (const RegionMass& focal : focals(mass, model)) {
    if (focal.regions != 0 && (focal.regions & ~wanted) == 0) sum += focal.mass;
  }
  return sum;
}

double plausibility(const GridMass& mass, GridElement element, GridModel model) {
  const unsigned wanted = regions_of(element, model);
  double sum = 0.0;
  for (const RegionMass& focal : focals(mass, model)) {
    if ((focal.regions & wanted) != 0) sum += focal.mass;
  }
  return sum;
}

double commonality(const GridMass& mass, GridElement element, GridModel model) {
  const unsigned wanted = regions_of(element, model);
  double sum = 0.0;
  for (const RegionMass& focal : focals(mass, model)) {
    if ((wanted & ~focal.regions) == 0) sum += focal.mass;
  }
  return sum;
}

double pignistic(const GridMass& mass, GridElement element, GridModel model) {
  const unsigned wanted = regions_of(element, model);
  double sum = 0.0;
  for (const RegionMass& focal : focals(divided(mass, model), model)) {
    if (focal.regions == 0) continue;
    sum += focal.mass * std::popcount(focal.regions & wanted) / std::popcount(focal.regions);
  }
  return sum;
}

double dsmp(const GridMass& mass, GridElement element, GridModel model, double epsilon) {
  if (!(epsilon >= 0.0) || std::isinf(epsilon)) {
    throw std::invalid_argument("the epsilon of DSmP must be finite and >= 0; got " + std::to_string(epsilon));
  }
  const double unit = std::max(1.0, epsilon);  // in which no sum overflows
  const unsigned wanted = regions_of(element, model);
  const std::array<RegionMass, 4> all = focals(divided(mass, model), model);
  const auto weight = [&](unsigned regions) {  // of the single regions inside, plus epsilon each
    double sum = epsilon / unit * std::popcount(regions);
    for (const RegionMass& focal : all) {
      if (std::popcount(focal.regions) == 1 && (focal.regions & ~regions) == 0) sum += focal.mass / unit;
    }
    return sum;
  };
  double sum = 0.0;
  for (const RegionMass& focal : all) {
    if (focal.regions == 0) continue;
    const double whole = weight(focal.regions);
    const unsigned common = focal.regions & wanted;
    sum += focal.mass * (whole > 0.0 ? weight(common) / whole
                                     : static_cast<double>(std::popcount(common)) / std::popcount(focal.regions));
  }
  return sum;
}

std::ostream& operator<<(std::ostream& out, const GridMass& mass) {
  return out << "{empty " << mass.empty << ", occupied " << mass.occupied << ", conflict " << mass.conflict
             << ", unknown " << mass.unknown << '}';
}

}  // namespace credo::evidence
