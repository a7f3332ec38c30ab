// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <nlohmann/json_fwd.hpp>

#include "evaluation/integrity.hpp"

namespace credo::apps {

/// Every number of it, and its curves, thinned to at most some hundred points.
[[nodiscard]] nlohmann::ordered_json to_json(const evaluation::Integrity& integrity);

}  // namespace credo::apps
