// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <string_view>

namespace credo::mapping {

/// Checks that beams of up to `reach_m` are 4 to 4096 cells long: enough to tell a wall from the way to it, and no more
/// cells under a single reading than a whole map may have.
/// \param sensor  whose beams, for the message
/// \throws std::invalid_argument with the resolutions that fit
void require_resolution_fits(double resolution_m, double reach_m, std::string_view sensor);

}  // namespace credo::mapping
