// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>

#include "grids/mass_map.hpp"

namespace credo::results {

struct SheetMap {
  std::string title, caption;
  const grids::MassMap* map = nullptr;
};

/// Maps of one place side by side: white is empty, black occupied (pignistic, the conflict divided out), blue unknown,
/// the redder the more conflict.
[[nodiscard]] cv::Mat map_sheet(std::span<const SheetMap> maps);

}  // namespace credo::results
