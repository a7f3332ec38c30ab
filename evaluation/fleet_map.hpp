// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evaluation/map_experiment.hpp"

// Li P.: the map that a monitoring centre makes of what several robots send.
namespace credo::evaluation {

/// In which order the centre takes the readings of two robots in.
enum class Order { kByTime, kFirstThenSecond, kSecondThenFirst };

/// The map of PCR2 of what two robots' sonars say, each reading in full (mapping::Freshness discounts none).
[[nodiscard]] grids::MassMap fused_by_pcr2(const MapDrive& first, const MapDrive& second,
                                           const mapping::MapperParams& params, Order order);

/// One robot's map that no order changes: merged with another's it is that of both.
[[nodiscard]] grids::EvidentialGrid summed(const MapDrive& drive, const mapping::MapperParams& params);

}  // namespace credo::evaluation
