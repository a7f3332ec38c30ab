// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// Who is whom: at most one column for each row, at most one row for each column.
struct Relation {
  std::vector<int> column_of_row;  ///< -1 for none
  /// ln of its plausibility: Π (1 - m(no)) of the pairs that are in it, Π (1 - m(yes)) of those that are not, before
  /// normalisation.
  double log_plausibility = 0.0;
};

/// The relation of largest plausibility, given for each pair the mass that the two are the same (Denoeux, El Zoghby,
/// Cherfaoui and Jouglet 2014). It is the assignment of the largest sum of assignment_weight (open_world.hpp), where
/// leaving a row alone weighs 0; found by shortest augmenting paths (Jonker and Volgenant 1987) in O(rows² (rows +
/// columns)). Of equally plausible ones always the same.
/// \param evidence  rows × columns, row by row
/// \returns nothing at total conflict: every relation contradicts a pair that is certain
/// \throws std::invalid_argument for another size
[[nodiscard]] std::optional<Relation> most_plausible_relation(std::span<const BinaryMass> evidence, std::size_t rows,
                                                              std::size_t columns);

}  // namespace credo::evidence
