// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>

namespace credo::tracking {

/// A value to come, from a straight line through the last ones.
struct Extrapolated {
  double value = 0.0;
  double variance = 0.0;  ///< of the line at that step; what the line does not model is not in it
  int from = 0;           ///< number of values that were used
};

/// The last few values of a quantity by step; values in which a gap lies are welcome.
class History {
 public:
  static constexpr int kCapacity = 8;

  /// Forgets the oldest when full. `step` grows.
  void add(int step, double value, double sigma);
  /// An angle, unwrapped: added as the one of value + k period that is nearest to the value before.
  void add_angle(int step, double value, double sigma, double period);

  /// Adds the same to all values: what is followed has changed, how it changes has not.
  void shift(double offset);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int last_step() const { return entries_[size_ - 1].step; }
  [[nodiscard]] double last() const { return entries_[size_ - 1].value; }

  /// Least-squares line over the last `count` values, at `step`: over three values in a row (4 a_3 + a_2 - 2 a_1) / 3
  /// (Clerentin et al., sec. 4.1). One value alone is repeated. Precondition: size() > 0.
  [[nodiscard]] Extrapolated extrapolate(int count, int step) const;

 private:
  struct Entry {
    int step = 0;
    double value = 0.0;
    double sigma = 0.0;
  };
  std::array<Entry, kCapacity> entries_;
  int size_ = 0;
};

}  // namespace credo::tracking
