// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/azimuth_edges.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <numbers>

#include "geometry/angles.hpp"

namespace credo::perception {
namespace {

constexpr int kHitLanes = 8;  // hits that are reckoned side by side
using HitLanes = Eigen::Array<double, kHitLanes, 1>;

constexpr int kLargestTapSum = 32;  // keeps the answer to 255 * AnnulusTable::kScale within 16 bits
constexpr double kMedianToSigma = 1.4826;
// Independent pixel noise keeps about this share of its sigma when two rows of pixels are mixed by weights that take
// every value alike: sqrt(mean of (1-a)^2 + a^2) = sqrt(2/3) per axis, of which only the radial one is free of the
// filter's own averaging.
constexpr double kInterpolationNoise = 0.816;

/// A threshold of the filter's answers, as they are.
std::int16_t as_answer(double threshold) { return static_cast<std::int16_t>(std::min(threshold, 32767.0)); }

/// Marks the columns where the answer has a local extremum of at least `least`. Side by side, without branches.
/// \param response  can be read one column before and one behind
void mark_extrema(const std::int16_t* response, int columns, std::int16_t least, std::uint8_t* marks) {
  for (int i = 0; i < columns; ++i) {
    const std::int16_t before = response[i - 1], here = response[i], after = response[i + 1];
    const auto fallen = static_cast<std::int16_t>(-least);
    const bool rising = (here >= least) & (here >= before) & (here > after);
    const bool falling = (here <= fallen) & (here <= before) & (here < after);
    marks[i] = static_cast<std::uint8_t>(rising | falling);
  }
}

std::int16_t largest(const std::int16_t* samples, int columns) {
  std::int16_t found = 0;
  for (int i = 0; i < columns; ++i) found = std::max(found, samples[i]);
  return found;
}

/// How often values were met. Neighbours are alike: counted in one place, each would wait for the one before it.
template <int kBins>
class Histogram {
 public:
  void add(int column, int bin) { ++places_[column % kPlaces][bin]; }
  [[nodiscard]] std::array<int, kBins> counts() const {
    std::array<int, kBins> sum{};
    for (const auto& place : places_) std::ranges::transform(sum, place, sum.begin(), std::plus());
    return sum;
  }

