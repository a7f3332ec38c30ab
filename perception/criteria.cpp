// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/criteria.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace credo::perception {

CriteriaParams CriteriaParams::paper() {
  CriteriaParams params;
  params.absolute = true;
  params.alignment = {.max_yes = 0.70,
                      .yes_full_until = 0.010,
                      .yes_zero_from = 0.040,
                      .max_no = 0.40,
                      .no_zero_until = 0.030,
                      .no_full_from = 0.080};  // m
  params.support = {.max_yes = 0.0,
                    .yes_full_until = 9.0,
                    .yes_zero_from = 8.0,
                    .max_no = 0.60,
                    .no_zero_until = 8.0,
                    .no_full_from = 3.0};
  params.density = {.max_yes = 0.60,
                    .yes_full_until = 20.0,
                    .yes_zero_from = 5.0,
                    .max_no = 0.30,
                    .no_zero_until = 8.0,
                    .no_full_from = 3.0};  // 1/m
  params.cases = {{{0.0, 0.3}, {0.15, 0.2}, {0.3, 0.1}, {0.5, 0.05}, {0.7, 0.0}}};
  params.gray = {.max_yes = 0.50,
                 .yes_full_until = 5.0,
                 .yes_zero_from = 15.0,
                 .max_no = 0.40,
                 .no_zero_until = 10.0,
                 .no_full_from = 40.0};  // grey levels
  return params;
}

std::array<evidence::BinaryMass, 5> segment_criteria(const SegmentMeasures& measures, const CriteriaParams& params) {
  std::array<evidence::BinaryMass, 5> criteria;
  criteria[0] = params.alignment(params.absolute ? measures.mean_residual_m : measures.mean_residual_sigmas);
  criteria[1] = params.support(measures.support);
  criteria[2] = params.density(params.absolute ? measures.density_per_m : measures.relative_density);
  if (measures.endpoint_case > 0) {
    const auto& [yes, no] = params.cases[static_cast<std::size_t>(measures.endpoint_case - 1)];
    criteria[3] = {.yes = yes, .no = no, .unknown = 1.0 - yes - no};
  }
  criteria[4] = params.gray(params.absolute ? measures.mean_gray_deviation : measures.mean_gray_sigmas);
  return criteria;
}

void measure_points(std::span<const sensors::ScanPoint> points, const geometry::LineEstimate& line,
                    double beam_increment, const PointNoise& noise, const CriteriaParams& params,
                    SegmentMeasures& measures) {
  const DirectedLine directed = line;
  const LineFit fit = judge_line(points, directed, noise);
  measures.support = fit.support;
  measures.density_per_m = measures.relative_density = 0.0;
  const double n = fit.support;
  // A line through two points fits them whatever they are, and one through three nearly so.
  const double correction = fit.support > 3 ? std::sqrt(n / (n - 2.0)) : std::numeric_limits<double>::quiet_NaN();
  measures.mean_residual_m = correction * fit.mean_residual_m;
  measures.mean_residual_sigmas = correction * fit.mean_residual_sigmas;
  if (fit.support == 0) return;
  // From the first to the last reading and half a beam at either side.
  double spacing = 0.0;
  for (const sensors::ScanPoint& point : points)
    spacing +=
        predicted_range(point, directed) * beam_increment / std::max(0.05, std::abs(directed.normal.dot(point.ray)));
  const double reach = std::abs(directed.direction.dot(points.back().position - points.front().position));
  measures.density_per_m = n / (reach + spacing / static_cast<double>(points.size()));
  measures.relative_density = measures.density_per_m * params.head_on_m * beam_increment;
}

double gray_deviation(const GrayCurve& gray, double from, double width) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const int bins = static_cast<int>(gray.values.size());
  if (bins == 0) return kNan;
  const double per_bin = 2.0 * std::numbers::pi / bins;
  constexpr int kBlurredBins = 2;
  const int begin = static_cast<int>(std::ceil(from / per_bin)) + kBlurredBins;
  const int count = static_cast<int>(width / per_bin) - 2 * kBlurredBins;
  if (count < 4) return kNan;
  int bin = (begin % bins + bins) % bins;
  const int start = bin;
  const auto next = [bins](int i) { return i + 1 == bins ? 0 : i + 1; };
  double sum = 0.0, moment = 0.0;
  const double middle = 0.5 * (count - 1);
  for (int i = 0; i < count; ++i, bin = next(bin)) {
    const double value = gray.values[static_cast<std::size_t>(bin)];
    sum += value;
    moment += (i - middle) * value;
  }
  const double mean = sum / count;
  const double slope = moment / (count * (static_cast<double>(count) * count - 1.0) / 12.0);
  double deviation = 0.0;
  bin = start;
  for (int i = 0; i < count; ++i, bin = next(bin))
    deviation += std::abs(gray.values[static_cast<std::size_t>(bin)] - mean - slope * (i - middle));
  return deviation / count;
}

void ConflictMeans::add(const std::array<evidence::BinaryMass, 5>& criteria, double conflict) {
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j)
      if (i != j) sums.pair[i][j] += criteria[i].yes * criteria[j].no + criteria[i].no * criteria[j].yes;
  sum += conflict;
  ++segments;
}

void ConflictMeans::write(Scene& scene) const {
  scene.conflicts = sums;
  scene.mean_conflict = segments > 0 ? sum / segments : 0.0;
  if (segments == 0) return;
  for (auto& row : scene.conflicts.pair)
    for (double& conflict : row) conflict /= segments;
}

}  // namespace credo::perception
