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

/// Nothing where they contradict each other in everything.
std::optional<GridMass> with_dempster(const GridMass& a, const GridMass& b) {
  const auto fused = evidence::without_conflict(evidence::dsmc(a, b));
  return fused ? std::optional(evidence::discount(*fused, kMostCertain)) : std::nullopt;
}

using State = ChangingFold::State;

double belief_in(const GridMass& mass, State state) { return state == State::kOccupied ? mass.occupied : mass.empty; }
State opposite(State state) { return state == State::kOccupied ? State::kEmpty : State::kOccupied; }

}  // namespace

/// What is and what the account holds fade, each kind at its own rate; what has faded too far is dropped.
void ChangingFold::age(Cell& cell, sensors::Timestamp time) const {
  if (cell.was_seen && time > cell.seen) {
    const double passed_s = sensors::seconds_between(cell.seen, time);
    const double empty_kept = std::pow(params.empty_kept_per_s, passed_s);
    const double occupied_kept = std::pow(params.occupied_kept_per_s, passed_s);
    cell.mass = aged(cell.mass, empty_kept, occupied_kept);
    cell.account = aged(cell.account, empty_kept, occupied_kept);
  }
  cell.seen = time;
  cell.was_seen = true;
  if (!cell.settled) return;
  if (cell.open && belief_in(cell.account, opposite(cell.state)) < params.contradicts_above &&
      belief_in(cell.account, cell.state) < params.contradicts_above)
    cell.open = false;
  const double left = belief_in(cell.mass, cell.state);
  if (left >= params.settled_at || (cell.open && left >= params.settles_until)) return;
  if (cell.open) cell.mass = cell.account;  // for want of better: all that is not long ago
  cell.open = cell.settled = false;
}

/// A reading of a cell that is in no state: contradiction goes to ignorance.
bool ChangingFold::settle(Cell& cell, const GridMass& reading, sensors::Timestamp time) const {
  cell.mass = evidence::discount(evidence::dsmh(std::array{cell.mass, reading}).mass, kMostCertain);
  if (std::max(cell.mass.occupied, cell.mass.empty) < params.settled_at) return true;
  const State state = cell.mass.occupied > cell.mass.empty ? State::kOccupied : State::kEmpty;
  if (state != cell.state) {
    cell.changes += cell.state != State::kNone ? 1 : 0;
    cell.since = time;
  }
  cell.state = state;
  cell.settled = true;
  return true;
}

/// A reading of a cell whose state is contradicted, by it or by one before.
bool ChangingFold::keep_account(Cell& cell, const GridMass& reading, sensors::Timestamp time) const {
  const auto account = with_dempster(cell.open ? cell.account : GridMass::vacuous(), reading);
  if (!account) return false;
  if (!cell.open) cell.contradicted = time;
  cell.open = true;
  cell.account = *account;
  if (belief_in(cell.account, opposite(cell.state)) >= params.changed_at) {
    cell.mass = cell.account;
    cell.state = opposite(cell.state);
    cell.since = cell.contradicted;
    cell.open = false;
    ++cell.changes;
  } else if (belief_in(cell.account, cell.state) >= params.settles_until) {  // the readings since confirm it
    cell.mass = with_dempster(cell.mass, cell.account).value_or(cell.mass);
    cell.open = false;
  }
  return true;
}

bool ChangingFold::update(Cell& cell, const GridMass& reading, sensors::Timestamp time) const {
  age(cell, time);
  if (!cell.settled) return settle(cell, reading, time);
  if (cell.open || belief_in(reading, opposite(cell.state)) > belief_in(reading, cell.state))
    return keep_account(cell, reading, time);
  const auto confirmed = with_dempster(cell.mass, reading);
  if (confirmed) cell.mass = *confirmed;
  return confirmed.has_value();
}

std::optional<sensors::Timestamp> since_when(const ChangingFold::Cell& cell) {
  return cell.settled ? std::optional(cell.since) : std::nullopt;
}

double changing(const ChangingFold::Cell& cell) {
  if (!cell.settled || !cell.open) return 0.0;
  return belief_in(cell.mass, cell.state) * belief_in(cell.account, opposite(cell.state));
}

}  // namespace credo::mapping
