// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/assignment.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace credo::tracking {

int Assigner::root(int node) {
  while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
  return node;
}

// One row, or one column: the heaviest pair; of equals the lowest row and column.
bool Assigner::settle(std::span<const Candidate> component) {
  const auto same_column = [&](const Candidate& c) { return c.column == component.front().column; };
  if (!std::ranges::all_of(component, same_column)) return false;  // one row cannot collide
  const Candidate* heaviest = &component.front();
  for (const Candidate& c : component) {
    if (c.weight > heaviest->weight || (c.weight == heaviest->weight && c.row < heaviest->row)) heaviest = &c;
  }
  for (const Candidate& c : component) column_of_row_[c.row] = -1;
  column_of_row_[heaviest->row] = heaviest->column;
  return true;
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

  std::erase_if(offered_, [&](const Candidate& c) { return !collides_[root(c.row)]; });
  std::ranges::sort(offered_, [&](const Candidate& a, const Candidate& b) {
    const int in_a = root(a.row), in_b = root(b.row);
    return in_a != in_b ? in_a < in_b : a.row != b.row ? a.row < b.row : a.column < b.column;
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
