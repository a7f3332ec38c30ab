// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <vector>

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// A frame seen in more detail: every element of `coarse` is split into some of `fine`. Both are power sets.
class Refining {
 public:
  /// \param images  of each element of coarse: not empty, disjoint, together all of fine
  /// \throws std::invalid_argument if they are not, or a frame is of another model
  Refining(Frame coarse, Frame fine, std::vector<Proposition> images);

  [[nodiscard]] const Frame& coarse() const { return coarse_; }
  [[nodiscard]] const Frame& fine() const { return fine_; }

  [[nodiscard]] Proposition refine(const Proposition& set) const;         ///< the same, said in `fine`
  [[nodiscard]] Proposition coarsen_outer(const Proposition& set) const;  ///< the elements that it meets
  [[nodiscard]] Proposition coarsen_inner(const Proposition& set) const;  ///< the elements that it contains

 private:
  Frame coarse_, fine_;
  std::vector<Proposition> images_;
};

/// Vacuous extension: every focal element said in `fine`; nothing is added, nothing lost.
/// All three: \throws std::invalid_argument for a mass function on another frame than the refining's
[[nodiscard]] MassFunction refine(const MassFunction& mass, const Refining& refining);
/// Outer reduction, Shafer's coarsening: what `fine` knew and `coarse` cannot say becomes ignorance; plausibilities
/// stay. After refine it gives the mass function back.
[[nodiscard]] MassFunction coarsen(const MassFunction& mass, const Refining& refining);
/// Inner reduction: a focal element becomes all that it contains, ∅ where that is nothing. Commonalities stay.
[[nodiscard]] MassFunction coarsen_inner(const MassFunction& mass, const Refining& refining);

/// The frame of all combinations of the elements of some frames, its factors: "wet × cold". The last factor runs
/// fastest.
class ProductFrame {
 public:
  /// \throws std::invalid_argument for no factor, one of another model than Shafer's, more than 256 combinations
  explicit ProductFrame(std::vector<Frame> factors);

  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] std::size_t size() const { return refinings_.size(); }
  /// How the factor is refined to the product. Precondition: i < size().
  [[nodiscard]] const Refining& factor(std::size_t i) const { return refinings_[i]; }

  /// What is known of a factor, said on the product. Precondition: i < size(). \throws as refine
  [[nodiscard]] MassFunction extend(const MassFunction& mass, std::size_t i) const;
  /// What is known of the product, for a factor: the marginal. Precondition: i < size(). \throws as coarsen
  [[nodiscard]] MassFunction marginal(const MassFunction& mass, std::size_t i) const;

 private:
  Frame frame_;
  std::vector<Refining> refinings_;
};

}  // namespace credo::evidence
