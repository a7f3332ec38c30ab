// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

namespace credo::datasets {

/// The readings of several sensors as one list, by time; those of equal times by sensor.
template <typename Reading>
[[nodiscard]] std::vector<Reading> in_time_order(std::vector<std::vector<Reading>> by_sensor) {
  std::vector<Reading> all;
  for (std::vector<Reading>& readings : by_sensor)
    all.insert(all.end(), std::make_move_iterator(readings.begin()), std::make_move_iterator(readings.end()));
  std::stable_sort(all.begin(), all.end(), [](const Reading& a, const Reading& b) { return a.time < b.time; });
  return all;
}

}  // namespace credo::datasets
