// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/binary_mass.hpp"

#include <cassert>
#include <cmath>
#include <ostream>
#include <sstream>
#include <stdexcept>

namespace credo::evidence {
namespace {

constexpr double kRescaleBelow = 0x1p-300;
constexpr double kRescale = 0x1p600;

Conjunction conjoin(std::span<const BinaryMass> sources) {
  Conjunction result;
  for (const BinaryMass& source : sources) result.add(source);
  return result;
}

std::span<const BinaryMass> as_span(std::initializer_list<BinaryMass> sources) {
  return {sources.begin(), sources.size()};
}

}  // namespace

BinaryMass BinaryMass::from(double yes, double no) {
  const double sum = yes + no;
  if (!(yes >= 0.0 && no >= 0.0 && sum <= 1.0 + kMassTolerance)) {
    std::ostringstream message;
    message << "not a mass: yes = " << yes << ", no = " << no << "; both must be >= 0 and sum to at most 1";
    throw std::invalid_argument(message.str());
  }
  if (sum > 1.0) return {.yes = yes / sum, .no = no / sum, .unknown = 0.0};
  return {.yes = yes, .no = no, .unknown = 1.0 - sum};
}

void Conjunction::add(const BinaryMass& source) {
  assert(std::abs(source.yes + source.no + source.unknown - 1.0) < 1e-6);
  conflict_ += unit_ * (yes_ * source.no + no_ * source.yes);
  yes_ = yes_ * (source.yes + source.unknown) + unknown_ * source.yes;
  no_ = no_ * (source.no + source.unknown) + unknown_ * source.no;
  unknown_ *= source.unknown;
  const double kept = yes_ + no_ + unknown_;
  if (kept < kRescaleBelow && kept > 0.0) {
    yes_ *= kRescale;
    no_ *= kRescale;
    unknown_ *= kRescale;
    unit_ /= kRescale;
  }
}

OpenBinaryMass Conjunction::open() const {
  return {.yes = unit_ * yes_, .no = unit_ * no_, .unknown = unit_ * unknown_, .conflict = conflict_};
}

std::optional<FusedBinaryMass> Conjunction::dempster() const {
  const double kept = yes_ + no_ + unknown_;
  if (!(kept > 0.0)) return std::nullopt;
  return FusedBinaryMass{{.yes = yes_ / kept, .no = no_ / kept, .unknown = unknown_ / kept}, conflict_};
}

FusedBinaryMass Conjunction::conflict_to_ignorance() const {
  const OpenBinaryMass mass = open();
  return {{.yes = mass.yes, .no = mass.no, .unknown = mass.unknown + mass.conflict}, mass.conflict};
}

std::optional<FusedBinaryMass> Conjunction::fuse(FusionRule rule) const {
  if (rule == FusionRule::kDempster) return dempster();
  return conflict_to_ignorance();
}

OpenBinaryMass conjunctive(std::span<const BinaryMass> sources) { return conjoin(sources).open(); }
OpenBinaryMass conjunctive(std::initializer_list<BinaryMass> sources) { return conjunctive(as_span(sources)); }

std::optional<FusedBinaryMass> dempster(std::span<const BinaryMass> sources) { return conjoin(sources).dempster(); }
std::optional<FusedBinaryMass> dempster(std::initializer_list<BinaryMass> sources) {
  return dempster(as_span(sources));
}

FusedBinaryMass conflict_to_ignorance(std::span<const BinaryMass> sources) {
  return conjoin(sources).conflict_to_ignorance();
}
FusedBinaryMass conflict_to_ignorance(std::initializer_list<BinaryMass> sources) {
  return conflict_to_ignorance(as_span(sources));
}

std::optional<FusedBinaryMass> fuse(std::span<const BinaryMass> sources, FusionRule rule) {
  return conjoin(sources).fuse(rule);
}
std::optional<FusedBinaryMass> fuse(std::initializer_list<BinaryMass> sources, FusionRule rule) {
  return fuse(as_span(sources), rule);
}

std::ostream& operator<<(std::ostream& out, const BinaryMass& mass) {
  return out << "{yes " << mass.yes << ", no " << mass.no << ", unknown " << mass.unknown << '}';
}

std::ostream& operator<<(std::ostream& out, const OpenBinaryMass& mass) {
  return out << "{yes " << mass.yes << ", no " << mass.no << ", unknown " << mass.unknown << ", conflict "
             << mass.conflict << '}';
}

}  // namespace credo::evidence
