// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "results/map_folder.hpp"

namespace credo::apps {

/// What is written of a map beside the map itself.
struct MapFilesOptions {
  std::string readout = "normalized";
  std::string map_mode = "trinary";

  [[nodiscard]] bool raw() const { return readout == "raw"; }
  [[nodiscard]] datasets::MapMode mode() const;
  [[nodiscard]] results::MapFolderParams params() const {
    return {.mode = mode(), .channels = raw() ? results::BeliefChannels::kRaw : results::BeliefChannels::kNormalized};
  }
};

/// --readout and --map-mode.
void add_map_files_options(CLI::App& command, MapFilesOptions& options);

}  // namespace credo::apps
