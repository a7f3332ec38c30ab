// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <yaml-cpp/node/node.h>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/pose.hpp"

/// YAML files read with suspicion: every key known, every number finite and within bounds, every complaint with its
/// line. For sources, not for headers: it drags in yaml-cpp.
namespace credo::datasets {

/// Lengths beyond this are a mistake of the file, not a building. [m]
inline constexpr double kLargestLength_m = 1e6;

/// What a number may be; the ends belong to it.
struct Bounds {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  bool low_open = false;  ///< `low` itself is not allowed
};
inline constexpr Bounds kAnyLength{.low = -kLargestLength_m, .high = kLargestLength_m};
inline constexpr Bounds kLength{.low = 0.0, .high = kLargestLength_m};
inline constexpr Bounds kPositiveLength{.low = 0.0, .high = kLargestLength_m, .low_open = true};
inline constexpr Bounds kAnyAngle{.low = -1e4, .high = 1e4};
inline constexpr Bounds kSigma{.low = 0.0, .high = 1e3};

class CheckedMap;

/// A value of a YAML file that knows where it stands and what it is called. Every reader throws FormatError.
class CheckedValue {
 public:
  CheckedValue(std::shared_ptr<const std::filesystem::path> file, const YAML::Node& node, std::string name, int line);

  [[nodiscard]] double number(const Bounds& bounds = {}) const;
  [[nodiscard]] int integer(int low, int high) const;
  [[nodiscard]] std::string text() const;
  /// One of the words, by its position in the list; suggests the nearest for any other.
  [[nodiscard]] std::size_t one_of(std::initializer_list<std::string_view> words) const;
  /// \param size  expected number of items; 0 = any
  [[nodiscard]] std::vector<CheckedValue> items(std::size_t size = 0) const;
  [[nodiscard]] std::vector<double> numbers(std::size_t size, const Bounds& bounds = {}) const;
  [[nodiscard]] geometry::Pose2 pose(const Bounds& lengths = kAnyLength) const;  ///< [x, y, theta]
  [[nodiscard]] CheckedMap map(std::initializer_list<std::string_view> known_keys) const;

  [[nodiscard]] int line() const { return line_; }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  [[nodiscard]] std::string found() const;
  [[nodiscard]] std::string_view scalar(std::string_view expected) const;

  std::shared_ptr<const std::filesystem::path> file_;
  YAML::Node node_;
  std::string name_;
  int line_;
};

/// The keys of a YAML map, checked when it is made: each is known and comes once.
class CheckedMap {
 public:
  CheckedMap(std::shared_ptr<const std::filesystem::path> file, const YAML::Node& node, std::string name, int line,
             std::initializer_list<std::string_view> known_keys);

  [[nodiscard]] CheckedValue required(std::string_view key) const;
  [[nodiscard]] std::optional<CheckedValue> optional(std::string_view key) const;
  [[nodiscard]] int line() const { return line_; }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::shared_ptr<const std::filesystem::path> file_;
  std::string name_;
  int line_;
  std::vector<std::pair<std::string, CheckedValue>> values_;
};

/// Reads a YAML file of one document as a value. \throws FormatError: missing, empty, not YAML, binary.
[[nodiscard]] CheckedValue load_yaml(const std::filesystem::path& file);

}  // namespace credo::datasets
