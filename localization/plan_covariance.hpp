// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <vector>

#include "localization/pose_state.hpp"

namespace credo::localization {

/// The part that the plan's errors, independent and in their standard deviations, have in a state's error: two columns
/// of derivatives for each place that takes part. Keeps its memory.
class PlanPart {
 public:
  /// Nothing takes part.
  /// \param errors  how many there are
  void clear(int errors);
  /// \param column  the first of a place, even
  void add(int column, const PoseState::Pair& derivative);
  /// Of that part of the state's error.
  [[nodiscard]] PoseState::Matrix covariance() const;

  struct Column {
    int first = 0;
    PoseState::Pair derivative;
  };
  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }

 private:
  std::vector<Column> columns_;
  std::vector<int> index_;  ///< into columns_, by place; -1: takes no part
};

/// Covariance of the state with the plan's errors, in their standard deviations: 9 rows, a column for each error, two
/// for each place. Those of which nothing was seen yet are zero and cost nothing: the others lie together, in the order
/// in which they were seen first.
class PlanCovariance {
 public:
  /// \param errors  columns, an even number
  explicit PlanCovariance(int errors = 0);
  PlanCovariance(const PlanCovariance&) = default;
  PlanCovariance(PlanCovariance&&) = default;
  ~PlanCovariance() = default;
  /// Of as many errors: without taking memory.
  PlanCovariance& operator=(const PlanCovariance& other);
  PlanCovariance& operator=(PlanCovariance&&) = default;

  [[nodiscard]] int errors() const { return 2 * static_cast<int>(slots_.size()); }
  /// \param column  the first of a place, even
  [[nodiscard]] PoseState::Pair operator[](int column) const;
  PlanCovariance& operator-=(const PlanPart& part);
  /// The state x becomes A x.
  void transform(const PoseState::Matrix& A);

 private:
  static constexpr int kLanes = 8;                                ///< errors side by side
  using Block = Eigen::Matrix<double, kLanes, PoseState::kSize>;  ///< transposed

  [[nodiscard]] std::size_t used_blocks() const { return static_cast<std::size_t>((2 * used_ + kLanes - 1) / kLanes); }

  std::vector<int> slots_;  ///< by place: where its columns lie, in places; -1: nowhere, they are zero
  int used_ = 0;            ///< places
  std::vector<Block> blocks_;
};

}  // namespace credo::localization
