// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/clerentin_experiment.hpp"

namespace credo::apps {

/// The paper's numbers beside those of both methods, with what explains the differences.
[[nodiscard]] std::string to_text(const ClerentinExperiment& experiment);
/// The same and the series: errors, beliefs, lives of tracks.
[[nodiscard]] nlohmann::ordered_json to_json(const ClerentinExperiment& experiment);

}  // namespace credo::apps
