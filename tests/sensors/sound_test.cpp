// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sensors/sound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace credo::sensors {
namespace {

TEST(Sound, IsFasterInWarmAir) {
  EXPECT_NEAR(sound_speed(0.0), 331.3, 1e-12);
  EXPECT_NEAR(sound_speed(20.0), 343.2, 0.05);
  EXPECT_NEAR(distance_of_flight(sound_speed(20.0), 0.01), 1.716, 1e-3);
}

TEST(Sound, RefusesWhatIsNoTemperature) {
  EXPECT_THROW((void)sound_speed(-273.15), std::invalid_argument);
  EXPECT_THROW((void)sound_speed(std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace credo::sensors
