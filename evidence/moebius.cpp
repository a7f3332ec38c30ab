// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/moebius.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

namespace credo::evidence {
namespace {

// For each element in turn, the halves of every block that do not and that do contain it.
template <typename Step>
void for_each_element(std::span<double> values, Step step) {
  assert(std::has_single_bit(values.size()));
  const std::size_t size = values.size();
  for (std::size_t half = 1; half < size; half *= 2) {
    for (std::size_t block = 0; block < size; block += 2 * half) {
      double* without = values.data() + block;
      double* with = without + half;
      for (std::size_t i = 0; i < half; ++i) step(without[i], with[i]);
    }
  }
}

void check_dense(const Frame& frame) {
  if (!frame.is_power_set() || frame.size() > kMaxDenseElements) {
    throw std::invalid_argument("dense functions need a frame of Shafer's model with at most " +
                                std::to_string(kMaxDenseElements) + " elements");
  }
}

}  // namespace

void mass_to_commonality(std::span<double> values) {
  for_each_element(values, [](double& without, double& with) { without += with; });
}
void commonality_to_mass(std::span<double> values) {
  for_each_element(values, [](double& without, double& with) { without -= with; });
}
void mass_to_implicability(std::span<double> values) {
  for_each_element(values, [](double& without, double& with) { with += without; });
}
void implicability_to_mass(std::span<double> values) {
  for_each_element(values, [](double& without, double& with) { with -= without; });
}

std::vector<double> to_dense(const MassFunction& mass) {
  check_dense(mass.frame());
  std::vector<double> values(std::size_t{1} << mass.frame().size());
  for (const Focal& focal : mass.focals()) values[focal.set.low_bits()] = focal.mass;
  return values;
}

MassFunction from_dense(const Frame& frame, std::span<const double> values, double negligible) {
  check_dense(frame);
  if (values.size() != std::size_t{1} << frame.size()) {
    throw std::invalid_argument("a dense function on " + std::to_string(frame.size()) + " elements has " +
                                std::to_string(std::size_t{1} << frame.size()) + " values, not " +
                                std::to_string(values.size()));
  }
  // Valid ones are ordered and each once already.
  MassFunction result(frame);
  result.focals_.reserve(values.size());
  double sum = 0.0;
  bool valid = true;
  for (std::size_t bits = 0; bits < values.size(); ++bits) {
    const double mass = values[bits];
    if (mass <= negligible && mass >= -negligible) continue;
    valid = valid && mass > 0.0;
    sum += mass;
    result.focals_.push_back({Proposition::from_bits(bits), mass});
  }
  if (!valid || !(std::abs(sum - 1.0) <= kMassTolerance)) return MassFunction(frame, result.focals_);  // says why not
  for (Focal& focal : result.focals_) focal.mass /= sum;
  return result;
}

}  // namespace credo::evidence
