// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdlib>

namespace credo::test {

/// RapidCheck draws the same cases in every run of a program that includes this, unless RC_PARAMS asks for others.
inline const bool kSeeded = setenv("RC_PARAMS", "seed=20040607", 0) == 0;

}  // namespace credo::test
