// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cstdlib>

namespace {

// RapidCheck draws the same 10 000 cases for every law in every run, unless RC_PARAMS asks for others.
const bool seeded = setenv("RC_PARAMS", "seed=20040607 max_success=10000", 0) == 0;

TEST(RandomMasses, AreTheSameInEveryRun) { EXPECT_TRUE(seeded); }

}  // namespace
