// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/table_row.hpp"

#include <fmt/format.h>

namespace credo::evaluation {

std::string table_row(const std::string& name, const std::string& value, const std::string& meaning) {
  return fmt::format("  {:<24} {:>12}   {}\n", name, value, meaning);
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f} %", 100.0 * *share) : "-";
}

}  // namespace credo::evaluation
