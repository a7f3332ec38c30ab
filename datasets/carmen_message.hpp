// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/format_error.hpp"
#include "datasets/number_text.hpp"
#include "datasets/text_file.hpp"
#include "datasets/trajectory.hpp"
#include "geometry/pose.hpp"

namespace credo::datasets {

/// One line of a CARMEN log, word by word: a name and what follows. Whatever does not fit is a FormatError.
class Message {
 public:
  Message(const std::filesystem::path& file, int line, std::string_view text) : file_(&file), line_(line) {
    for (std::size_t begin = text.find_first_not_of(kSpace); begin != std::string_view::npos;) {
      const std::size_t end = std::min(text.find_first_of(kSpace, begin), text.size());
      words_.push_back(text.substr(begin, end - begin));
      begin = text.find_first_not_of(kSpace, end);
    }
  }

  [[nodiscard]] std::string_view name() const { return words_.empty() ? std::string_view() : words_.front(); }
  [[nodiscard]] std::size_t left() const { return words_.size() - next_; }
  [[nodiscard]] std::string_view word() {
    if (left() == 0) fail("ends too early: the message is truncated");
    return words_[next_++];
  }
  [[nodiscard]] double number() {
    const std::string_view text = word();
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) fail("expected a number, found " + in_quotes(text));
    return value;
  }
  [[nodiscard]] double finite() {
    const double value = number();
    if (!(std::abs(value) <= kLargestLength_m)) fail("expected a finite number, found " + std::to_string(value));
    return value;
  }
  [[nodiscard]] int count() {
    const double value = number();
    if (!(value >= 1.0 && value <= kLargestCount) || value != std::floor(value)) {
      std::string found;
      append_shortest(found, value);
      fail("expected how many readings follow, 1 to " + std::to_string(kLargestCount) + ", found " + found);
    }
    return static_cast<int>(value);
  }
  [[nodiscard]] geometry::Pose2 pose() {
    const double x = finite(), y = finite(), theta = finite();
    return {x, y, geometry::wrap_angle(theta)};
  }
  [[nodiscard]] int count_or_zero() {
    if (left() != 0 && words_[next_] == "0") return ++next_, 0;
    return count();
  }
  void skip(std::size_t words) {
    for (std::size_t i = 0; i < words; ++i) (void)word();
  }
  /// The time at the end: "ipc_time host logger_time"; 0 where there is none.
  [[nodiscard]] sensors::Timestamp time() {
    if (left() == 0) return 0;
    const std::string_view text = word();
    try {
      return parse_seconds(text);
    } catch (const std::invalid_argument& error) {
      fail(error.what());
    }
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw FormatError(*file_, line_, std::string(name()) + ": " + message);
  }

 private:
  static constexpr double kLargestLength_m = 1e6;
  static constexpr int kLargestCount = 100'000;
  static constexpr std::string_view kSpace = " \t\r";
  const std::filesystem::path* file_;
  int line_;
  std::vector<std::string_view> words_;
  std::size_t next_ = 1;
};

}  // namespace credo::datasets
