// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/changing_fold.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "evidence/grid_rules.hpp"

namespace credo::mapping {
namespace {

using evidence::GridMass;

constexpr double kMostCertain = 0.999;  // so that ageing and contradiction always have something to act on

/// Contextual discounting of a normal mass on two elements: each loses to ignorance at its own rate.
GridMass aged(const GridMass& mass, double empty_kept, double occupied_kept) {
  const double empty = mass.empty * empty_kept, occupied = mass.occupied * occupied_kept;
  return {.empty = empty, .occupied = occupied, .conflict = 0.0, .unknown = 1.0 - empty - occupied};
}

GridMass with_dempster(const GridMass& a, const GridMass& b) {
  const auto fused = evidence::without_conflict(evidence::dsmc(a, b));
  return fused ? evidence::discount(*fused, kMostCertain) : a;
}

double belief_in(const GridMass& mass, bool occupied) { return occupied ? mass.occupied : mass.empty; }

}  // namespace

bool ChangingFold::update(Cell& cell, const GridMass& reading, sensors::Timestamp time) const {
  if (cell.seen != 0 && time > cell.seen) {
    const double passed_s = sensors::seconds_between(cell.seen, time);
    cell.mass =
        aged(cell.mass, std::pow(params.empty_kept_per_s, passed_s), std::pow(params.occupied_kept_per_s, passed_s));
  }
  cell.seen = time;
  const bool occupied = cell.mass.occupied > cell.mass.empty;  // the state, where it is in one
  if (cell.settled && belief_in(cell.mass, occupied) < params.settled_at && !cell.open) cell.settled = false;
  if (!cell.settled) {
    cell.mass = evidence::discount(evidence::dsmh(std::array{cell.mass, reading}).mass, kMostCertain);
    cell.settled = std::max(cell.mass.occupied, cell.mass.empty) >= params.settled_at;
    if (cell.settled) cell.since = time;
    return true;
  }
  const bool contradicts = belief_in(reading, !occupied) > belief_in(reading, occupied);
  if (!cell.open && !contradicts) {
    cell.mass = with_dempster(cell.mass, reading);
    return true;
  }
  if (!cell.open) {
    cell.open = true;
    cell.contradicted = time;
    cell.account = GridMass::vacuous();
  }
  cell.account = with_dempster(cell.account, reading);
  if (belief_in(cell.account, !occupied) >= params.changed_at) {
    cell.mass = cell.account;
    cell.since = cell.contradicted;
    cell.open = false;
    ++cell.changes;
  } else if (belief_in(cell.account, occupied) >= params.settles_until) {
    cell.open = false;
  }
  return true;
}

std::optional<sensors::Timestamp> since_when(const ChangingFold::Cell& cell) {
  return cell.settled ? std::optional(cell.since) : std::nullopt;
}

double changing(const ChangingFold::Cell& cell) {
  if (!cell.settled || !cell.open) return 0.0;
  const bool occupied = cell.mass.occupied > cell.mass.empty;
  return belief_in(cell.mass, occupied) * belief_in(cell.account, !occupied);
}

}  // namespace credo::mapping
