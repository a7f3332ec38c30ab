// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/csv_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "datasets/format_error.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

std::string header_of(const std::vector<std::string>& columns) {
  std::string header = "#";
  for (const std::string& column : columns) header += (header.size() > 1 ? "," : "") + column;
  return header;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& file, std::vector<std::string> columns, std::string reason)
    : file_(file), columns_(std::move(columns)), reason_(std::move(reason)), content_(read_text_file(file)) {
  if (content_.empty()) throw FormatError(file_, 0, "is empty; expected the header " + in_quotes(header_of(columns_)));
  check_header();
}

void CsvTable::fail(const std::string& message) const { throw FormatError(file_, line_, message); }

void CsvTable::check_header() {
  const std::string_view header = trimmed(next_line());
  if (!header.starts_with('#'))
    fail("expected the header " + in_quotes(header_of(columns_)) + ", found " + in_quotes(header));
  row_ = header.substr(1);
  in_row_ = 0;
  column_ = 0;
  for (const std::string& expected : columns_) {
    const std::string_view name = field();
    if (name != expected)
      fail("column " + std::to_string(column_) + " of the header: expected " + in_quotes(expected) + ", found " +
           in_quotes(name));
  }
  if (in_row_ != std::string_view::npos) fail_columns();
}

std::string_view CsvTable::next_line() {
  const std::size_t end = std::min(content_.find('\n', position_), content_.size());
  const std::string_view line(content_.data() + position_, end - position_);
  position_ = end + 1;
  ++line_;
  return line;
}

bool CsvTable::next_row() {
  if (column_ != 0 && in_row_ != std::string_view::npos) fail_columns();
  while (position_ < content_.size()) {
    row_ = next_line();
    const auto first = row_.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || row_[first] == '#') continue;
    in_row_ = 0;
    column_ = 0;
    return true;
  }
  return false;
}

void CsvTable::fail_columns() const {
  const auto found = 1 + std::count(row_.begin(), row_.end(), ',');
  fail("expected " + std::to_string(columns_.size()) + " columns" + (reason_.empty() ? "" : " (" + reason_ + ")") +
       ", found " + std::to_string(found));
}

std::string_view CsvTable::field() {
  if (in_row_ == std::string_view::npos) fail_columns();
  const std::size_t comma = row_.find(',', in_row_);
  const std::string_view text = row_.substr(in_row_, comma == std::string_view::npos ? comma : comma - in_row_);
  in_row_ = comma == std::string_view::npos ? comma : comma + 1;
  ++column_;
  return trimmed(text);
}

sensors::Timestamp CsvTable::time() {
  const std::string_view text = field();
  sensors::Timestamp time = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (error != std::errc{} || end != text.data() + text.size() || !sensors::is_usable(time))
    fail(column() + ": expected a time in whole nanoseconds, found " + in_quotes(text) +
         (text.find_first_of(".eE") != std::string_view::npos ? " (seconds? multiply them by 1e9)" : ""));
  if (has_time_ && time < last_time_)
    fail("the time " + std::to_string(time) + " ns comes after " + std::to_string(last_time_) + " ns in line " +
         std::to_string(last_time_line_) + ": expected rows in order of time");
  has_time_ = true;
  last_time_ = time;
  last_time_line_ = line_;
  return time;
}

double CsvTable::number() {
  const std::string_view text = field();
  if (text.empty()) return std::nan("");
  double value = 0.0;
  const char* const begin = text.data() + (text.front() == '+' ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    fail(column() + ": expected a number, found " + in_quotes(text));
  return value;
}

double CsvTable::finite(double low, double high) {
  const double value = number();
  if (!(value >= low && value <= high)) {
    char bounds[80];
    char* end = std::to_chars(bounds, bounds + 36, low).ptr;
    *end++ = '.', *end++ = '.';
    end = std::to_chars(end, bounds + sizeof bounds, high).ptr;
    fail(column() + ": expected a number in " + std::string(bounds, end) + ", found " +
         (std::isnan(value) ? "nan or nothing" : std::to_string(value)));
  }
  return value;
}

std::string_view CsvTable::text() { return field(); }

std::string_view CsvTable::rest() {
  if (in_row_ == std::string_view::npos) fail_columns();
  const std::string_view text = row_.substr(in_row_);
  in_row_ = std::string_view::npos;
  ++column_;
  return trimmed(text);
}

}  // namespace credo::datasets
