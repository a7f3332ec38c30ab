// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/contributed_map.hpp"

#include <stdexcept>
#include <utility>

namespace credo::mapping {

void ContributedMap::add(const std::string& contributor, const grids::EvidentialGrid& evidence) {
  whole_.merge(evidence);
  contributions_.try_emplace(contributor, whole_.georeference()).first->second.merge(evidence);
}

grids::EvidentialGrid ContributedMap::take_out(const std::string& contributor) {
  const auto found = contributions_.find(contributor);
  if (found == contributions_.end()) {
    std::string known;
    for (const auto& entry : contributions_) known += (known.empty() ? "" : ", ") + entry.first;
    throw std::invalid_argument("nothing in the map is from '" + contributor + "': expected one of " +
                                (known.empty() ? "none" : known));
  }
  grids::EvidentialGrid taken = std::move(found->second);
  contributions_.erase(found);
  if (whole_.saturated_tiles().empty()) {
    whole_.remove(taken);
  } else {  // a cell at its floor has lost how much it held
    whole_ = grids::EvidentialGrid(whole_.georeference());
    for (const auto& entry : contributions_) whole_.merge(entry.second);
  }
  return taken;
}

}  // namespace credo::mapping
