// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <limits>
#include <span>

#include "evidence/belief_shapes.hpp"
#include "perception/line_fit.hpp"
#include "perception/scene.hpp"

namespace credo::perception {

/// What the five criteria of a segment's existence look at (Clerentin et al., sec. 3.1). nan: could not be measured.
struct SegmentMeasures {
  double mean_residual_m = std::numeric_limits<double>::quiet_NaN();
  double mean_residual_sigmas = std::numeric_limits<double>::quiet_NaN();  ///< in expected standard deviations
  int support = 0;                                                         ///< points
  double density_per_m = 0.0;                                              ///< points along the segment
  double relative_density = 0.0;  ///< 1: a wall seen head-on at 2 m by the same scanner
  int endpoint_case = 0;          ///< 1..5; 0: there is no camera
  double mean_gray_deviation = std::numeric_limits<double>::quiet_NaN();  ///< from the straight line [grey levels]
  double mean_gray_sigmas = std::numeric_limits<double>::quiet_NaN();     ///< the same in expected standard deviations
};

/// Belief shapes of the five criteria. The figures that held the paper's are lost; these are ours (docs/equations.md).
struct CriteriaParams {
  /// 1: mean |residual| of the points, in expected standard deviations. Normal noise gives 0.8.
  evidence::RampBelief alignment{.max_yes = 0.8,
                                 .yes_full_until = 1.0,
                                 .yes_zero_from = 2.5,
                                 .max_no = 0.5,
                                 .no_zero_until = 2.0,
                                 .no_full_from = 4.0};
  /// 2: number of points.
  evidence::RampBelief support{.max_yes = 0.6,
                               .yes_full_until = 12.0,
                               .yes_zero_from = 3.0,
                               .max_no = 0.4,
                               .no_zero_until = 6.0,
                               .no_full_from = 3.0};
  /// 3: density of points, relative to a wall seen head-on at 2 m. Far is ignorance, not denial.
  evidence::RampBelief density{.max_yes = 0.7,
                               .yes_full_until = 1.0,
                               .yes_zero_from = 0.2,
                               .max_no = 0.0,
                               .no_zero_until = 0.0,
                               .no_full_from = 0.0};
  /// 4: the five cases of the ends, (YES, NO) each.
  std::array<std::array<double, 2>, 5> cases{{{0.10, 0.20}, {0.30, 0.10}, {0.50, 0.0}, {0.65, 0.0}, {0.80, 0.0}}};
  /// 5: mean deviation of the grey levels over the segment from a straight line, in expected standard deviations.
  evidence::RampBelief gray{.max_yes = 0.6,
                            .yes_full_until = 2.0,
                            .yes_zero_from = 8.0,
                            .max_no = 0.4,
                            .no_zero_until = 8.0,
                            .no_full_from = 24.0};
  bool absolute = false;   ///< breakpoints in metres, points per metre and grey levels instead
  double head_on_m = 2.0;  ///< the wall that densities are relative to

  /// The shapes with absolute breakpoints that go with the paper's method.
  [[nodiscard]] static CriteriaParams paper();
};

/// The five masses; a criterion that could not be measured is vacuous.
[[nodiscard]] std::array<evidence::BinaryMass, 5> segment_criteria(const SegmentMeasures& measures,
                                                                   const CriteriaParams& params = {});

/// Points along the line that was fitted to them: how they fit it and their density. Sets the residuals, support and
/// densities. The mean residual is corrected for the two parameters that the line took; below four points it says
/// nothing and is nan.
void measure_points(std::span<const sensors::ScanPoint> points, const geometry::LineEstimate& line,
                    double beam_increment, const PointNoise& noise, const CriteriaParams& params,
                    SegmentMeasures& measures);

/// Mean |deviation| of the grey-level curve from its least-squares straight line over the sector of the given
/// width from azimuth `from` counter-clockwise; the bins beside the ends, which the edges there blur, are left out.
/// \returns nan for an empty curve or fewer than 4 bins.
[[nodiscard]] double gray_deviation(const GrayCurve& gray, double from, double width);

/// Sums the conflicts of the segments' criteria; `write` puts their means into the scene.
struct ConflictMeans {
  ConflictReport sums;
  double sum = 0.0;
  int segments = 0;

  void add(const std::array<evidence::BinaryMass, 5>& criteria, double conflict);
  void write(Scene& scene) const;
};

}  // namespace credo::perception
