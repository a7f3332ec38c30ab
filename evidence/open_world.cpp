// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/open_world.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

namespace credo::evidence {
namespace {

// There are quadrature rules of 1, 2, 3, ... kConsecutiveRules nodes, beyond that of the powers of two only: they are
// made once, and a rule of n nodes takes O(n^2).
constexpr std::size_t kConsecutiveRules = 32;

// Exact for polynomials up to this degree: 2 nodes - 1 >= degree.
std::size_t nodes_for_degree(std::size_t degree) {
  const std::size_t fewest = (degree + 2) / 2;
  return fewest <= kConsecutiveRules ? fewest : std::bit_ceil(fewest);
}

std::size_t nodes_before_rule(std::size_t nodes) {
  if (nodes <= kConsecutiveRules) return nodes * (nodes - 1) / 2;
  return kConsecutiveRules * (kConsecutiveRules + 1) / 2 + (nodes - 2 * kConsecutiveRules);
}

// Value and derivative of the Legendre polynomial of degree n at t, |t| < 1.
struct Legendre {
  double value;
  double slope;
};
Legendre legendre(int n, double t) {
  double previous = 1.0, current = t;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2.0 * k - 1.0) * t * current - (k - 1.0) * previous) / k;
    previous = current;
    current = next;
  }
  return {current, n * (t * current - previous) / (t * t - 1.0)};
}

// The i-th root of the Legendre polynomial, from the largest, by Newton's method.
double legendre_root(int n, int i) {
  double t = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
  for (int step = 0; step < 8; ++step) {
    const Legendre p = legendre(n, t);
    t -= p.value / p.slope;
  }
  return t;
}

struct Leaders {
  int first = -1;  // index; the number of candidates stands for *
  double best = -1.0;
  double second = 0.0;
};

Leaders leaders(std::span<const double> match, double none) {
  Leaders result;
  const int count = static_cast<int>(match.size());
  for (int i = 0; i <= count; ++i) {
    const double value = i < count ? match[i] : none;
    if (value > result.best) {
      result.second = std::max(0.0, result.best);
      result.best = value;
      result.first = i;
    } else {
      result.second = std::max(result.second, value);
    }
  }
  return result;
}

}  // namespace

void OpenWorldMatcher::reserve(std::size_t candidates) {
  evidence_.reserve(candidates);
  suffix_.reserve(candidates + 1);
  factors_.reserve(candidates + 1);
  open_.match.reserve(candidates);
  normalised_.match.reserve(candidates);
  plausibility_.match.reserve(candidates);
  pignistic_.match.reserve(candidates);
  prepare_nodes(nodes_for_degree(candidates));
}

void OpenWorldMatcher::combine(std::span<const BinaryMass> evidence) {
  const std::size_t count = evidence.size();
  evidence_.assign(evidence.begin(), evidence.end());
  suffix_.resize(count + 1);
  suffix_[count] = 1.0;
  for (std::size_t i = count; i-- > 0;) suffix_[i] = suffix_[i + 1] * (evidence[i].no + evidence[i].unknown);
  all_out_ = suffix_[0];

  // Clerentin et al., sec. 4.1: m(P_i) = m_i(P_i) prod_{j != i} (1 - m_j(P_j)), m(*) = prod m_j(not P_j), and in Theta
  // what of prod (1 - m_j(P_j)) is not *. One candidate after the other, so that nothing is subtracted.
  // The running values are local: as members they would go through memory with every candidate.
  open_.match.resize(count);
  double prefix = 1.0, claimed = 0.0, none = 1.0, unknown = 0.0, conflict = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const BinaryMass& m = evidence[i];
    const double out = m.no + m.unknown;
    open_.match[i] = m.yes * prefix * suffix_[i + 1];
    conflict += claimed * m.yes;
    claimed = claimed * out + prefix * m.yes;
    unknown = unknown * out + none * m.unknown;
    none *= m.no;
    prefix *= out;
  }
  open_.none = none;
  open_.unknown = unknown;
  open_.conflict = conflict;
  kept_ = claimed + all_out_;
}

const OpenWorldMasses& OpenWorldMatcher::normalised() {
  assert(!total_conflict());
  normalised_.match.resize(open_.match.size());
  std::ranges::transform(open_.match, normalised_.match.begin(), [this](double mass) { return mass / kept_; });
  normalised_.none = open_.none / kept_;
  normalised_.unknown = open_.unknown / kept_;
  normalised_.conflict = open_.conflict;
  return normalised_;
}

