// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <iosfwd>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "evidence/binary_mass.hpp"
#include "evidence/frame.hpp"

namespace credo::evidence {

/// A proposition and the mass that it is given.
struct Focal {
  Proposition set;
  double mass = 0.0;

  friend bool operator==(const Focal&, const Focal&) = default;
};

/// A mass function (basic belief assignment) on a frame of any model, as the list of its focal elements. A value: it
/// never changes, all masses are > 0 and sum to 1. Mass on the empty set is allowed (the open world of the TBM); so is,
/// on a hybrid model, mass on what a constraint empties, and counts as mass on the empty set.
class MassFunction {
 public:
  /// From propositions and masses, in any order; what is named twice is added up, zeros are left out. Sums that differ
  /// from 1 by no more than kMassTolerance (1e-9) are divided out.
  /// \throws std::invalid_argument for a mass that is nan, negative or over 1, a sum other than 1, a proposition of
  ///         another frame; it says which
  MassFunction(Frame frame, std::span<const Focal> focals);
  /// The same with propositions as text: MassFunction(frame, {{"A", 0.6}, {"A ∪ B", 0.4}}).
  MassFunction(Frame frame, std::initializer_list<std::pair<std::string_view, double>> focals);

  /// All mass on Θ: total ignorance, neutral in most rules.
  [[nodiscard]] static MassFunction vacuous(Frame frame);
  /// All mass on one proposition.
  [[nodiscard]] static MassFunction categorical(Frame frame, const Proposition& set);
  /// `mass` in [0, 1] on one proposition, the rest on Θ.
  [[nodiscard]] static MassFunction simple_support(Frame frame, const Proposition& set, double mass);
  /// One mass for each element. Power sets only. \param probabilities  size n, sum 1
  [[nodiscard]] static MassFunction bayesian(Frame frame, std::span<const double> probabilities);
  [[nodiscard]] static MassFunction bayesian(Frame frame, std::initializer_list<double> probabilities) {
    return bayesian(std::move(frame), std::span(probabilities.begin(), probabilities.size()));
  }
  /// The mass function with nested focal elements whose plausibilities of the elements are these, a possibility
  /// distribution. Power sets only. \param contour  size n, each in [0, 1], the largest 1
  [[nodiscard]] static MassFunction consonant(Frame frame, std::span<const double> contour);
  [[nodiscard]] static MassFunction consonant(Frame frame, std::initializer_list<double> contour) {
    return consonant(std::move(frame), std::span(contour.begin(), contour.size()));
  }
  /// What focals() of a mass function gave, to the last bit: the constructor divides by the sum, which rounds.
  /// \throws std::invalid_argument as the constructor, or unless ordered by proposition, each once, all > 0
  [[nodiscard]] static MassFunction restored(Frame frame, std::span<const Focal> focals);
  /// The rest to 1 goes to Θ. \throws as the constructor, but for a sum below 1
  [[nodiscard]] static MassFunction with_rest_unknown(Frame frame, std::span<const Focal> focals);
  [[nodiscard]] static MassFunction with_rest_unknown(
      Frame frame, std::initializer_list<std::pair<std::string_view, double>> focals);

  [[nodiscard]] const Frame& frame() const& { return frame_; }
  [[nodiscard]] Frame frame() && { return std::move(frame_); }
  /// Ordered by proposition; each once. On a hybrid model two of them may be one in the model, A and A ∪ C where C is
  /// empty: they keep their forms, which PCR2 looks at.
  [[nodiscard]] std::span<const Focal> focals() const& { return focals_; }
  [[nodiscard]] std::vector<Focal> focals() && { return std::move(focals_); }  ///< of what is gone after the statement
  [[nodiscard]] double mass(const Proposition& set) const;  ///< of all forms that are this one in the model
  [[nodiscard]] double mass(std::string_view set) const { return mass(frame_.parse(set)); }
  [[nodiscard]] double conflict() const { return mass(Proposition()); }  ///< m(∅)

  [[nodiscard]] bool is_normal() const { return conflict() == 0.0; }            ///< nothing on ∅
  [[nodiscard]] bool is_dogmatic() const { return mass(frame_.all()) == 0.0; }  ///< nothing on Θ
  [[nodiscard]] bool is_vacuous() const { return mass(frame_.all()) == 1.0; }
  [[nodiscard]] bool is_categorical() const { return mass(focals_.front().set) == 1.0; }
  [[nodiscard]] bool is_bayesian() const;   ///< all mass on single Venn regions
  [[nodiscard]] bool is_consonant() const;  ///< the focal elements are nested

  friend bool operator==(const MassFunction&, const MassFunction&) = default;

 private:
  friend class FocalSum;
  friend std::optional<MassFunction> from_commonality(const Frame& frame, std::vector<double> commonalities);
  explicit MassFunction(Frame frame) : frame_(std::move(frame)) {}

  Frame frame_;
  std::vector<Focal> focals_;
};

/// Adds up masses that rules give to propositions, without validation: the masses must be >= 0.
class FocalSum {
 public:
  void add(const Proposition& set, double mass);
  /// Added up under what exists of each proposition; kept under its canonical form, ordered.
  [[nodiscard]] MassFunction mass_function(const Frame& frame) const;
  [[nodiscard]] std::span<const Focal> terms() const { return terms_; }  ///< in the order of their first addition
  void clear();

 private:
  std::vector<Focal> terms_;
  std::unordered_map<Proposition, std::size_t> index_;  // from where a search of terms_ would be slower
};

/// A mass function and the conflict that was met (and moved or divided out) on the way to it.
struct Fused {
  MassFunction mass;
  double conflict = 0.0;

  friend bool operator==(const Fused&, const Fused&) = default;
};

/// The mass function without what it gives to ∅, divided by the sum of the rest: Dempster's normalisation.
/// \returns nothing if there is no rest
[[nodiscard]] std::optional<Fused> normalised(const MassFunction& mass);

/// The mass functions that a rule combines: a list in braces, or any contiguous range. A view, for parameters only.
class Sources {
 public:
  Sources(std::initializer_list<MassFunction> list) : masses_(list.begin(), list.size()) {}
  template <std::convertible_to<std::span<const MassFunction>> Range>
  Sources(const Range& masses) : masses_(masses) {}

  [[nodiscard]] std::size_t size() const { return masses_.size(); }
  [[nodiscard]] auto begin() const { return masses_.begin(); }
  [[nodiscard]] auto end() const { return masses_.end(); }
  [[nodiscard]] const MassFunction& operator[](std::size_t i) const { return masses_[i]; }
  /// \throws std::invalid_argument unless there is at least one mass function and all have the same frame
  Frame common_frame() const;

 private:
  std::span<const MassFunction> masses_;
};

/// A mass function of {YES, NO} (or any other two elements of a power set) in the form of the closed rules, and back.
/// Element 0 is YES. \throws std::invalid_argument unless the frame is a power set of two elements and the mass normal
[[nodiscard]] BinaryMass to_binary(const MassFunction& mass);
/// \throws std::invalid_argument as to_binary, or as the constructor of MassFunction
[[nodiscard]] MassFunction from_binary(const Frame& frame, const BinaryMass& mass);

/// {A: 0.6, A ∪ B: 0.4}
std::ostream& operator<<(std::ostream& out, const MassFunction& mass);

}  // namespace credo::evidence
