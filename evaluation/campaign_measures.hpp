// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

#include "evaluation/campaign_summary.hpp"

// What a summary measures, acquisition by acquisition and run by run.
namespace credo::evaluation {

/// As in "confidently wrong".
[[nodiscard]] bool is_wrong(const Sample& sample, const ScoreParams& words);
[[nodiscard]] bool is_confident(const Sample& sample, const ScoreParams& words);

/// All measures of a group, always the same ones in the same order.
/// \param runs  with rows
[[nodiscard]] std::vector<Measure> measures_of(std::span<const CampaignRun* const> runs, const SummaryParams& params);

}  // namespace credo::evaluation
