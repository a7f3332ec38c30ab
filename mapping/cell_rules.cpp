// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/cell_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "evidence/grid_rules.hpp"

namespace credo::mapping {

using evidence::GridMass;

bool DsmcFold::update(Cell& cell, const GridMass& reading, sensors::Timestamp /*time*/) const {
  cell = evidence::dsmc(cell, reading);
  return true;
}

bool DempsterFold::update(Cell& cell, const GridMass& reading, sensors::Timestamp /*time*/) const {
  const auto fused = evidence::without_conflict(evidence::dsmc(cell, reading));
  if (fused) cell = *fused;
  return fused.has_value();
}

bool DempsterFloatFold::update(Cell& cell, const GridMass& reading, sensors::Timestamp /*time*/) const {
  constexpr double kMost = evidence::FixedLogCommonality::kMaxReliability, kAll = 1.0 - 0x1p-53;
  const double known = 1.0 - reading.unknown;
  cell += evidence::log_commonality(reading, known > kMost ? kMost / known : kAll).as<float>();
  return true;
}

GridMass DempsterFloatFold::masses(const Cell& cell) const { return evidence::normalised_masses(cell.as<double>()); }

bool Pcr2Fold::update(Cell& cell, const GridMass& reading, sensors::Timestamp /*time*/) const {
  cell = evidence::pcr2(std::array{cell, reading}).mass;
  return true;
}

bool Pcr5Fold::update(Cell& cell, const GridMass& reading, sensors::Timestamp /*time*/) const {
  cell = evidence::pcr5(cell, reading).mass;
  return true;
}

bool DsmhFold::update(Cell& cell, const GridMass& reading, sensors::Timestamp /*time*/) const {
  cell = evidence::dsmh(std::array{cell, reading}).mass;
  return true;
}

bool BayesFold::update(Cell& cell, const GridMass& reading, sensors::Timestamp /*time*/) const {
  const auto mass = evidence::without_conflict(reading);
  if (!mass) return false;
  const double occupied = std::clamp(mass->occupied + 0.5 * mass->unknown, certain_at, 1.0 - certain_at);
  cell += std::log(occupied / (1.0 - occupied));
  return true;
}

GridMass BayesFold::masses(const Cell& cell) const {
  const double occupied = 1.0 / (1.0 + std::exp(-cell));
  return {.empty = 1.0 - occupied, .occupied = occupied, .conflict = 0.0, .unknown = 0.0};
}

GridMass approximated(const GridMass& reading, int found_empty, int found_full, const ApproximationParams& params) {
  const double rho = reading.empty, full = reading.occupied;
  if (!(rho > 0.0 || full > 0.0)) return GridMass::vacuous();
  const bool empty = rho > full;
  // Exponents of eqs. (8), (9), at least 1: how often anything was found, over how often this.
  const auto exponent = [&] {
    const double all = 1.0 + found_empty + found_full;
    switch (params.approximation) {
      case Approximation::kFixed: break;
      case Approximation::kAdaptive: return all / ((empty ? found_full : found_empty) + 1.0);
      case Approximation::kFaceValue: return all / ((empty ? found_empty : found_full) + 1.0);
    }
    return 1.0;
  }();
  const double most = 0.25 * (empty ? rho : full);
  const auto small = [&](double e) { return std::min(std::pow(e, exponent), most); };
  if (empty)  // eq. (8)
    return {.empty = rho - small(params.e1) - small(params.e2),
            .occupied = small(params.e2),
            .conflict = 0.0,
            .unknown = 1.0 - rho + small(params.e1)};
  return {.empty = small(params.e2),  // eq. (9)
          .occupied = full - small(params.e2) - small(params.e3),
          .conflict = 0.0,
          .unknown = 1.0 - full + small(params.e3)};
}

bool ApproximatedDempsterFold::update(Cell& cell, const GridMass& reading, sensors::Timestamp /*time*/) const {
  if (reading.empty == reading.occupied) return true;  // neither region
  ++(reading.empty > reading.occupied ? cell.found_empty : cell.found_full);
  return DempsterFold{}.update(cell.mass, approximated(reading, cell.found_empty, cell.found_full, params));
}

ZhuState decide_zhu(const GridMass& mass, const ZhuDecisionParams& params) {
  const bool occupied = mass.occupied > mass.empty;
  const double first = std::max(mass.occupied, mass.empty), second = std::min(mass.occupied, mass.empty);
  if (!(first - second > params.least_margin && mass.unknown < params.most_ignorance && first > mass.unknown))
    return ZhuState::kUnknown;
  return occupied ? ZhuState::kOccupied : ZhuState::kEmpty;
}

}  // namespace credo::mapping
