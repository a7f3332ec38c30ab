// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <vector>

#include "evaluation/reproduction.hpp"

// A method over its free parameters, when a paper does not say which it took.
namespace credo::evaluation {

/// Errors (wrong cells, say) by setting and random seed.
using SweptErrors = std::vector<std::vector<double>>;

/// \throws std::invalid_argument without values
[[nodiscard]] double median_of(std::vector<double> values);

/// By which shares a method errs less than another, of all settings and seeds where the other errs.
[[nodiscard]] std::vector<double> reductions(const SweptErrors& other, const SweptErrors& method);

/// What a method comes to at its own best.
struct OwnBest {
  Spread error;                       ///< over the seeds; of none with one seed
  std::vector<std::size_t> settings;  ///< that were chosen, each once
};

/// For each seed the setting that errs least over the other seeds, and its error on this one: so that none is chosen by
/// what it is judged by. With one seed there is nothing to choose by.
[[nodiscard]] OwnBest best_on_other_seeds(const SweptErrors& errors);

}  // namespace credo::evaluation
