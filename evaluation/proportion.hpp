// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <optional>

#include "evaluation/consistency.hpp"

namespace credo::evaluation {

/// How many of how many, with what that says of the probability behind it (Clopper and Pearson, 1934), as if the
/// trials were independent; acquisitions of one drive are not, and deserve a wider interval.
struct Proportion {
  std::size_t count = 0;
  std::size_t of = 0;

  /// Counts one more.
  void add(bool yes) {
    ++of;
    count += yes ? 1 : 0;
  }
  /// Nothing where there is nothing to take a share of.
  [[nodiscard]] std::optional<double> share() const;
  /// Two-sided, at 95 %; 0 to 1 without trials.
  [[nodiscard]] Bounds interval() const;
  /// One-sided, at 95 %: what the probability is at most. With a count of 0 about 3 / of, the "rule of three".
  [[nodiscard]] double upper_bound() const;
};

}  // namespace credo::evaluation
