// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/yaml_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace credo::sim {
namespace {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row.back();
}

std::string location(const std::string& file, const YAML::Mark& mark) {
  return file + ":" + std::to_string(mark.line + 1) + ": ";
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 2) + 1;
  for (const std::string& candidate : known)
    if (const std::size_t distance = edit_distance(word, candidate); distance < least) {
      least = distance;
      best = candidate;
    }
  return best;
}

YamlMap::YamlMap(const YAML::Node& node, std::string file, std::string what)
    : node_(node), file_(std::move(file)), what_(std::move(what)) {
  if (!node_.IsMap())
    throw std::runtime_error(location(file_, node_.Mark()) + what_ + " must be a map of keys and values");
}

bool YamlMap::has(const std::string& key) { return child(key).IsDefined(); }

YAML::Node YamlMap::child(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  const YAML::Node& node = node_;  // the subscript of a const node adds no key
  return node[key];
}

YamlMap YamlMap::map(const std::string& key) {
  const YAML::Node node = child(key);
  if (!node.IsDefined()) fail(key, what_ + " needs the key '" + key + "'");
  return {node, file_, key};
}

std::vector<YamlMap> YamlMap::maps(const std::string& key) {
  std::vector<YamlMap> items;
  const YAML::Node node = child(key);
  if (!node.IsDefined()) return items;
  if (!node.IsSequence()) fail(key, "'" + key + "' must be a list");
  for (const YAML::Node& item : node) items.emplace_back(item, file_, "an entry of '" + key + "'");
  return items;
}

template <typename T>
T YamlMap::value(const std::string& key, const T& fallback, const char* expected) {
  const YAML::Node node = child(key);
  if (!node.IsDefined()) return fallback;
  try {
    return node.as<T>();
  } catch (const YAML::Exception&) {
    fail(key, "'" + key + "' must be " + expected);
  }
}

double YamlMap::number(const std::string& key, double fallback) {
  const double result = value<double>(key, fallback, "a number");
  if (!(std::abs(result) <= kLargest)) fail(key, "'" + key + "' must be a finite number (within 1e6)");
  return result;
}

double YamlMap::number_within(const std::string& key, double fallback, double low, double high) {
  const double result = number(key, fallback);
  if (!(result >= low && result <= high)) {
    std::ostringstream message;
    message << "'" << key << "' must be from " << low << " to " << high << ", not " << result;
    fail(key, message.str());
  }
  return result;
}

double YamlMap::number(const std::string& key) {
  if (!has(key)) fail(key, what_ + " needs the key '" + key + "'");
  return number(key, 0.0);
}

int YamlMap::integer(const std::string& key, int fallback) { return value<int>(key, fallback, "a whole number"); }
int YamlMap::integer_within(const std::string& key, int fallback, int low, int high) {
  const int result = integer(key, fallback);
  if (result < low || result > high)
    fail(key, "'" + key + "' must be a whole number from " + std::to_string(low) + " to " + std::to_string(high) +
                  ", not " + std::to_string(result));
  return result;
}
bool YamlMap::flag(const std::string& key, bool fallback) { return value<bool>(key, fallback, "true or false"); }
std::string YamlMap::text(const std::string& key, const std::string& fallback) {
  return value<std::string>(key, fallback, "a text");
}

std::vector<double> YamlMap::numbers_of(const YAML::Node& node, std::size_t count, const std::string& key) const {
  const std::string expected =
      "'" + key + "' must be a list of " + std::to_string(count) + " numbers (finite, within 1e6)";
  const auto where = [&] { return location(file_, node.IsDefined() ? node.Mark() : node_.Mark()); };
  if (!node.IsDefined() || !node.IsSequence() || node.size() != count) throw std::runtime_error(where() + expected);
  std::vector<double> numbers;
  for (const YAML::Node& item : node) {
    try {
      numbers.push_back(item.as<double>());
    } catch (const YAML::Exception&) {
      throw std::runtime_error(where() + expected);
    }
    if (!(std::abs(numbers.back()) <= kLargest)) throw std::runtime_error(where() + expected);
  }
  return numbers;
}

std::vector<double> YamlMap::numbers(const std::string& key, std::size_t count) {
  return numbers_of(child(key), count, key);
}

Eigen::Vector2d YamlMap::point(const std::string& key) {
  const std::vector<double> p = numbers(key, 2);
  return {p[0], p[1]};
}

std::vector<Eigen::Vector2d> YamlMap::points(const std::string& key) {
  const YAML::Node node = child(key);
  if (!node.IsDefined() || !node.IsSequence()) fail(key, "'" + key + "' must be a list of points [x, y]");
  std::vector<Eigen::Vector2d> points;
  for (const YAML::Node& item : node) {
    const std::vector<double> p = numbers_of(item, 2, key);
    points.emplace_back(p[0], p[1]);
  }
  return points;
}

void YamlMap::close() const {
  std::vector<std::string> seen;
  for (const auto& entry : node_) {
    if (!entry.first.IsScalar())
      throw std::runtime_error(location(file_, entry.first.Mark()) + "expected a key in " + what_ +
                               ", found a list or a map");
    const std::string& key = entry.first.Scalar();
    if (std::find(seen.begin(), seen.end(), key) != seen.end())
      throw std::runtime_error(location(file_, entry.first.Mark()) + "the key '" + key + "' comes twice in " + what_);
    seen.push_back(key);
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const std::string near = nearest_word(key, known_);
    throw std::runtime_error(location(file_, entry.first.Mark()) + "unknown key '" + key + "' in " + what_ +
                             (near.empty() ? "" : ": did you mean '" + near + "'?"));
  }
}

void YamlMap::fail(const std::string& key, const std::string& message) const {
  const YAML::Node& map = node_;
  const YAML::Node node = map[key];
  throw std::runtime_error(location(file_, node.IsDefined() ? node.Mark() : map.Mark()) + message);
}

void placed(const YamlMap& map, const std::string& key, const std::function<void()>& build) {
  try {
    build();
  } catch (const std::invalid_argument& error) {
    map.fail(key, error.what());
  }
}

double not_negative(YamlMap& map, const std::string& key, double fallback) {
  return map.number_within(key, fallback, 0.0, YamlMap::kLargest);
}

double positive(YamlMap& map, const std::string& key, double fallback, double least) {
  return map.number_within(key, fallback, least, YamlMap::kLargest);
}

double share(YamlMap& map, const std::string& key, double fallback) {
  return map.number_within(key, fallback, 0.0, 1.0);
}

}  // namespace credo::sim
