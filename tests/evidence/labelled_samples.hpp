// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "evidence/shape_fitting.hpp"

/// Samples of known truths, to fit shapes to and to judge them by.
namespace credo::evidence {

inline double rising_truth(double x) { return 1.0 / (1.0 + std::exp(-1.5 * x)); }
inline double falling_truth(double x) { return rising_truth(-x); }
inline double flat_truth(double) { return .3; }

/// x uniform in [-3, 3], labels true with the probability of the truth.
inline std::vector<LabelledSample> drawn(double (*truth)(double), std::size_t count, unsigned seed) {
  std::mt19937_64 generator(seed);
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  std::vector<LabelledSample> samples(count);
  for (LabelledSample& sample : samples) {
    sample.x = 6.0 * uniform() - 3.0;
    sample.label = uniform() < truth(sample.x);
  }
  return samples;
}

inline constexpr unsigned kSeeds = 20;

inline PiecewiseBelief fitted_shape(double (*truth)(double), std::size_t count, double confidence, unsigned seed) {
  const ShapeTitle title{.name = "fitted", .quantity = "score", .unit = "1"};
  return fit_shape(drawn(truth, count, seed), title, {.confidence = confidence}).shape;
}

/// Means over the seeds of shapes fitted to `count` samples and judged by 20 000 others.
inline Calibration mean_calibration(double (*truth)(double), std::size_t count, double confidence) {
  Calibration mean;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const PiecewiseBelief shape = fitted_shape(truth, count, confidence, seed);
    const Calibration one = calibration_of(shape, drawn(truth, 20'000, seed + 1000));
    mean.coverage += one.coverage / kSeeds;
    mean.calibration_error += one.calibration_error / kSeeds;
    mean.mean_unknown += one.mean_unknown / kSeeds;
  }
  return mean;
}

/// How fitted shapes hold the truth itself, without the scatter of samples to judge by.
struct HeldTruth {
  double held = 0.0;  ///< share of 600 places in [-3, 3] where the true probability lies in [Bel, Pl]
  double unknown = 0.0;
};

/// Means over the seeds.
inline HeldTruth held_truth(double (*truth)(double), std::size_t count, double confidence) {
  constexpr int kPlaces = 600;
  HeldTruth mean;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const PiecewiseBelief shape = fitted_shape(truth, count, confidence, seed);
    for (int i = 0; i < kPlaces; ++i) {
      const double x = -3.0 + 6.0 * (i + 0.5) / kPlaces;
      const BinaryMass mass = shape(x);
      const bool held = mass.belief() <= truth(x) && truth(x) <= mass.plausibility();
      mean.held += (held ? 1.0 : 0.0) / (kSeeds * kPlaces);
      mean.unknown += mass.unknown / (kSeeds * kPlaces);
    }
  }
  return mean;
}

}  // namespace credo::evidence
