// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/compare.hpp"

#include <stdexcept>

#include "apps/commands.hpp"

namespace credo::apps {

datasets::Dataset open_comparable(const std::string& path) {
  datasets::Dataset dataset = datasets::Dataset::open(path);
  const auto require = [&](bool there, const char* what) {
    if (!there) throw std::runtime_error(path + ": the dataset has no " + what + ", which a comparison needs");
  };
  require(dataset.header.floor_plan.has_value(), "floor plan");
  require(!dataset.truth.empty(), "ground truth (groundtruth0)");
  return dataset;
}

void add_compare(CLI::App& app) {
  CLI::App* compare = app.add_subcommand("compare", "Every method on the same readings: one table.");
  compare->footer(
      "  credo compare localizers datasets/office datasets/hall    Credo beside Kalman and particle filters and ICP\n"
      "  credo compare association datasets/office                 who is who: Credo beside nearest neighbour and "
      "JPDA\n"
      "  credo compare maps datasets/office                       sensor models and rules of the map");
  compare->require_subcommand(1);
  add_compare_localizers(*compare);
  add_compare_association(*compare);
  add_compare_maps(*compare);
}

}  // namespace credo::apps
