// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <concepts>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "evidence/mass_function.hpp"

namespace credo::evidence {

/// What holds for a rule whatever the mass functions, as long as nothing is on ∅ (the bold rule: as long as something
/// is); docs/evidence/laws.md is made by the tests that prove it.
struct Laws {
  bool associative = false;  ///< combining some sources first changes nothing: the rule may be folded
  bool commutative = true;
  bool idempotent = false;       ///< a source combined with itself is itself
  bool vacuous_neutral = false;  ///< a source that knows nothing changes nothing, however many sources there are
};

/// A rule as a type: what all the rules in evidence/ have in common, for code that works with any of them. `combine`
/// takes all sources at once and returns nothing at total conflict if the rule has no result there.
template <typename R>
concept CombinationRule = requires(const Sources& sources) {
  { R::kName } -> std::convertible_to<std::string_view>;
  { R::kLaws } -> std::convertible_to<Laws>;
  { R::combine(sources) } -> std::same_as<std::optional<Fused>>;
};

/// A rule that may be folded: source after source, in any grouping, as if all were combined at once.
template <typename R>
concept AssociativeRule = CombinationRule<R> && R::kLaws.associative;

namespace rule {

struct Conjunctive {
  static constexpr std::string_view kName = "conjunctive";
  static constexpr Laws kLaws{.associative = true, .vacuous_neutral = true};
  static std::optional<Fused> combine(const Sources& sources);
};
struct Dempster {
  static constexpr std::string_view kName = "dempster";
  static constexpr Laws kLaws{.associative = true, .vacuous_neutral = true};
  static std::optional<Fused> combine(const Sources& sources);
};
struct Disjunctive {
  static constexpr std::string_view kName = "disjunctive";
  static constexpr Laws kLaws{.associative = true};
  static std::optional<Fused> combine(const Sources& sources);
};
struct ConflictToIgnorance {  ///< Yager
  static constexpr std::string_view kName = "yager";
  static constexpr Laws kLaws{.vacuous_neutral = true};
  static std::optional<Fused> combine(const Sources& sources);
};
struct DuboisPrade {
  static constexpr std::string_view kName = "dubois_prade";
  static constexpr Laws kLaws{};
  static std::optional<Fused> combine(const Sources& sources);
};
struct Dsmh {
  static constexpr std::string_view kName = "dsmh";
  static constexpr Laws kLaws{};
  static std::optional<Fused> combine(const Sources& sources);
};
struct Pcr2 {
  static constexpr std::string_view kName = "pcr2";
  static constexpr Laws kLaws{.vacuous_neutral = true};
  static std::optional<Fused> combine(const Sources& sources);
};
struct Pcr5 {
  static constexpr std::string_view kName = "pcr5";
  static constexpr Laws kLaws{};
  static std::optional<Fused> combine(const Sources& sources);
};
struct Pcr6 {
  static constexpr std::string_view kName = "pcr6";
  static constexpr Laws kLaws{};
  static std::optional<Fused> combine(const Sources& sources);
};
struct Cautious {
  static constexpr std::string_view kName = "cautious";
  static constexpr Laws kLaws{.associative = true, .idempotent = true};
  static std::optional<Fused> combine(const Sources& sources);
};
struct Bold {
  static constexpr std::string_view kName = "bold";
  static constexpr Laws kLaws{.associative = true, .idempotent = true};
  static std::optional<Fused> combine(const Sources& sources);
};
struct Average {
  static constexpr std::string_view kName = "average";
  static constexpr Laws kLaws{.idempotent = true};
  static std::optional<Fused> combine(const Sources& sources);
};
struct Murphy {
  static constexpr std::string_view kName = "murphy";
  static constexpr Laws kLaws{};
  static std::optional<Fused> combine(const Sources& sources);
};

}  // namespace rule

/// A rule chosen while running, by its name.
struct NamedRule {
  std::string_view name;
  Laws laws;
  std::optional<Fused> (*combine)(const Sources& sources);
};
/// All rules above.
[[nodiscard]] std::span<const NamedRule> all_rules();
/// \throws std::invalid_argument, naming the rules
[[nodiscard]] const NamedRule& rule_named(std::string_view name);

/// Sources taken in one after the other. Only of associative rules, so that the result is that of all together, in any
/// order; `Fold<rule::Pcr5>` does not compile.
template <AssociativeRule R>
class Fold {
 public:
  explicit Fold(MassFunction first) : mass_(std::move(first)) {}

  /// \returns false at total conflict, where the mass function stays as it was
  bool add(const MassFunction& source) {
    std::optional<Fused> fused = R::combine({mass_, source});
    if (fused) mass_ = std::move(fused->mass);
    return fused.has_value();
  }
  [[nodiscard]] const MassFunction& mass() const { return mass_; }

 private:
  MassFunction mass_;
};

/// The left fold of any rule: what was before combined with the next. For rules that are not associative it depends on
/// the order of the sources and differs from combining all at once; it is what a map does whose cells keep a mass
/// function (a recursive filter). `conflict` of the result is that of the last step.
/// \returns nothing if a step has no result
template <CombinationRule R>
[[nodiscard]] std::optional<Fused> fold_in_order(const Sources& sources) {
  sources.common_frame();
  std::optional<Fused> result = Fused{sources[0], 0.0};
  for (std::size_t i = 1; i < sources.size() && result; ++i) result = R::combine({result->mass, sources[i]});
  return result;
}

}  // namespace credo::evidence
