// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Geometry>
#include <span>

#include "mapping/mapper.hpp"

namespace credo::apps {

/// The rectangle around what the readings let the sensors see, beam by beam; what mapping::map_along() makes of them
/// covers it, and hardly more. Empty where no reading has a pose.
[[nodiscard]] Eigen::AlignedBox2d seen_ground(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                                              std::span<const sensors::RangeScan> scans,
                                              std::span<const sensors::SonarSweep> sweeps,
                                              const mapping::TrajectoryMappingParams& params);

/// Refuses, before anything is mapped, a resolution with which the map would be larger than a picture may be.
/// \throws std::length_error with a resolution to try, and the option that asks for the map without pictures
void require_map_fits(const Eigen::AlignedBox2d& ground, double resolution_m);

/// Says that a map is too large for the pictures of it, and what is there instead.
void warn_without_pictures(const grids::EvidentialGrid& grid);

}  // namespace credo::apps
