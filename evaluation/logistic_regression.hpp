// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace credo::evaluation {

struct LogisticParams {
  double ridge = 3.0;  ///< weights are as small as 1/sqrt(this) unless the rows say otherwise
  int most_iterations = 50;
};

/// Logistic regression on sparse rows, with a ridge and no constant: where nothing counts, both states are as likely.
class LogisticRegression {
 public:
  struct Entry {
    std::uint32_t weight;
    float count;
  };
  struct Fit {
    std::vector<double> weights;
    double loss = 0.0;  ///< sum of -ln of the probability of the truth, each row as often as it counts
  };

  /// \throws std::invalid_argument if a parameter is out of its range
  LogisticRegression(std::size_t weights, const LogisticParams& params);

  /// \param entries  of weights below the number of them. \param count  how often the row counts
  void add(std::span<const Entry> entries, bool occupied, double count);
  [[nodiscard]] std::int64_t rows() const { return static_cast<std::int64_t>(rows_.size()); }

  /// The likeliest weights, by Newton's method.
  [[nodiscard]] Fit fit() const;

 private:
  struct Row {
    std::size_t begin = 0, end = 0;  ///< its entries
    bool occupied = false;
    double count = 1.0;
  };

  std::size_t weights_;
  LogisticParams params_;
  std::vector<Row> rows_;
  std::vector<Entry> entries_;
};

}  // namespace credo::evaluation
