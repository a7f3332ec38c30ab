// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/shape_fitting.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "evidence/predictive_belief.hpp"

namespace credo::evidence {
namespace {

using Samples = std::span<const LabelledSample>;

/// Those whose x is finite, in its order.
std::vector<LabelledSample> usable_by_x(Samples samples) {
  std::vector<LabelledSample> usable;
  std::ranges::copy_if(samples, std::back_inserter(usable), [](const auto& s) { return std::isfinite(s.x); });
  if (usable.empty()) {
    throw std::invalid_argument("samples: found none of " + std::to_string(samples.size()) +
                                " with a finite x, expected at least one");
  }
  std::ranges::stable_sort(usable, {}, &LabelledSample::x);
  return usable;
}

/// At most `count` shares of about equal size, none smaller than `min_size` unless it is the only one. Equal x stay
/// together.
std::vector<Samples> equal_shares(Samples sorted, std::size_t count, std::size_t min_size) {
  count = std::clamp<std::size_t>(sorted.size() / min_size, 1, count);
  std::vector<Samples> shares;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= count; ++i) {
    std::size_t end = sorted.size() * i / count;
    while (end < sorted.size() && sorted[end].x == sorted[end - 1].x) ++end;
    if (end < begin + min_size || sorted.size() < end + min_size) end = i < count ? begin : sorted.size();
    if (end > begin) shares.push_back(sorted.subspan(begin, end - begin));
    begin = end;
  }
  return shares;
}

std::size_t count_true(Samples samples) {
  return static_cast<std::size_t>(std::ranges::count(samples, true, &LabelledSample::label));
}

double mean_x(Samples samples) {
  double sum = 0.0;
  for (const LabelledSample& sample : samples) sum += sample.x;
  return std::clamp(sum / static_cast<double>(samples.size()), samples.front().x, samples.back().x);
}

/// Trials of an event and how often it happened.
struct Count {
  std::size_t yes = 0;
  std::size_t all = 0;

  [[nodiscard]] double frequency() const { return static_cast<double>(yes) / static_cast<double>(all); }
};

/// Pool adjacent violators: neighbours whose frequencies fall are added up until none does. For each count its pool's.
std::vector<Count> pooled_to_rise(const std::vector<Count>& counts) {
  struct Pool {
    Count count;
    std::size_t members = 1;
  };
  std::vector<Pool> pools;
  for (const Count& count : counts) {
    Pool last{.count = count};
    while (!pools.empty() && pools.back().count.frequency() >= last.count.frequency()) {
      last.count.yes += pools.back().count.yes;
      last.count.all += pools.back().count.all;
      last.members += pools.back().members;
      pools.pop_back();
    }
    pools.push_back(last);
  }
  std::vector<Count> result;
  for (const Pool& pool : pools) result.insert(result.end(), pool.members, pool.count);
  return result;
}

double squared_misfit(const std::vector<Count>& counts, const std::vector<Count>& pooled) {
  double sum = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double miss = counts[i].frequency() - pooled[i].frequency();
    sum += static_cast<double>(counts[i].all) * miss * miss;
  }
  return sum;
}

/// Of the event not happening: falls where the other rises.
std::vector<Count> opposite(std::vector<Count> counts) {
  for (Count& count : counts) count.yes = count.all - count.yes;
  return counts;
}

Direction better_direction(const std::vector<Count>& counts) {
  const std::vector<Count> falling = opposite(counts);
  const bool rises = squared_misfit(counts, pooled_to_rise(counts)) <= squared_misfit(falling, pooled_to_rise(falling));
  return rises ? Direction::kRising : Direction::kFalling;
}

/// Bounds never cross here: each holds the frequency of its own pool, and these rise.
std::vector<BinaryMass> rising_masses(const std::vector<Count>& counts, double confidence) {
  std::vector<BinaryMass> masses;
  for (const Count& pool : pooled_to_rise(counts)) {
    masses.push_back(predictive_belief(pool.yes, pool.all, confidence));
  }
  for (std::size_t i = 1; i < masses.size(); ++i) {
    masses[i].yes = std::max(masses[i].yes, masses[i - 1].yes);
    const std::size_t back = masses.size() - 1 - i;
    masses[back].no = std::max(masses[back].no, masses[back + 1].no);
  }
  return masses;
}

std::vector<BinaryMass> monotone_masses(const std::vector<Count>& counts, double confidence, Direction direction) {
  if (direction == Direction::kRising) return rising_masses(counts, confidence);
  std::vector<BinaryMass> masses = rising_masses(opposite(counts), confidence);
  for (BinaryMass& mass : masses) std::swap(mass.yes, mass.no);
  return masses;
}

bool same_committed(const BinaryMass& a, const BinaryMass& b) { return a.yes == b.yes && a.no == b.no; }

