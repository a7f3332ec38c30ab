// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "evaluation/campaign_summary.hpp"

// Pictures of a campaign, for people. All are CV_8UC3.
namespace credo::evaluation {

/// Position and heading errors of each degradation: median, quartiles, 5 to 95 %, and the largest, on a logarithmic
/// axis.
[[nodiscard]] cv::Mat error_picture(const CampaignSpec& spec, std::span<const CampaignRun> runs);

/// What each degradation's acquisitions were: available, available but misleading, localized with too large a
/// protection level, or an alert of what kind.
[[nodiscard]] cv::Mat availability_picture(const CampaignSpec& spec, std::span<const CampaignRun> runs,
                                           const ScoreParams& words = {});

/// Position error against its upper protection level, one point for each acquisition that has both: misleading ones are
/// right of the diagonal and below the alert limit. What is beyond 1 m is drawn at 1 m.
[[nodiscard]] cv::Mat protection_picture(std::span<const CampaignRun> runs, const ScoreParams& words = {});

}  // namespace credo::evaluation
