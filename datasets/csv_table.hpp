// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sensors/time.hpp"

namespace credo::datasets {

/// Reads a table of a dataset field by field, row after row; what is wrong is a FormatError with file and line.
///
///     for (CsvTable table(file, {"timestamp [ns]", "x [m]"}); table.next_row();) {
///       const Timestamp time = table.time();
///       const double x = table.finite(-1e6, 1e6);
///     }
///
/// The first line is the header, '#' and the names of the columns, and must be as expected. Carriage returns, spaces
/// around fields, empty lines and further lines that start with '#' do no harm.
class CsvTable {
 public:
  /// \param reason  why there are that many columns, for the complaint where there are not; may be empty
  /// \throws FormatError if the file cannot be read or its header differs
  CsvTable(const std::filesystem::path& file, std::vector<std::string> columns, std::string reason = {});

  /// Goes to the next row, after checking that the one before was read to its end.
  [[nodiscard]] bool next_row();

  // The next field of the row.
  [[nodiscard]] sensors::Timestamp time();  ///< must not be before that of the row before
  [[nodiscard]] double number();            ///< nan where empty; may be nan or infinite
  [[nodiscard]] double finite(double low, double high);
  [[nodiscard]] std::string_view text();  ///< trimmed; may be empty
  [[nodiscard]] std::string_view rest();  ///< of the row, commas included, trimmed

  [[nodiscard]] int line() const { return line_; }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  [[nodiscard]] std::string_view next_line();
  [[nodiscard]] std::string_view field();
  [[nodiscard]] const std::string& column() const { return columns_[column_ - 1]; }
  [[noreturn]] void fail_columns() const;
  void check_header();

  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::string reason_;
  std::string content_;
  std::size_t position_ = 0;  ///< of the next line
  int line_ = 0;
  std::string_view row_;
  std::size_t in_row_ = 0;  ///< position of the next field; npos: after the last
  std::size_t column_ = 0;  ///< fields read
  bool has_time_ = false;
  sensors::Timestamp last_time_ = 0;
  int last_time_line_ = 0;
};

}  // namespace credo::datasets
