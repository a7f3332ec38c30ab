// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/plan_covariance.hpp"

#include <algorithm>
#include <cassert>

namespace credo::localization {

void PlanPart::clear(int errors) {
  assert(errors % 2 == 0);
  index_.assign(static_cast<std::size_t>(errors / 2), -1);
  columns_.reserve(index_.size());
  columns_.clear();
}

void PlanPart::add(int column, const PoseState::Pair& derivative) {
  assert(column % 2 == 0 && column / 2 < static_cast<int>(index_.size()));
  int& index = index_[static_cast<std::size_t>(column / 2)];
  if (index < 0) {
    index = static_cast<int>(columns_.size());
    columns_.push_back({column, PoseState::Pair::Zero()});
  }
  columns_[static_cast<std::size_t>(index)].derivative += derivative;
}

PoseState::Matrix PlanPart::covariance() const {
  PoseState::Matrix sum = PoseState::Matrix::Zero();
  for (const Column& column : columns_) sum.noalias() += column.derivative * column.derivative.transpose();
  return sum;
}

PlanCovariance::PlanCovariance(int errors)
    : slots_(static_cast<std::size_t>(errors / 2), -1),
      blocks_(static_cast<std::size_t>((errors + kLanes - 1) / kLanes), Block::Zero()) {
  assert(errors % 2 == 0);
}

PlanCovariance& PlanCovariance::operator=(const PlanCovariance& other) {
  if (this == &other) return *this;
  slots_ = other.slots_;
  used_ = other.used_;
  blocks_.resize(other.blocks_.size());
  std::copy_n(other.blocks_.begin(), other.used_blocks(), blocks_.begin());
  return *this;
}

PoseState::Pair PlanCovariance::operator[](int column) const {
  assert(column % 2 == 0 && column < errors());
  const int slot = slots_[static_cast<std::size_t>(column / 2)];
  if (slot < 0) return PoseState::Pair::Zero();
  return blocks_[static_cast<std::size_t>(2 * slot / kLanes)].middleRows<2>(2 * slot % kLanes).transpose();
}

PlanCovariance& PlanCovariance::operator-=(const PlanPart& part) {
  for (const auto& [first, derivative] : part.columns()) {
    int& slot = slots_[static_cast<std::size_t>(first / 2)];
    const bool is_new = slot < 0;
    if (is_new) slot = used_++;
    auto rows = blocks_[static_cast<std::size_t>(2 * slot / kLanes)].middleRows<2>(2 * slot % kLanes);
    if (is_new) rows.setZero();
    rows -= derivative.transpose();
  }
  return *this;
}

void PlanCovariance::transform(const PoseState::Matrix& A) {
  const PoseState::Matrix transposed = A.transpose();
  for (std::size_t i = 0; i < used_blocks(); ++i) blocks_[i] = (blocks_[i].lazyProduct(transposed)).eval();
}

}  // namespace credo::localization
