// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/utility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace credo::evidence {
namespace {

struct Expectations {
  double lower = 0.0;
  double upper = 0.0;
  double pignistic = 0.0;
};

Expectations expectations(const MassFunction& mass, std::span<const double> values) {
  const Frame& frame = mass.frame();
  if (!frame.is_power_set() || values.size() != frame.size()) {
    throw std::invalid_argument("an expectation needs a frame of Shafer's model and one value for each of its " +
                                std::to_string(frame.size()) + " elements; got " + std::to_string(values.size()));
  }
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) {
    throw std::invalid_argument("the values of an expectation must be finite");
  }
  Expectations sum;
  double kept = 0.0;
  for (const Focal& focal : mass.focals()) {
    if (focal.set.empty()) continue;
    double least = std::numeric_limits<double>::infinity(), most = -least, mean = 0.0;
    const auto count = static_cast<double>(focal.set.count());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!focal.set.contains(i)) continue;
      least = std::min(least, values[i]);
      most = std::max(most, values[i]);
      mean += values[i] / count;
    }
    sum.lower += focal.mass * least;
    sum.upper += focal.mass * most;
    sum.pignistic += focal.mass * mean;
    kept += focal.mass;
  }
  if (!(kept > 0.0)) throw std::domain_error("total conflict: there is no mass left to expect a value of");
  return {sum.lower / kept, sum.upper / kept, sum.pignistic / kept};
}

std::vector<Expectations> of_acts(const MassFunction& mass, std::span<const double> utilities) {
  const std::size_t elements = mass.frame().size();
  if (utilities.empty() || utilities.size() % elements != 0) {
    throw std::invalid_argument("acts need one utility for each of the " + std::to_string(elements) +
                                " elements; got " + std::to_string(utilities.size()) + " in all");
  }
  std::vector<Expectations> acts;
  for (std::size_t first = 0; first < utilities.size(); first += elements) {
    acts.push_back(expectations(mass, utilities.subspan(first, elements)));
  }
  return acts;
}

template <typename Value>
Decision best(const std::vector<Expectations>& acts, Value value) {
  Decision decision{.rejected = false, .choice = 0, .value = value(acts.front())};
  for (std::size_t i = 1; i < acts.size(); ++i) {
    if (value(acts[i]) > decision.value) decision = {.rejected = false, .choice = i, .value = value(acts[i])};
  }
  decision.margin = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < acts.size(); ++i) {
    if (i != decision.choice) decision.margin = std::min(decision.margin, decision.value - value(acts[i]));
  }
  return decision;
}

}  // namespace

double lower_expectation(const MassFunction& mass, std::span<const double> values) {
  return expectations(mass, values).lower;
}
double upper_expectation(const MassFunction& mass, std::span<const double> values) {
  return expectations(mass, values).upper;
}
double pignistic_expectation(const MassFunction& mass, std::span<const double> values) {
  return expectations(mass, values).pignistic;
}

Decision best_act(const MassFunction& mass, std::span<const double> utilities, double pessimism) {
  if (!(pessimism >= 0.0 && pessimism <= 1.0)) {
    throw std::invalid_argument("pessimism must be in [0, 1]; got " + std::to_string(pessimism));
  }
  return best(of_acts(mass, utilities),
              [&](const Expectations& e) { return pessimism * e.lower + (1.0 - pessimism) * e.upper; });
}

Decision best_act_pignistic(const MassFunction& mass, std::span<const double> utilities) {
  return best(of_acts(mass, utilities), [](const Expectations& e) { return e.pignistic; });
}

std::vector<std::size_t> undominated_acts(const MassFunction& mass, std::span<const double> utilities) {
  const std::vector<Expectations> acts = of_acts(mass, utilities);
  const double safest = std::ranges::max(acts, {}, &Expectations::lower).lower;
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < acts.size(); ++i) {
    if (acts[i].upper >= safest) result.push_back(i);
  }
  return result;
}

}  // namespace credo::evidence
