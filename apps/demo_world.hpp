// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

namespace credo::apps {

/// The text of sim/worlds/demo.yaml.
extern const char* const kDemoWorld;

}  // namespace credo::apps
