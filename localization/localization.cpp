// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/localization.hpp"

#include <ostream>

namespace credo::localization {

const char* to_string(Status status) {
  switch (status) {
    case Status::kInitializing: return "initializing";
    case Status::kLocalized: return "localized";
    case Status::kUncertain: return "uncertain";
    case Status::kAmbiguous: return "ambiguous";
    case Status::kLost: return "lost";
  }
  return "unknown";
}

std::ostream& operator<<(std::ostream& out, const Localization& localization) {
  return out << to_string(localization.status) << " at " << localization.estimate << ", belief " << localization.belief
             << ", matched " << localization.matched << " of " << localization.detected;
}

}  // namespace credo::localization
