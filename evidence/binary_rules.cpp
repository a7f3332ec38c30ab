// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/binary_rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "evidence/averaging.hpp"
#include "evidence/binary_cell.hpp"
#include "evidence/pcr6_quadrature.hpp"
#include "evidence/proportional.hpp"

namespace credo::evidence {
namespace {

using Cell = cell::Open<double>;

Cell as_cell(const BinaryMass& mass) { return {mass.yes, mass.no, mass.unknown, 0.0}; }
Cell as_cell(const OpenBinaryMass& mass) { return {mass.yes, mass.no, mass.unknown, mass.conflict}; }
BinaryMass as_mass(const Cell& cell) { return {cell.yes, cell.no, cell.unknown}; }
OpenBinaryMass as_open(const Cell& cell) { return {cell.yes, cell.no, cell.unknown, cell.conflict}; }

void need_a_source(std::size_t count, const char* rule) {
  if (count == 0) throw std::invalid_argument(std::string(rule) + " needs at least one mass; got none");
}

// In proportion to the shares, so that their rounding loses no mass.
FusedBinaryMass given_back(const OpenBinaryMass& open, const ConflictShares& shares) {
  const double sum = shares.yes + shares.no + shares.unknown;
  const double unit = sum > 0.0 ? open.conflict / sum : 0.0;
  return {{.yes = open.yes + unit * shares.yes,
           .no = open.no + unit * shares.no,
           .unknown = open.unknown + unit * shares.unknown},
          open.conflict};
}

// PCR5 and PCR5+: every product of masses, with the product of those that each of YES, NO and the frame was given.
class ConflictingProducts {
 public:
  ConflictingProducts(std::span<const BinaryMass> sources, FrameShare frame) : sources_(sources), frame_(frame) {
    double count = 1.0;
    for (const BinaryMass& source : sources) count *= (source.yes > 0.0) + (source.no > 0.0) + (source.unknown > 0.0);
    if (count > kMaxProducts) {
      std::ostringstream message;
      message << "PCR5 of " << sources.size() << " sources has " << count << " products of masses, more than "
              << kMaxProducts << ": combine fewer at once, or use PCR6, which needs none";
      throw std::invalid_argument(message.str());
    }
  }

  ConflictShares shares() {
    descend(0, {});
    return sum_;
  }

 private:
  // 1 where none named it.
  struct Named {
    double yes = 1.0, no = 1.0, unknown = 1.0;
    bool has_yes = false, has_no = false, has_unknown = false;
  };

  void descend(std::size_t i, const Named& named) {
    if (i == sources_.size()) return share(named);
    const BinaryMass& source = sources_[i];
    Named next = named;
    if (source.yes > 0.0) {
      next.yes *= source.yes;
      next.has_yes = true;
      descend(i + 1, next);
    }
    next = named;
    if (source.no > 0.0) {
      next.no *= source.no;
      next.has_no = true;
      descend(i + 1, next);
    }
    next = named;
    if (source.unknown > 0.0) {
      next.unknown *= source.unknown;
      next.has_unknown = frame_ == FrameShare::kShares;
      descend(i + 1, next);
    }
  }

  void share(const Named& named) {
    const double product = named.yes * named.no * named.unknown;
    if (!named.has_yes || !named.has_no || product == 0.0) return;
    const double unit = product / (named.yes + named.no + (named.has_unknown ? named.unknown : 0.0));
    sum_.yes += unit * named.yes;
    sum_.no += unit * named.no;
    if (named.has_unknown) sum_.unknown += unit * named.unknown;
  }

