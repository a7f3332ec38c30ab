// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/map_files_options.hpp"

#include <map>

namespace credo::apps {

void add_map_files_options(CLI::App& command, MapFilesOptions& options) {
  command
      .add_option("--readout", options.readout,
                  "channels of map_belief.tiff: after Dempster's normalisation, or raw masses")
      ->check(CLI::IsMember({"normalized", "raw"}))
      ->capture_default_str();
  command.add_option("--map-mode", options.mode, "what the grey of map.yaml says: trinary, scale (percent) or raw")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, datasets::MapMode>{{"trinary", datasets::MapMode::kTrinary},
                                                                           {"scale", datasets::MapMode::kScale},
                                                                           {"raw", datasets::MapMode::kRaw}}))
      ->default_str("trinary");
}

}  // namespace credo::apps
