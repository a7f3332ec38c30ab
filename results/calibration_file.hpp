// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <string>

#include "localization/rig_calibration.hpp"

namespace credo::results {

/// The text of calibration.yaml: what the drive has taught about the instruments, under the keys of their sensor.yaml.
/// \param rig  as calibrated before the drive
[[nodiscard]] std::string to_yaml(const localization::RigCalibration& calibration, const sensors::Rig& rig);

/// The same in a few lines for people; empty without instruments.
[[nodiscard]] std::string to_text(const localization::RigCalibration& calibration, const sensors::Rig& rig);

}  // namespace credo::results
