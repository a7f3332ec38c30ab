// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "grids/evidential_grid.hpp"

namespace credo::apps {

/// Warns of tiles with cells that have reached the end of their range: what they took in beyond it is lost.
void warn_of_saturation(const grids::EvidentialGrid& grid);

}  // namespace credo::apps
