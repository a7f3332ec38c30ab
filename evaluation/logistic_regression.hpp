// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace credo::evaluation {

/// Is told now and then the share of the work at hand that is done; what it throws ends the work.
using CalibrationProgress = std::function<void(double share)>;

struct LogisticParams {
  double ridge = 3.0;  ///< weights are within 1/sqrt(this) of what they are drawn to unless the rows say otherwise
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

  /// The same rows with weights that are one: what each counts goes to its pool.
  /// \param pools  of each weight, from 0. Precondition: one for each weight
  [[nodiscard]] LogisticRegression pooled(std::span<const std::uint32_t> pools) const;

  /// The likeliest weights, by Newton's method.
  /// \param towards  what the ridge draws each weight to: its value where no row says anything; empty: 0
  [[nodiscard]] Fit fit(std::span<const double> towards = {}) const;

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
