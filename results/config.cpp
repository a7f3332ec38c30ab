// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/config.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ranges>
#include <type_traits>

#include "results/fields.hpp"

namespace credo::results {
namespace {

template <typename E, std::size_t... I>
std::string_view name_of(E value, std::index_sequence<I...>) {
  std::string_view name = "unknown";
  ((static_cast<std::size_t>(value) == I ? void(name = fields::enumerator<static_cast<E>(I)>()) : void()), ...);
  return name;
}

/// kConflictToIgnorance -> conflict_to_ignorance
std::string snake(std::string_view enumerator) {
  std::string result;
  for (const char c : enumerator.substr(enumerator.starts_with('k') ? 1 : 0)) {
    const bool upper = c >= 'A' && c <= 'Z';
    if (upper && !result.empty()) result += '_';
    result += upper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return result;
}

std::string number(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  return fmt::format("{:.12g}", value);
}

template <typename T>
constexpr bool is_matrix = requires(const T& value) {
  value.rows();
  value.cols();
  value(0, 0);
};

template <typename T>
std::string scalar(const T& value) {
  if constexpr (std::is_same_v<T, bool>)
    return value ? "true" : "false";
  else if constexpr (std::is_enum_v<T>)
    return snake(name_of(value, std::make_index_sequence<10>{}));
  else if constexpr (std::is_floating_point_v<T>)
    return number(value);
  else
    return fmt::format("{}", value);
}

template <typename T>
constexpr bool is_sensor_model = std::is_same_v<T, mapping::SonarParams> || std::is_same_v<T, mapping::LaserParams>;

/// In one line: a number, or a list or a map of what fits on one line.
template <typename T>
std::string flow(const T& value) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    return scalar(value);
  } else if constexpr (is_sensor_model<T>) {
    return std::string(mapping::name_of(value));
  } else if constexpr (is_matrix<T>) {
    std::string text = "[";
    for (int i = 0; i < value.size(); ++i)
      text += (i > 0 ? ", " : "") + number(value(i / value.cols(), i % value.cols()));
    return text + "]";
  } else if constexpr (std::ranges::range<T>) {
    std::string text = "[";
    for (const auto& element : value) text += (text.size() > 1 ? ", " : "") + flow(element);
    return text + "]";
  } else {
    std::string text = "{";
    fields::for_each(value, [&](std::string_view name, const auto& field) {
      text += fmt::format("{}{}: {}", text.size() > 1 ? ", " : "", name, flow(field));
    });
    return text + "}";
  }
}

template <typename T>
constexpr bool fits_one_line() {
  return std::is_arithmetic_v<T> || std::is_enum_v<T> || is_matrix<T> || std::ranges::range<T>;
}

/// An aggregate of a few plain values (a mass, the breakpoints of a belief) is one line; others are indented blocks.
template <typename T>
bool is_small(const T& value) {
  if constexpr (fits_one_line<T>())
    return true;
  else {
    bool plain = fields::count<T>() <= 6;
    fields::for_each(value, [&](std::string_view, const auto& field) {
      plain = plain && std::is_floating_point_v<std::decay_t<decltype(field)>>;
    });
    return plain;
  }
}

template <typename T>
void emit(std::string& out, std::string_view name, const T& value, std::size_t depth) {
  const std::string indent(2 * depth, ' ');
  if constexpr (is_sensor_model<T>) {
    out += fmt::format("{}{}:\n{}  model: {}\n", indent, name, indent, mapping::name_of(value));
    std::visit(
        [&](const auto& model) {
          fields::for_each(
              model, [&](std::string_view field_name, const auto& field) { emit(out, field_name, field, depth + 1); });
        },
        value);
  } else if constexpr (fits_one_line<T>()) {
    out += fmt::format("{}{}: {}\n", indent, name, flow(value));
  } else if (depth > 1 && is_small(value)) {
    out += fmt::format("{}{}: {}\n", indent, name, flow(value));
  } else {
    out += fmt::format("{}{}:\n", indent, name);
    fields::for_each(value,
                     [&](std::string_view field_name, const auto& field) { emit(out, field_name, field, depth + 1); });
  }
}

std::string yaml_quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + '"';
}

}  // namespace

std::string to_yaml(const RunConfig& config) {
  std::string out = "# Every parameter of this run, as used.\nformat: credo-results/1\n";
  out += "credo: " + config.version + "\n";
  out += "dataset: " + yaml_quoted(config.dataset) + "\n";
  out += "method: " + scalar(config.localizer.method) + "\n";
  out += "map_poses: " + yaml_quoted(config.map_poses) + "\n";
  const bool paper = config.localizer.method == perception::Method::kPaper;
  out += "belief_yes: >-\n  Mass on \"the localization is correct\", fused by ";
  out += paper
             ? "Dempster's rule from the number of matched primitives, the\n"
               "  share of the detected ones that were matched, and the existence of each track that has a landmark\n"
               "  (Clerentin et al., sec. 4.5).\n"
             : "conflict to ignorance from the number of matched\n"
               "  primitives, the share of the detected ones that the plan explains, the share of the plan's points in "
               "sight that are\n"
               "  recognised, the share of the scan that lies on the plan, the camera's bearings under the pose's "
               "heading, the "
               "agreement of\n  the pose with what is left of it without a landmark, and the mean existence of the "
               "matched "
               "tracks (after Clerentin\n  et al., sec. 4.5). Halved where the pose contradicts its prediction, faded "
               "where nothing is seen.\n";
  out += paper ? "  It is a degree of belief, not a calibrated probability: the paper has no integrity monitor, and "
                 "the protection\n"
                 "  levels (pl_ columns of localization.csv) are nan.\n"
               : "  The protection levels (pl_ columns of localization.csv) are the errors that are exceeded with the "
                 "probability\n"
                 "  localizer.integrity.risk, at the low and the high end of what is known of wrong matches.\n";
  emit(out, "observer", config.observer, 0);
  emit(out, "localizer", config.localizer, 0);
  emit(out, "mapper", config.mapper, 0);
  return out;
}

std::string to_yaml(const mapping::TrajectoryMappingParams& params, const std::string& version,
                    const std::string& source, const std::string& poses) {
  std::string out = "# Every parameter of this map, as used.\nformat: credo-results/1\n";
  out += "credo: " + version + "\nsource: " + yaml_quoted(source) + "\nmap_poses: " + yaml_quoted(poses) + "\n";
  emit(out, "mapping", params, 0);
  return out;
}

std::string to_yaml(const std::string& version, const std::string& source, const std::vector<double>& region) {
  std::string out = "# Where this map is from.\nformat: credo-results/1\n";
  out += "credo: " + version + "\nmap: " + yaml_quoted(source) + "\n";
  if (!region.empty()) out += fmt::format("region_m: [{:g}]\n", fmt::join(region, ", "));
  return out;
}

}  // namespace credo::results
