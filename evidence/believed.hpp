// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// A value with the belief in it.
template <typename T>
struct Believed {
  T value;
  BinaryMass belief;

  friend bool operator==(const Believed&, const Believed&) = default;
};

}  // namespace credo::evidence
