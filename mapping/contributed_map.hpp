// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "grids/evidential_grid.hpp"
#include "sensors/time.hpp"

namespace credo::mapping {

/// From `begin` on and before `end`: periods that follow each other share no reading.
struct Period {
  sensors::Timestamp begin = 0;
  sensors::Timestamp end = 0;
};

/// The readings of a period, in their order.
template <typename Reading>
[[nodiscard]] std::vector<Reading> during(const Period& period, std::span<const Reading> readings) {
  std::vector<Reading> taken;
  std::copy_if(readings.begin(), readings.end(), std::back_inserter(taken),
               [&](const Reading& reading) { return reading.time >= period.begin && reading.time < period.end; });
  return taken;
}

/// A map that knows whose evidence it holds, a robot's or a period's, so that each contribution can be taken out again:
/// the whole is, to the bit, the merge of those that are left, in whatever order they came and went. Holds each
/// contribution beside the whole: about twice the memory of the maps.
class ContributedMap {
 public:
  /// \throws std::invalid_argument as grids::EvidentialGrid
  explicit ContributedMap(const grids::Georeference& georeference = {}) : whole_(georeference) {}

  [[nodiscard]] const grids::EvidentialGrid& whole() const { return whole_; }
  [[nodiscard]] const std::map<std::string, grids::EvidentialGrid>& contributions() const { return contributions_; }

  /// Merges more evidence of a contributor, who may be a new one. Both hold disjoint readings.
  /// \throws std::invalid_argument if the georeferences differ; nothing is merged then
  void add(const std::string& contributor, const grids::EvidentialGrid& evidence);

  /// Takes all evidence of a contributor out of the whole. \returns it
  /// \throws std::invalid_argument if there is no such contributor; the message names those that there are
  grids::EvidentialGrid take_out(const std::string& contributor);

 private:
  grids::EvidentialGrid whole_;
  std::map<std::string, grids::EvidentialGrid> contributions_;
};

}  // namespace credo::mapping
