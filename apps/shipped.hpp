// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <string>

namespace credo::apps {

/// The world that is drawn from a seed and is no file.
inline constexpr const char* kRandomWorld = "random";

/// YAML files that come with credo.
struct ShippedFiles {
  const char* what;       ///< one of them, in a message
  const char* installed;  ///< folder under share/credo
  const char* source;     ///< folder of the source tree
  const char* besides;    ///< what else a name may be, in a message
};
inline constexpr ShippedFiles kWorlds{"world", "worlds", CREDO_WORLDS, kRandomWorld};
inline constexpr ShippedFiles kCampaigns{"campaign", "campaigns", CREDO_CAMPAIGNS, ""};

/// A file that is there, or one of those that come with credo by its name without ".yaml"; else a folder that is there,
/// for its reader to refuse.
/// \throws std::runtime_error for none of these, with the nearest name and all that are known
[[nodiscard]] std::filesystem::path find_shipped(const std::string& name, const ShippedFiles& files);

}  // namespace credo::apps
