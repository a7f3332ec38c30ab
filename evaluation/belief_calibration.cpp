// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/belief_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace credo::evaluation {
namespace {

std::vector<std::size_t> rising_order(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

}  // namespace

Reliability reliability(std::span<const double> probabilities, const std::vector<bool>& came_true, int bins) {
  constexpr double kLeastProbability = 1e-6;
  Reliability result;
  const std::size_t n = probabilities.size();
  if (n == 0) return result;
  const std::vector<std::size_t> order = rising_order(probabilities);
  const auto count = static_cast<std::size_t>(bins);
  double deviations = 0.0, squares = 0.0, logs = 0.0;
  for (std::size_t bin = 0; bin < count; ++bin) {
    ReliabilityBin b;
    double expected = 0.0;
    for (std::size_t k = n * bin / count; k < n * (bin + 1) / count; ++k) {
      const double p = probabilities[order[k]];
      const bool is_true = came_true[order[k]];
      expected += p;
      b.came_true.add(is_true);
      squares += std::pow(p - (is_true ? 1.0 : 0.0), 2);
      logs -= std::log(std::max(kLeastProbability, is_true ? p : 1.0 - p));
    }
    if (b.came_true.of == 0) continue;
    deviations += std::abs(expected - static_cast<double>(b.came_true.count));
    b.probability = expected / static_cast<double>(b.came_true.of);
    result.bins.push_back(b);
  }
  result.calibration_error = deviations / static_cast<double>(n);
  result.brier = squares / static_cast<double>(n);
  result.log_loss = logs / static_cast<double>(n);
  return result;
}

double calibration_error(std::span<const double> probabilities, const std::vector<bool>& came_true, int bins) {
  return reliability(probabilities, came_true, bins).calibration_error;
}

bool BeliefBin::agrees() const {
  const Bounds frequency = came_true.interval();
  return frequency.lower <= plausibility && belief <= frequency.upper;
}

IntervalCalibration interval_calibration(std::span<const evidence::BinaryMass> beliefs,
                                         const std::vector<bool>& came_true, int per_side) {
  const auto place = [per_side](double value) {
    return std::clamp(static_cast<int>(std::floor(value * per_side)), 0, per_side - 1);
  };
  std::map<std::pair<int, int>, BeliefBin> grid;
  IntervalCalibration result;
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    const double belief = beliefs[i].belief(), plausibility = beliefs[i].plausibility();
    BeliefBin& bin = grid[{place(belief), place(plausibility)}];
    bin.belief += belief;
    bin.plausibility += plausibility;
    bin.came_true.add(came_true[i]);
    result.mean_width += (plausibility - belief) / static_cast<double>(beliefs.size());
  }
  for (auto& [cell, bin] : grid) {
    bin.belief /= static_cast<double>(bin.came_true.of);
    bin.plausibility /= static_cast<double>(bin.came_true.of);
    result.covered.of += bin.came_true.of;
    result.covered.count += bin.agrees() ? bin.came_true.of : 0;
    result.bins.push_back(bin);
  }
  return result;
}

std::vector<RiskPoint> risk_coverage(std::span<const EvaluatedRun> runs, const ScoreParams& params) {
  std::vector<const Sample*> samples;
  for (const EvaluatedRun& run : runs) {
    for (const Sample& sample : run.samples) {
      if (sample.placed()) samples.push_back(&sample);
    }
  }
  const auto trust = [](const Sample* s) { return s->localization.belief.pignistic(); };
  std::stable_sort(samples.begin(), samples.end(),
                   [&](const Sample* a, const Sample* b) { return trust(a) > trust(b); });
  std::vector<RiskPoint> curve;
  double position = 0.0, heading = 0.0, lost = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    position += samples[k]->position_m();
    heading += samples[k]->heading_rad();
    lost += is_lost(*samples[k], params) ? 1.0 : 0.0;
    const double threshold = trust(samples[k]), accepted = static_cast<double>(k + 1);
    if (k + 1 < samples.size() && trust(samples[k + 1]) == threshold) continue;  // equal ones are accepted together
    curve.push_back({.threshold = threshold,
                     .coverage = accepted / static_cast<double>(samples.size()),
                     .mean_position_m = position / accepted,
                     .mean_heading_rad = heading / accepted,
                     .lost = lost / accepted});
  }
  return curve;
}

std::optional<double> area_under_risk(std::span<const RiskPoint> curve) {
  if (curve.empty()) return {};
  double area = 0.0, before = 0.0;
  for (const RiskPoint& point : curve) {
    area += (point.coverage - before) * point.lost;
    before = point.coverage;
  }
  return area;
}

}  // namespace credo::evaluation
