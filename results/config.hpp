// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <string>
#include <vector>

#include "localization/localizer.hpp"
#include "mapping/mapper.hpp"
#include "perception/observer.hpp"

namespace credo::results {

/// What a run was made with.
struct RunConfig {
  std::string version;
  std::string dataset;                     ///< its name
  std::string map_poses = "localization";  ///< where the mapper's poses came from
  perception::ObserverParams observer = {};
  localization::LocalizerParams localizer = {};
  mapping::MapperParams mapper = {};
};

/// The text of config.yaml: every parameter as used, and what belief_yes means.
[[nodiscard]] std::string to_yaml(const RunConfig& config);
/// The same of a map that was made from given poses.
[[nodiscard]] std::string to_yaml(const mapping::TrajectoryMappingParams& params, const std::string& version,
                                  const std::string& source, const std::string& poses);
/// The same of a map that was taken from another one.
/// \param region  two corners of what was taken [m]; empty: all of it
[[nodiscard]] std::string to_yaml(const std::string& version, const std::string& source,
                                  const std::vector<double>& region);

}  // namespace credo::results
