// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/refinement.hpp"

#include <stdexcept>
#include <string>

namespace credo::evidence {
namespace {

void check_power_set(const Frame& frame) {
  if (!frame.is_power_set()) throw std::invalid_argument("refinement and products need frames of Shafer's model");
}

// Every focal element carried over to another frame.
template <typename Carry>
MassFunction carried(const MassFunction& mass, const Frame& from, const Frame& to, Carry carry) {
  if (!(mass.frame() == from)) throw std::invalid_argument("the mass function is on another frame than the refining's");
  FocalSum sum;
  for (const Focal& focal : mass.focals()) sum.add(carry(focal.set), focal.mass);
  return sum.mass_function(to);
}

Frame frame_of_combinations(const std::vector<Frame>& factors) {
  if (factors.empty()) throw std::invalid_argument("a product needs at least one frame");
  std::vector<std::string> names{""};
  for (const Frame& factor : factors) {
    check_power_set(factor);
    std::vector<std::string> longer;
    for (const std::string& name : names) {
      for (std::size_t i = 0; i < factor.size(); ++i) {
        longer.push_back(name.empty() ? factor.name(i) : name + " × " + factor.name(i));
      }
    }
    if (longer.size() > Proposition::kMaxRegions) {
      throw std::invalid_argument("a product of frames has at most " + std::to_string(Proposition::kMaxRegions) +
                                  " elements");
    }
    names = std::move(longer);
  }
  return Frame::shafer(std::move(names));
}

}  // namespace

Refining::Refining(Frame coarse, Frame fine, std::vector<Proposition> images)
    : coarse_(std::move(coarse)), fine_(std::move(fine)), images_(std::move(images)) {
  check_power_set(coarse_);
  check_power_set(fine_);
  if (images_.size() != coarse_.size()) {
    throw std::invalid_argument("a refining needs one image for each of the " + std::to_string(coarse_.size()) +
                                " elements, not " + std::to_string(images_.size()));
  }
  Proposition covered;
  for (std::size_t i = 0; i < images_.size(); ++i) {
    const Proposition image = fine_.admitted(images_[i]);
    if (image.empty()) throw std::invalid_argument("the image of '" + coarse_.name(i) + "' is empty");
    if (image.meets(covered)) {
      throw std::invalid_argument("the image of '" + coarse_.name(i) + "' overlaps that of another element");
    }
    covered |= image;
  }
  if (covered != fine_.all()) {
    throw std::invalid_argument("the images leave out " + fine_.to_string(fine_.all() - covered));
  }
}

Proposition Refining::refine(const Proposition& set) const {
  Proposition result;
  for (std::size_t i = 0; i < images_.size(); ++i) {
    if (set.contains(i)) result |= images_[i];
  }
  return result;
}

Proposition Refining::coarsen_outer(const Proposition& set) const {
  Proposition result;
  for (std::size_t i = 0; i < images_.size(); ++i) {
    if (images_[i].meets(set)) result |= coarse_.element(i);
  }
  return result;
}

Proposition Refining::coarsen_inner(const Proposition& set) const {
  Proposition result;
  for (std::size_t i = 0; i < images_.size(); ++i) {
    if (images_[i].subset_of(set)) result |= coarse_.element(i);
  }
  return result;
}

MassFunction refine(const MassFunction& mass, const Refining& refining) {
  return carried(mass, refining.coarse(), refining.fine(),
                 [&](const Proposition& set) { return refining.refine(set); });
}

MassFunction coarsen(const MassFunction& mass, const Refining& refining) {
  return carried(mass, refining.fine(), refining.coarse(),
                 [&](const Proposition& set) { return refining.coarsen_outer(set); });
}

MassFunction coarsen_inner(const MassFunction& mass, const Refining& refining) {
  return carried(mass, refining.fine(), refining.coarse(),
                 [&](const Proposition& set) { return refining.coarsen_inner(set); });
}

ProductFrame::ProductFrame(std::vector<Frame> factors) : frame_(frame_of_combinations(factors)) {
  std::size_t stride = frame_.size();  // neighbours of one factor's element in the product
  for (const Frame& factor : factors) {
    stride /= factor.size();
    std::vector<Proposition> images(factor.size());
    for (std::size_t k = 0; k < frame_.size(); ++k) images[k / stride % factor.size()] |= Proposition::region(k);
    refinings_.emplace_back(factor, frame_, std::move(images));
  }
}

MassFunction ProductFrame::extend(const MassFunction& mass, std::size_t i) const { return refine(mass, factor(i)); }

MassFunction ProductFrame::marginal(const MassFunction& mass, std::size_t i) const { return coarsen(mass, factor(i)); }

}  // namespace credo::evidence
