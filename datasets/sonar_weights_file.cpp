// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/sonar_weights_file.hpp"

#include "datasets/checked_yaml.hpp"
#include "datasets/number_text.hpp"
#include "datasets/text_file.hpp"

namespace credo::datasets {
namespace {

constexpr Bounds kAnyWeight{.low = -1e3, .high = 1e3};
constexpr int kWeightDecimals = 5;
constexpr std::size_t kPerLine = 12;

}  // namespace

std::vector<double> read_sonar_weights(const std::filesystem::path& file, std::size_t count) {
  const CheckedMap keys = load_yaml(file).map({"format", "source", "weights"});
  (void)keys.required("format").one_of({"credo-sonar-weights/1"});
  return keys.required("weights").numbers(count, kAnyWeight);
}

void write_sonar_weights(const std::filesystem::path& file, std::span<const double> weights,
                         const std::string& source) {
  std::string text = "format: credo-sonar-weights/1\nsource: '";
  for (const char c : source) text += c == '\'' ? std::string("''") : std::string(1, c);
  text += "'\nweights: [";
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (i > 0) text += i % kPerLine == 0 ? ",\n  " : ", ";
    append_fixed(text, weights[i], kWeightDecimals);
  }
  write_file_whole(file, text + "]\n");
}

}  // namespace credo::datasets
