// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tracking/extrapolation.hpp"

#include <algorithm>
#include <cmath>

namespace credo::tracking {

void History::add(int step, double value, double sigma) {
  if (size_ == kCapacity) {
    std::move(entries_.begin() + 1, entries_.end(), entries_.begin());
    --size_;
  }
  entries_[size_++] = {step, value, sigma};
}

void History::add_angle(int step, double value, double sigma, double period) {
  const double near = size_ > 0 ? last() + std::remainder(value - last(), period) : value;
  add(step, near, sigma);
}

void History::shift(double offset) {
  for (int i = 0; i < size_; ++i) entries_[i].value += offset;
}

Extrapolated History::extrapolate(int count, int step) const {
  const int n = std::clamp(count, 1, size_);
  const Entry* const first = entries_.data() + size_ - n;
  double mean_step = 0.0, mean_value = 0.0, variance = 0.0;
  for (int i = 0; i < n; ++i) {
    mean_step += first[i].step;
    mean_value += first[i].value;
    variance += first[i].sigma * first[i].sigma;
  }
  mean_step /= n, mean_value /= n, variance /= n;
  double spread = 0.0, moment = 0.0;
  for (int i = 0; i < n; ++i) {
    const double s = first[i].step - mean_step;
    spread += s * s;
    moment += s * (first[i].value - mean_value);
  }
  if (spread == 0.0) return {mean_value, variance / n, n};
  const double ahead = step - mean_step;
  return {mean_value + moment / spread * ahead, variance * (1.0 / n + ahead * ahead / spread), n};
}

}  // namespace credo::tracking
