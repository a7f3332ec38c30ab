// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/conflict_to_sets.hpp"

#include <unordered_map>

#include "evidence/conjunctive.hpp"

namespace credo::evidence {
namespace {

// What all products have in common that agree in it: summed up there, s sources need no k^s products.
struct ProductKind {
  Proposition intersection;
  Proposition united;     // of what exists of the sets
  Proposition composing;  // of the elements that the sets are composed of, as long as nothing of them exists

  friend bool operator==(const ProductKind&, const ProductKind&) = default;
};

struct ProductKindHash {
  std::size_t operator()(const ProductKind& product) const {
    return (product.intersection.hash() * 31 + product.united.hash()) * 31 + product.composing.hash();
  }
};

using ProductSum = std::vector<std::pair<ProductKind, double>>;

ProductSum times(const ProductSum& products, const MassFunction& source, bool remember_composing) {
  const Frame& frame = source.frame();
  ProductSum next;
  std::unordered_map<ProductKind, std::size_t, ProductKindHash> index;
  for (const Focal& focal : source.focals()) {
    const Proposition regions = frame.existing(focal.set);
    const Proposition elements = remember_composing ? frame.composing(focal.set) : Proposition();
    for (const auto& [product, mass] : products) {
      ProductKind together{product.intersection & regions, product.united | regions, {}};
      if (together.united.empty()) together.composing = product.composing | frame.existing(elements);
      const auto [place, is_new] = index.try_emplace(together, next.size());
      if (is_new) next.emplace_back(together, 0.0);
      next[place->second].second += mass * focal.mass;
    }
  }
  return next;
}

Fused move_conflict(const Sources& sources, bool hybrid) {
  const Frame frame = sources.common_frame();
  ProductSum products{{{frame.existing(frame.all()), {}, {}}, 1.0}};
  for (const MassFunction& source : sources) products = times(products, source, hybrid);
  FocalSum sum;
  double conflict = 0.0;
  for (const auto& [product, mass] : products) {
    if (!product.intersection.empty()) {
      sum.add(product.intersection, mass);  // S1
      continue;
    }
    conflict += mass;
    if (!product.united.empty() || !hybrid) {
      sum.add(product.united, mass);  // S3
    } else {
      sum.add(product.composing.empty() ? frame.all() : product.composing, mass);  // S2
    }
  }
  return {sum.mass_function(frame), conflict};
}

}  // namespace

Fused conflict_to_ignorance(const Sources& sources) {
  const Frame frame = sources.common_frame();
  const MassFunction open = conjunctive(sources);
  FocalSum sum;
  for (const Focal& focal : open.focals()) sum.add(focal.set.empty() ? frame.all() : focal.set, focal.mass);
  return {sum.mass_function(frame), open.conflict()};
}

Fused dubois_prade(const Sources& sources) { return move_conflict(sources, false); }

Fused dsmh(const Sources& sources) { return move_conflict(sources, true); }

}  // namespace credo::evidence
