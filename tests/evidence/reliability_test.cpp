// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/reliability.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "evidence/binary_rules.hpp"
#include "evidence/log_commonality.hpp"
#include "evidence/track_belief.hpp"

namespace credo::evidence {
namespace {

TEST(Reliability, IsAProbability) {
  EXPECT_NO_THROW(check_reliability(0.0));
  EXPECT_NO_THROW(check_reliability(1.0));
  EXPECT_THAT([] { check_reliability(1.5); },
              ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr("in [0, 1]; got 1.5")));
}

TEST(Reliability, IsCheckedByAllThatDiscount) {
  for (const double wrong : {-0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(static_cast<void>(discount(BinaryMass{}, wrong)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(discount(GridMass{}, wrong)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(discount(LogCommonality{}, wrong)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(contextual_discount(BinaryMass{}, wrong, 0.5)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(contextual_discount(BinaryMass{}, 0.5, wrong)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(match_support(wrong)), std::invalid_argument);
  }
}

}  // namespace
}  // namespace credo::evidence
