// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/assignment.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <tuple>

namespace credo::tracking {
namespace {

constexpr int kMostSteps = 2000;  // of a search; beyond, the graph library is faster

}  // namespace

void Assigner::reserve(std::size_t rows, std::size_t columns, std::size_t candidates) {
  column_of_row_.reserve(rows);
  best_weight_.reserve(rows);
  chosen_.reserve(rows);
  best_.reserve(rows);
  row_of_column_.reserve(columns);
  taken_.reserve(columns);
  parent_.reserve(rows + columns);
  collides_.reserve(rows + columns);
  offered_.reserve(candidates);
}

int Assigner::root(int node) {
  while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
  return node;
}

// Branch and bound, as far as that is quick. `component` is by row, heaviest first; of equals the first found.
bool Assigner::settle(std::span<const Candidate> component) {
  double at_most = 0.0;
  for (std::size_t i = 0; i < component.size(); ++i)
    if (i == 0 || component[i].row != component[i - 1].row) at_most += component[i].weight;
  best_sum_ = 0.0;
  chosen_.clear();
  best_.clear();
  steps_left_ = kMostSteps;
  search(component, 0.0, at_most);
  if (steps_left_ == 0) return false;
  for (const Candidate& c : component) column_of_row_[c.row] = -1;
  for (const Candidate& c : best_) column_of_row_[c.row] = c.column;
  return true;
}

// The first row of `rest` with every column that is free, and with none; then the rows behind it.
// at_most: what all of `rest` can add.
void Assigner::search(std::span<const Candidate> rest, double sum, double at_most) {
  if (steps_left_ == 0) return;
  --steps_left_;
  if (sum > best_sum_) {
    best_sum_ = sum;
    best_ = chosen_;
  }
  if (rest.empty() || sum + at_most <= best_sum_) return;
  const auto other_row = [row = rest.front().row](const Candidate& c) { return c.row != row; };
  const auto row = rest.first(static_cast<std::size_t>(std::ranges::find_if(rest, other_row) - rest.begin()));
  const auto behind = rest.subspan(row.size());
  for (const Candidate& c : row) {
    if (taken_[c.column]) continue;
    taken_[c.column] = 1;
    chosen_.push_back(c);
    search(behind, sum + c.weight, at_most - row.front().weight);
    chosen_.pop_back();
    taken_[c.column] = 0;
  }
  search(behind, sum, at_most - row.front().weight);
}

const std::vector<int>& Assigner::assign(int rows, int columns, std::span<const Candidate> candidates) {
  column_of_row_.assign(rows, -1);
  row_of_column_.assign(columns, -1);
  best_weight_.assign(rows, 0.0);
  offered_.clear();
  for (const Candidate& c : candidates) {
    assert(c.row >= 0 && c.row < rows && c.column >= 0 && c.column < columns);
    if (!(c.weight > 0.0)) continue;
    offered_.push_back(c);
    if (c.weight > best_weight_[c.row]) {
      best_weight_[c.row] = c.weight;
      column_of_row_[c.row] = c.column;
    }
  }
  // Where every row of a component has its best column to itself, nothing can be better.
  parent_.resize(rows + columns);
  std::iota(parent_.begin(), parent_.end(), 0);
  for (const Candidate& c : offered_) parent_[root(c.row)] = root(rows + c.column);
  collides_.assign(rows + columns, 0);
  bool any = false;
  for (int row = 0; row < rows; ++row) {
    const int column = column_of_row_[row];
    if (column < 0) continue;
    if (row_of_column_[column] >= 0) collides_[root(row)] = 1, any = true;
    row_of_column_[column] = row;
  }
  if (!any) return column_of_row_;

  taken_.assign(columns, 0);
  std::erase_if(offered_, [&](const Candidate& c) { return !collides_[root(c.row)]; });
  std::ranges::sort(offered_, [&](const Candidate& a, const Candidate& b) {
    const int in_a = root(a.row), in_b = root(b.row);
    return std::tuple(in_a, a.row, -a.weight, a.column) < std::tuple(in_b, b.row, -b.weight, b.column);
  });
  for (auto first = offered_.begin(); first != offered_.end();) {
    const int component = root(first->row);
    const auto last = std::find_if(first, offered_.end(), [&](const Candidate& c) { return root(c.row) != component; });
    if (!settle({first, last})) assign_by_min_cost_flow({first, last}, column_of_row_);
    first = last;
  }
  return column_of_row_;
}

}  // namespace credo::tracking
