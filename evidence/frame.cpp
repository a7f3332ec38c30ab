// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/frame.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <unordered_set>

namespace credo::evidence {
namespace {

constexpr std::size_t kMaxOverlapping = 8;  // 2^8 - 1 regions fill a Proposition
constexpr std::size_t kMaxEnumeratedShafer = 20;
constexpr std::size_t kMaxEnumeratedOverlapping = 5;  // 7579; six would be 7 828 352

constexpr std::size_t kMaxDepth = 1000;  // of a proposition as text

constexpr std::string_view kUnion = "∪", kIntersection = "∩", kComplement = "¬", kEmptySet = "∅", kAll = "Θ";
constexpr std::string_view kOperators[] = {kUnion, kIntersection, kComplement, "|", "&", "~", "(", ")"};

std::size_t operator_at(std::string_view text) {  // its length in bytes, 0 if there is none
  for (const std::string_view sign : kOperators) {
    if (text.starts_with(sign)) return sign.size();
  }
  return 0;
}

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

void check_names(const std::vector<std::string>& names, std::size_t most) {
  if (names.empty()) throw std::invalid_argument("a frame needs at least one element");
  if (names.size() > most) {
    throw std::invalid_argument("a frame of this model has at most " + std::to_string(most) + " elements, not " +
                                std::to_string(names.size()));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    const auto refuse = [&](const std::string& why) {
      throw std::invalid_argument("the name of element " + std::to_string(i + 1) + ", '" + name + "', " + why);
    };
    if (name.empty()) refuse("is empty");
    if (is_space(name.front()) || is_space(name.back())) refuse("begins or ends with a space");
    if (name == kEmptySet || name == kAll) refuse("is the name of a proposition of every frame");
    for (std::size_t at = 0; at < name.size(); ++at) {
      if (operator_at(std::string_view(name).substr(at)) != 0) refuse("has the character of an operator");
    }
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), name) !=
        names.begin() + static_cast<std::ptrdiff_t>(i)) {
      refuse("is given twice");
    }
  }
}

// union := meet { ∪ meet },  meet := factor { ∩ factor },  factor := ¬ factor | ( union ) | ∅ | Θ | name
class Parser {
 public:
  Parser(const Frame& frame, std::string_view text) : frame_(frame), text_(text), rest_(text) {}

  Proposition parse() {
    const Proposition result = parse_union();
    if (!rest_.empty()) fail("expected ∪, ∩ or the end");
    return result;
  }

 private:
  Proposition parse_union() {
    Proposition result = parse_intersection();
    while (accept(kUnion) || accept("|")) result |= parse_intersection();
    return result;
  }

  Proposition parse_intersection() {
    Proposition result = parse_factor();
    while (accept(kIntersection) || accept("&")) result &= parse_factor();
    return result;
  }

  Proposition parse_factor() {
    if (accept(kComplement) || accept("~")) {
      if (!frame_.is_power_set()) fail("a complement is no proposition where elements may overlap");
      return frame_.all() - nested([this] { return parse_factor(); });
    }
    if (accept("(")) {
      const Proposition inner = nested([this] { return parse_union(); });
      if (!accept(")")) fail("expected )");
      return inner;
    }
    return parse_name();
  }

  template <typename Parse>
  Proposition nested(Parse parse) {  // text of any origin must not exhaust the stack
    if (++depth_ > kMaxDepth) fail("expected at most " + std::to_string(kMaxDepth) + " levels of ( and ¬");
    const Proposition inner = parse();
    --depth_;
    return inner;
  }

  Proposition parse_name() {
    skip_spaces();
    std::size_t length = 0;
    while (length < rest_.size() && operator_at(rest_.substr(length)) == 0) ++length;
    std::string_view name = rest_.substr(0, length);
    while (!name.empty() && is_space(name.back())) name.remove_suffix(1);
    if (name.empty()) fail("expected an element");
    rest_.remove_prefix(length);
    if (name == kEmptySet) return {};
    if (name == kAll) return frame_.all();
    return frame_.element(frame_.index(name));
  }

