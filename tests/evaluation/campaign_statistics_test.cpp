// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/campaign_statistics.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "evaluation/localization_score.hpp"
#include "sim/random.hpp"
#include "tests/support/seeded.hpp"

namespace credo::evaluation {
namespace {

constexpr std::size_t kClusters = 5;

struct Case {
  std::vector<ClusteredValue> values;
  std::vector<int> weights;

  /// Every value as often as its cluster counts.
  [[nodiscard]] std::vector<ClusteredValue> written_out() const {
    std::vector<ClusteredValue> all;
    for (const ClusteredValue& v : values) all.insert(all.end(), static_cast<std::size_t>(weights[v.cluster]), v);
    return all;
  }
};

/// Of few different values, so that many are equal.
Case any_case() {
  Case c;
  c.values.resize(static_cast<std::size_t>(*rc::gen::inRange(0, 40)));
  for (ClusteredValue& v : c.values)
    v = {0.1 * *rc::gen::inRange(0, 11), static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(kClusters))),
         *rc::gen::arbitrary<bool>()};
  for (std::size_t i = 0; i < kClusters; ++i) c.weights.push_back(*rc::gen::inRange(0, 4));
  return c;
}

bool near(const std::optional<double>& a, const std::optional<double>& b) {
  return a.has_value() == b.has_value() && (!a || std::abs(*a - *b) < 1e-12);
}

RC_GTEST_PROP(ClusteredValuesLaw, AWeightIsARepetition, ()) {
  const Case c = any_case();
  const std::vector<ClusteredValue> all = c.written_out();
  const std::vector<int> once(kClusters, 1);
  RC_ASSERT(near(ClusteredValues(c.values).quantile(0.9, c.weights), ClusteredValues(all).quantile(0.9, once)));
  RC_ASSERT(near(ClusteredValues(c.values).auroc(c.weights), ClusteredValues(all).auroc(once)));
}

RC_GTEST_PROP(ClusteredValuesLaw, AurocIsThatOfTheWords, ()) {
  const Case c = any_case();
  std::vector<double> good, bad;
  for (const ClusteredValue& v : c.written_out()) (v.good ? good : bad).push_back(v.value);
  RC_ASSERT(near(ClusteredValues(c.values).auroc(c.weights), auroc(good, bad)));
}

/// Values that differ: of equal ones the order among themselves matters at the edge of a bin.
RC_GTEST_PROP(ClusteredValuesLaw, CalibrationErrorIsThatOfTheWords, ()) {
  Case c = any_case();
  for (std::size_t i = 0; i < c.values.size(); ++i) c.values[i].value += 1e-3 * static_cast<double>(i);
  const std::vector<ClusteredValue> all = c.written_out();
  const auto error = ClusteredValues(c.values).calibration_error(c.weights);
  RC_ASSERT(error.has_value() == !all.empty());
  std::vector<double> values;
  std::vector<bool> good;
  for (const ClusteredValue& v : all) {
    values.push_back(v.value);
    good.push_back(v.good);
  }
  RC_ASSERT(near(error.value_or(0.0), calibration_error(values, good)));
}

TEST(ClusteredValues, QuantileIsTheSmallestThatCoversTheShare) {
  const ClusteredValues values({{3.0, 0}, {1.0, 0}, {2.0, 1}, {4.0, 1}});
  const std::vector<int> once{1, 1}, second{0, 1}, none{0, 0};
  EXPECT_EQ(values.quantile(0.5, once), 2.0);
  EXPECT_EQ(values.quantile(0.51, once), 3.0);
  EXPECT_EQ(values.quantile(1.0, once), 4.0);
  EXPECT_EQ(values.quantile(0.5, second), 2.0);
  EXPECT_EQ(values.quantile(0.5, none), std::nullopt);
}

TEST(Bootstrap, CoversTheMeanAsOftenAsItSays) {
  int covered = 0;
  constexpr int kTimes = 400;
  constexpr std::size_t kDrives = 40;
  for (int i = 0; i < kTimes; ++i) {
    sim::Random random(11, 0, static_cast<std::uint64_t>(i));
    ClusteredRatio mean(kDrives);
    for (std::size_t k = 0; k < kDrives; ++k) mean.add(k, random.normal(), 1.0);
    const auto e = bootstrap(kDrives, mean, {.resamples = 200, .seed = 3});
    covered += e->low <= 0.0 && e->high >= 0.0 ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(covered) / kTimes, 0.95, 0.03);
}

TEST(Bootstrap, DrawsWholeClusters) {
  // Two drives of 100 acquisitions each that agree within a drive: the mean of two, not of 200.
  ClusteredRatio mean(2);
  mean.add(0, 0.0, 100.0);
  mean.add(1, 100.0, 100.0);
  const auto e = bootstrap(2, mean);
  EXPECT_EQ(e->value, 0.5);
  EXPECT_EQ(e->low, 0.0);
  EXPECT_EQ(e->high, 1.0);
}

TEST(Bootstrap, SaysNothingOfTheSpreadOfOne) {
  ClusteredRatio mean(1);
  mean.add(0, 3.0, 2.0);
  const auto e = bootstrap(1, mean);
  EXPECT_EQ(e->value, 1.5);
  EXPECT_TRUE(std::isnan(e->low) && std::isnan(e->high));
  EXPECT_FALSE(bootstrap(3, ClusteredRatio(3)));
}

TEST(Bootstrap, GivesTheSameForTheSameSeed) {
  ClusteredRatio mean(20);
  for (std::size_t i = 0; i < 20; ++i) mean.add(i, static_cast<double>(i * i), 1.0);
  const auto a = bootstrap(20, mean, {.seed = 1}), b = bootstrap(20, mean, {.seed = 1}),
             c = bootstrap(20, mean, {.seed = 2});
  EXPECT_EQ(a->low, b->low);
  EXPECT_EQ(a->high, b->high);
  EXPECT_NE(a->low, c->low);
}

}  // namespace
}  // namespace credo::evaluation
