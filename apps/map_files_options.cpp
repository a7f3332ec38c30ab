// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/map_files_options.hpp"

namespace credo::apps {

datasets::MapMode MapFilesOptions::mode() const {
  if (map_mode == "scale") return datasets::MapMode::kScale;
  return map_mode == "raw" ? datasets::MapMode::kRaw : datasets::MapMode::kTrinary;
}

void add_map_files_options(CLI::App& command, MapFilesOptions& options) {
  command
      .add_option("--readout", options.readout,
                  "channels of map_belief.tiff: after Dempster's normalisation, or raw masses")
      ->check(CLI::IsMember({"normalized", "raw"}))
      ->capture_default_str();
  command
      .add_option("--map-mode", options.map_mode, "what the grey of map.yaml says: decisions, percent or probability")
      ->check(CLI::IsMember({"trinary", "scale", "raw"}))
      ->capture_default_str();
}

}  // namespace credo::apps
