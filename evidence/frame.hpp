// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "evidence/proposition.hpp"

namespace credo::evidence {

/// A frame of discernment: named elements, and which of the Venn regions of their diagram exist. Shafer's model, the
/// free DSm model and every hybrid between them differ in nothing else (docs/decisions/001-belief-models.md).
///
/// Propositions are read from and written to text: `∪` or `|`, `∩` or `&` (binds tighter), parentheses, `∅` and `Θ`;
/// on a power set also `¬` or `~`. A frame is a cheap value: copies share what never changes.
class Frame {
 public:
  /// The elements exclude each other: propositions are subsets, 2^Θ. Up to 256 elements.
  /// All three: \throws std::invalid_argument for no name, one given twice, too many, or one that cannot be parsed:
  ///         with the characters of an operator, or with spaces at an end.
  [[nodiscard]] static Frame shafer(std::vector<std::string> names);
  /// Any elements may overlap: propositions are built by ∪ and ∩, the hyper-power set D^Θ. Up to 8 elements.
  [[nodiscard]] static Frame free_dsm(std::vector<std::string> names);
  /// The free model with constraints: every proposition of `empty` is empty, be it an overlap (exclusivity, "A ∩ B") or
  /// an element (non-existence, "A"). Up to 8 elements. A proposition that a constraint empties keeps its form, which
  /// DSmH and PCR2 look at.
  /// \throws std::invalid_argument also where nothing is left
  [[nodiscard]] static Frame hybrid(std::vector<std::string> names, std::span<const std::string> empty);
  [[nodiscard]] static Frame hybrid(std::vector<std::string> names, std::initializer_list<std::string> empty) {
    return hybrid(std::move(names), std::span(empty.begin(), empty.size()));
  }

  [[nodiscard]] std::size_t size() const { return diagram_->names.size(); }  ///< number of elements, n
  [[nodiscard]] const std::string& name(std::size_t element) const { return diagram_->names[element]; }
  [[nodiscard]] std::size_t index(std::string_view name) const;  ///< \throws std::invalid_argument, naming the elements
  /// Of Shafer's model: the regions are the elements.
  [[nodiscard]] bool is_power_set() const { return diagram_->terms.empty(); }
  [[nodiscard]] std::size_t region_count() const { return diagram_->regions; }  ///< also those that do not exist

  /// Everything that exists. Written Θ.
  [[nodiscard]] const Proposition& all() const { return diagram_->all; }
  /// The element with its overlaps. Precondition: element < size().
  [[nodiscard]] const Proposition& element(std::size_t element) const { return diagram_->elements[element]; }
  /// What of a proposition exists in this model. Two propositions are the same if these are.
  [[nodiscard]] Proposition existing(const Proposition& set) const { return set & diagram_->existing; }
  /// Number of Venn regions that exist in it: the DSm cardinality C_M; on a power set the number of elements.
  [[nodiscard]] std::size_t cardinality(const Proposition& set) const { return existing(set).count(); }
  /// The elements that a proposition is composed of, in union: u(X) of DSmH. A ∩ B and A ∪ B both give A ∪ B.
  [[nodiscard]] Proposition composing(const Proposition& set) const;
  /// The largest union of intersections that is the same in this model: what masses are kept under, and what is
  /// written. Under constraints it has regions that do not exist.
  [[nodiscard]] Proposition canonical(const Proposition& set) const;
  /// The union of intersections that has exactly these regions if there is one, so that what a constraint empties keeps
  /// its form; else the canonical form.
  /// \throws std::invalid_argument if it has regions of no frame, or is no union of intersections in this model
  [[nodiscard]] Proposition admitted(const Proposition& set) const;

  /// All but the empty one, canonical, by growing cardinality: 2^n - 1 on a power set; 4, 18, 166, 7579 for n = 2 .. 5
  /// on the free model.
  /// \throws std::length_error beyond 20 elements of a power set and 5 of another: masses need no enumeration
  [[nodiscard]] std::vector<Proposition> propositions() const;

  /// \throws std::invalid_argument, saying where and what was expected
  [[nodiscard]] Proposition parse(std::string_view text) const;
  /// "A ∩ B ∪ C": the shortest union of intersections. Parsed again it is the same in this model.
  [[nodiscard]] std::string to_string(const Proposition& set) const;

  /// The same names and the same regions.
  friend bool operator==(const Frame& a, const Frame& b) {
    return a.diagram_ == b.diagram_ ||
           (a.is_power_set() == b.is_power_set() && a.diagram_->names == b.diagram_->names &&
            a.diagram_->existing == b.diagram_->existing && a.diagram_->regions == b.diagram_->regions);
  }

 private:
  struct Term {  // an intersection of elements
    std::uint32_t elements;
    Proposition regions;
  };
  struct Diagram {
    std::vector<std::string> names;
    std::size_t regions = 0;
    Proposition existing;
    Proposition all;
    std::vector<Proposition> elements;
    std::vector<Term> terms;  // by growing number of elements; none on a power set
  };
  explicit Frame(std::shared_ptr<const Diagram> diagram) : diagram_(std::move(diagram)) {}
  static Diagram overlapping(std::vector<std::string> names);
  std::vector<Term> shortest_union(const Proposition& set) const;

  std::shared_ptr<const Diagram> diagram_;
};

}  // namespace credo::evidence
