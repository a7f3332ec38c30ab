// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/moebius.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

namespace credo::evidence {
namespace {

// The halves of a block that do not and that do contain the element, whose number is log2(half).
template <typename Step>
void for_each_pair(double* block, std::size_t half, Step step) {
  for (std::size_t i = 0; i < half; ++i) step(block[i], block[half + i]);
}

// For each element in turn, all pairs of subsets that differ in it. The first three elements are done in one pass:
// loops of one, two and four steps would cost more than what they do.
template <typename Step>
void for_each_element(std::span<double> values, Step step) {
  assert(std::has_single_bit(values.size()));
  constexpr std::size_t kBlock = 8;
  const std::size_t size = values.size();
  std::size_t half = 1;
  if (size >= kBlock) {
    for (double* block = values.data(); block != values.data() + size; block += kBlock) {
      for (const std::size_t i : {0, 2, 4, 6}) for_each_pair(block + i, 1, step);
      for (const std::size_t i : {0, 4}) for_each_pair(block + i, 2, step);
      for_each_pair(block, 4, step);
    }
    half = kBlock;
  }
  for (; half < size; half *= 2) {
    for (std::size_t block = 0; block < size; block += 2 * half) for_each_pair(values.data() + block, half, step);
  }
}

void check_dense(const Frame& frame) {
  if (!frame.is_power_set() || frame.size() > kMaxDenseElements) {
    throw std::invalid_argument("a function of all subsets needs a frame of Shafer's model with at most " +
                                std::to_string(kMaxDenseElements) + " elements; this one has " +
                                std::to_string(frame.size()) + (frame.is_power_set() ? "" : " that may overlap"));
  }
}

void check_size(const Frame& frame, std::size_t size) {
  check_dense(frame);
  const std::size_t expected = std::size_t{1} << frame.size();
  if (size != expected) {
    throw std::invalid_argument("a dense function on " + std::to_string(frame.size()) + " elements has " +
                                std::to_string(expected) + " values, not " + std::to_string(size));
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

MassFunction from_dense(const Frame& frame, std::span<const double> values) {
  check_size(frame, values.size());
  std::vector<Focal> focals;
  for (std::size_t bits = 0; bits < values.size(); ++bits) {
    if (values[bits] != 0.0) focals.push_back({Proposition::from_bits(bits), values[bits]});
  }
  return MassFunction(frame, std::span<const Focal>(focals));
}

std::optional<MassFunction> from_commonality(const Frame& frame, std::vector<double> commonalities) {
  check_size(frame, commonalities.size());
  if (!(std::abs(commonalities[0] - 1.0) <= kMassTolerance)) return std::nullopt;
  std::vector<double> masses = commonalities;
  commonality_to_mass(masses);
  MassFunction result(frame);
  result.focals_.resize(masses.size());
  std::size_t kept = 0;
  for (std::size_t bits = 0; bits < masses.size(); ++bits) {
    const double rounding = kTransformRounding * commonalities[bits];
    if (!(masses[bits] >= -rounding)) return std::nullopt;
    result.focals_[kept] = {Proposition::from_bits(bits), masses[bits]};
    kept += masses[bits] > rounding ? 1 : 0;
  }
  const bool all_is_small = kept == 0 || result.focals_[kept - 1].set != frame.all();
  if (all_is_small && masses.back() > 0.0) result.focals_[kept++] = {frame.all(), masses.back()};
  result.focals_.resize(kept);
  double sum = 0.0;
  for (const Focal& focal : result.focals_) sum += focal.mass;
  for (Focal& focal : result.focals_) focal.mass /= sum;
  return result;
}

bool dense_is_faster(const Sources& sources) {
  const Frame frame = sources.common_frame();
  constexpr std::size_t kMinElements = 6;  // below, pairs take next to nothing and are more accurate
  if (!frame.is_power_set() || frame.size() < kMinElements || frame.size() > kMaxDenseElements) return false;
  constexpr double kPairPerAddition = 16.0;  // one pair costs as much
  const double subsets = std::ldexp(1.0, static_cast<int>(frame.size()));
  double pairs = 0.0, focals = 1.0;
  for (const MassFunction& source : sources) {
    const auto count = static_cast<double>(source.focals().size());
    pairs += focals * count;
    focals = std::min(subsets, focals * count);
  }
  const double additions = (static_cast<double>(sources.size()) + 1.0) * static_cast<double>(frame.size()) * subsets;
  return kPairPerAddition * pairs > additions;
}

}  // namespace credo::evidence