 private:
  static constexpr int kPlaces = 4;
  std::array<std::array<int, kBins>, kPlaces> places_{};
};

/// The columns that are marked, growing. Eight are looked at together, the first in the lowest byte. Most often two of
/// them are marked, or one, or none: two are listed whatever there is, as a branch that goes either way costs more.
/// \param columns  a multiple of 8
/// \param marks    0 or 1
/// \param listed   memory for as many columns, and two
std::span<int> list_marks(const std::uint8_t* marks, int columns, std::vector<int>& listed) {
  static_assert(std::endian::native == std::endian::little);
  constexpr std::uint64_t kOnes = 0x0101010101010101;
  assert(listed.size() >= static_cast<std::size_t>(columns) + 2);
  int* end = listed.data();
  for (int first = 0; first < columns; first += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, marks + first, sizeof word);
    int* next = end;
    end += word * kOnes >> 56;  // the sum of the bytes
    const auto list_lowest = [&] {
      *next++ = first + std::countr_zero(word) / 8;
      word &= word - 1;
    };
    list_lowest();
    list_lowest();
    while (word != 0) list_lowest();
  }
  return {listed.data(), end};
}

/// exp(-x^2 / 2), looked up to 1e-4: how far the answers to two steps at a distance of x widths overlap.
class Overlap {
 public:
  Overlap() {
    for (int i = 0; i <= kSteps; ++i) {
      const double x = i * kStep;
      values_[static_cast<std::size_t>(i)] = static_cast<float>(std::exp(-0.5 * x * x));
    }
  }
  double operator()(double x) const {
    const double at = x * (1.0 / kStep);
    if (!(at < kSteps)) return 0.0;
    const auto i = static_cast<std::size_t>(at);
    return values_[i] + (at - static_cast<double>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int kSteps = 256;
  static constexpr double kStep = 1.0 / 32.0;
  std::array<float, kSteps + 1> values_{};
};

/// The hit of a circle that follows one; the first follows the last.
std::size_t next(std::span<const EdgeHit> hits, std::size_t hit) { return hit + 1 < hits.size() ? hit + 1 : 0; }

double way_to_next(std::span<const EdgeHit> hits, std::size_t hit) {
  const double way = hits[next(hits, hit)].azimuth - hits[hit].azimuth;
  return hit + 1 < hits.size() ? way : way + geometry::kTurn;
}

double length(double a, double b) { return std::sqrt(a * a + b * b); }

}  // namespace

AzimuthEdgeFilter::AzimuthEdgeFilter(const EdgeFilterParams& params, double column_px, int max_columns)
    : params_(params),
      column_px_(column_px),
      samples_(max_columns + 2 * kMargin),
      marks_(max_columns),
      response_(max_columns + 2 * kMargin) {
  widths_.reserve(samples_.size());
  columns_.resize(marks_.size() + 2);
  pairs_.reserve(marks_.size());
  shifts_.reserve(marks_.size());
  const double sigma = std::max(1.0, params.sigma_px / column_px);  // in columns, at least one
  std::array<double, kReach> ideal{};
  double sum = 0.0;
  for (int i = 0; i < kReach; ++i) sum += ideal[i] = (i + 1) * std::exp(-0.5 * (i + 1) * (i + 1) / (sigma * sigma));
  double blurred_sum = 0.0;
  std::array<double, 2 * kReach + 1> kernel{};
  for (int i = 0; i < kReach; ++i) {
    taps_[i] = static_cast<std::int16_t>(std::floor(ideal[i] / sum * kLargestTapSum));
    blurred_sum += taps_[i] * std::erf((i + 1) * column_px / (std::numbers::sqrt2 * params.expected_blur_px));
    kernel[kReach + i + 1] = taps_[i];
    kernel[kReach - i - 1] = -taps_[i];
  }
  gain_ = AnnulusTable::kScale * blurred_sum;
  // White noise n through kernel k: variance n^2 sum k^2. The place of the extremum is (D+ - D-) / (2 curvature), whose
  // numerator has the variance of the kernel's difference over two columns.
  double square = 0.0;
  double difference_square = 0.0;
  for (int i = 0; i < 2 * kReach + 1; ++i) square += kernel[i] * kernel[i];
  for (int i = -2; i < 2 * kReach + 1; ++i) {
    const double ahead = i + 2 <= 2 * kReach ? kernel[i + 2] : 0.0;
    const double here = i >= 0 ? kernel[i] : 0.0;
    difference_square += (ahead - here) * (ahead - here);
  }
  // Besides filter and lens: the area of a pixel, 1/12 px^2, and the interpolation between pixels, 1/6 px^2.
  nominal_width_ = std::hypot(sigma, std::hypot(params.expected_blur_px, 0.5) / column_px);
  width_columns_ = nominal_width_;
  noise_gain_ = AnnulusTable::kScale * kInterpolationNoise * std::sqrt(square);
  extremum_gain_ = AnnulusTable::kScale * kInterpolationNoise * std::sqrt(difference_square) / 2.0;
}

void AzimuthEdgeFilter::filter_row(const AnnulusTable& table, const std::uint8_t* pixels, int row) {
  const int columns = table.rows()[row].columns;
  std::int16_t* sample = samples_.data() + kMargin;
  table.sample(pixels, row, sample);
  std::copy(sample, sample + kMargin, sample + columns);
  std::copy(sample + columns - kMargin, sample + columns, sample - kMargin);
  std::int16_t* response = response_.data() + kMargin;
  const auto [t1, t2, t3, t4] = taps_;
  for (int i = 0; i < columns; ++i) {
    response[i] =
        static_cast<std::int16_t>(t1 * (sample[i + 1] - sample[i - 1]) + t2 * (sample[i + 2] - sample[i - 2]) +
                                  t3 * (sample[i + 3] - sample[i - 3]) + t4 * (sample[i + 4] - sample[i - 4]));
  }
  response[-1] = response[columns - 1];
  response[columns] = response[0];
}

void AzimuthEdgeFilter::measure_widths(int columns, std::int16_t least) {
  constexpr int kAlone = 6;  // columns on both sides without another step
  const std::int16_t* response = response_.data() + kMargin;
  mark_extrema(response, columns, least, marks_.data());
  for (const int i : list_marks(marks_.data(), columns, columns_)) {
    if (i < kAlone || i >= columns - kAlone) continue;
    const int sign = response[i] > 0 ? 1 : -1;
    const int here = sign * response[i], before = sign * response[i - 1], after = sign * response[i + 1];
    int lowest = 0;
    for (int j = i - kAlone; j <= i + kAlone; ++j) lowest = std::min(lowest, sign * response[j]);
    const int aside = std::max(sign * response[i - kAlone], sign * response[i + kAlone]);
    if (6 * -lowest > here || 4 * aside > here) continue;
    // A Gaussian of width w has the curvature -1/w^2 of its height at its top, and nearly so over three columns.
    widths_.push_back(static_cast<float>(std::sqrt(here / (2.0 * here - before - after))));
  }
}

void AzimuthEdgeFilter::measure(const AnnulusTable& table, const std::uint8_t* pixels) {
  constexpr int kBins = 512;
  constexpr int kBinWidth = 4;
  constexpr std::size_t kLeastWidths = 20;
  Histogram<kBins> answers;
  Histogram<256> levels;
  int total = 0;
  widths_.clear();
  const std::int16_t clear_step = as_answer(4.0 * params_.least_step * gain_);
  for (int row = 0; row < static_cast<int>(table.rows().size()); row += params_.noise_row_step) {
    filter_row(table, pixels, row);
    const int columns = table.rows()[row].columns;
    for (int i = 0; i < columns; ++i) {
      answers.add(i, std::min(kBins - 1, std::abs(response_[kMargin + i]) / kBinWidth));
      if (table.usable(row, i)) levels.add(i, samples_[kMargin + i] / AnnulusTable::kScale);
    }
    total += columns;
    measure_widths(columns, clear_step);
  }
  levels_ = levels.counts();
  const std::array<int, kBins> counts = answers.counts();
  int below = 0;
  int bin = 0;
  while (bin < kBins - 1 && 2 * (below + counts[bin]) < total) below += counts[bin++];
  const double inside = counts[bin] > 0 ? (0.5 * total - below) / counts[bin] : 0.0;
  noise_ = kMedianToSigma * kBinWidth * (bin + std::clamp(inside, 0.0, 1.0)) / noise_gain_;
  width_columns_ = nominal_width_;
  if (widths_.size() < kLeastWidths) return;
  const auto median = widths_.begin() + static_cast<std::ptrdiff_t>(widths_.size() / 2);
  std::nth_element(widths_.begin(), median, widths_.end());
  width_columns_ = std::clamp(static_cast<double>(*median), 0.6 * nominal_width_, 2.0 * nominal_width_);
}

void AzimuthEdgeFilter::find(const AnnulusTable& table, const std::uint8_t* pixels, std::vector<EdgeHit>& hits) {
  const double threshold = std::max(params_.least_step * gain_, params_.least_step_sigmas * noise_ * noise_gain_);
  const std::int16_t least = as_answer(threshold);
  const double saturated_sample = params_.saturated_level * AnnulusTable::kScale;
  for (int row = 0; row < static_cast<int>(table.rows().size()); ++row) {
    filter_row(table, pixels, row);
    const AnnulusRow& circle = table.rows()[row];
    const int columns = circle.columns;
    mark_extrema(response_.data() + kMargin, columns, least, marks_.data());
    row_saturates_ = largest(samples_.data() + kMargin, columns) > saturated_sample;
    std::span<int> found = list_marks(marks_.data(), columns, columns_);
    if (!table.all_usable()) {
      const auto hidden = std::ranges::remove_if(found, [&](int column) { return !usable(table, row, column); });
      found = found.first(found.size() - hidden.size());
    }
    const std::size_t before = hits.size();
    for (std::size_t first = 0; first < found.size(); first += kHitLanes)
      add_hits(circle, row, found.subspan(first, std::min<std::size_t>(kHitLanes, found.size() - first)), hits);
    separate(circle, std::span(hits).subspan(before));
  }
}

/// Two steps a1, a2 at x1 < x2 whose answers are Gaussians g of width w: the extremum near x1 lies where
/// a1 (m - x1) g(m - x1) + a2 (m - x2) g(m - x2) = 0, so m - x1 = (a2 / a1) d g(d) / g(m - x1) with d = x2 - m. To
/// first order the last g is 1; the measured heights give a1, a2 by two linear equations with g(d).
/// \param pairs  the first of two neighbouring hits each, at most kHitLanes
void AzimuthEdgeFilter::part(std::span<const int> pairs, double width, std::span<const EdgeHit> hits) {
  static const Overlap overlap_at;
  HitLanes apparent, a_height, b_height;
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const auto i = static_cast<std::size_t>(pairs[std::min(lane, static_cast<int>(pairs.size()) - 1)]);
    apparent[lane] = way_to_next(hits, i);
    a_height[lane] = hits[i].step;
    b_height[lane] = hits[next(hits, i)].step;
  }
  const HitLanes limit = 0.35 * apparent;
  HitLanes distance = apparent, shift_a, shift_b;
  const double inverse_width = 1.0 / width;
  for (int round = 0; round < 3; ++round) {  // the true distance is what the shifts leave of the apparent one
    const HitLanes overlap = (distance * inverse_width).unaryExpr([](double x) { return overlap_at(x); });
    const HitLanes a_step = a_height - overlap * b_height;
    const HitLanes b_step = b_height - overlap * a_height;
    shift_a = (b_step / a_step * distance * overlap).max(-limit).min(limit);
    shift_b = -(a_step / b_step * distance * overlap).max(-limit).min(limit);
    distance = (apparent + shift_a - shift_b).max(width);
  }
  for (std::size_t lane = 0; lane < pairs.size(); ++lane) {
    const auto i = static_cast<std::size_t>(pairs[lane]);
    shifts_[i] += shift_a[static_cast<Eigen::Index>(lane)];
    shifts_[next(hits, i)] += shift_b[static_cast<Eigen::Index>(lane)];
  }
}

/// Moves neighbours that shift each other apart.
/// \param hits  of one circle, by azimuth: the first may be below 0, and is wrapped
void AzimuthEdgeFilter::separate(const AnnulusRow& circle, std::span<EdgeHit> hits) {
  const double width = width_columns_ * 2.0 * std::numbers::pi / circle.columns;
  const double reach = params_.neighbour_reach * width;
  shifts_.assign(hits.size(), 0.0);
  pairs_.clear();
  for (std::size_t i = 0; hits.size() > 1 && i < hits.size(); ++i)
    if (way_to_next(hits, i) < reach) pairs_.push_back(static_cast<int>(i));
  for (std::size_t first = 0; first < pairs_.size(); first += kHitLanes)
    part(std::span(pairs_).subspan(first, std::min<std::size_t>(kHitLanes, pairs_.size() - first)), width, hits);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (shifts_[i] == 0.0) continue;
    hits[i].azimuth -= static_cast<float>(shifts_[i]);
    hits[i].sigma = static_cast<float>(length(hits[i].sigma, params_.neighbour_share * shifts_[i]));
  }
  if (!hits.empty() && hits.front().azimuth < 0.0F) hits.front().azimuth += static_cast<float>(geometry::kTurn);
}

