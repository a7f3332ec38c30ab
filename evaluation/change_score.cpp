// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/change_score.hpp"

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "evaluation/true_cells.hpp"
#include "evidence/log_commonality.hpp"
#include "mapping/sequential_mapper.hpp"

namespace credo::evaluation {
namespace {

using evidence::GridMass;
using grids::CellBox;
using grids::CellIndex;
using State = TrueCells::State;

/// The map that no order changes as a fold, to be looked at in between.
struct SumFold {
  using Cell = evidence::FixedLogCommonality;
  static constexpr bool kForgets = false;

  [[nodiscard]] bool update(Cell& cell, const GridMass& reading, sensors::Timestamp = 0) const {
    cell += evidence::fixed_increment(reading, 1.0);
    return true;
  }
  [[nodiscard]] GridMass masses(const Cell& cell) const { return evidence::normalised_masses(cell.value()); }
};

/// A rule that counts the sweeps in which a cell was seen.
template <mapping::CellRule Rule>
struct Counted {
  struct Cell {
    typename Rule::Cell of_rule{};
    int sweeps = 0;
  };
  static constexpr bool kForgets = Rule::kForgets;
  Rule rule;

  [[nodiscard]] bool update(Cell& cell, const GridMass& reading, sensors::Timestamp time) const {
    ++cell.sweeps;
    return rule.update(cell.of_rule, reading, time);
  }
  [[nodiscard]] GridMass masses(const Cell& cell) const { return rule.masses(cell.of_rule); }
};

/// A cell that changed, and how often it had been seen by then.
struct Watched {
  CellIndex cell;
  int seen_before = 0;
  int next_look = 3;
};

template <mapping::CellRule Rule>
class Follower {
 public:
  Follower(const sensors::Rig& rig, const mapping::MapperParams& params, const Rule& rule,
           std::span<const datasets::TruthState> states)
      : rule_{rule}, mapper_(rig, params, rule_), states_(states) {
    for (const datasets::TruthState& state : states)
      truths_.emplace_back(state.map, params.georeference, box_of(state.map, params.georeference));
  }

  void take_in(const evidence::Believed<geometry::PoseEstimate>& pose, const sensors::RangeScan& scan,
               const sensors::MotionPath& path) {
    while (now_ + 1 < states_.size() && states_[now_ + 1].since <= scan.time) change();
    mapper_.insert(pose, scan, path);
    std::erase_if(watched_, [&](Watched& watched) { return look_at(watched); });
  }

  [[nodiscard]] ChangeScore score() {
    for_each_cell(truths_.front().box(), [&](CellIndex cell) {
      const auto* seen = mapper_.grid().find(cell);
      if (seen == nullptr || seen->sweeps < 5 || !always_the_same(cell)) return;
      const State real = truths_.back().at(cell);
      if (real == State::kUnknown ||
          (real == State::kOccupied && !truths_.back().near(cell, State::kEmpty, kWallTolerance)))
        return;
      ++score_.unchanged;
      score_.wrong += is_right(cell) ? 0 : 1;
      if constexpr (std::is_same_v<Rule, mapping::ChangingFold>)
        score_.said_changed += seen->of_rule.changes > 0 ? 1 : 0;
    });
    return score_;
  }

 private:
  void change() {
    const TrueCells &before = truths_[now_], &after = truths_[now_ + 1];
    ++now_;
    for_each_cell(after.box(), [&](CellIndex cell) {
      const State was = before.at(cell), is = after.at(cell);
      if (was == is) return;
      std::erase_if(watched_, [&](const Watched& other) { return other.cell == cell; });
      const auto* seen = mapper_.grid().find(cell);
      if (was != State::kUnknown && is != State::kUnknown)
        watched_.push_back({cell, seen == nullptr ? 0 : seen->sweeps});
    });
  }

  /// True where it need not be looked at any more.
  bool look_at(Watched& watched) {
    const auto* seen = mapper_.grid().find(watched.cell);
    if (seen == nullptr || seen->sweeps - watched.seen_before < watched.next_look) return false;
    const bool third = watched.next_look == 3;
    ++(third ? score_.changed_3 : score_.changed_5);
    (third ? score_.right_3 : score_.right_5) += is_right(watched.cell) ? 1 : 0;
    watched.next_look = 5;
    return !third;
  }

  [[nodiscard]] State said(CellIndex cell) const {
    const auto* seen = mapper_.grid().find(cell);
    if (seen == nullptr) return State::kUnknown;
    const GridMass mass = rule_.masses(*seen);
    if (mass.occupied == mass.empty) return State::kUnknown;
    return mass.occupied > mass.empty ? State::kOccupied : State::kEmpty;
  }

  [[nodiscard]] bool is_right(CellIndex cell) const {
    const TrueCells& truth = truths_[now_];
    switch (said(cell)) {
      case State::kOccupied: return truth.near(cell, State::kOccupied, kWallTolerance);
      case State::kEmpty: break;
      case State::kUnknown: return false;
    }
    if (truth.at(cell) == State::kEmpty) return true;
    return any_within(cell, kWallTolerance, [&](CellIndex other) { return said(other) == State::kOccupied; });
  }

  [[nodiscard]] bool always_the_same(CellIndex cell) const {
    return std::all_of(truths_.begin(), truths_.end(),
                       [&](const TrueCells& truth) { return truth.at(cell) == truths_.front().at(cell); });
  }

  Counted<Rule> rule_;
  mapping::SequentialMapper<Counted<Rule>> mapper_;
  std::span<const datasets::TruthState> states_;
  std::vector<TrueCells> truths_;
  std::size_t now_ = 0;
  std::vector<Watched> watched_;
  ChangeScore score_;
};

}  // namespace

ChangeScore change_score(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                         std::span<const sensors::RangeScan> scans, std::span<const datasets::TruthState> states,
                         const mapping::TrajectoryMappingParams& params, const mapping::MapRule& rule,
                         const std::function<void(double share)>& progress) {
  if (states.empty()) throw std::invalid_argument("no state of the world is given to compare the map with");
  if (T_map_base.empty()) throw std::invalid_argument("the trajectory has no pose: nothing can be mapped along it");
  const auto follow = [&](const auto& chosen) {
    Follower follower(rig, params.mapper, chosen, states);
    std::size_t done = 0;
    for (const sensors::RangeScan& scan : scans) {
      if (progress) progress(static_cast<double>(++done) / static_cast<double>(scans.size()));
      if (!mapping::covers(T_map_base, scan.time, params.max_gap_s)) continue;
      follower.take_in({{T_map_base.pose_at(scan.time), params.covariance}, params.belief}, scan, T_map_base);
    }
    return follower.score();
  };
  return std::visit(
      [&](const auto& chosen) {
        if constexpr (std::is_same_v<std::decay_t<decltype(chosen)>, grids::ReadOut>)
          return follow(SumFold{});  // its read-outs decide alike
        else
          return follow(chosen);
      },
      rule);
}

}  // namespace credo::evaluation
