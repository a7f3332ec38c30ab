// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/line_votes.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/angles.hpp"

namespace credo::perception {
namespace {

using geometry::kTurn;

}  // namespace

LineVotes::LineVotes(const AnnulusTable& annulus, const sensors::OmniCamera& camera, double bin_rad, double horizon_px)
    : bins_(std::max(16, static_cast<int>(std::lround(kTurn / bin_rad)))) {
  for (int bin = 0; bin < bins_; ++bin) {
    const double azimuth = (bin + 0.5) * kTurn / bins_;
    directions_.push_back(
        {camera.image_direction(azimuth - camera.T_base_camera.theta), {std::cos(azimuth), std::sin(azimuth)}});
  }
  for (const AnnulusRow& row : annulus.rows()) levers_.push_back(1.0 / row.radius_px - 1.0 / horizon_px);
  begin_.resize(2 * bins_ + 1);
  begin_of_row_.resize(annulus.rows().size() + 1);
  count_usable_rows(annulus);
}

void LineVotes::reserve(std::size_t hits) {
  slots_.reserve(hits);
  hits_.reserve(hits);
  used_.reserve(hits);
  near_.reserve(hits);
  by_row_.reserve(hits);
  middle_.reserve(hits);
  peaks_.reserve(static_cast<std::size_t>(bins_));
}

void LineVotes::count_usable_rows(const AnnulusTable& annulus) {
  const auto rows = static_cast<int>(annulus.rows().size());
  usable_rows_.assign(bins_, rows);
  if (annulus.all_usable()) return;
  for (int bin = 0; bin < bins_; ++bin) {
    for (int row = 0; row < rows; ++row) {
      const int columns = annulus.rows()[row].columns;
      const int column = static_cast<int>(std::lround((bin + 0.5) / bins_ * columns)) % columns;
      if (!annulus.usable(row, column)) --usable_rows_[bin];
    }
  }
}

double LineVotes::usable_rows(double azimuth) const { return std::max(1, usable_rows_[bin_of(azimuth)]); }

void LineVotes::count(std::span<const EdgeHit> hits) {
  std::fill(begin_.begin(), begin_.end(), 0);
  slots_.resize(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    slots_[i] = slot_of(hits[i].step > 0.0F ? 1 : -1, bin_of(hits[i].azimuth));
    ++begin_[slots_[i] + 1];
  }
  for (std::size_t slot = 1; slot < begin_.size(); ++slot) begin_[slot] += begin_[slot - 1];
  hits_.resize(hits.size());
  used_.assign(hits.size(), 0);
  // Fill every slot in the order of the hits (by row); begin_ moves to the ends, that is one slot on, and back.
  for (std::size_t i = 0; i < hits.size(); ++i) hits_[begin_[slots_[i]]++] = hits[i];
  std::copy_backward(begin_.begin(), begin_.end() - 1, begin_.end());
  begin_[0] = 0;
}

const std::vector<LinePeak>& LineVotes::peaks(double least_share, double least_chance_sigmas) {
  peaks_.clear();
  const double per_bin = static_cast<double>(hits_.size()) / (2.0 * bins_);
  for (const int polarity : {-1, 1}) {
    const auto votes = [&](int bin) {
      const int slot = slot_of(polarity, wrapped(bin));
      return begin_[slot + 1] - begin_[slot];
    };
    const auto together = [&](int bin) { return votes(bin - 1) + votes(bin) + votes(bin + 1); };
    // The middle bin weighs double, so that lines three bins apart make two peaks.
    const auto height = [&](int bin) { return together(bin) + votes(bin); };
    const double chance = 3.0 * per_bin + least_chance_sigmas * std::sqrt(3.0 * per_bin);
    for (int bin = 0; bin < bins_; ++bin) {
      const int here = together(bin);
      const double least = std::max(least_share * std::max(1, usable_rows_[bin]), chance);
      if (here < least || height(bin) < height(bin - 1) || height(bin) <= height(bin + 1)) continue;
      peaks_.push_back({.azimuth = (bin + 0.5) * kTurn / bins_, .polarity = polarity, .votes = here, .bin = bin});
    }
  }
  std::sort(peaks_.begin(), peaks_.end(), [](const LinePeak& a, const LinePeak& b) {
    return std::tuple(-a.votes, a.polarity, a.bin) < std::tuple(-b.votes, b.polarity, b.bin);
  });
  return peaks_;
}

template <class Visit>
void LineVotes::for_each_near(const LinePeak& peak, double window_rad, Visit&& visit) const {
  const int reach = static_cast<int>(std::ceil(window_rad * bins_ / kTurn));
  for (int bin = peak.bin - reach; bin <= peak.bin + reach; ++bin) {
    const int slot = slot_of(peak.polarity, wrapped(bin));
    for (int i = begin_[slot]; i < begin_[slot + 1]; ++i) visit(i, bin);
  }
}

/// A counting sort, as rows are few; the hits of one row stay in order. The rows are counted already.
void LineVotes::sort_near_by_row() {
  for (std::size_t row = 1; row < begin_of_row_.size(); ++row) begin_of_row_[row] += begin_of_row_[row - 1];
  by_row_.resize(near_.size());
  for (const std::int32_t i : near_) by_row_[begin_of_row_[hits_[i].row]++] = i;
}

double LineVotes::gather(const LinePeak& peak, double window_rad, RadialPoints& points) {
  points.clear();
  near_.clear();
  middle_.clear();
  std::fill(begin_of_row_.begin(), begin_of_row_.end(), 0);
  for_each_near(peak, window_rad, [&](int i, int bin) {
    if (used_[i] != 0) return;
    near_.push_back(i);
    ++begin_of_row_[hits_[i].row + 1];
    if (std::abs(bin - peak.bin) <= 1) middle_.push_back(geometry::wrap_angle(hits_[i].azimuth - peak.azimuth));
  });
  if (middle_.empty()) return 0.0;
  sort_near_by_row();
  for (const std::int32_t i : by_row_) {
    const EdgeHit& hit = hits_[i];
    points.push_back({.azimuth = geometry::wrap_angle(hit.azimuth - peak.azimuth),
                      .sigma = hit.sigma,
                      .lever = levers_[hit.row],
                      .row = hit.row,
                      .step = std::abs(hit.step)});
  }
  const auto median = middle_.begin() + static_cast<std::ptrdiff_t>(middle_.size() / 2);
  std::nth_element(middle_.begin(), median, middle_.end());
  return *median;
}

void LineVotes::use_up(const LinePeak& peak, const RadialFit& fit, double window_rad, double own_rad) {
  for_each_near(peak, window_rad + own_rad, [&](int i, int) {
    const EdgeHit& hit = hits_[i];
    const double distance =
        geometry::wrap_angle(hit.azimuth - peak.azimuth) - fit.azimuth - fit.slope * levers_[hit.row];
    if (std::abs(distance) <= own_rad + 3.0 * hit.sigma) used_[i] = 1;
  });
}

}  // namespace credo::perception
