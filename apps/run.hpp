// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/pipeline.hpp"

namespace credo::apps {

struct RunOptions {
  std::string dataset;
  std::string out;  ///< empty: results/NAME
  std::string method = "default";
  std::string pictures;  ///< empty: none
  int picture_moments = 6;
  double resolution_m = 0.05;
  std::string readout = "normalized";
  std::vector<std::array<double, 4>> poses_at{};  ///< set by hand: time [s], x [m], y [m], theta [rad]
  bool force = false;
};

/// `credo run` without what it prints: writes the results (and pictures) and returns what came out.
/// \param out  where the results went
[[nodiscard]] Outcome run_and_write(const datasets::Dataset& dataset, const RunOptions& options,
                                    std::filesystem::path& out);

}  // namespace credo::apps
