// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <optional>

#include "mapping/cell_rules.hpp"

namespace credo::mapping {

struct ChangingParams {
  /// How much of the evidence is left after a second: contextual discounting (Mercier, Quost and Denoeux 2008), as what
  /// is empty becomes occupied at another rate than the reverse. By default half is left after ten minutes of "empty",
  /// and after an hour of "occupied": walls stay.
  double empty_kept_per_s = 0.99885;
  double occupied_kept_per_s = 0.99981;
  double settled_at = 0.9;   ///< belief from which a cell is in a state that readings can contradict
  double changed_at = 0.97;  ///< belief in the opposite, of all readings since the first contradiction, from which the
                             ///< cell has changed: two readings of a laser that agree
  double settles_until = 0.5;  ///< belief in the state, of the same readings, from which the contradiction was noise
  /// A time without readings that leaves less than this share of what an account holds against the state ends it, as
  /// what comes then is another matter. A share, so that weak readings add up as strong ones do.
  double account_kept = 0.5;
  /// Readings that agree with it after which a change counts as one. A cell that goes back before has not changed, and
  /// is what it was since then: at the edges of things some readings in a row are wrong.
  int confirmed_after = 5;
};

/// A cell of a world that changes: DSm hybrid rule over time. "Empty and occupied" is nothing at one moment, so what a
/// reading contradicts goes to ignorance as long as the cell is in no state; but a cell can have been empty and be
/// occupied. So the first reading that contradicts a settled cell begins a second account, of the readings from then
/// on: if they agree on the opposite, the cell has changed, at the time of that first reading; if they come back to
/// what the cell was, it was noise. What is follows at once; that it changed counts once the new state has lasted.
/// Both age: what was long ago is held against nothing. A cell that was forgotten and
/// is found in the other state has changed, too, since it was found.
struct ChangingFold {
  /// Forgets by itself: of a robot at rest each reading counts in full.
  static constexpr bool kForgets = true;

  enum class State : std::uint8_t { kNone, kEmpty, kOccupied };
  struct Cell {
    evidence::GridMass mass;              ///< what is
    evidence::GridMass account;           ///< of the readings since `contradicted`
    sensors::Timestamp seen = 0;          ///< latest reading
    sensors::Timestamp since = 0;         ///< settled in its state from then on
    sensors::Timestamp contradicted = 0;  ///< first reading of the account
    sensors::Timestamp since_before = 0;  ///< in the state before, if the change is not confirmed
    std::int32_t changes = 0;             ///< that are confirmed
    std::int32_t unconfirmed = 0;         ///< readings that are still asked for; 0: the latest change is confirmed
    State state = State::kNone;           ///< the latest that it was settled in
    bool was_seen = false;
    bool settled = false;  ///< it is in its state now
    bool open = false;     ///< an account is open
  };
  ChangingParams params;

  [[nodiscard]] bool update(Cell& cell, const evidence::GridMass& reading, sensors::Timestamp time) const;
  [[nodiscard]] evidence::GridMass masses(const Cell& cell) const { return cell.mass; }

 private:
  void age(Cell& cell, sensors::Timestamp time) const;
  void settle(Cell& cell, const evidence::GridMass& reading, sensors::Timestamp time) const;
  void turn(Cell& cell, sensors::Timestamp since) const;
  void keep_account(Cell& cell, const evidence::GridMass& reading, sensors::Timestamp time) const;
};
static_assert(CellRule<ChangingFold>);

/// Since when a cell is what it is; nothing where it is in no state. A cell that never changed: since it was settled.
[[nodiscard]] std::optional<sensors::Timestamp> since_when(const ChangingFold::Cell& cell);

/// Mass of "it was the one and is the other": what the account holds against the state.
[[nodiscard]] double changing(const ChangingFold::Cell& cell);

}  // namespace credo::mapping
