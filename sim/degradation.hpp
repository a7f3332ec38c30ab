// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/world.hpp"

namespace credo::sim {

/// Names of what can be made worse, in the order in which tables list them:
///   nominal          nothing
///   clutter          30 % of the walls hidden by unmapped things
///   people           4 persons
///   worst_range      the range finder of 1999: 128 beams, 1-sigma of 1 % of the squared range
///   worst            worst_range, clutter and people at once
///   moved_wall       a wall or a piece of furniture stands elsewhere than the plan says, or a wall was put up
///   low_light, saturated, camera_blind, range_blind, both_blind, lying_range, lying_camera, odometry_slip
///                    a sensor fails, from somewhere in the middle part of the drive on, for a while
///   motion_blur      images of 80 ms, driving on
///   no_odometry      there is none
///   wrong_start      the robot is told a place up to 2 m, and a heading up to 90 degrees, off
///   unknown_start    the robot is told nothing
///   kidnap           set down at least 1 m elsewhere, every other time turned by at least 30 degrees too
///   turned           turned on the spot by at least 30 degrees
///   symmetric        another building: a room that looks the same turned by half a turn; the robot is told nothing
[[nodiscard]] const std::vector<std::string>& degradation_names();

/// The world made worse; what happens when and where is drawn from the seed, in the middle part of the drive, so that
/// the drive goes on long enough after. The name of the world stays (but of `symmetric`): the same plan, calibration
/// and noise as without. \throws std::invalid_argument  for an unknown name, or a world in which that cannot be done
[[nodiscard]] World degraded(World world, std::string_view name, std::uint64_t seed);

}  // namespace credo::sim
