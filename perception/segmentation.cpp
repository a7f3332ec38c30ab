// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace credo::perception {
namespace {

using geometry::LineEstimate;
using sensors::ScanPoint;

constexpr double kFarthest = 1e5;      // m; no range finder reads that
constexpr double kMedianSigma = 0.67;  // of the median of three, in standard deviations of one
constexpr int kRoughAngle = 6;         // points; the angle of fewer is too rough to be linear
constexpr double kNever = std::numeric_limits<double>::infinity();

double median_of_three(double a, double b, double c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

/// What speaks for a piece as a line of its own. Some points that are mostly outliers of their own line have none: they
/// must not pass into a neighbour because nothing is lost.
double chi2_of_own_line(const LineFit& fit, int size) { return std::min(fit.chi2, 10.0 + 2.0 * size); }

/// Distance along the line from one beam to the next.
double spacing_at(const ScanPoint& point, const DirectedLine& line, double increment, double min_sine) {
  return predicted_range(point, line) * increment / std::max(min_sine, std::abs(line.normal.dot(point.ray)));
}

}  // namespace

Segmenter::Segmenter(const sensors::RangeFinder& range_finder, const SegmentationParams& params,
                     const LineFitParams& fit_params)
    : noise_{range_finder.noise, fit_params},
      params_(params),
      increment_(std::abs(range_finder.angle_increment_rad)),
      clockwise_(range_finder.angle_increment_rad < 0.0),
      range_max_(range_finder.range_max_m) {
  pieces_.reserve(static_cast<std::size_t>(std::max(0, range_finder.count)));
  if (increment_ <= 0.0) return;
  const double full_turn = 2.0 * std::numbers::pi;
  if (range_finder.count * increment_ > full_turn - 1.5 * increment_)
    turn_ = static_cast<int>(std::lround(full_turn / increment_));
  allowed_beams_ = 1 + std::max(params_.missing_beams, static_cast<int>(params_.missing_rad / increment_));
}

int Segmenter::beams_between(const ScanPoint& a, const ScanPoint& b) const {
  const int beams = clockwise_ ? a.beam - b.beam : b.beam - a.beam;
  return beams < 0 ? beams + turn_ : beams;
}

bool Segmenter::connected(const ScanPoint& a, const ScanPoint& b) const {
  const int beams = beams_between(a, b);
  if (beams > allowed_beams_) return false;
  // A wall that makes the angle grazing_rad with the nearer beam (Borges and Aldon).
  const double turn = std::min(beams * increment_, 0.6 * params_.grazing_rad);
  const double wall = std::min(a.range_m, b.range_m) * std::sin(turn) / std::sin(params_.grazing_rad - turn);
  const double reach = wall + params_.break_sigmas * std::sqrt(a.sigma_m * a.sigma_m + b.sigma_m * b.sigma_m);
  return (a.position - b.position).squaredNorm() <= reach * reach;
}

/// A full turn begins behind its widest break that is not a stray reading's.
void Segmenter::rotate_to_break(Points& points) const {
  const std::size_t n = points.size();
  if (turn_ == 0 || n < 4) return;
  std::size_t start = 0;
  double widest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const ScanPoint &before2 = points[(i + n - 2) % n], &before = points[(i + n - 1) % n];
    const ScanPoint &here = points[i], &after = points[(i + 1) % n];
    const double width = (here.position - before.position).squaredNorm();
    if (width <= widest || connected(before, here) || connected(before2, here) || connected(before, after)) continue;
    widest = width;
    start = i;
  }
  std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(start), points.end());
}

/// Runs between breaks, each split by Duda-Hart. Stray readings inside a run do not end it.
void Segmenter::split_runs(const Points& points) {
  const int n = static_cast<int>(points.size());
  for (int first = 0; first < n;) {
    int last = first;
    for (bool grown = true; grown;) {
      grown = false;
      for (int step = 1; step <= 1 + params_.bridged_outliers && last + step < n && !grown; ++step) {
        if (!connected(points[last], points[last + step])) continue;
        last += step;
        grown = true;
      }
    }
    split(points, first, last);
    first = last + 1;
  }
}

