// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "evaluation/consistency.hpp"
#include "evaluation/integrity.hpp"

// Pictures of how well localizations know whether they are right, for people. All are CV_8UC3.
namespace credo::evaluation {

/// What tells the lost from the others: the share of the lost that is caught against the false alarms, and against the
/// precision.
[[nodiscard]] cv::Mat detection_picture(const Integrity& integrity);

/// How often the localization was correct, against BetP(YES) and against [Bel, Pl].
[[nodiscard]] cv::Mat calibration_picture(const Integrity& integrity);

/// What is wrong with the accepted poses, against the share that is accepted.
[[nodiscard]] cv::Mat risk_picture(const Integrity& integrity);

/// Errors against protection levels, of position and of heading.
[[nodiscard]] cv::Mat protection_picture(const Integrity& integrity);

/// How many lost poses and kidnaps are answered within so many acquisitions.
[[nodiscard]] cv::Mat timing_picture(const Integrity& integrity);

/// ANEES of pose, position and heading at each acquisition, with the bounds of an honest covariance.
[[nodiscard]] cv::Mat consistency_picture(std::span<const Consistency> consistencies);

}  // namespace credo::evaluation
