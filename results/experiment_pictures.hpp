// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "geometry/floor_plan.hpp"
#include "results/canvas.hpp"
#include "results/history.hpp"

// Pictures of an experiment with several drives, by the number of the acquisition from 1 on. All are CV_8UC3.
namespace credo::results {

/// One drive as one of several in a picture.
struct NamedDrive {
  std::string name;
  Color color;
  std::span<const Moment> history;
};

/// The plan with the true ('+') and the computed ('x') positions of the drives, as fig. 19 of Clerentin et al. has
/// them.
[[nodiscard]] cv::Mat positions_picture(const geometry::FloorPlan& plan, std::span<const NamedDrive> drives);

/// m_l(YES) of the drives, as fig. 23.
[[nodiscard]] cv::Mat beliefs_picture(std::span<const NamedDrive> drives);

/// The masses of one track, as figs. 21 and 22, with its type and whether it was seen as a strip.
/// \param first  number of the first acquisition
/// \param lost   the track ended: the last sample is that of its loss
[[nodiscard]] cv::Mat track_life_picture(const std::string& title, std::span<const TrackSample> samples, int first,
                                         bool lost);

}  // namespace credo::results
