// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/pcr6_quadrature.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace credo::evidence {
namespace {

constexpr std::size_t kLanes = 8;  // nodes at once; they span a factor of 8
using Lanes = std::array<double, kLanes>;

constexpr double kStep = 0.375 * std::numbers::ln2;  // in ln t

// Nodes t and their weights t dt/d(ln t).
struct Nodes {
  Lanes t;
  Lanes weight;
};

// e^(-tm) - 1 of the masses of one source.
struct Decay {
  Lanes yes, no, unknown;
};

// For t m < 0.01: its Taylor series.
double small_decay(double t, double m) {
  const double x = t * m;
  return -x * (1.0 - x / 2 * (1.0 - x / 3 * (1.0 - x / 4 * (1.0 - x / 5))));
}

// e^(-8x) - 1 from e^(-x) - 1, which keeps its digits where x is small.
void eightfold(Lanes& decay) {
  for (double& value : decay) {
    value *= 2.0 + value;
    value *= 2.0 + value;
    value *= 2.0 + value;
  }
}

// Sums of the products of factors m e^(-tm), by which of YES and NO they name; and of the same products times the sum
// of the masses in them that were given to YES, to NO, to the frame.
struct NodeProducts {
  Lanes none{}, yes{}, no{}, both{};
  Lanes yes_of_yes{}, yes_of_both{};
  Lanes no_of_no{}, no_of_both{};
  Lanes unknown_of_none{}, unknown_of_yes{}, unknown_of_no{}, unknown_of_both{};

  NodeProducts() { none.fill(1.0); }
};

// \param stake  of the frame: the mass with which it counts in S
void take_in(NodeProducts& p, const BinaryMass& source, double stake, const Decay& decay) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double a = source.yes + source.yes * decay.yes[i];
    const double b = source.no + source.no * decay.no[i];
    const double u = source.unknown + source.unknown * decay.unknown[i];
    const double a2 = source.yes * a, b2 = source.no * b, u2 = stake * u;
    const double au = a + u, bu = b + u, all = a + b + u;
    p.yes_of_both[i] = p.yes_of_both[i] * all + p.yes_of_yes[i] * b + (p.both[i] + p.no[i]) * a2;
    p.no_of_both[i] = p.no_of_both[i] * all + p.no_of_no[i] * a + (p.both[i] + p.yes[i]) * b2;
    p.unknown_of_both[i] =
        p.unknown_of_both[i] * all + p.unknown_of_yes[i] * b + p.unknown_of_no[i] * a + p.both[i] * u2;
    p.both[i] = p.both[i] * all + p.yes[i] * b + p.no[i] * a;
    p.yes_of_yes[i] = p.yes_of_yes[i] * au + (p.yes[i] + p.none[i]) * a2;
    p.no_of_no[i] = p.no_of_no[i] * bu + (p.no[i] + p.none[i]) * b2;
    p.unknown_of_yes[i] = p.unknown_of_yes[i] * au + p.unknown_of_none[i] * a + p.yes[i] * u2;
    p.unknown_of_no[i] = p.unknown_of_no[i] * bu + p.unknown_of_none[i] * b + p.no[i] * u2;
    p.yes[i] = p.yes[i] * au + p.none[i] * a;
    p.no[i] = p.no[i] * bu + p.none[i] * b;
    p.unknown_of_none[i] = p.unknown_of_none[i] * u + p.none[i] * u2;
    p.none[i] *= u;
  }
}

class Quadrature {
 public:
  Quadrature(std::span<const BinaryMass> sources, FrameShare frame)
      : sources_(sources), frame_shares_(frame == FrameShare::kShares), decays_(sources.size()) {}

  ConflictShares shares() {
    // The first node is so small that the rest is one node, with an error of 0.03 (S t)³; the last so large that what
    // it misses, of S < 1/t, are products of masses below 1/t: three of them, or two beside masses of the frame.
    const auto count = static_cast<double>(sources_.size());
    const double first = 0x1p-12 / count, last = frame_shares_ ? 0x1p14 : 0x1p20 * count;
    start(rest_below(first));
    add();
    for (start(from(first)); nodes_.t[0] < last; advance()) add();
    return sum_;
  }

 private:
  static Nodes from(double first) {
    Nodes nodes;
    for (std::size_t i = 0; i < kLanes; ++i) {
      nodes.t[i] = first * std::exp2(0.375 * static_cast<double>(i));
      nodes.weight[i] = kStep * nodes.t[i];
    }
    return nodes;
  }

  // The nodes first / r, first / r², ... as one: the sum of their weights, at their weighted mean.
  static Nodes rest_below(double first) {
    const double ratio = std::exp2(0.375);
    Nodes nodes{};
    nodes.t[0] = first / (ratio + 1.0);
    nodes.weight[0] = kStep * first / (ratio - 1.0);
    return nodes;
  }

  double stake(const BinaryMass& source) const { return frame_shares_ ? source.unknown : 0.0; }

  void start(const Nodes& nodes) {
    nodes_ = nodes;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      for (std::size_t i = 0; i < kLanes; ++i) {
        decays_[s].yes[i] = small_decay(nodes.t[i], sources_[s].yes);
        decays_[s].no[i] = small_decay(nodes.t[i], sources_[s].no);
        decays_[s].unknown[i] = small_decay(nodes.t[i], stake(sources_[s]));
      }
    }
  }

  void advance() {
    for (double& t : nodes_.t) t *= 8.0;
    for (double& weight : nodes_.weight) weight *= 8.0;
    for (Decay& decay : decays_) {
      eightfold(decay.yes);
      eightfold(decay.no);
      eightfold(decay.unknown);
    }
  }

  void add() {
    NodeProducts products;
    for (std::size_t s = 0; s < sources_.size(); ++s) take_in(products, sources_[s], stake(sources_[s]), decays_[s]);
    for (std::size_t i = 0; i < kLanes; ++i) {
      sum_.yes += nodes_.weight[i] * products.yes_of_both[i];
      sum_.no += nodes_.weight[i] * products.no_of_both[i];
      sum_.unknown += nodes_.weight[i] * products.unknown_of_both[i];
    }
  }

  std::span<const BinaryMass> sources_;
  bool frame_shares_;
  std::vector<Decay> decays_;
  Nodes nodes_{};
  ConflictShares sum_;
};

}  // namespace

ConflictShares pcr6_shares(std::span<const BinaryMass> sources, FrameShare frame) {
  return Quadrature(sources, frame).shares();
}

}  // namespace credo::evidence
