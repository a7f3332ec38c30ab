// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/sensor_weights_file.hpp"

#include "datasets/checked_yaml.hpp"
#include "datasets/number_text.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

constexpr Bounds kAnyWeight{.low = -1e3, .high = 1e3};
constexpr int kWeightDecimals = 5;
constexpr std::size_t kPerLine = 12;

/// What a file of weights begins with.
std::string head(const std::string& format, const std::string& source) {
  std::string text = "format: " + format + "\nsource: '";
  for (const char c : source) text += c == '\'' ? std::string("''") : std::string(1, c);
  return text + "'\n";
}

void append_list(std::string& text, const std::string& key, std::span<const double> weights) {
  text += key + ": [";
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (i > 0) text += i % kPerLine == 0 ? ",\n    " : ", ";
    append_fixed(text, weights[i], kWeightDecimals);
  }
  text += "]\n";
}

void append_length(std::string& text, const std::string& key, double least_m, double sigmas) {
  text += key + ": {least: ";
  append_shortest(text, least_m);
  text += ", sigmas: ";
  append_shortest(text, sigmas);
  text += "}\n";
}

void read_length(const CheckedValue& value, double& least_m, double& sigmas) {
  const CheckedMap keys = value.map({"least", "sigmas"});
  least_m = keys.required("least").number(kPositiveLength);
  sigmas = keys.required("sigmas").number({.low = 0.0, .high = 100.0});
}

LaserModelFile::Weights read_weights(const CheckedValue& value, std::size_t count) {
  const CheckedMap keys = value.map({"free_weight", "hit_weights"});
  return {.free_weight = keys.required("free_weight").number({.low = 0.0, .high = kAnyWeight.high}),
          .hit_weights = keys.required("hit_weights").numbers(count, kAnyWeight)};
}

void append_weights(std::string& text, const std::string& key, const LaserModelFile::Weights& weights) {
  text += key + ":\n  free_weight: ";
  append_fixed(text, weights.free_weight, kWeightDecimals);
  text += "\n  ";
  append_list(text, "hit_weights", weights.hit_weights);
}

}  // namespace

std::vector<double> read_sonar_weights(const std::filesystem::path& file, std::size_t count) {
  const CheckedMap keys = load_yaml(file).map({"format", "source", "weights"});
  (void)keys.required("format").one_of({"credo-sonar-weights/1"});
  return keys.required("weights").numbers(count, kAnyWeight);
}

void write_sonar_weights(const std::filesystem::path& file, std::span<const double> weights,
                         const std::string& source) {
  std::string text = head("credo-sonar-weights/1", source);
  append_list(text, "weights", weights);
  write_file_whole(file, text);
}

LaserModelFile read_laser_weights(const std::filesystem::path& file, std::size_t count) {
  const CheckedMap keys = load_yaml(file).map({"format", "source", "free_margin", "half_width", "summed", "alone"});
  (void)keys.required("format").one_of({"credo-laser-weights/1"});
  LaserModelFile model;
  read_length(keys.required("free_margin"), model.free_margin_m, model.free_margin_sigmas);
  const CheckedValue half_width = keys.required("half_width");
  read_length(half_width, model.half_width_m, model.half_width_sigmas);
  if (model.half_width_m > model.free_margin_m || model.half_width_sigmas > model.free_margin_sigmas)
    half_width.fail("half_width may not be above free_margin, neither its least nor its sigmas");
  model.summed = read_weights(keys.required("summed"), count);
  model.alone = read_weights(keys.required("alone"), count);
  return model;
}

void write_laser_weights(const std::filesystem::path& file, const LaserModelFile& model, const std::string& source) {
  std::string text = head("credo-laser-weights/1", source);
  append_length(text, "free_margin", model.free_margin_m, model.free_margin_sigmas);
  append_length(text, "half_width", model.half_width_m, model.half_width_sigmas);
  append_weights(text, "summed", model.summed);
  append_weights(text, "alone", model.alone);
  write_file_whole(file, text);
}

}  // namespace credo::datasets