const OpenWorldValues& OpenWorldMatcher::plausibility() {
  assert(!total_conflict());
  plausibility_.match.resize(evidence_.size());
  double prefix = 1.0;
  for (std::size_t i = 0; i < evidence_.size(); ++i) {
    const BinaryMass& m = evidence_[i];
    plausibility_.match[i] = (m.yes + m.unknown) * prefix * suffix_[i + 1] / kept_;
    prefix *= m.no + m.unknown;
  }
  plausibility_.none = all_out_ / kept_;
  return plausibility_;
}

// A disjunction of k elements, * among them, gives 1/k = int_0^1 x^(k-1) dx to each. Summed over all disjunctions the
// integrand factorises: with b = m_i(not P_i), c = m_i(Theta),
//   K BetP(*)   = int_0^1 prod_i (b_i + c_i x) dx
//   K BetP(P_j) = m(P_j) + int_0^1 c_j x prod_{i != j} (b_i + c_i x) dx,
// polynomials of degree <= p, which Gauss-Legendre integrates exactly, with positive terms only.
const OpenWorldValues& OpenWorldMatcher::pignistic() {
  assert(!total_conflict());
  const std::size_t count = evidence_.size();
  const std::size_t rule = nodes_for_degree(count);
  prepare_nodes(rule);
  pignistic_.match.assign(open_.match.begin(), open_.match.end());
  pignistic_.none = 0.0;
  factors_.resize(count + 1);
  factors_[count] = 1.0;
  for (const Node& node : std::span(nodes_).subspan(nodes_before_rule(rule), rule)) {
    for (std::size_t i = count; i-- > 0;)
      factors_[i] = factors_[i + 1] * (evidence_[i].no + evidence_[i].unknown * node.x);
    pignistic_.none += node.weight * factors_[0];
    double prefix = node.weight;
    for (std::size_t i = 0; i < count; ++i) {
      const double shared = evidence_[i].unknown * node.x;
      pignistic_.match[i] += prefix * shared * factors_[i + 1];
      prefix *= evidence_[i].no + shared;
    }
  }
  for (double& value : pignistic_.match) value /= kept_;
  pignistic_.none /= kept_;
  return pignistic_;
}

OpenWorldDecision OpenWorldMatcher::decide_by_mass() const {
  if (total_conflict()) return {};
  const Leaders lead = leaders(open_.match, open_.none);
  OpenWorldDecision decision{MatchDecision::kNone, -1, lead.best / kept_, (lead.best - lead.second) / kept_};
  if (open_.unknown > lead.best || lead.first == static_cast<int>(open_.match.size())) return decision;
  decision.kind = MatchDecision::kMatched;
  decision.candidate = lead.first;
  return decision;
}

OpenWorldDecision OpenWorldMatcher::decide_by_pignistic(double min_margin) {
  if (total_conflict()) return {};
  const OpenWorldValues& probability = pignistic();
  const Leaders lead = leaders(probability.match, probability.none);
  OpenWorldDecision decision{MatchDecision::kUndecided, -1, lead.best, lead.best - lead.second};
  if (!(decision.margin >= min_margin)) return decision;
  const bool none = lead.first == static_cast<int>(probability.match.size());
  decision.kind = none ? MatchDecision::kNone : MatchDecision::kMatched;
  decision.candidate = none ? -1 : lead.first;
  return decision;
}

void OpenWorldMatcher::prepare_nodes(std::size_t rule) {
  while (largest_rule_ < rule) {
    largest_rule_ = largest_rule_ < kConsecutiveRules ? largest_rule_ + 1 : 2 * largest_rule_;
    const int n = static_cast<int>(largest_rule_);
    for (int i = 0; i < n; ++i) {
      const double t = legendre_root(n, i);
      const double slope = legendre(n, t).slope;
      nodes_.push_back({0.5 * (1.0 - t), 1.0 / ((1.0 - t * t) * slope * slope)});
    }
  }
}

double assignment_weight(const BinaryMass& evidence) {
  // 1 - b = yes + unknown, 1 - a = no + unknown: nothing is subtracted.
  return std::log(evidence.yes + evidence.unknown) - std::log(evidence.no + evidence.unknown);
}

}  // namespace credo::evidence
