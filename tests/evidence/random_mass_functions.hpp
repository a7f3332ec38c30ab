// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <gtest/gtest.h>

#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "evidence/mass_function.hpp"

/// Random mass functions on frames of every model for RapidCheck. What is drawn are small numbers, so that failures
/// shrink to few focal elements with round masses.
namespace credo::evidence {

using Masses = std::vector<MassFunction>;

/// What masses are drawn.
struct MassDomain {
  std::vector<Frame> frames;
  bool some_unknown = false;   ///< every one has mass on Θ
  bool some_conflict = false;  ///< every one has mass on ∅
  bool emptied = false;        ///< also on what the constraints of a hybrid model empty
  bool tiny = false;           ///< down to 1e-310
};

inline std::vector<std::string> element_names(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.emplace_back(1, static_cast<char>('A' + i));
  return names;
}

/// 2^Θ for n = 2, 3, 4, 6, 10.
inline const std::vector<Frame>& power_sets() {
  static const std::vector<Frame> frames = [] {
    std::vector<Frame> result;
    for (const std::size_t n : {2u, 3u, 4u, 6u, 10u}) result.push_back(Frame::shafer(element_names(n)));
    return result;
  }();
  return frames;
}

/// D^Θ for n = 2, 3, 4.
inline const std::vector<Frame>& hyper_power_sets() {
  static const std::vector<Frame> frames = [] {
    std::vector<Frame> result;
    for (const std::size_t n : {2u, 3u, 4u}) result.push_back(Frame::free_dsm(element_names(n)));
    return result;
  }();
  return frames;
}

/// With exclusivity and non-existence constraints, n = 2, 3, 4.
inline const std::vector<Frame>& hybrids() {
  static const std::vector<Frame> frames = [] {
    const auto hybrid = [](std::size_t n, const std::vector<std::string>& empty) {
      return Frame::hybrid(element_names(n), empty);
    };
    return std::vector<Frame>{hybrid(2, {"A ∩ B"}), hybrid(3, {"A ∩ B"}), hybrid(3, {"C"}),
                              hybrid(4, {"A ∩ B", "C ∩ D"}), hybrid(4, {"A ∩ B ∩ C", "D ∩ A"})};
  }();
  return frames;
}

inline std::vector<Frame> all_hyper_power_sets() {
  std::vector<Frame> frames = hyper_power_sets();
  frames.insert(frames.end(), hybrids().begin(), hybrids().end());
  return frames;
}

inline std::vector<Frame> all_frames() {
  std::vector<Frame> frames = power_sets();
  const std::vector<Frame> others = all_hyper_power_sets();
  frames.insert(frames.end(), others.begin(), others.end());
  return frames;
}

/// The propositions of a frame, listed once for all draws.
inline const std::vector<Proposition>& propositions_of(const Frame& frame) {
  static std::vector<std::pair<Frame, std::vector<Proposition>>> known;
  const auto found = std::ranges::find_if(known, [&](const auto& each) { return each.first == frame; });
  if (found != known.end()) return found->second;
  known.emplace_back(frame, frame.propositions());
  return known.back().second;
}

/// Which proposition, and how many parts of the mass.
using Share = std::pair<int, int>;

inline MassFunction mass_function(const Frame& frame, const std::vector<Share>& shares, const MassDomain& domain) {
  std::vector<std::string> names;
  for (std::size_t i = 0; domain.emptied && i < frame.size(); ++i) names.push_back(frame.name(i));
  const std::vector<Proposition>& sets = propositions_of(domain.emptied ? Frame::free_dsm(names) : frame);
  std::vector<Focal> focals;
  double sum = 0.0;
  const auto add = [&](const Proposition& set, double parts) {
    focals.push_back({set, parts});
    sum += parts;
  };
  constexpr double kTiny[] = {0.0, 1e-310, 1e-200, 1e-80, 1e-12, 1e-3, 1.0, 3.0};
  for (const auto& [set, parts] : shares) {
    add(sets[static_cast<std::size_t>(set) % sets.size()], domain.tiny ? kTiny[parts] : parts);
  }
  if (domain.some_unknown || sum == 0.0) add(frame.all(), 1.0);
  if (domain.some_conflict) add(Proposition(), 1.0);
  for (Focal& focal : focals) focal.mass /= sum;
  return MassFunction(frame, focals);
}

/// `count` mass functions on one of the domain's frames, each with up to five focal elements.
inline rc::Gen<std::vector<MassFunction>> random_sources(std::size_t count, const MassDomain& domain) {
  constexpr std::size_t kFocals = 5;
  constexpr int kSets = 1 << 10, kParts = 8, kFullRange = 100;
  const auto share = rc::gen::pair(rc::gen::inRange(0, kSets), rc::gen::inRange(0, kParts));
  const auto shares = rc::gen::container<std::vector<Share>>(kFocals, share);
  const auto draw = rc::gen::pair(rc::gen::inRange<std::size_t>(0, domain.frames.size()),
                                  rc::gen::container<std::vector<std::vector<Share>>>(count, shares));
  return rc::gen::map(rc::gen::resize(kFullRange, draw), [domain](const auto& drawn) {
    std::vector<MassFunction> result;
    for (const auto& each : drawn.second) result.push_back(mass_function(domain.frames[drawn.first], each, domain));
    return result;
  });
}

/// The largest difference of the masses of a proposition.
inline double distance(const MassFunction& a, const MassFunction& b) {
  double largest = 0.0;
  for (const Focal& focal : a.focals()) largest = std::max(largest, std::abs(a.mass(focal.set) - b.mass(focal.set)));
  for (const Focal& focal : b.focals()) largest = std::max(largest, std::abs(a.mass(focal.set) - b.mass(focal.set)));
  return largest;
}

inline double total(const MassFunction& mass) {
  double sum = 0.0;
  for (const Focal& focal : mass.focals()) sum += focal.mass;
  return sum;
}

}  // namespace credo::evidence
