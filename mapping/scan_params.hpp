// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

namespace credo::mapping {

/// How a scan is spread over the cells. A beam speaks for the sector up to half-way to its neighbours, but behind what
/// one of them hits, on another surface, for a tenth of that half.
struct ScanParams {
  double max_range_m = 30.0;           ///< beams are cut here: free up to it, no hit beyond
  double no_return_reliability = 0.1;  ///< of "empty" along a beam that nothing came back from
  double no_return_range_m = 4.0;      ///< and up to here only, or range_max where that is nearer
  double min_incidence_rad = 0.087;    ///< neighbouring hits lie on one surface if it is met at least this steeply;
                                       ///< of sparse beams, four times the angle between them, up to 0.7
  double max_half_sector_rad = 0.03;   ///< a beam speaks for no more than this to either side, unless on one surface
};

}  // namespace credo::mapping
