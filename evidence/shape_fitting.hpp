// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "evidence/piecewise_belief.hpp"

namespace credo::evidence {

/// A measured quantity, and whether what it was measured of turned out true.
struct LabelledSample {
  double x = 0.0;
  bool label = false;
};

/// How the share of `true` changes with growing x.
enum class Direction { kRising, kFalling };

struct FitParams {
  int breakpoints = 16;      ///< at most; too few bend less than the truth, which many samples bring to light
  int min_samples = 5;       ///< of each breakpoint, unless there are fewer in all
  double confidence = 0.95;  ///< in (0, 1): how often [Bel, Pl] is to hold the true share, place by place
  std::optional<Direction> direction = {};  ///< none: the one that fits better
};

/// How well a shape agrees with samples. Samples are ordered by x and cut into bins of equal count, at least 10 samples
/// each (fewer bins for few samples); equal x stay together.
struct Calibration {
  std::size_t samples = 0;  ///< that were judged on
  std::size_t ignored = 0;  ///< whose x is not finite
  std::size_t bins = 0;
  /// Share of the bins whose frequency of `true` lies in [mean Bel, mean Pl] of their samples. The frequency of m
  /// samples scatters by sqrt(p (1 - p) / m) of its own: to compare with a confidence, judge on many more samples than
  /// were fitted.
  double coverage = 0.0;
  /// Share of the bins that speak against the shape however few their samples: the 95 % interval of Clopper and Pearson
  /// around their frequency does not meet [mean Bel, mean Pl]. Up to 0.05 is chance.
  double refuted = 0.0;
  double brier_score = 0.0;        ///< mean of (BetP - label)^2 (Brier 1950)
  double calibration_error = 0.0;  ///< mean over the samples of |mean BetP - frequency| of their bin (ECE)
  double mean_unknown = 0.0;       ///< mass of the frame: what being careful costs
};

/// Any shape judged by any samples, best by such as it was not fitted to.
/// \param bins  at most, >= 1
/// \throws std::invalid_argument if no sample has a finite x, or for another number of bins
[[nodiscard]] Calibration calibration_of(const PiecewiseBelief& shape, std::span<const LabelledSample> samples,
                                         int bins = 10);

struct FittedShape {
  PiecewiseBelief shape;
  Direction direction = Direction::kRising;  ///< given or found
  std::size_t samples = 0;                   ///< that were fitted
  std::size_t ignored = 0;                   ///< whose x is not finite
  /// Of a shape fitted in the same way to every other sample in the order of x, judged by those left out; nothing for
  /// fewer than two samples.
  std::optional<Calibration> held_out = {};
};

/// A monotone belief shape for which YES means: the label is true. The samples are cut by x into shares of equal count,
/// whose frequencies are made monotone by pooling (isotonic regression; Ayer et al. 1955). Each share gives a
/// breakpoint at its mean x, and its masses are the predictive belief of its pool: Bel is the lower and Pl the upper
/// bound of the probability (predictive_belief.hpp), so few samples leave most unknown. Bounds are then passed on to
/// the neighbours: a probability that does not fall is nowhere below an earlier lower bound, nor above a later upper
/// one. Breakpoints within a constant stretch are left out.
///
/// The order of the samples changes nothing in the shape; nor do samples whose x is not finite. The confidence is that
/// of each breakpoint, not of all at once, and takes the samples for independent.
/// \throws std::invalid_argument if no sample has a finite x, for parameters out of range and a title that is none
[[nodiscard]] FittedShape fit_shape(std::span<const LabelledSample> samples, const ShapeTitle& title,
                                    const FitParams& params = {});

}  // namespace credo::evidence