  bool accept(std::string_view sign) {
    skip_spaces();
    if (!rest_.starts_with(sign)) return false;
    rest_.remove_prefix(sign.size());
    skip_spaces();
    return true;
  }

  void skip_spaces() {
    while (!rest_.empty() && is_space(rest_.front())) rest_.remove_prefix(1);
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw std::invalid_argument("'" + std::string(text_) + "' is no proposition: " + why + " at '" +
                                std::string(rest_) + "'");
  }

  const Frame& frame_;
  std::string_view text_, rest_;
  std::size_t depth_ = 0;
};

}  // namespace

Frame Frame::shafer(std::vector<std::string> names) {
  check_names(names, Proposition::kMaxRegions);
  Diagram diagram;
  diagram.names = std::move(names);
  diagram.regions = diagram.names.size();
  diagram.existing = diagram.all = Proposition::first(diagram.regions);
  for (std::size_t i = 0; i < diagram.regions; ++i) diagram.elements.push_back(Proposition::region(i));
  return Frame(std::make_shared<const Diagram>(std::move(diagram)));
}

// Region r lies in the elements whose bits are set in r + 1, and in no other.
Frame::Diagram Frame::overlapping(std::vector<std::string> names) {
  check_names(names, kMaxOverlapping);
  Diagram diagram;
  diagram.names = std::move(names);
  const auto count = static_cast<std::uint32_t>(diagram.names.size());
  diagram.regions = (std::size_t{1} << count) - 1;
  diagram.existing = diagram.all = Proposition::first(diagram.regions);
  for (std::uint32_t size = 1; size <= count; ++size) {
    for (std::uint32_t term = 1; term <= diagram.regions; ++term) {
      if (static_cast<std::uint32_t>(std::popcount(term)) != size) continue;
      Proposition regions;
      for (std::uint32_t r = 1; r <= diagram.regions; ++r) {
        if ((r & term) == term) regions |= Proposition::region(r - 1);
      }
      diagram.terms.push_back({term, regions});
      if (size == 1) diagram.elements.push_back(regions);
    }
  }
  return diagram;
}

Frame Frame::free_dsm(std::vector<std::string> names) {
  return Frame(std::make_shared<const Diagram>(overlapping(std::move(names))));
}

Frame Frame::hybrid(std::vector<std::string> names, std::span<const std::string> empty) {
  Diagram diagram = overlapping(std::move(names));
  const Frame free = Frame(std::make_shared<const Diagram>(diagram));
  for (const std::string& constraint : empty) diagram.existing = diagram.existing - free.parse(constraint);
  if (diagram.existing.empty()) throw std::invalid_argument("the constraints leave nothing of the frame");
  const Frame constrained = Frame(std::make_shared<const Diagram>(diagram));
  diagram.all = constrained.canonical(diagram.existing);
  return Frame(std::make_shared<const Diagram>(std::move(diagram)));
}

std::size_t Frame::index(std::string_view name) const {
  const auto found = std::ranges::find(diagram_->names, name);
  if (found == diagram_->names.end()) {
    std::string known;
    for (const std::string& each : diagram_->names) known += (known.empty() ? "" : ", ") + each;
    throw std::invalid_argument("the frame has no element '" + std::string(name) + "'; it has: " + known);
  }
  return static_cast<std::size_t>(found - diagram_->names.begin());
}

std::vector<Frame::Term> Frame::shortest_union(const Proposition& set) const {
  std::vector<Term> chosen;
  const Proposition wanted = existing(set);
  for (const Term& term : diagram_->terms) {
    const Proposition here = existing(term.regions);
    if (here.empty() || !here.subset_of(wanted)) continue;
    const bool covered =
        std::ranges::any_of(chosen, [&](const Term& c) { return (c.elements & term.elements) == c.elements; });
    if (!covered) chosen.push_back(term);
  }
  return chosen;
}

