// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/resolution_fit.hpp"

#include <stdexcept>
#include <string>

namespace credo::mapping {

void require_resolution_fits(double resolution_m, double reach_m, std::string_view sensor) {
  constexpr double kLeastCells = 4.0, kMostCells = 4096.0;
  const double cells = reach_m / resolution_m;
  if (cells >= kLeastCells && cells <= kMostCells) return;
  throw std::invalid_argument(std::string(sensor) + ": a resolution of " + std::to_string(resolution_m) +
                              " m does not fit a range of " + std::to_string(reach_m) + " m: choose one between " +
                              std::to_string(reach_m / kMostCells) + " and " + std::to_string(reach_m / kLeastCells) +
                              " m");
}

}  // namespace credo::mapping
