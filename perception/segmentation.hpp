// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "perception/line_fit.hpp"
#include "perception/scene.hpp"
#include "sensors/range_finder.hpp"

namespace credo::perception {

struct SegmentationParams {
  // Breaks: neighbouring readings further apart than a wall can explain that is seen at `grazing_rad` or steeper
  // (Borges and Aldon 2004).
  double grazing_rad = 0.1745;
  double break_sigmas = 3.0;  ///< added to that, in expected standard deviations of the range
  int bridged_outliers = 2;   ///< lone readings in a row that do not break a wall
  int missing_beams = 2;      ///< beams without a reading in a row that do not break a wall,
  double missing_rad = 0.05;  ///< or as many as this angle holds
  // Duda-Hart: a run is split at the point that is farthest from the chord through its ends.
  double split_sigmas = 3.0;  ///< of the point and its two neighbours across the chord: of the median of the three, in
                              ///< its expected standard deviations
  double split_m = 0.0;       ///< > 0: in metres instead, of the single farthest point (Clerentin et al.)
  // Collinear neighbours are one.
  double merge_chi2 = 20.0;  ///< growth by joining two; the place was chosen to part them, so this is 99 % of the
                             ///< largest of many, not of one with 2 degrees of freedom; 0: nothing is merged
  double merge_gap_m = 0.5;  ///< at most, where beams are missing between them
  // What is kept.
  int min_support = 3;
  double min_sine = 0.09;      ///< of the mean angle between beams and line: flatter is a mixture of near and far
  double corner_sine = 0.26;   ///< sharper junctions lie where the lines meet
  int open_beams = 3;          ///< empty ones in a row that make an end open,
  double open_reach = 0.7;     ///< where the wall would have been seen within this share of the largest range
  double open_sine = 0.35;     ///< and not flatter than this
  double joined_sigmas = 4.0;  ///< ends this close are one junction, in expected standard deviations of their distance
};

/// A straight run of range readings.
struct RangeSegment {
  int first = 0;  ///< point index, inclusive
  int last = 0;   ///< inclusive
  LineFit fit{};
  geometry::Segment extent{};  ///< a before b counter-clockwise
  SegmentEnd end_a = SegmentEnd::kUnseen;
  SegmentEnd end_b = SegmentEnd::kUnseen;
  double spacing_a = 0.0;  ///< distance to the next reading that a continued wall would give, at each end [m]
  double spacing_b = 0.0;
  double jump_a_sigmas = 0.0;  ///< how much farther a free end's neighbour is, in expected standard deviations
  double jump_b_sigmas = 0.0;
  double gap_to_next_m = 0.0;       ///< from end b to end a of the next segment, counter-clockwise
  double gap_to_next_sigmas = 0.0;  ///< in expected standard deviations
};

/// Cuts scans into straight segments: breaks, Duda-Hart splits, merging of collinear neighbours, boundaries, fits.
/// Keeps its scratch memory.
class Segmenter {
 public:
  Segmenter(const sensors::RangeFinder& range_finder, const SegmentationParams& params,
            const LineFitParams& fit_params);

  /// \param ranges_m  as measured, by beam: tells empty beams (inf) from missing ones (nan)
  /// \param points  in beam order, of one scan; those beyond any sensor's reach are left out; left in counter-clockwise
  /// order, those of a full turn rotated so that no segment spans
  ///                the ends of the vector.
  /// \param segments  cleared first; counter-clockwise.
  void segment(std::span<const float> ranges_m, std::vector<sensors::ScanPoint>& points,
               std::vector<RangeSegment>& segments);

  [[nodiscard]] const PointNoise& noise() const { return noise_; }
  [[nodiscard]] double beam_increment() const { return increment_; }

 private:
  struct Piece {
    int first = 0;
    int last = 0;
    LineFit fit;
    double merge_cost = 0.0;  ///< growth of chi-square by merging with a later one
    int merge_with = 0;       ///< 0: none, 1: the next, 2: the one after, which skips one or two stray readings

    [[nodiscard]] int size() const { return last - first + 1; }
  };

  using Points = std::vector<sensors::ScanPoint>;

  void rotate_to_break(Points& points) const;
  void split_runs(const Points& points);
  void split(const Points& points, int first, int last);
  [[nodiscard]] int split_point(const Points& points, int first, int last) const;
  void merge(const Points& points);
  void rate_merge(const Points& points, std::size_t piece);
  void settle(const Points& points);
  void absorb(const Points& points);
  void turn_pieces(Points& points);
  void move_boundaries(const Points& points);
  void keep_lines(const Points& points, std::vector<RangeSegment>& segments) const;
  void judge_ends(std::span<const float> ranges_m, const Points& points, std::vector<RangeSegment>& segments) const;
  void place_ends(std::vector<RangeSegment>& segments) const;

  [[nodiscard]] std::span<const sensors::ScanPoint> span(const Points& points, int first, int last) const {
    return {points.data() + first, static_cast<std::size_t>(last - first + 1)};
  }
  [[nodiscard]] int beams_between(const sensors::ScanPoint& a, const sensors::ScanPoint& b) const;
  [[nodiscard]] bool connected(const sensors::ScanPoint& a, const sensors::ScanPoint& b) const;
  /// The best boundary between the lines of `a` and `b` for the points first..last, and chi-square with it.
  struct Boundary {
    int last_of_a = 0;
    double chi2 = 0.0;
  };
  [[nodiscard]] Boundary boundary(const Points& points, const Piece& a, const Piece& b, int first, int last) const;
  struct Misfit {
    double chi2 = 0.0;           ///< squared residual in expected standard deviations; at most that of an outlier
    double log_vagueness = 0.0;  ///< of the variance with the line's error to that without
  };
  [[nodiscard]] Misfit misfit(const sensors::ScanPoint& point, const DirectedLine& line) const;
  [[nodiscard]] double merge_cost(const Points& points, const Piece& a, const Piece& b) const;
  struct Beside {
    SegmentEnd end = SegmentEnd::kUnseen;
    double jump_sigmas = 0.0;
  };
  [[nodiscard]] Beside end_beside(std::span<const float> ranges_m, const Points& points, const RangeSegment& segment,
                                  int end, int step) const;
  [[nodiscard]] bool open_beside(std::span<const float> ranges_m, const sensors::ScanPoint& end,
                                 const geometry::LineEstimate& line, int step) const;

  PointNoise noise_;
  SegmentationParams params_;
  double increment_ = 0.0;  ///< positive
  bool clockwise_ = false;
  int turn_ = 0;  ///< beams of a full turn; 0 where the scan does not close
  double range_max_ = 0.0;
  int allowed_beams_ = 1;  ///< from one reading to the next of the same wall
  std::vector<Piece> pieces_;
};

}  // namespace credo::perception
