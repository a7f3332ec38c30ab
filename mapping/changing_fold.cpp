// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/changing_fold.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

/// Of a mass that holds some ignorance and a reading that is not conflict alone: something is left.
GridMass with_dempster(const GridMass& mass, const GridMass& reading) {
  return evidence::discount(evidence::without_conflict(evidence::dsmc(mass, reading)).value(), kMostCertain);
}

using State = ChangingFold::State;

double belief_in(const GridMass& mass, State state) { return state == State::kOccupied ? mass.occupied : mass.empty; }
State opposite(State state) { return state == State::kOccupied ? State::kEmpty : State::kOccupied; }

}  // namespace

/// What is and what the account holds fade, each kind at its own rate; what has faded too far is dropped.
void ChangingFold::age(Cell& cell, sensors::Timestamp time) const {
  if (!cell.was_seen || time <= cell.seen) return;
  const double passed_s = sensors::seconds_between(cell.seen, time);
  const double empty_kept = std::pow(params.empty_kept_per_s, passed_s);
  const double occupied_kept = std::pow(params.occupied_kept_per_s, passed_s);
  cell.mass = aged(cell.mass, empty_kept, occupied_kept);
  cell.account = aged(cell.account, empty_kept, occupied_kept);
  if (!cell.settled) return;
  if ((cell.state == State::kOccupied ? empty_kept : occupied_kept) < params.account_kept) cell.open = false;
  const double left = belief_in(cell.mass, cell.state);
  if (left >= params.settled_at || (cell.open && left >= params.settles_until)) return;
  if (cell.open) cell.mass = cell.account;  // for want of better: all that is not long ago
  cell.open = cell.settled = false;
}

/// A reading of a cell that is in no state: contradiction goes to ignorance.
void ChangingFold::settle(Cell& cell, const GridMass& reading, sensors::Timestamp time) const {
  cell.mass = evidence::discount(evidence::dsmh(std::array{cell.mass, reading}).mass, kMostCertain);
  if (std::max(cell.mass.occupied, cell.mass.empty) < params.settled_at) return;
  const State state = cell.mass.occupied > cell.mass.empty ? State::kOccupied : State::kEmpty;
  if (cell.state == State::kNone)
    cell.since = time;
  else if (state != cell.state)
    turn(cell, time);
  cell.state = state;
  cell.settled = true;
}

/// From one state to the other: back, if it has not lasted.
void ChangingFold::turn(Cell& cell, sensors::Timestamp since) const {
  if (std::exchange(cell.unconfirmed, 0) > 0) {
    cell.since = cell.since_before;
    return;
  }
  cell.since_before = std::exchange(cell.since, since);
  cell.unconfirmed = params.confirmed_after;
}

/// A reading of a cell whose state is contradicted, by it or by one before.
void ChangingFold::keep_account(Cell& cell, const GridMass& reading, sensors::Timestamp time) const {
  if (!cell.open) {
    cell.open = true;
    cell.contradicted = time;
    cell.account = GridMass::vacuous();
  }
  cell.account = with_dempster(cell.account, reading);
  if (belief_in(cell.account, opposite(cell.state)) >= params.changed_at) {
    cell.mass = cell.account;
    cell.state = opposite(cell.state);
    turn(cell, cell.contradicted);
    cell.open = false;
  } else if (belief_in(cell.account, cell.state) >= params.settles_until) {  // the readings since confirm it
    cell.mass = with_dempster(cell.mass, cell.account);
    cell.open = false;
  }
}

bool ChangingFold::update(Cell& cell, const GridMass& reading, sensors::Timestamp time) const {
  if (!evidence::without_conflict(reading)) return false;
  age(cell, time);
  cell.seen = cell.was_seen ? std::max(cell.seen, time) : time;
  cell.was_seen = true;
  const bool contradicts = belief_in(reading, opposite(cell.state)) > belief_in(reading, cell.state);
  if (cell.settled && !contradicts && cell.unconfirmed > 0 && --cell.unconfirmed == 0) ++cell.changes;
  if (!cell.settled)
    settle(cell, reading, time);
  else if (cell.open || contradicts)
    keep_account(cell, reading, time);
  else
    cell.mass = with_dempster(cell.mass, reading);
  return true;
}

std::optional<sensors::Timestamp> since_when(const ChangingFold::Cell& cell) {
  return cell.settled ? std::optional(cell.since) : std::nullopt;
}

double changing(const ChangingFold::Cell& cell) {
  if (!cell.settled || !cell.open) return 0.0;
  return belief_in(cell.mass, cell.state) * belief_in(cell.account, opposite(cell.state));
}

}  // namespace credo::mapping