void check_at_least_one(const char* name, int found) {
  if (found >= 1) return;
  throw std::invalid_argument(std::string(name) + ": found " + std::to_string(found) + ", expected at least 1");
}

FittedShape fit_sorted(Samples sorted, const ShapeTitle& title, const FitParams& params) {
  const std::vector<Samples> shares =
      equal_shares(sorted, static_cast<std::size_t>(params.breakpoints), static_cast<std::size_t>(params.min_samples));
  std::vector<Count> counts;
  for (const Samples share : shares) counts.push_back({.yes = count_true(share), .all = share.size()});
  const Direction direction = params.direction ? *params.direction : better_direction(counts);
  const std::vector<BinaryMass> masses = monotone_masses(counts, params.confidence, direction);

  std::vector<Breakpoint> breakpoints;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const bool inside = i > 0 && i + 1 < shares.size();
    if (inside && same_committed(masses[i - 1], masses[i]) && same_committed(masses[i], masses[i + 1])) continue;
    breakpoints.push_back({.name = "share " + std::to_string(i + 1) + " of " + std::to_string(shares.size()),
                           .x = mean_x(shares[i]),
                           .yes = masses[i].yes,
                           .no = masses[i].no});
  }
  return {.shape = {title, std::move(breakpoints)}, .direction = direction, .samples = sorted.size()};
}

/// Sums over the samples of a bin.
struct BinSums {
  Count labels;
  double yes = 0.0, no = 0.0, unknown = 0.0, pignistic = 0.0;
  double squared_miss = 0.0;

  [[nodiscard]] bool holds(double lower, double upper) const {  // [lower, upper] meets [mean Bel, mean Pl]
    const auto size = static_cast<double>(labels.all);
    return yes <= size * (upper + kMassTolerance) && no <= size * (1.0 - lower + kMassTolerance);
  }
  [[nodiscard]] bool covered() const { return holds(labels.frequency(), labels.frequency()); }
  [[nodiscard]] bool refutes() const {
    const BinaryMass interval = predictive_belief(labels.yes, labels.all, 0.95);
    return !holds(interval.belief(), interval.plausibility());
  }
};

BinSums sums_of(const PiecewiseBelief& shape, Samples bin) {
  BinSums sums{.labels = {.yes = count_true(bin), .all = bin.size()}};
  for (const LabelledSample& sample : bin) {
    const BinaryMass mass = shape(sample.x);
    const double miss = mass.pignistic() - (sample.label ? 1.0 : 0.0);
    sums.yes += mass.yes;
    sums.no += mass.no;
    sums.unknown += mass.unknown;
    sums.pignistic += mass.pignistic();
    sums.squared_miss += miss * miss;
  }
  return sums;
}

}  // namespace

FittedShape fit_shape(std::span<const LabelledSample> samples, const ShapeTitle& title, const FitParams& params) {
  check_at_least_one("breakpoints", params.breakpoints);
  check_at_least_one("min_samples", params.min_samples);
  const std::vector<LabelledSample> sorted = usable_by_x(samples);
  FittedShape result = fit_sorted(sorted, title, params);
  result.ignored = samples.size() - sorted.size();
  if (sorted.size() < 2) return result;

  std::vector<LabelledSample> halves[2];
  for (std::size_t i = 0; i < sorted.size(); ++i) halves[i % 2].push_back(sorted[i]);
  result.held_out = calibration_of(fit_sorted(halves[0], title, params).shape, halves[1]);
  return result;
}

Calibration calibration_of(const PiecewiseBelief& shape, std::span<const LabelledSample> samples, int bins) {
  check_at_least_one("bins", bins);
  constexpr std::size_t kMinBinSize = 10;
  const std::vector<LabelledSample> sorted = usable_by_x(samples);
  const std::vector<Samples> shares = equal_shares(sorted, static_cast<std::size_t>(bins), kMinBinSize);
  Calibration sum{.samples = sorted.size(), .ignored = samples.size() - sorted.size(), .bins = shares.size()};
  for (const Samples share : shares) {
    const BinSums bin = sums_of(shape, share);
    sum.coverage += bin.covered() ? 1.0 : 0.0;
    sum.refuted += bin.refutes() ? 1.0 : 0.0;
    sum.brier_score += bin.squared_miss;
    sum.calibration_error += std::abs(bin.pignistic - static_cast<double>(bin.labels.yes));
    sum.mean_unknown += bin.unknown;
  }
  for (double* const total : {&sum.coverage, &sum.refuted}) *total /= static_cast<double>(shares.size());
  for (double* const total : {&sum.brier_score, &sum.calibration_error, &sum.mean_unknown}) {
    *total /= static_cast<double>(sorted.size());
  }
  return sum;
}

}  // namespace credo::evidence
