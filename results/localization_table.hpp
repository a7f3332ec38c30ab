// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "localization/localization.hpp"

namespace credo::results {

/// One row of localization.csv. `localization.hypotheses` is empty: they have a table of their own.
struct LocalizationRow {
  localization::Localization localization;
};

/// The first line of localization.csv, with the line's end.
inline constexpr std::string_view kLocalizationHeader =
    "#timestamp [ns],x [m],y [m],theta [rad],var_x,cov_xy,cov_xtheta,var_y,cov_ytheta,var_theta,"
    "belief_yes,belief_no,belief_unknown,conflict,status,detected,matched,tracked,"
    "pl_position_low [m],pl_position_high [m],pl_heading_low [rad],pl_heading_high [rad],reason\n";
/// A line, with the line's end.
[[nodiscard]] std::string to_line(const LocalizationRow& row);

/// Reads a localization.csv. Columns appended after those known here are ignored.
/// \throws datasets::FormatError with file and line: a missing file, another header, a value that is not finite or
/// cannot be (only protection levels may be nan), an unknown status, a time that decreases
[[nodiscard]] std::vector<LocalizationRow> read_localization(const std::filesystem::path& file);

/// A row of a table that begins with the columns of localization.csv and goes on with others.
struct ExtendedRow {
  LocalizationRow row;
  std::vector<std::string> more;  ///< the others, as texts
};

/// The first line of such a table, with the line's end. \param more  names of the other columns
[[nodiscard]] std::string extended_header(std::span<const std::string> more);
/// A line, with the line's end.
[[nodiscard]] std::string to_line(const ExtendedRow& row);
/// Reads such a table. \throws datasets::FormatError as read_localization, and for a row without just these columns
[[nodiscard]] std::vector<ExtendedRow> read_extended_localization(const std::filesystem::path& file,
                                                                  std::span<const std::string> more);

}  // namespace credo::results
