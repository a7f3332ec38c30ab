// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/idle_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <variant>

namespace credo::apps {
namespace {

template <typename Params>
constexpr bool kTwoForms = requires(Params p) {
  p.variant;
}
|| requires(Params p) { p.matched.variant; };

/// \param params_of  a model by its name
template <typename ParamsOf>
void require_two_forms(const std::vector<std::string>& models, std::span<const std::string_view> all,
                       const ParamsOf& params_of) {
  const auto has_two = [&](std::string_view name) {
    return std::visit([]<typename Params>(const Params&) { return kTwoForms<Params>; }, params_of(name));
  };
  if (std::ranges::any_of(models, has_two)) return;
  std::vector<std::string_view> others;
  std::ranges::copy_if(all, std::back_inserter(others), has_two);
  throw std::runtime_error(fmt::format("--printed: there is one form only of '{}'; there are two of {}",
                                       fmt::join(models, "', '"), fmt::join(others, ", ")));
}

}  // namespace

void require_sensors(const CLI::App& command, const MapSource& source, std::initializer_list<SensorOption> options) {
  for (const auto& [option, sensor] : options)
    if (command.count(option) > 0 && std::ranges::count(source.sensors, sensor) == 0)
      throw std::runtime_error(fmt::format("{}: is of the {}, which --sensors {} leaves out: drop one of the two",
                                           option, sensor == std::string_view("sonar") ? "sonar" : "range finders",
                                           fmt::join(source.sensors, ",")));
}

void require_learned(const std::string& weights, const char* weights_option, std::span<const std::string> models,
                     const char* models_option) {
  if (!weights.empty() && std::ranges::count(models, "calibrated") == 0)
    throw std::runtime_error(fmt::format("{}: these are of the model 'calibrated', not of '{}': add {} calibrated",
                                         weights_option, fmt::join(models, "', '"), models_option));
}

void require_two_forms_of_sonar(const std::vector<std::string>& models) {
  constexpr double kAnyResolution_m = 0.05;
  require_two_forms(models, mapping::sonar_model_names(),
                    [](std::string_view name) { return mapping::sonar_params(name, kAnyResolution_m); });
}

void require_two_forms_of_laser(const std::vector<std::string>& models) {
  require_two_forms(models, mapping::laser_model_names(),
                    [](std::string_view name) { return mapping::laser_params(name); });
}

}  // namespace credo::apps