  std::span<const BinaryMass> sources_;
  FrameShare frame_;
  ConflictShares sum_;
};

FusedBinaryMass pcr_of_two(const BinaryMass& a, const BinaryMass& b) {
  return {as_mass(cell::pcr5(as_cell(a), as_cell(b))), conjunctive({a, b}).conflict};
}

FusedBinaryMass product_weighted(const BinarySources& sources, FrameShare frame) {
  if (sources.size() == 2) return pcr_of_two(sources[0], sources[1]);
  return given_back(conjunctive(sources.span()), ConflictingProducts(sources.span(), frame).shares());
}

FusedBinaryMass sum_weighted(const BinarySources& sources, FrameShare frame) {
  if (sources.size() == 2) return pcr_of_two(sources[0], sources[1]);
  const OpenBinaryMass open = conjunctive(sources.span());
  if (open.conflict == 0.0) return {{open.yes, open.no, open.unknown}, 0.0};
  return given_back(open, pcr6_shares(sources.span(), frame));
}

template <typename Masses>
OpenBinaryMass least_committed(const Masses& sources) {
  need_a_source(sources.size(), "the cautious rule");
  const auto weights = [](const auto& source) {
    if (!cell::has_weights(as_cell(source))) {
      throw std::invalid_argument("a dogmatic mass, unknown = 0, has no weights: discount it first");
    }
    return cell::weights(as_cell(source));
  };
  cell::Weights<double> least = weights(sources[0]);
  for (std::size_t i = 1; i < sources.size(); ++i) least = cell::least(least, weights(sources[i]));
  return as_open(cell::recompose(least));
}

OpenBinaryMass negation(const OpenBinaryMass& mass) {
  return {.yes = mass.no, .no = mass.yes, .unknown = mass.conflict, .conflict = mass.unknown};
}

}  // namespace

BinaryMass disjunctive(const BinarySources& sources) {
  need_a_source(sources.size(), "the disjunctive rule");
  Cell united = as_cell(sources[0]);
  for (const BinaryMass& source : sources.span().subspan(1)) united = cell::disjunctive(united, as_cell(source));
  return as_mass(united);
}

BinaryMass average(const BinarySources& sources, std::span<const double> weights) {
  need_a_source(sources.size(), "an average");
  const double total = total_weight(weights, sources.size());
  BinaryMass sum{0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const double share = (weights.empty() ? 1.0 : weights[i]) / total;
    sum.yes += share * sources[i].yes;
    sum.no += share * sources[i].no;
    sum.unknown += share * sources[i].unknown;
  }
  return sum;
}

FusedBinaryMass murphy(const BinarySources& sources) {
  const BinaryMass mean = average(sources);
  Conjunction repeated;
  for (std::size_t i = 0; i < sources.size(); ++i) repeated.add(mean);
  return repeated.dempster().value();
}

FusedBinaryMass pcr2(const BinarySources& sources) {
  const OpenBinaryMass open = conjunctive(sources.span());
  double sum_yes = 0.0, sum_no = 0.0;
  for (const BinaryMass& source : sources) {
    sum_yes += source.yes;
    sum_no += source.no;
  }
  return {as_mass(cell::pcr2(as_cell(open), sum_yes, sum_no)), open.conflict};
}

FusedBinaryMass pcr5(const BinarySources& sources) { return product_weighted(sources, FrameShare::kShares); }
FusedBinaryMass pcr5_plus(const BinarySources& sources) { return product_weighted(sources, FrameShare::kTakesNoPart); }
FusedBinaryMass pcr6(const BinarySources& sources) { return sum_weighted(sources, FrameShare::kShares); }
FusedBinaryMass pcr6_plus(const BinarySources& sources) { return sum_weighted(sources, FrameShare::kTakesNoPart); }

OpenBinaryMass cautious(const BinarySources& sources) { return least_committed(sources); }
OpenBinaryMass cautious(std::span<const OpenBinaryMass> sources) { return least_committed(sources); }

OpenBinaryMass bold(std::span<const OpenBinaryMass> sources) {
  std::vector<OpenBinaryMass> negated;
  for (const OpenBinaryMass& source : sources) {
    negated.push_back(negation(source));
    if (!cell::has_weights(as_cell(negated.back()))) {
      throw std::invalid_argument("the bold rule needs mass on the empty set in every source");
    }
  }
  return negation(cautious(negated));
}

std::optional<OpenBinaryMass> decombine(const OpenBinaryMass& whole, const BinaryMass& part) {
  if (!(part.unknown > 0.0)) throw std::invalid_argument("a dogmatic mass, unknown = 0, cannot be taken out");
  // q(Θ) and q(YES) - q(Θ) of the quotient q_whole / q_part, on one denominator.
  const double unknown = whole.unknown / part.unknown;
  if (!(unknown <= 1.0 + kMassTolerance)) return std::nullopt;
  const auto rest = [&](double of_whole, double of_part) {
    return (of_whole - unknown * of_part) / (of_part + part.unknown);
  };
  OpenBinaryMass result{.yes = rest(whole.yes, part.yes), .no = rest(whole.no, part.no), .unknown = unknown};
  result.conflict = 1.0 - (result.yes + result.no + result.unknown);
  // Rounding grows as what is divided by gets smaller.
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() / part.unknown;
  for (double* mass : {&result.yes, &result.no, &result.unknown, &result.conflict}) {
    if (!(*mass >= -rounding)) return std::nullopt;
    *mass = std::max(0.0, *mass);
  }
  const double sum = result.yes + result.no + result.unknown + result.conflict;
  return OpenBinaryMass{result.yes / sum, result.no / sum, result.unknown / sum, result.conflict / sum};
}

}  // namespace credo::evidence
