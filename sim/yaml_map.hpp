// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <yaml-cpp/yaml.h>
#include <Eigen/Core>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace credo::sim {

/// A YAML map that knows which keys were asked for, so that one that nobody knows is an error that names the file, the
/// line and the nearest known key. `close` must be called when all keys have been read.
class YamlMap {
 public:
  static constexpr double kLargest = 1e6;  ///< of any number, in either direction

  /// \throws std::runtime_error  unless the node is a map.
  YamlMap(const YAML::Node& node, std::string file, std::string what);

  [[nodiscard]] bool has(const std::string& key);
  [[nodiscard]] YAML::Node child(const std::string& key);           ///< an undefined node where it is absent
  [[nodiscard]] YamlMap map(const std::string& key);                ///< \throws where it is absent
  [[nodiscard]] std::vector<YamlMap> maps(const std::string& key);  ///< of a list of maps; empty where it is absent

  [[nodiscard]] double number(const std::string& key, double fallback);
  [[nodiscard]] double number(const std::string& key);  ///< \throws where it is absent
  [[nodiscard]] int integer(const std::string& key, int fallback);
  [[nodiscard]] bool flag(const std::string& key, bool fallback);
  [[nodiscard]] std::string text(const std::string& key, const std::string& fallback);
  /// \throws where the number is not from `low` to `high`
  [[nodiscard]] double number_within(const std::string& key, double fallback, double low, double high);
  [[nodiscard]] int integer_within(const std::string& key, int fallback, int low, int high);
  /// A list of `count` numbers. \throws where it is absent or of another length
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count);
  [[nodiscard]] std::vector<double> numbers_of(const YAML::Node& node, std::size_t count, const std::string& key) const;
  [[nodiscard]] Eigen::Vector2d point(const std::string& key);
  /// A list of points [x, y].
  [[nodiscard]] std::vector<Eigen::Vector2d> points(const std::string& key);

  /// \throws std::runtime_error  at a key that was not asked for.
  void close() const;
  /// \throws std::runtime_error  "file:line: message" at the line of a key, or of the map where it is absent.
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;

 private:
  template <typename T>
  [[nodiscard]] T value(const std::string& key, const T& fallback, const char* expected);
  YAML::Node node_;
  std::string file_;
  std::string what_;
  std::vector<std::string> known_;
};

/// Runs `build`, which knows no file, and says where its complaint (std::invalid_argument) belongs: at `key`.
void placed(const YamlMap& map, const std::string& key, const std::function<void()>& build);

// Numbers of one sign, and shares. They throw as number_within.
[[nodiscard]] double not_negative(YamlMap& map, const std::string& key, double fallback);
[[nodiscard]] double positive(YamlMap& map, const std::string& key, double fallback, double least = 1e-4);
[[nodiscard]] double share(YamlMap& map, const std::string& key, double fallback);

/// The member of `known` with the least edit distance to `word`; empty if none is near.
[[nodiscard]] std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace credo::sim
