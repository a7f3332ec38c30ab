// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "mapping/sonar_bayes.hpp"
#include "mapping/sonar_calibrated.hpp"
#include "mapping/sonar_li.hpp"
#include "mapping/sonar_regions.hpp"

namespace credo::mapping {

/// A sonar model by its parameters.
using SonarParams = std::variant<Li2007Params, Li2006SonarParams, LiPParams, SuParams, ZhuParams, BayesSonarParams,
                                 CalibratedSonarParams>;

/// \throws std::invalid_argument if a parameter is out of its range, or the ring cannot be mapped.
[[nodiscard]] AnySonarModel sonar_model(const sensors::SonarRing& ring, const SonarParams& params);

/// li2007, li2006, lip, su, zhu, bayes, calibrated.
[[nodiscard]] std::string_view name_of(const SonarParams& params);
[[nodiscard]] std::span<const std::string_view> sonar_model_names();
/// The model of a name with its defaults, for cells of a size. \throws std::invalid_argument for another name
[[nodiscard]] SonarParams sonar_params(std::string_view name, double resolution_m);

}  // namespace credo::mapping
