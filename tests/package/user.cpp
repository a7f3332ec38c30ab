// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <iostream>

#include "evidence/binary_mass.hpp"

int main() {
  using credo::evidence::BinaryMass;
  std::cout << credo::evidence::conflict_to_ignorance({BinaryMass::from(0.6, 0.1), BinaryMass::from(0.5, 0.3)}).mass;
}
