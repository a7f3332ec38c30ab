// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <opencv2/core.hpp>

#include "results/canvas.hpp"

namespace credo::results {

/// Whether some pixel has just this colour.
inline bool has(const cv::Mat& picture, Color color) {
  cv::Mat found;
  const cv::Scalar bgr(color.blue, color.green, color.red);
  cv::inRange(picture, bgr, bgr, found);
  return cv::countNonZero(found) > 0;
}

}  // namespace credo::results
