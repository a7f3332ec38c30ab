// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

#include "perception/line_fit.hpp"
#include "perception/scan_lines.hpp"

namespace credo::perception {

struct HoughLineParams {
  double angle_step_rad = 0.0175;  ///< of the accumulator: the spacing of the beams
  double offset_step_m = 0.05;     ///< likewise: wide enough for the noise, and for what the angle's step blurs nearby
  double gap_m = 0.5;              ///< a longer one parts two lines
  int min_support = 8;             ///< points: fewer are on some line by chance
  int most_lines = 20;
};

/// The straight faces of a scan by Hough transform (Hough 1962, in the normal form of Duda and Hart 1972), as Li X.
/// 2007 locates the robot by: each point votes for all lines through it; the line with most votes is fitted to the
/// longest run of its points, these are taken out, and the next one is looked for. Points need not be neighbours in the
/// scan, so that a wall behind a row of pillars is one line, which segmentation cuts in pieces; yet points of clutter
/// that happen to be in a row are one, too, and no end is known to be a place of the world.
/// \param points  in counter-clockwise order, in the base frame
/// \returns the lines by falling number of votes
/// \throws std::invalid_argument  for steps that are not positive
[[nodiscard]] std::vector<ScanLine> hough_lines(std::span<const sensors::ScanPoint> points, const PointNoise& noise,
                                                const HoughLineParams& params = {});

}  // namespace credo::perception
