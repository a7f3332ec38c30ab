// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "evaluation/campaign_summary.hpp"

namespace credo::apps {

/// The commands that play one run of a campaign again into `replay/`, with images, and run it.
[[nodiscard]] std::string replay_command(const evaluation::RunKey& key, perception::Method method);

/// The table by degradation, all measures with their intervals over everything, how many matches are wrong by the
/// belief of their tracks, the worst runs and how to replay them.
/// \param milliseconds  per acquisition, by degradation and "all"
[[nodiscard]] std::string to_text(const evaluation::CampaignSummary& summary, perception::Method method,
                                  const std::map<std::string, double>& milliseconds);

[[nodiscard]] nlohmann::ordered_json to_json(const evaluation::CampaignSummary& summary, perception::Method method);

}  // namespace credo::apps
