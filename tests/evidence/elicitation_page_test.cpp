// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// Every table of docs/evidence/elicitation.md, computed again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "evidence/piecewise_belief.hpp"
#include "evidence/sensor_matching.hpp"
#include "evidence/shape_fitting.hpp"
#include "tests/evidence/labelled_samples.hpp"

namespace credo::evidence {
namespace {

using ::testing::HasSubstr;

std::string page() {
  std::ifstream file(CREDO_SOURCE_DIR "/docs/evidence/elicitation.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// "| first | 0.10 | 0.20 |\n"
std::string row(const std::string& first, const std::vector<double>& cells, int decimals) {
  std::string text = "| " + first + " |";
  for (const double cell : cells) {
    char number[40];
    std::snprintf(number, sizeof number, " %.*f |", decimals, cell);
    text += number;
  }
  return text + '\n';
}

std::string row_of(const std::string& first, const BinaryMass& mass, int decimals) {
  return row(first, {mass.yes, mass.no, mass.unknown}, decimals);
}

/// What stands in the page's block of code that begins so.
std::string block(const std::string& beginning) {
  const std::string text = page();
  const std::size_t begin = text.find("```\n" + beginning);
  if (begin == std::string::npos) return {};
  return text.substr(begin + 4, text.find("```", begin + 4) - begin - 4);
}

TEST(ElicitationPage, ShapeThatIsShownIsReadAndGivesTheTable) {
  const PiecewiseBelief shape = read_piecewise_belief(block("shape alignment"));
  EXPECT_EQ(to_text(shape), block("shape alignment"));
  std::string table;
  for (const int x : {0, 1, 2, 3, 5}) table += row_of(std::to_string(x), shape(x), 2);
  EXPECT_THAT(page(), HasSubstr(table));
}

TEST(ElicitationPage, FittedShapeGivesTheTable) {
  std::vector<LabelledSample> samples;
  const std::size_t happened[] = {1, 8, 6, 19};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 20; ++k) samples.push_back({static_cast<double>(i + 1), k < happened[i]});
  }
  const PiecewiseBelief shape = fit_shape(samples, {.name = "n", .quantity = "x", .unit = "1"}).shape;
  std::string table;
  for (int x = 1; x <= 4; ++x) {
    const std::string first = std::to_string(x) + " | " + std::to_string(happened[x - 1]) + " of 20";
    table += row_of(first, shape(x), 3);
  }
  EXPECT_THAT(page(), HasSubstr(table));
}

TEST(ElicitationPage, FittedShapesHoldTheTruthAsMeasured) {
  std::string table;
  for (const std::size_t count : {30u, 100u, 1000u, 10'000u}) {
    std::vector<double> cells;
    for (const auto truth : {rising_truth, flat_truth}) {
      const HeldTruth sure = held_truth(truth, count, .95);
      const HeldTruth bold = held_truth(truth, count, .8);
      cells.insert(cells.end(), {sure.held, sure.unknown, bold.held, bold.unknown});
    }
    table += row(std::to_string(count), cells, 2);
  }
  EXPECT_THAT(page(), HasSubstr(table));
}

TEST(ElicitationPage, RepeatedReadingsPartBetPMatchingFromDempster) {
  const BinaryMass reading{.5, .1, .4};
  const auto bayes = [&](std::size_t count, Matching matching) {
    return 1.0 / (1.0 + std::exp(-static_cast<double>(count) * matched_log_odds(reading, matching)));
  };
  std::string table;
  for (const std::size_t count : {1u, 2u, 5u, 10u}) {
    const BinaryMass fused = dempster(std::vector<BinaryMass>(count, reading))->mass;
    table += row(std::to_string(count),
                 {matched_probability(fused, Matching::kPlausibility), bayes(count, Matching::kPlausibility),
                  matched_probability(fused, Matching::kPignistic), bayes(count, Matching::kPignistic)},
                 4);
  }
  EXPECT_THAT(page(), HasSubstr(table));
}

TEST(ElicitationPage, MostUnknownMassesGiveTheTable) {
  std::string table;
  for (const double p : {.5, .6, .7, .9}) {
    const BinaryMass by_betp = most_unknown_with(p, Matching::kPignistic);
    const BinaryMass by_plp = most_unknown_with(p, Matching::kPlausibility);
    char first[8];
    std::snprintf(first, sizeof first, "%.1f", p);
    table += row(first, {by_betp.yes, by_betp.unknown, by_plp.yes, by_plp.unknown}, 3);
  }
  EXPECT_THAT(page(), HasSubstr(table));
}

}  // namespace
}  // namespace credo::evidence