/// The point where a run is to be split: after it.
/// \returns -1 where the chord through the ends explains the run.
int Segmenter::split_point(const Points& points, int first, int last) const {
  const Eigen::Vector2d chord = points[last].position - points[first].position;
  const double length = chord.norm();
  if (length < 1e-9) return -1;
  const Eigen::Vector2d normal(-chord.y() / length, chord.x() / length);
  const auto deviation = [&](int k) {
    if (k <= first || k >= last) return 0.0;
    const double distance = normal.dot(points[k].position - points[first].position);
    if (params_.split_m > 0.0) return distance;
    return distance / std::sqrt(noise_.variance_across(points[k].ray, points[k].range_m, normal));
  };
  const double threshold = params_.split_m > 0.0 ? params_.split_m : kMedianSigma * params_.split_sigmas;
  int farthest = -1;
  double most = threshold;
  double before = 0.0, here = deviation(first + 1);
  for (int k = first + 1; k < last; ++k) {
    const double after = deviation(k + 1);
    // A stray reading has no neighbours that deviate with it.
    const double size = std::abs(params_.split_m > 0.0 ? here : median_of_three(before, here, after));
    if (size > most) {
      most = size;
      farthest = params_.split_m > 0.0 || std::abs(here) == size ? k : std::abs(before) == size ? k - 1 : k + 1;
    }
    before = here;
    here = after;
  }
  return std::min(farthest, last - 1);
}

void Segmenter::split(const Points& points, int first, int last) {
  const int at = last - first < 2 ? -1 : split_point(points, first, last);
  if (at < first) {
    Piece piece{.first = first, .last = last, .fit = {}, .merge_cost = kNever, .merge_with = 0};
    piece.fit = fit_line(span(points, first, last), noise_);
    pieces_.push_back(piece);
    return;
  }
  split(points, first, at);
  split(points, at + 1, last);
}

/// How a reading fits a line whose own error counts.
Segmenter::Misfit Segmenter::misfit(const ScanPoint& point, const DirectedLine& line) const {
  const double most = noise_.params.no_weight_from * noise_.params.no_weight_from;
  const double residual = line.normal.dot(point.position - line.estimate.centroid);
  const double own = noise_.variance_across(point.ray, predicted_range(point, line), line.normal);
  const double variance = own + variance_at(line, point.position);
  return {std::min(most, residual * residual / variance), std::log(variance / own)};
}

/// How much chi-square would grow if two pieces were one line: the Mahalanobis distance of their lines, compared at the
/// second one's centroid. The angle of a few points is too rough for that: they are held against the other's line.
double Segmenter::merge_cost(const Points& points, const Piece& a, const Piece& b) const {
  if (a.size() + b.size() < 3) return kNever;
  const ScanPoint &end = points[a.last], &begin = points[b.first];
  const int beams = beams_between(end, begin);
  if (beams > allowed_beams_) return kNever;
  const int stray = b.first - a.last - 1;
  const bool gap_counts = beams > 1 + stray;
  if (gap_counts && (end.position - begin.position).squaredNorm() > params_.merge_gap_m * params_.merge_gap_m)
    return kNever;
  if (std::min(a.size(), b.size()) < kRoughAngle) {
    const Piece &few = a.size() < b.size() ? a : b, &many = a.size() < b.size() ? b : a;
    double growth = -chi2_of_own_line(few.fit, few.size());
    const DirectedLine line = many.fit.line;
    for (int k = few.first; k <= few.last; ++k) growth += misfit(points[k], line).chi2;
    return growth;
  }
  const LineEstimate &one = a.fit.line, &two = b.fit.line;
  const Eigen::Vector2d between = two.centroid - one.centroid;
  const double s = one.direction().dot(between);
  const double offset = one.normal().dot(between);
  const double turn = std::remainder(two.angle - one.angle, std::numbers::pi);
  const double turn_variance_one = one.sigma_angle * one.sigma_angle;
  const double offset_variance = variance_at(one, two.centroid) + two.sigma_across * two.sigma_across;
  const double turn_variance = turn_variance_one + two.sigma_angle * two.sigma_angle;
  const double shared = s * turn_variance_one;  // a line that turns moves what lies ahead on it
  const double det = offset_variance * turn_variance - shared * shared;
  return (offset * offset * turn_variance - 2.0 * offset * turn * shared + turn * turn * offset_variance) / det;
}

