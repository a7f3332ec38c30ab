// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/proportional.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "evidence/conjunctive.hpp"

namespace credo::evidence {
namespace {

// Whether a conflicting product names the set and, besides, only sets of which `beside` holds. Products that meet in
// the same regions are one, so s sources need no k^s of them.
template <typename Beside>
bool in_conflict(const Sources& sources, const Proposition& set, Beside beside) {
  const Frame frame = sources.common_frame();
  std::set<std::pair<Proposition, bool>> products{{frame.existing(set), false}};  // where they meet; if they name it
  for (const MassFunction& source : sources) {
    std::set<std::pair<Proposition, bool>> next;
    for (const Focal& focal : source.focals()) {
      if (!beside(focal.set)) continue;
      const Proposition regions = frame.existing(focal.set);
      for (const auto& [intersection, named] : products) {
        next.insert({intersection & regions, named || focal.set == set});
      }
    }
    products = std::move(next);
  }
  return products.contains({Proposition(), true});
}

std::set<Proposition> sets_named(const Sources& sources) {
  std::set<Proposition> sets;
  for (const MassFunction& source : sources) {
    for (const Focal& focal : source.focals()) sets.insert(focal.set);
  }
  return sets;
}

// What exists of the sets that PCR2 takes to be involved.
std::set<Proposition> involved(const Sources& sources) {
  const Frame frame = sources.common_frame();
  std::set<Proposition> result;
  for (const Proposition& set : sets_named(sources)) {
    const auto beside = [&](const Proposition& other) { return other == set || !other.subset_of(set); };
    if (!in_conflict(sources, set, beside)) continue;
    if (!frame.existing(set).empty()) {
      result.insert(frame.existing(set));
      continue;
    }
    const Proposition elements = frame.composing(set);
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (frame.element(i).subset_of(elements)) result.insert(frame.existing(frame.element(i)));
    }
  }
  return result;
}

// The elements that all conflicting products are composed of; Θ if there are none in one of them.
Proposition composing_conflicts(const Sources& sources) {
  const Frame frame = sources.common_frame();
  const auto elements = [&](const Proposition& set) { return frame.existing(frame.composing(set)); };
  const auto has_none = [&](const MassFunction& source) {
    return std::ranges::any_of(source.focals(), [&](const Focal& focal) { return elements(focal.set).empty(); });
  };
  if (std::ranges::all_of(sources, has_none)) return frame.all();
  Proposition result;
  for (const Proposition& set : sets_named(sources)) {
    if (in_conflict(sources, set, [](const Proposition&) { return true; })) result |= elements(set);
  }
  return result;
}

// Visits every product of focal elements, one of each source.
class Products {
 public:
  explicit Products(const Sources& sources) : frame_(sources.common_frame()) {
    double count = 1.0;
    for (const MassFunction& source : sources) count *= static_cast<double>(source.focals().size());
    if (count > kMaxProducts) {
      std::ostringstream message;
      message << "the sources have " << count << " products of focal elements, more than " << kMaxProducts
              << ": combine fewer at once, or use the rules for two elements";
      throw std::invalid_argument(message.str());
    }
    for (const MassFunction& source : sources) {
      sources_.emplace_back();
      for (const Focal& focal : source.focals()) {
        sources_.back().push_back({focal.set, frame_.existing(focal.set), focal.mass});
      }
    }
  }

  struct Member {
    Proposition set;
    Proposition existing;
    double mass;
  };

  // visit(members, intersection, product of the masses)
  template <typename Visit>
  void for_each(Visit visit) {
    members_.resize(sources_.size());
    descend(0, frame_.existing(frame_.all()), 1.0, visit);
  }

 private:
  template <typename Visit>
  void descend(std::size_t source, const Proposition& intersection, double product, Visit& visit) {
    if (source == sources_.size()) {
      visit(std::span<const Member>(members_), intersection, product);
      return;
    }
    for (const Member& member : sources_[source]) {
      members_[source] = member;
      descend(source + 1, intersection & member.existing, product * member.mass, visit);
    }
  }

  Frame frame_;
  std::vector<std::vector<Member>> sources_;
  std::vector<Member> members_;
};

// Where nothing that is involved exists, as DSmH has it: the elements that the sets are composed of, or Θ.
Proposition composing_or_all(const Frame& frame, std::span<const Products::Member> members) {
  Proposition elements;
  for (const Products::Member& member : members) elements |= frame.existing(frame.composing(member.set));
  return elements.empty() ? frame.all() : elements;
}

// PCR5 and PCR6: `accumulate` makes the weight of a set from the masses that the sources of a product give to it.
template <typename Accumulate>
Fused redistribute_each_product(const Sources& sources, Accumulate accumulate) {
  const Frame frame = sources.common_frame();
  FocalSum sum;
  double conflict = 0.0;
  std::vector<Focal> weights;  // of the sets of one product
  Products(sources).for_each(
      [&](std::span<const Products::Member> members, const Proposition& intersection, double product) {
        if (!intersection.empty()) {
          sum.add(intersection, product);
          return;
        }
        if (product == 0.0) return;  // underflow: the weights may have no sum either
        conflict += product;
        weights.clear();
        for (const Products::Member& member : members) {
          if (member.existing.empty()) continue;
          const auto known = std::ranges::find(weights, member.existing, &Focal::set);
          if (known == weights.end()) {
            weights.push_back({member.existing, member.mass});
          } else {
            known->mass = accumulate(known->mass, member.mass);
          }
        }
        double total = 0.0;
        for (const Focal& each : weights) total += each.mass;
        if (weights.empty()) sum.add(composing_or_all(frame, members), product);
        for (const Focal& each : weights) sum.add(each.set, product * (each.mass / total));
      });
  return {sum.mass_function(frame), conflict};
}

}  // namespace

Fused pcr2(const Sources& sources) {
  const Frame frame = sources.common_frame();
  const std::set<Proposition> sharing = involved(sources);
  FocalSum columns;  // c(X): the sum over the sources, for what exists
  for (const MassFunction& source : sources) {
    for (const Focal& focal : source.focals()) {
      const Proposition regions = frame.existing(focal.set);
      if (sharing.contains(regions)) columns.add(regions, focal.mass);
    }
  }
  double total = 0.0;
  for (const Focal& column : columns.terms()) total += column.mass;

  const MassFunction open = conjunctive(sources);
  const double conflict = open.conflict();
  FocalSum sum;
  for (const Focal& focal : open.focals()) {
    if (!focal.set.empty()) sum.add(frame.existing(focal.set), focal.mass);
  }
  if (total > 0.0) {
    for (const Focal& column : columns.terms()) sum.add(column.set, conflict * (column.mass / total));
  } else if (conflict > 0.0) {
    sum.add(composing_conflicts(sources), conflict);
  }
  return {sum.mass_function(frame), conflict};
}

Fused pcr5(const Sources& sources) { return redistribute_each_product(sources, std::multiplies<>()); }

Fused pcr6(const Sources& sources) { return redistribute_each_product(sources, std::plus<>()); }

}  // namespace credo::evidence
