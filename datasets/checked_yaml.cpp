// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/checked_yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "datasets/format_error.hpp"
#include "datasets/nearest_word.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

/// The whole text as a finite or infinite number; nothing where it is none.
std::optional<double> parse_number(std::string_view text) {
  if (text == ".nan" || text == ".NaN" || text == ".NAN") return std::nan("");
  bool negative = false;
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) {
    negative = text.front() == '-';
    text.remove_prefix(1);
  }
  if (text == ".inf" || text == ".Inf" || text == ".INF") text.remove_prefix(1);
  if (text.empty() || text.front() == '-') return std::nullopt;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range)
    value = HUGE_VAL;
  else if (error != std::errc{})
    return std::nullopt;
  return negative ? -value : value;
}

std::string shortest(double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, result.ptr};
}

std::string described(const Bounds& bounds) {
  const bool bounded_below = bounds.low > -kLargestLength_m, bounded_above = bounds.high < kLargestLength_m;
  const std::string low = (bounds.low_open ? "above " : "at least ") + shortest(bounds.low);
  const std::string high = "at most " + shortest(bounds.high);
  if (bounded_below && bounded_above) return "a number " + low + " and " + high;
  if (bounded_below) return "a number " + low;
  return bounded_above ? "a number " + high : "a finite number";
}

int line_of(const YAML::Node& node) { return node.Mark().line + 1; }

}  // namespace

CheckedValue::CheckedValue(std::shared_ptr<const std::filesystem::path> file, const YAML::Node& node, std::string name,
                           int line)
    : file_(std::move(file)), node_(node), name_(std::move(name)), line_(line) {}

void CheckedValue::fail(const std::string& message) const { throw FormatError(*file_, line_, message); }

std::string CheckedValue::found() const {
  if (node_.IsMap()) return "a map";
  if (node_.IsSequence()) return "a list of " + std::to_string(node_.size());
  return node_.IsScalar() ? in_quotes(node_.Scalar()) : "nothing";
}

std::string_view CheckedValue::scalar(std::string_view expected) const {
  if (!node_.IsScalar()) fail(name_ + ": expected " + std::string(expected) + ", found " + found());
  return node_.Scalar();
}

double CheckedValue::number(const Bounds& bounds) const {
  const std::string_view text = scalar(described(bounds));
  const std::optional<double> value = parse_number(text);
  const bool allowed = value && std::isfinite(*value) && *value <= bounds.high &&
                       (bounds.low_open ? *value > bounds.low : *value >= bounds.low);
  if (!allowed) {
    const bool only_too_large = value && std::abs(*value) > kLargestLength_m && std::isfinite(*value);
    fail(name_ + ": expected " + described(bounds) + ", found " + in_quotes(text) +
         (only_too_large ? " (beyond 1e6)" : ""));
  }
  return *value;
}

int CheckedValue::integer(int low, int high) const {
  const std::string expected = "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  const std::string_view text = scalar(expected);
  long long value = 0;
  const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < low || value > high)
    fail(name_ + ": expected " + expected + ", found " + in_quotes(text));
  return static_cast<int>(value);
}

std::string CheckedValue::text() const { return std::string(scalar("a word or a line of text")); }

std::size_t CheckedValue::one_of(std::initializer_list<std::string_view> words) const {
  const std::vector<std::string> known(words.begin(), words.end());
  const std::string_view text = scalar("one of " + joined(known));
  const auto at = std::find(words.begin(), words.end(), text);
  if (at != words.end()) return static_cast<std::size_t>(at - words.begin());
  const auto nearest = nearest_word(text, known);
  const std::string expected = known.size() == 1 ? in_quotes(known.front()) : "one of " + joined(known);
  fail(name_ + ": expected " + expected + ", found " + in_quotes(text) +
       (nearest && known.size() > 1 ? "; did you mean '" + *nearest + "'?" : ""));
}

std::vector<CheckedValue> CheckedValue::items(std::size_t size) const {
  const std::string expected = size == 0 ? "a list [...]" : "a list of " + std::to_string(size);
  if (!node_.IsSequence() || (size != 0 && node_.size() != size))
    fail(name_ + ": expected " + expected + ", found " + found());
  std::vector<CheckedValue> all;
  all.reserve(node_.size());
  for (const YAML::Node& item : node_)
    all.emplace_back(file_, item, name_ + "[" + std::to_string(all.size()) + "]", line_of(item));
  return all;
}

std::vector<double> CheckedValue::numbers(std::size_t size, const Bounds& bounds) const {
  std::vector<double> values;
  for (const CheckedValue& item : items(size)) values.push_back(item.number(bounds));
  return values;
}

geometry::Pose2 CheckedValue::pose(const Bounds& lengths) const {
  const std::vector<CheckedValue> xyt = items(3);
  return {xyt[0].number(lengths), xyt[1].number(lengths), geometry::wrap_angle(xyt[2].number(kAnyAngle))};
}

CheckedMap CheckedValue::map(std::initializer_list<std::string_view> known_keys) const {
  return CheckedMap(file_, node_, name_, line_, known_keys);
}

CheckedMap::CheckedMap(std::shared_ptr<const std::filesystem::path> file, const YAML::Node& node, std::string name,
                       int line, std::initializer_list<std::string_view> known_keys)
    : file_(std::move(file)), name_(std::move(name)), line_(line) {
  const std::vector<std::string> known(known_keys.begin(), known_keys.end());
  if (!node.IsMap()) fail((name_.empty() ? "" : name_ + ": ") + "expected keys and values (" + joined(known) + ")");
  for (const auto& entry : node) {
    const YAML::Node& key_node = entry.first;
    const YAML::Node& value = entry.second;
    const int key_line = line_of(key_node);
    if (!key_node.IsScalar()) throw FormatError(*file_, key_line, "expected a key, found a list or a map");
    const std::string& key = key_node.Scalar();
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      const auto nearest = nearest_word(key, known);
      throw FormatError(*file_, key_line,
                        "unknown key " + in_quotes(key) + (name_.empty() ? "" : " in " + name_) +
                            (nearest ? "; did you mean '" + *nearest + "'?" : "; known keys: " + joined(known)));
    }
    if (const auto earlier = optional(key))
      throw FormatError(*file_, key_line,
                        "the key " + in_quotes(key) + " comes twice; first in line " + std::to_string(earlier->line()));
    values_.emplace_back(key, CheckedValue(file_, value, name_.empty() ? key : name_ + "." + key, key_line));
  }
}

std::optional<CheckedValue> CheckedMap::optional(std::string_view key) const {
  for (const auto& [name, value] : values_)
    if (name == key) return value;
  return std::nullopt;
}

CheckedValue CheckedMap::required(std::string_view key) const {
  if (const auto value = optional(key)) return *value;
  fail("the key '" + std::string(key) + "' is missing" + (name_.empty() ? "" : " in " + name_));
}

void CheckedMap::fail(const std::string& message) const { throw FormatError(*file_, line_, message); }

CheckedValue load_yaml(const std::filesystem::path& file) {
  const std::string content = read_text_file(file);
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(content);
    if (documents.empty() || documents.front().IsNull())
      throw FormatError(file, 0, "is empty; expected keys and values");
    if (documents.size() > 1) throw FormatError(file, 0, "holds more than one YAML document; expected one");
    return {std::make_shared<const std::filesystem::path>(file), documents.front(), "", 1};
  } catch (const YAML::Exception& error) {
    throw FormatError(file, error.mark.is_null() ? 0 : error.mark.line + 1, "is not valid YAML: " + error.msg);
  }
}

}  // namespace credo::datasets
