// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/localization_table.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "datasets/format_error.hpp"
#include "datasets/text_file.hpp"

namespace credo::results {
namespace {

using localization::Status;

constexpr std::size_t kColumns = 23;  // the reason, the last one, included
constexpr std::array kStatuses{Status::kInitializing, Status::kLocalized, Status::kUncertain, Status::kAmbiguous,
                               Status::kLost};

/// A field in quotes where it must be (RFC 4180).
std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c == '\n' || c == '\r' ? ' ' : c;
  }
  return result + '"';
}

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && inside && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      inside = !inside;
    } else if (c == ',' && !inside) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

class RowReader {
 public:
  RowReader(const std::filesystem::path& file, int line, std::string_view text)
      : file_(file), line_(line), fields_(fields_of(text)) {
    if (fields_.size() < kColumns) {
      fail("expected " + std::to_string(kColumns) + " columns, found " + std::to_string(fields_.size()));
    }
  }

  template <typename Number>
  Number number() {
    const std::string& field = fields_[next_++];
    Number value{};
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size()) {
      fail("expected a number in column " + std::to_string(next_) + ", found '" + field + "'");
    }
    return value;
  }
  /// May be nan: that is how protection levels say that there are none.
  double real() { return number<double>(); }
  double within(double low, double high) {
    const double value = real();
    if (!(value >= low && value <= high))
      fail(fmt::format("expected a number from {} to {} in column {}, found '{}'", low, high, next_,
                       fields_[next_ - 1]));
    return value;
  }
  double length() { return within(-1e6, 1e6); }
  double share() { return within(0.0, 1.0); }
  evidence::BinaryMass belief() {
    evidence::BinaryMass mass;
    mass.yes = share();
    mass.no = share();
    mass.unknown = share();
    constexpr double kRounding = 1e-3;
    if (std::abs(mass.yes + mass.no + mass.unknown - 1.0) > kRounding) fail("the belief does not sum to 1");
    return mass;
  }
  int count() { return static_cast<int>(within(0.0, 1e9)); }
  sensors::Timestamp time() {
    const auto value = number<sensors::Timestamp>();
    if (!sensors::is_usable(value)) fail("expected a time in nanoseconds, found '" + fields_[next_ - 1] + "'");
    return value;
  }
  std::string text() { return fields_[next_++]; }
  /// What has not been read.
  std::vector<std::string> rest(std::size_t count) {
    if (fields_.size() != next_ + count)
      fail(fmt::format("expected {} columns, found {}", next_ + count, fields_.size()));
    return {fields_.begin() + static_cast<std::ptrdiff_t>(next_), fields_.end()};
  }
  Status status() {
    const std::string word = text();
    for (const Status status : kStatuses) {
      if (word == localization::to_string(status)) return status;
    }
    fail("unknown status '" + word + "'; known are initializing, localized, uncertain, ambiguous and lost");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw datasets::FormatError(file_, line_, what); }

  const std::filesystem::path& file_;
  int line_;
  std::vector<std::string> fields_;
  std::size_t next_ = 0;
};

Eigen::Matrix3d read_covariance(RowReader& read) {
  constexpr double kLargest = 1e12;
  Eigen::Matrix3d covariance;
  for (const auto& [i, j] : {std::pair{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}) {
    covariance(i, j) = covariance(j, i) = read.within(i == j ? 0.0 : -kLargest, kLargest);
  }
  return covariance;
}

LocalizationRow read_row(RowReader& read) {
  LocalizationRow row;
  localization::Localization& l = row.localization;
  l.time = read.time();
  l.estimate.pose.x = read.length();
  l.estimate.pose.y = read.length();
  l.estimate.pose.theta = read.length();
  l.estimate.covariance = read_covariance(read);
  l.belief = read.belief();
  l.conflict = read.share();
  l.status = read.status();
  l.detected = read.count();
  l.matched = read.count();
  l.tracked = read.count();
  l.protection.position_low_m = read.real();
  l.protection.position_high_m = read.real();
  l.protection.heading_low_rad = read.real();
  l.protection.heading_high_rad = read.real();
  l.reason = read.text();
  return row;
}

/// Calls read(RowReader&), which returns the row's time, for every row of a table with this header or more columns.
template <typename Read>
void for_each_row(const std::filesystem::path& file, std::string_view header, const Read& read) {
  std::istringstream in(datasets::read_text_file(file));
  std::string text;
  const std::string_view known = header.substr(0, header.size() - 1);
  if (!std::getline(in, text) || !text.starts_with(known)) {
    throw datasets::FormatError(file, 1, "is no localization.csv: expected the header '" + std::string(known) + "'");
  }
  std::optional<sensors::Timestamp> above;
  for (int line = 2; std::getline(in, text); ++line) {
    if (datasets::trimmed(text).empty() || text[0] == '#') continue;
    RowReader row(file, line, text);
    const sensors::Timestamp time = read(row);
    if (above && time < *above) {
      throw datasets::FormatError(file, line,
                                  "the time is before that of the row above: expected rows in order of time");
    }
    above = time;
  }
}

}  // namespace

std::string to_line(const LocalizationRow& row) {
  const localization::Localization& l = row.localization;
  const geometry::Pose2& pose = l.estimate.pose;
  const Eigen::Matrix3d& c = l.estimate.covariance;
  const localization::ProtectionLevels& p = l.protection;
  return fmt::format(
      "{},{:.6f},{:.6f},{:.9f},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{:.9e},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{},{},"
      "{:.6f},{:.6f},{:.9f},{:.9f},{}\n",
      l.time, pose.x, pose.y, pose.theta, c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2), l.belief.yes,
      l.belief.no, l.belief.unknown, l.conflict, localization::to_string(l.status), l.detected, l.matched, l.tracked,
      p.position_low_m, p.position_high_m, p.heading_low_rad, p.heading_high_rad, csv_quoted(l.reason));
}

std::vector<LocalizationRow> read_localization(const std::filesystem::path& file) {
  std::vector<LocalizationRow> rows;
  for_each_row(file, kLocalizationHeader, [&](RowReader& read) {
    rows.push_back(read_row(read));
    return rows.back().localization.time;
  });
  return rows;
}

std::vector<ExtendedRow> read_extended_localization(const std::filesystem::path& file,
                                                    std::span<const std::string> more) {
  std::vector<ExtendedRow> rows;
  for_each_row(file, extended_header(more), [&](RowReader& read) {
    LocalizationRow row = read_row(read);
    rows.push_back({std::move(row), read.rest(more.size())});
    return rows.back().row.localization.time;
  });
  return rows;
}

std::string extended_header(std::span<const std::string> more) {
  std::string header(kLocalizationHeader.substr(0, kLocalizationHeader.size() - 1));
  for (const std::string& column : more) header.append(",").append(column);
  return header + "\n";
}

std::string to_line(const ExtendedRow& row) {
  std::string line = to_line(row.row);
  line.pop_back();
  for (const std::string& value : row.more) line.append(",").append(csv_quoted(value));
  return line + "\n";
}

}  // namespace credo::results
