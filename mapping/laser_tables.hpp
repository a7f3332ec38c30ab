// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <vector>

#include "mapping/evidence_levels.hpp"
#include "mapping/laser_model.hpp"
#include "mapping/scan_params.hpp"
#include "sensors/range_finder.hpp"

namespace credo::mapping {

/// A laser model brought into tables.
struct LaserTables {
  std::array<evidence::FixedLogCommonality, kLevels + 1> free;
  std::array<evidence::FixedLogCommonality, kLevels + 1> hit;
  double bins_per_metre = 0.0;
  std::vector<float> free_margin_m;  ///< by range
  std::vector<float> half_width_m;   ///< by range
  std::vector<float> hit_share;      ///< by range
  double no_return_reliability = 0.0;
};

template <LaserModel Model>
[[nodiscard]] LaserTables laser_tables(const Model& model, const sensors::RangeFinder& range_finder,
                                       const ScanParams& params) {
  constexpr int kBins = 1024;
  LaserTables tables{.free = increments(model.free_mass(), model.reliability()),
                     .hit = increments(model.hit_mass(), model.reliability()),
                     .bins_per_metre = kBins / range_finder.range_max_m,
                     .free_margin_m = {},
                     .half_width_m = {},
                     .hit_share = {},
                     .no_return_reliability = params.no_return_reliability};
  for (int bin = 0; bin <= kBins; ++bin) {
    const double range_m = (bin + 0.5) / tables.bins_per_metre;
    tables.free_margin_m.push_back(static_cast<float>(model.free_margin(range_m, range_finder.noise)));
    tables.half_width_m.push_back(static_cast<float>(model.half_width(range_m, range_finder.noise)));
    tables.hit_share.push_back(static_cast<float>(model.hit_share(range_m, range_finder.noise)));
  }
  return tables;
}

}  // namespace credo::mapping
