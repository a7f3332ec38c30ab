// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

// Statistics over acquisitions that come in independent clusters. Acquisitions of one run are alike, so a resample
// draws clusters: every statistic here takes how often each cluster was drawn.
namespace credo::evaluation {

/// A number with the ends of its 95 % interval; nan where no interval is known.
struct Estimate {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// How often each cluster counts.
using Weights = std::span<const int>;

/// One acquisition.
struct ClusteredValue {
  double value = 0.0;
  std::size_t cluster = 0;
  bool good = false;  ///< what a probability is compared with
};

/// Sum of numerators over sum of denominators. Index: cluster.
struct ClusteredRatio {
  std::vector<double> numerators, denominators;

  explicit ClusteredRatio(std::size_t clusters) : numerators(clusters, 0.0), denominators(clusters, 0.0) {}
  void add(std::size_t cluster, double numerator, double denominator) {
    numerators[cluster] += numerator;
    denominators[cluster] += denominator;
  }
  /// Nothing where the denominators sum to 0.
  [[nodiscard]] std::optional<double> operator()(Weights weights) const;
};

/// Values in rising order.
class ClusteredValues {
 public:
  explicit ClusteredValues(std::vector<ClusteredValue> values);

  /// The smallest value that at least this share of the values does not exceed; nothing without values.
  [[nodiscard]] std::optional<double> quantile(double share, Weights weights) const;
  /// Probability that a good one has the higher value than another (evaluation::auroc).
  [[nodiscard]] std::optional<double> auroc(Weights weights) const;
  /// Of the values as probabilities of being good, in bins of equal count (evaluation::calibration_error).
  [[nodiscard]] std::optional<double> calibration_error(Weights weights, int bins = 10) const;

 private:
  [[nodiscard]] long total(Weights weights) const;

  std::vector<ClusteredValue> values_;
};

struct BootstrapParams {
  int resamples = 1000;  ///< the ends of a 95 % interval are then the 25th from either side
  std::uint64_t seed = 1;
};

/// The statistic with every cluster once, and its 95 % percentile interval over resamples of the clusters (Efron and
/// Tibshirani 1993, ch. 13). One cluster says nothing of the spread: the ends are then nan.
/// \returns nothing where the statistic is nothing with every cluster once
[[nodiscard]] std::optional<Estimate> bootstrap(std::size_t clusters,
                                                const std::function<std::optional<double>(Weights)>& statistic,
                                                const BootstrapParams& params = {});

}  // namespace credo::evaluation
