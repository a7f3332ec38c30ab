// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "apps/map_source.hpp"

// What a person asks for and would have no effect is refused, so that nobody takes it for granted.
namespace credo::apps {

/// An option that is of one kind of sensor: "sonar", or "range".
struct SensorOption {
  const char* option;
  const char* sensor;
};

/// \throws std::runtime_error if one was given, and its sensors are not mapped
void require_sensors(const CLI::App& command, const MapSource& source, std::initializer_list<SensorOption> options);

/// \throws std::runtime_error if weights are given and none of the models was learned
void require_learned(const std::string& weights, const char* weights_option, std::span<const std::string> models,
                     const char* models_option);

/// \throws std::runtime_error unless one of the models has a form as printed and another as resolved
void require_two_forms_of_sonar(const std::vector<std::string>& models);
void require_two_forms_of_laser(const std::vector<std::string>& models);

}  // namespace credo::apps
