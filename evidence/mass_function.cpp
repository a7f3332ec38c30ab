// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/mass_function.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>
#include <stdexcept>

namespace credo::evidence {
namespace {

constexpr std::size_t kSearchedInOrder = 12;  // so many terms are found faster by looking at each

template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream message;
  message.precision(12);
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

bool in_unit_interval(double mass) { return mass >= 0.0 && mass <= 1.0 + kMassTolerance; }

std::vector<Focal> parsed(const Frame& frame, std::initializer_list<std::pair<std::string_view, double>> focals) {
  std::vector<Focal> result;
  for (const auto& [text, mass] : focals) result.push_back({frame.parse(text), mass});
  return result;
}

double checked_sum(const Frame& frame, std::span<const Focal> focals) {
  double sum = 0.0;
  for (const Focal& focal : focals) {
    if (!in_unit_interval(focal.mass)) {
      refuse("not a mass function: m(", frame.to_string(frame.admitted(focal.set)), ") = ", focal.mass,
             "; a mass must be in [0, 1]");
    }
    sum += focal.mass;
  }
  return sum;
}

void check_power_set(const Frame& frame, std::size_t values, const char* what) {
  if (!frame.is_power_set()) refuse("a ", what, " needs a frame of Shafer's model: its elements exclude each other");
  if (values != frame.size())
    refuse("a ", what, " needs ", frame.size(), " values, one for each element; got ", values);
}

}  // namespace

MassFunction::MassFunction(Frame frame, std::span<const Focal> focals) : frame_(std::move(frame)) {
  const double sum = checked_sum(frame_, focals);
  if (std::abs(sum - 1.0) > kMassTolerance) {
    refuse("not a mass function: the masses sum to ", sum, ", not to 1 (tolerance ", kMassTolerance, ")");
  }
  focals_.reserve(focals.size());
  for (const Focal& focal : focals) focals_.push_back({frame_.admitted(focal.set), focal.mass / sum});
  if (!std::ranges::is_sorted(focals_, {}, &Focal::set)) std::ranges::stable_sort(focals_, {}, &Focal::set);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < focals_.size(); ++i) {
    if (kept > 0 && focals_[kept - 1].set == focals_[i].set) {
      focals_[kept - 1].mass += focals_[i].mass;
    } else if (focals_[i].mass > 0.0) {
      focals_[kept++] = focals_[i];
    }
  }
  focals_.resize(kept);
}

MassFunction::MassFunction(Frame frame, std::initializer_list<std::pair<std::string_view, double>> focals)
    : MassFunction(frame, parsed(frame, focals)) {}

MassFunction MassFunction::vacuous(Frame frame) {
  const Proposition all = frame.all();
  return categorical(std::move(frame), all);
}

MassFunction MassFunction::categorical(Frame frame, const Proposition& set) {
  const Focal focal{set, 1.0};
  return MassFunction(std::move(frame), std::span(&focal, 1));
}

MassFunction MassFunction::simple_support(Frame frame, const Proposition& set, double mass) {
  if (!in_unit_interval(mass)) refuse("the mass of a simple support must be in [0, 1]; got ", mass);
  const Focal focals[] = {{set, mass}, {frame.all(), std::max(0.0, 1.0 - mass)}};
  return MassFunction(std::move(frame), focals);
}

MassFunction MassFunction::bayesian(Frame frame, std::span<const double> probabilities) {
  check_power_set(frame, probabilities.size(), "Bayesian mass function");
  std::vector<Focal> focals;
  for (std::size_t i = 0; i < probabilities.size(); ++i) focals.push_back({frame.element(i), probabilities[i]});
  return MassFunction(std::move(frame), std::span<const Focal>(focals));
}

MassFunction MassFunction::consonant(Frame frame, std::span<const double> contour) {
  check_power_set(frame, contour.size(), "consonant mass function");
  std::vector<std::pair<double, std::size_t>> falling;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    if (!in_unit_interval(contour[i])) {
      refuse("the plausibility of ", frame.name(i), " must be in [0, 1]; got ", contour[i]);
    }
    falling.emplace_back(-contour[i], i);
  }
  std::ranges::sort(falling);
  if (std::abs(falling.front().first + 1.0) > kMassTolerance) {
    refuse("the largest plausibility of a consonant mass function must be 1; got ", -falling.front().first);
  }
  falling.front().first = -1.0;
  // The set of the k most plausible elements has what the k-th is more plausible than the next.
  std::vector<Focal> focals;
  Proposition nested;
  for (std::size_t k = 0; k < falling.size(); ++k) {
    nested |= frame.element(falling[k].second);
    const double next = k + 1 < falling.size() ? -falling[k + 1].first : 0.0;
    focals.push_back({nested, std::max(0.0, -falling[k].first - next)});
  }
  return MassFunction(std::move(frame), std::span<const Focal>(focals));
}

MassFunction MassFunction::restored(Frame frame, std::span<const Focal> focals) {
  MassFunction result(std::move(frame), focals);
  if (!std::ranges::equal(result.focals_, focals, {}, &Focal::set, &Focal::set)) {
    refuse("the focal elements to restore must be ordered by proposition, each once and with a mass > 0");
  }
  result.focals_.assign(focals.begin(), focals.end());
  return result;
}

