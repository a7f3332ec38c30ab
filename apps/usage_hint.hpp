// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace credo::apps {

/// What the first word of a command line that is no sub-command or option of `app` was probably meant to be, as
/// "unknown ...; did you mean '...'?". Empty if all are known.
[[nodiscard]] std::string usage_hint(const CLI::App& app, int argc, const char* const* argv);

}  // namespace credo::apps
