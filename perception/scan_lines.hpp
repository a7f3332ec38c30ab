// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <optional>
#include <vector>

#include "perception/scene.hpp"

namespace credo::perception {

/// A straight face as one scan shows it, in the base frame.
struct ScanLine {
  /// Its direction has the robot on the left, so that the two faces of a wall differ by half a turn, and its normal
  /// points to the robot's side.
  geometry::LineEstimate line;
  geometry::Segment extent;  ///< along the direction of `line`
  /// 1-sigma along the line of each end of `extent`; nothing for an end that is no place of the world: hidden by
  /// something nearer, out of reach, or where another of the lines meets it, which tells it by itself. [m]
  std::array<std::optional<double>, 2> end_sigma_m;
  int support = 0;  ///< points
};

struct ScanLineParams {
  int min_support = 4;             ///< points, at least: three make a line of any clutter
  double max_sigma_rad = 0.15;     ///< of its direction: a line less sure of it is a spot
  double least_pignistic = 0.5;    ///< BetP(YES) of its existence, at least
  double curved_turn_rad = 0.79;   ///< a face that is joined to its neighbour under less than this, and more than
  double straight_turn_rad = 0.1;  ///< this, is a piece of something round: its lines move with the robot,
  double curved_face_m = 0.6;      ///< unless it is longer than this
};

/// The walls of a scene as lines, counter-clockwise.
/// \param lines  cleared first, keeps its memory
void scan_lines(const Scene& scene, const ScanLineParams& params, std::vector<ScanLine>& lines);

/// Turned by half a turn where the direction of `extent` asks for it.
[[nodiscard]] geometry::LineEstimate directed_along(geometry::LineEstimate line, const geometry::Segment& extent);

}  // namespace credo::perception
