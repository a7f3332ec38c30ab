// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cstdlib>

namespace {

// RapidCheck draws the same cases in every run, unless RC_PARAMS asks for others.
const bool seeded = setenv("RC_PARAMS", "seed=20040607", 0) == 0;

TEST(RandomMasses, AreTheSameInEveryRun) { EXPECT_TRUE(seeded); }

}  // namespace
