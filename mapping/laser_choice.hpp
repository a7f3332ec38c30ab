// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "mapping/laser_bayes.hpp"
#include "mapping/laser_calibrated.hpp"
#include "mapping/laser_tables.hpp"

namespace credo::mapping {

/// A laser model by its parameters.
using LaserParams = std::variant<Li2006LaserParams, BayesLaserParams, CalibratedLaserParams>;

/// \param taken  how the cells take the readings in; only a model that was learned makes a difference
/// \throws std::invalid_argument if a parameter is out of its range.
[[nodiscard]] LaserTables laser_tables(const LaserParams& laser, const sensors::RangeFinder& range_finder,
                                       const ScanParams& params, ReadingsTaken taken = ReadingsTaken::kSummed);

/// li2006, bayes, calibrated.
[[nodiscard]] std::string_view name_of(const LaserParams& params);
[[nodiscard]] std::span<const std::string_view> laser_model_names();
/// The model of a name with its defaults. \throws std::invalid_argument for another name
[[nodiscard]] LaserParams laser_params(std::string_view name);

}  // namespace credo::mapping