MassFunction MassFunction::with_rest_unknown(Frame frame, std::span<const Focal> focals) {
  std::vector<Focal> all(focals.begin(), focals.end());
  all.push_back({frame.all(), std::max(0.0, 1.0 - checked_sum(frame, focals))});
  return MassFunction(std::move(frame), std::span<const Focal>(all));
}

MassFunction MassFunction::with_rest_unknown(Frame frame,
                                             std::initializer_list<std::pair<std::string_view, double>> focals) {
  const std::vector<Focal> read = parsed(frame, focals);
  return with_rest_unknown(std::move(frame), std::span<const Focal>(read));
}

double MassFunction::mass(const Proposition& set) const {
  const Proposition wanted = frame_.existing(set);
  if (frame_.is_power_set()) {
    const auto found = std::ranges::lower_bound(focals_, wanted, {}, &Focal::set);
    return found != focals_.end() && found->set == wanted ? found->mass : 0.0;
  }
  double sum = 0.0;
  for (const Focal& focal : focals_) {
    if (frame_.existing(focal.set) == wanted) sum += focal.mass;
  }
  return sum;
}

bool MassFunction::is_bayesian() const {
  return std::ranges::all_of(focals_, [this](const Focal& focal) { return frame_.cardinality(focal.set) == 1; });
}

bool MassFunction::is_consonant() const {
  std::vector<Proposition> sets;
  for (const Focal& focal : focals_) sets.push_back(frame_.existing(focal.set));
  std::ranges::sort(sets, {}, &Proposition::count);
  return std::ranges::adjacent_find(sets, [](const Proposition& a, const Proposition& b) { return !a.subset_of(b); }) ==
         sets.end();
}

void FocalSum::add(const Proposition& set, double mass) {
  if (!index_.empty()) {
    const auto [place, is_new] = index_.try_emplace(set, terms_.size());
    if (is_new) {
      terms_.push_back({set, mass});
    } else {
      terms_[place->second].mass += mass;
    }
    return;
  }
  for (Focal& term : terms_) {
    if (term.set == set) {
      term.mass += mass;
      return;
    }
  }
  terms_.push_back({set, mass});
  if (terms_.size() > kSearchedInOrder) {
    for (std::size_t i = 0; i < terms_.size(); ++i) index_.emplace(terms_[i].set, i);
  }
}

void FocalSum::clear() {
  terms_.clear();
  index_.clear();
}

MassFunction FocalSum::mass_function(const Frame& frame) const {
  FocalSum merged;  // two sets may be one in the model
  for (const Focal& term : terms_) {
    if (term.mass > 0.0) merged.add(frame.existing(term.set), term.mass);
  }
  MassFunction result(frame);
  result.focals_ = std::move(merged.terms_);
  for (Focal& focal : result.focals_) focal.set = frame.canonical(focal.set);
  std::ranges::sort(result.focals_, {}, &Focal::set);
  return result;
}

std::optional<Fused> normalised(const MassFunction& mass) {
  const auto is_kept = [&](const Focal& focal) { return !mass.frame().existing(focal.set).empty(); };
  double kept = 0.0;
  for (const Focal& focal : mass.focals()) kept += is_kept(focal) ? focal.mass : 0.0;
  if (!(kept > 0.0)) return std::nullopt;
  FocalSum rest;
  for (const Focal& focal : mass.focals()) {
    if (is_kept(focal)) rest.add(focal.set, focal.mass / kept);
  }
  return Fused{rest.mass_function(mass.frame()), mass.conflict()};
}

Frame Sources::common_frame() const {
  if (masses_.empty()) throw std::invalid_argument("at least one mass function is needed: an empty list has no frame");
  for (const MassFunction& mass : masses_) {
    if (!(mass.frame() == masses_.front().frame())) {
      throw std::invalid_argument("mass functions of different frames cannot be combined: refine them to a common one");
    }
  }
  return masses_.front().frame();
}

BinaryMass to_binary(const MassFunction& mass) {
  if (!mass.frame().is_power_set() || mass.frame().size() != 2 || !mass.is_normal()) {
    throw std::invalid_argument("a binary mass is a normal mass function on a power set of two elements");
  }
  return {mass.mass(mass.frame().element(0)), mass.mass(mass.frame().element(1)), mass.mass(mass.frame().all())};
}

MassFunction from_binary(const Frame& frame, const BinaryMass& mass) {
  if (!frame.is_power_set() || frame.size() != 2) {
    throw std::invalid_argument("a binary mass needs a power set of two elements");
  }
  const Focal focals[] = {{frame.element(0), mass.yes}, {frame.element(1), mass.no}, {frame.all(), mass.unknown}};
  return MassFunction(frame, focals);
}

std::ostream& operator<<(std::ostream& out, const MassFunction& mass) {
  out << '{';
  const char* between = "";
  for (const Focal& focal : mass.focals()) {
    out << between << mass.frame().to_string(focal.set) << ": " << focal.mass;
    between = ", ";
  }
  return out << '}';
}

}  // namespace credo::evidence