void Segmenter::rate_merge(const Points& points, std::size_t i) {
  Piece& piece = pieces_[i];
  piece.merge_cost = kNever;
  piece.merge_with = 0;
  for (std::size_t skip = 1; skip <= 2 && i + skip < pieces_.size(); ++skip) {
    if (skip == 2 && pieces_[i + 1].size() > params_.bridged_outliers) break;
    const double cost = merge_cost(points, piece, pieces_[i + skip]);
    if (cost > params_.merge_chi2 || cost >= piece.merge_cost) continue;
    piece.merge_cost = cost;
    piece.merge_with = static_cast<int>(skip);
  }
}

/// Joins the two neighbours that fit one line best, until none do.
void Segmenter::merge(const Points& points) {
  for (std::size_t i = 0; i < pieces_.size(); ++i) rate_merge(points, i);
  while (true) {
    const auto best = std::min_element(pieces_.begin(), pieces_.end(),
                                       [](const Piece& a, const Piece& b) { return a.merge_cost < b.merge_cost; });
    if (best == pieces_.end() || best->merge_with == 0) return;
    const Piece& other = *(best + best->merge_with);
    const LineFit joint = fit_line(span(points, best->first, other.last), noise_);
    const DirectedLine line = joint.line;
    const double growth = judge_line(span(points, best->first, best->last), line, noise_).chi2 +
                          judge_line(span(points, other.first, other.last), line, noise_).chi2 -
                          chi2_of_own_line(best->fit, best->size()) - chi2_of_own_line(other.fit, other.size());
    if (growth > params_.merge_chi2) {
      best->merge_cost = kNever;
      best->merge_with = 0;
      continue;
    }
    best->last = other.last;
    best->fit = joint;
    const std::size_t at = static_cast<std::size_t>(best - pieces_.begin());
    pieces_.erase(best + 1, best + 1 + best->merge_with);
    for (std::size_t i = at < 2 ? 0 : at - 2; i <= at; ++i) rate_merge(points, i);
  }
}

/// Each reading of first..last goes to the line that explains it. The lines are prolonged, so their own errors count,
/// and with the logarithm, or the vaguer line would explain more.
Segmenter::Boundary Segmenter::boundary(const Points& points, const Piece& a, const Piece& b, int first,
                                        int last) const {
  const DirectedLine line_a = a.fit.line, line_b = b.fit.line;
  Boundary best{.last_of_a = first - 1, .chi2 = 0.0};
  double balance = 0.0, least = 0.0, chi2 = 0.0, chi2_at_best = 0.0;
  for (int k = first; k <= last; ++k) {
    const Misfit to_a = misfit(points[k], line_a), to_b = misfit(points[k], line_b);
    best.chi2 += to_b.chi2;
    chi2 += to_a.chi2 - to_b.chi2;
    balance += to_a.chi2 + to_a.log_vagueness - to_b.chi2 - to_b.log_vagueness;
    if (balance >= least) continue;
    least = balance;
    chi2_at_best = chi2;
    best.last_of_a = k;
  }
  best.chi2 += chi2_at_best;
  return best;
}