/// Whether the filter at a column takes in usable samples only.
bool AzimuthEdgeFilter::usable(const AnnulusTable& table, int row, int column) const {
  const int columns = table.rows()[row].columns;
  for (int i = -kReach; i <= kReach; ++i)
    if (!table.usable(row, (column + i + columns) % columns)) return false;
  return true;
}

bool AzimuthEdgeFilter::saturates(int column) const {
  const std::int16_t* sample = samples_.data() + kMargin + column;
  return *std::max_element(sample - kReach, sample + kReach + 1) > params_.saturated_level * AnnulusTable::kScale;
}

/// \param columns  of the row's extrema, at most kHitLanes
void AzimuthEdgeFilter::add_hits(const AnnulusRow& circle, int row, std::span<const int> columns,
                                 std::vector<EdgeHit>& hits) const {
  HitLanes column, before, here, after, model_px;
  std::array<bool, kHitLanes> saturated;
  for (int lane = 0; lane < kHitLanes; ++lane) {
    const int i = columns[std::min(lane, static_cast<int>(columns.size()) - 1)];
    const std::int16_t* response = response_.data() + kMargin + i;
    column[lane] = i;
    before[lane] = response[-1];
    here[lane] = response[0];
    after[lane] = response[1];
    saturated[lane] = row_saturates_ && saturates(i);
    model_px[lane] = saturated[lane] ? params_.saturated_sigma_px : params_.model_sigma_px;
  }
  const double column_rad = 2.0 * std::numbers::pi / circle.columns;
  const double sharp = params_.broad_from * width_columns_;
  const HitLanes inverse_curvature = 1.0 / (2.0 * here - before - after).abs();  // > 0 at an extremum
  const HitLanes between = here.sign() * (0.5 * (after - before)) * inverse_curvature;
  const HitLanes noise_px = extremum_gain_ * noise_ * inverse_curvature * column_rad * circle.radius_px;
  const HitLanes excess_px = column_px_ * (here.abs() * inverse_curvature - sharp * sharp).max(0.0).sqrt();
  const HitLanes broad_px = params_.broad_share * excess_px;
  const HitLanes sigma_px = (noise_px * noise_px + model_px * model_px + broad_px * broad_px).sqrt();
  const HitLanes sigma = sigma_px * (1.0 / circle.radius_px), step = here * (1.0 / gain_);
  const HitLanes azimuth = (column + between) * column_rad;
  for (int lane = 0; lane < static_cast<int>(columns.size()); ++lane)
    hits.push_back({.azimuth = static_cast<float>(azimuth[lane]),
                    .sigma = static_cast<float>(sigma[lane]),
                    .step = static_cast<float>(step[lane]),
                    .row = static_cast<std::int16_t>(row),
                    .saturated = saturated[lane]});
}

}  // namespace credo::perception
