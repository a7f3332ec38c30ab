// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/plausible_relation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "evidence/open_world.hpp"

namespace credo::evidence {
namespace {

constexpr double kCertain = 1e7;  // more than all that is not certain: a finite weight is below 1500
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// One column for each row at the least total cost. Column `columns` + r is row r's own: to be left alone, for 0.
class LeastCost {
 public:
  LeastCost(std::span<const BinaryMass> evidence, std::size_t rows, std::size_t columns)
      : evidence_(evidence),
        rows_(rows),
        columns_(columns),
        all_(columns + rows),
        row_price_(rows),
        column_price_(all_),
        row_of_column_(all_, kNone) {}

  std::vector<int> solve() {
    for (std::size_t row = 0; row < rows_; ++row) augment(row);
    std::vector<int> column_of_row(rows_, -1);
    for (std::size_t column = 0; column < columns_; ++column) {
      if (row_of_column_[column] != kNone) column_of_row[row_of_column_[column]] = static_cast<int>(column);
    }
    return column_of_row;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  double cost(std::size_t row, std::size_t column) const {
    if (column >= columns_) return column - columns_ == row ? 0.0 : kInfinity;
    const BinaryMass& pair = evidence_[row * columns_ + column];
    if (pair.yes + pair.unknown <= 0.0) return kInfinity;
    return -std::min(assignment_weight(pair), kCertain);
  }

  // The cheapest path, in reduced costs, from a row without a column to a column without a row; the rows on it change
  // to their next columns.
  void augment(std::size_t start) {
    std::vector<double> distance(all_, kInfinity);
    std::vector<std::size_t> row_before(all_, kNone);
    std::vector<char> done(all_, 0);
    std::size_t row = start, column = kNone;
    double reached = 0.0;
    do {
      std::size_t nearest = kNone;
      for (std::size_t j = 0; j < all_; ++j) {
        if (done[j]) continue;
        const double through = reached + cost(row, j) - row_price_[row] - column_price_[j];
        if (through < distance[j]) {
          distance[j] = through;
          row_before[j] = row;
        }
        if (nearest == kNone || distance[j] < distance[nearest]) nearest = j;
      }
      column = nearest;
      reached = distance[column];
      done[column] = 1;
      row = row_of_column_[column];
    } while (row != kNone);
    reprice(start, distance, done, reached);
    while (column != kNone) {
      const std::size_t before = row_before[column];
      std::size_t previous = kNone;  // the column that this row gives up
      for (std::size_t j = 0; j < all_ && before != start; ++j) {
        if (row_of_column_[j] == before) previous = j;
      }
      row_of_column_[column] = before;
      column = previous;
    }
  }

  void reprice(std::size_t start, const std::vector<double>& distance, const std::vector<char>& done, double reached) {
    row_price_[start] += reached;
    for (std::size_t j = 0; j < all_; ++j) {
      if (!done[j] || row_of_column_[j] == kNone) continue;
      row_price_[row_of_column_[j]] += reached - distance[j];
      column_price_[j] -= reached - distance[j];
    }
  }

  std::span<const BinaryMass> evidence_;
  std::size_t rows_, columns_, all_;
  std::vector<double> row_price_, column_price_;
  std::vector<std::size_t> row_of_column_;
};

}  // namespace

std::optional<Relation> most_plausible_relation(std::span<const BinaryMass> evidence, std::size_t rows,
                                                std::size_t columns) {
  if (evidence.size() != rows * columns) {
    throw std::invalid_argument("the evidence about " + std::to_string(rows) + " rows and " + std::to_string(columns) +
                                " columns has " + std::to_string(rows * columns) + " masses, not " +
                                std::to_string(evidence.size()));
  }
  Relation relation{.column_of_row = LeastCost(evidence, rows, columns).solve()};
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const BinaryMass& pair = evidence[row * columns + column];
      const bool is_in = relation.column_of_row[row] == static_cast<int>(column);
      relation.log_plausibility += std::log((is_in ? pair.yes : pair.no) + pair.unknown);
    }
  }
  if (relation.log_plausibility == -kInfinity) return std::nullopt;
  return relation;
}

}  // namespace credo::evidence