/// A piece that its neighbours explain as well, each a part of it, is no line of its own: the few readings round a
/// corner.
void Segmenter::absorb(const Points& points) {
  for (std::size_t i = 1; i + 1 < pieces_.size();) {
    Piece &a = pieces_[i - 1], &piece = pieces_[i], &b = pieces_[i + 1];
    const bool small =
        piece.size() <= std::min(a.size(), b.size()) && std::min(a.size(), b.size()) >= params_.min_support;
    const bool linked =
        connected(points[a.last], points[piece.first]) && connected(points[piece.last], points[b.first]);
    const Boundary shared =
        small && linked ? boundary(points, a, b, piece.first, piece.last) : Boundary{a.last, kNever};
    const bool explained =
        shared.chi2 - chi2_of_own_line(piece.fit, piece.size()) <= params_.merge_chi2;  // false for nan
    if (!(small && linked && explained)) {
      ++i;
      continue;
    }
    a.last = shared.last_of_a;
    b.first = shared.last_of_a + 1;
    a.fit = fit_line(span(points, a.first, a.last), noise_);
    b.fit = fit_line(span(points, b.first, b.last), noise_);
    pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// Each reading near the boundary of two neighbours goes to the line that explains it.
void Segmenter::move_boundaries(const Points& points) {
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) {
    Piece &a = pieces_[i], &b = pieces_[i + 1];
    if (std::min(a.size(), b.size()) < params_.min_support || !connected(points[a.last], points[b.first])) continue;
    const int last =
        boundary(points, a, b, a.first + std::max(2, a.size() / 2), b.last - std::max(2, b.size() / 2)).last_of_a;
    if (last == a.last) continue;
    a.last = last;
    b.first = last + 1;
    a.fit = fit_line(span(points, a.first, a.last), noise_);
    b.fit = fit_line(span(points, b.first, b.last), noise_);
  }
}

void Segmenter::settle(const Points& points) {
  merge(points);
  absorb(points);
  move_boundaries(points);
}

/// A full turn without a break is begun at another piece, so that what met at its ends can be settled, too.
void Segmenter::turn_pieces(Points& points) {
  const auto half = static_cast<std::ptrdiff_t>(pieces_.size() / 2);
  const int shift = pieces_[static_cast<std::size_t>(half)].first;
  const int n = static_cast<int>(points.size());
  std::rotate(points.begin(), points.begin() + shift, points.end());
  std::rotate(pieces_.begin(), pieces_.begin() + half, pieces_.end());
  for (Piece& piece : pieces_) {
    const int size = piece.size();
    piece.first = (piece.first - shift + n) % n;
    piece.last = piece.first + size - 1;
  }
}

void Segmenter::keep_lines(const Points& points, std::vector<RangeSegment>& segments) const {
  const double outlier = noise_.params.no_weight_from;
  for (const Piece& piece : pieces_) {
    RangeSegment segment{.first = piece.first, .last = piece.last, .fit = piece.fit};
    const DirectedLine line = segment.fit.line;
    const auto strays = [&](int k) { return std::abs(residual_sigmas(points[k], line, noise_)) >= outlier; };
    while (segment.first < segment.last && strays(segment.first)) ++segment.first;
    while (segment.last > segment.first && strays(segment.last)) --segment.last;
    if (segment.fit.support < params_.min_support) continue;
    double sine = 0.0;
    for (int k = segment.first; k <= segment.last; ++k) sine += std::abs(line.normal.dot(points[k].ray));
    if (sine < params_.min_sine * (segment.last - segment.first + 1)) continue;
    segment.extent = {piece.fit.line.foot_of(points[segment.first].position),
                      piece.fit.line.foot_of(points[segment.last].position)};
    if (segment.extent.length() < 1e-6) continue;
    segment.spacing_a = spacing_at(points[segment.first], line, increment_, params_.min_sine);
    segment.spacing_b = spacing_at(points[segment.last], line, increment_, params_.min_sine);
    segments.push_back(segment);
  }
}

void Segmenter::segment(std::span<const float> ranges_m, Points& points, std::vector<RangeSegment>& segments) {
  segments.clear();
  pieces_.clear();
  std::erase_if(points, [](const ScanPoint& point) { return !(point.range_m < kFarthest); });
  if (clockwise_) std::reverse(points.begin(), points.end());
  if (static_cast<int>(points.size()) < params_.min_support || increment_ <= 0.0) return;
  rotate_to_break(points);
  split_runs(points);
  if (params_.merge_chi2 > 0.0) {
    settle(points);
    if (turn_ > 0 && pieces_.size() > 1 && connected(points.back(), points.front())) {
      turn_pieces(points);
      settle(points);
    }
  }
  keep_lines(points, segments);
  judge_ends(ranges_m, points, segments);
  place_ends(segments);
}

}  // namespace credo::perception
