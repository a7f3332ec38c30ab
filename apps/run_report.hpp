// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "apps/pipeline.hpp"
#include "evaluation/localization_score.hpp"

namespace credo::apps {

/// The score of a run against the truth of its dataset; nothing where the dataset has none.
[[nodiscard]] std::optional<evaluation::LocalizationScore> score_of(const Outcome& outcome,
                                                                    const datasets::Dataset& dataset);

[[nodiscard]] std::string to_text(const Outcome& outcome, const datasets::Dataset& dataset);
[[nodiscard]] nlohmann::ordered_json to_json(const Outcome& outcome, const datasets::Dataset& dataset);
[[nodiscard]] nlohmann::ordered_json to_json(const evaluation::LocalizationScore& score);

}  // namespace credo::apps
