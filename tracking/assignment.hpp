// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

namespace credo::tracking {

/// A possible pair; a row that gets no column weighs 0.
struct Candidate {
  int row = 0;
  int column = 0;
  double weight = 0.0;
};

/// Assignment of at most one column to each row and one row to each column, of the largest sum of weights.
/// Rows whose best columns differ are resolved as they stand; what still collides is split into connected components.
/// Small ones are searched, and only what is left goes to the graph library. Keeps its memory.
class Assigner {
 public:
  void reserve(std::size_t rows, std::size_t columns, std::size_t candidates);

  /// \param candidates  each pair at most once; only positive weights can be part of the optimum, the others are
  ///   skipped
  /// \returns the column of each row, -1 for none; valid until the next call. Of equal sums always the same.
  const std::vector<int>& assign(int rows, int columns, std::span<const Candidate> candidates);

 private:
  int root(int node);
  bool settle(std::span<const Candidate> component);
  void search(std::span<const Candidate> rest, double sum, double at_most);

  std::vector<int> column_of_row_, row_of_column_, parent_;
  std::vector<double> best_weight_;
  std::vector<Candidate> offered_;
  std::vector<char> collides_;
  std::vector<char> taken_;               ///< by column, on the way of a search
  std::vector<Candidate> chosen_, best_;  ///< on the way of a search, and of the best one so far
  double best_sum_ = 0.0;
  int steps_left_ = 0;
};

/// The same by successive shortest paths (Boost.Graph) over one component, whatever its form.
/// \param column_of_row  receives the columns of the rows that occur in `candidates`
void assign_by_min_cost_flow(std::span<const Candidate> candidates, std::span<int> column_of_row);

}  // namespace credo::tracking
