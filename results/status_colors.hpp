// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "localization/localization.hpp"
#include "results/canvas.hpp"

namespace credo::results {

[[nodiscard]] constexpr Color color_of(localization::Status status) {
  switch (status) {
    case localization::Status::kInitializing: return colors::kMuted;
    case localization::Status::kLocalized: return colors::kGreen;
    case localization::Status::kUncertain: return colors::kYellow;
    case localization::Status::kAmbiguous: return colors::kPurple;
    case localization::Status::kLost: return colors::kRed;
  }
  return colors::kInk;
}

}  // namespace credo::results