Proposition Frame::canonical(const Proposition& set) const {
  if (is_power_set()) return existing(set);
  Proposition result;
  for (const Term& term : shortest_union(set)) result |= term.regions;
  return result;
}

Proposition Frame::admitted(const Proposition& set) const {
  if (is_power_set() && set.subset_of(all())) return set;
  if (!set.subset_of(Proposition::first(region_count()))) {
    throw std::invalid_argument("a proposition has a region that the frame does not know: it is of another frame");
  }
  Proposition exact;
  for (const Term& term : diagram_->terms) {
    if (term.regions.subset_of(set)) exact |= term.regions;
  }
  if (exact == set) return set;
  const Proposition same = canonical(set);
  if (existing(same) != existing(set)) {
    throw std::invalid_argument("a set of Venn regions is no union of intersections of the frame's elements");
  }
  return same;
}

Proposition Frame::composing(const Proposition& set) const {
  if (is_power_set()) return set;
  std::vector<std::uint32_t> chosen;
  Proposition result;
  for (const Term& term : diagram_->terms) {
    if (!term.regions.subset_of(set)) continue;
    if (std::ranges::any_of(chosen, [&](std::uint32_t c) { return (c & term.elements) == c; })) continue;
    chosen.push_back(term.elements);
    for (std::size_t i = 0; i < size(); ++i) {
      if ((term.elements >> i & 1) != 0) result |= element(i);
    }
  }
  return result;
}

std::vector<Proposition> Frame::propositions() const {
  const std::size_t most = is_power_set() ? kMaxEnumeratedShafer : kMaxEnumeratedOverlapping;
  if (size() > most) {
    throw std::length_error("the propositions of " + std::to_string(size()) + " elements are too many to list; " +
                            std::to_string(most) + " elements are the most");
  }
  std::vector<Proposition> result;
  if (is_power_set()) {
    for (std::uint64_t bits = 1; bits < std::uint64_t{1} << size(); ++bits) {
      result.push_back(Proposition::from_bits(bits));
    }
  } else {  // all unions of intersections
    std::unordered_set<Proposition> seen{Proposition()};
    for (const Term& term : diagram_->terms) {
      const Proposition regions = existing(term.regions);
      for (const Proposition& each : std::vector(seen.begin(), seen.end())) seen.insert(each | regions);
    }
    seen.erase(Proposition());
    for (const Proposition& each : seen) result.push_back(canonical(each));
  }
  std::ranges::sort(result, [this](const Proposition& a, const Proposition& b) {
    const std::size_t size_a = cardinality(a), size_b = cardinality(b);
    return size_a != size_b ? size_a < size_b : a < b;
  });
  return result;
}

Proposition Frame::parse(std::string_view text) const { return Parser(*this, text).parse(); }

std::string Frame::to_string(const Proposition& set) const {
  const Proposition here = existing(set);
  if (here.empty()) return std::string(kEmptySet);
  if (here == diagram_->existing) return std::string(kAll);
  std::vector<std::vector<std::size_t>> terms;
  if (is_power_set()) {
    for (std::size_t i = 0; i < size(); ++i) {
      if (here.contains(i)) terms.push_back({i});
    }
  } else {
    for (const Term& term : shortest_union(here)) {
      terms.emplace_back();
      for (std::size_t i = 0; i < size(); ++i) {
        if ((term.elements >> i & 1) != 0) terms.back().push_back(i);
      }
    }
    std::ranges::sort(terms);
  }
  std::string text;
  for (const std::vector<std::size_t>& term : terms) {
    if (!text.empty()) text += " ∪ ";
    for (std::size_t k = 0; k < term.size(); ++k) text += (k == 0 ? "" : " ∩ ") + name(term[k]);
  }
  return text;
}

}  // namespace credo::evidence
