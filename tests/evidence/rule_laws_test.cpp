// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "evidence/binary_rules.hpp"
#include "evidence/rules.hpp"
#include "tests/evidence/random_mass_functions.hpp"

/// Every law of every rule: what a rule claims holds for 10 000 random lists of sources; what it does not claim fails
/// for one of them. docs/evidence/laws.md shows the outcome (CREDO_UPDATE_DOCS=1 writes it there).
namespace credo::evidence {
namespace {

constexpr double kTolerance = 1e-9;

bool same(const std::optional<Fused>& a, const std::optional<Fused>& b) {
  if (!a || !b) return !a && !b;
  return distance(a->mass, b->mass) <= kTolerance;
}

bool is(const std::optional<Fused>& fused, const MassFunction& mass) {
  return fused && distance(fused->mass, mass) <= kTolerance;
}

bool commutes(const NamedRule& rule, const Masses& m) {
  const std::optional<Fused> all = rule.combine(m);
  return same(all, rule.combine({m[2], m[1], m[0]})) && same(all, rule.combine({m[1], m[2], m[0]}));
}

bool associates(const NamedRule& rule, const Masses& m) {
  const std::optional<Fused> all = rule.combine(m), left = rule.combine({m[0], m[1]}),
                             right = rule.combine({m[1], m[2]});
  return same(all, left ? rule.combine({left->mass, m[2]}) : std::nullopt) &&
         same(all, right ? rule.combine({m[0], right->mass}) : std::nullopt);
}

bool is_idempotent(const NamedRule& rule, const Masses& m) { return is(rule.combine({m[0], m[0]}), m[0]); }

bool ignores_a_vacuous_source(const NamedRule& rule, const Masses& m) {
  return is(rule.combine({m[0], MassFunction::vacuous(m[0].frame())}), m[0]);
}

bool ignores_vacuous_sources(const NamedRule& rule, const Masses& m) {
  const MassFunction vacuous = MassFunction::vacuous(m[0].frame());
  return ignores_a_vacuous_source(rule, m) &&
         same(rule.combine({m[0], m[1]}), rule.combine({m[0], vacuous, m[1], vacuous}));
}

// The rules that there are on two elements alone, as those of any frame.
template <FusedBinaryMass (*kRule)(const BinarySources&)>
std::optional<Fused> on_two_elements(const Sources& sources) {
  std::vector<BinaryMass> binary;
  for (const MassFunction& source : sources) binary.push_back(to_binary(source));
  const FusedBinaryMass fused = kRule(binary);
  return Fused{from_binary(sources.common_frame(), fused.mass), fused.conflict};
}

std::vector<NamedRule> tested_rules() {
  std::vector<NamedRule> rules(all_rules().begin(), all_rules().end());
  rules.push_back({"pcr5_plus", {.vacuous_neutral = true}, on_two_elements<pcr5_plus>});
  rules.push_back({"pcr6_plus", {.vacuous_neutral = true}, on_two_elements<pcr6_plus>});
  return rules;
}

bool needs_two_elements(const NamedRule& rule) { return rule.name == "pcr5_plus" || rule.name == "pcr6_plus"; }

MassDomain domain_of(const NamedRule& rule) {
  if (needs_two_elements(rule)) return {.frames = {Frame::shafer({"A", "B"})}};
  if (rule.name == "cautious") return {.frames = power_sets(), .some_unknown = true};
  if (rule.name == "bold") return {.frames = power_sets(), .some_conflict = true};
  return {.frames = all_frames()};
}

using Law = bool (*)(const NamedRule&, const Masses&);

// Empty if the law holds; else the sources, as simple as they were found, for which it does not.
std::string counterexample(const NamedRule& rule, Law law) {
  const MassDomain domain = domain_of(rule);
  const auto property = [&] {
    const Masses sources = *random_sources(3, domain);
    bool holds = false;
    try {
      holds = law(rule, sources);
    } catch (const std::invalid_argument&) {
      if (rule.name != "bold") throw;  // of which the vacuous mass function is no source
    }
    RC_ASSERT(holds);
  };
  const rc::detail::TestResult result = rc::detail::checkTestable(property, rc::detail::TestMetadata());
  if (result.is<rc::detail::SuccessResult>()) return {};
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  return text.str();
}

std::string result_at_total_conflict(const NamedRule& rule) {
  const Frame frame = needs_two_elements(rule) ? Frame::shafer({"A", "B"}) : Frame::shafer({"A", "B", "C"});
  try {
    const std::optional<Fused> fused = rule.combine(
        {MassFunction::categorical(frame, frame.parse("A")), MassFunction::categorical(frame, frame.parse("B"))});
    if (!fused) return "none";
    std::ostringstream text;
    for (const Focal& focal : fused->mass.focals()) {
      text << (text.str().empty() ? "" : ", ") << "m(" << frame.to_string(focal.set) << ") = " << focal.mass;
    }
    return text.str();
  } catch (const std::invalid_argument&) {
    return "no such sources";
  }
}

// A line of the file that begins with the head of the row; written anew where CREDO_UPDATE_DOCS asks for it.
std::string documented(const std::string& row) {
  const std::string path = CREDO_SOURCE_DIR "/docs/evidence/laws.md", head = row.substr(0, row.find('|', 1) + 1);
  std::ifstream file(path);
  std::string line, found, whole;
  while (std::getline(file, line)) {
    if (line.starts_with(head)) {
      found = line;
      if (std::getenv("CREDO_UPDATE_DOCS") != nullptr) line = found = row;
    }
    whole += line + '\n';
  }
  file.close();
  if (std::getenv("CREDO_UPDATE_DOCS") != nullptr) std::ofstream(path) << whole;
  return found;
}

class RuleLaws : public ::testing::TestWithParam<NamedRule> {};

TEST_P(RuleLaws, HoldAsClaimedAndAsDocumented) {
  const NamedRule& rule = GetParam();
  std::string row = "| `" + std::string(rule.name) + "` |";
  const auto check = [&](Law law, std::optional<bool> claimed) {
    const std::string found = counterexample(rule, law);
    if (claimed) {
      EXPECT_EQ(found.empty(), *claimed) << found;
    }
    row += found.empty() ? " yes |" : " no |";
  };
  check(commutes, rule.laws.commutative);
  check(associates, rule.laws.associative);
  check(is_idempotent, rule.laws.idempotent);
  check(ignores_vacuous_sources, rule.laws.vacuous_neutral);
  check(ignores_a_vacuous_source, std::nullopt);
  row += " " + result_at_total_conflict(rule) + " |";
  EXPECT_EQ(documented(row), row);
}

// Whatever the sources: constraints that empty what they name and masses that underflow included.
TEST_P(RuleLaws, EveryResultIsAMassFunction) {
  const NamedRule& rule = GetParam();
  MassDomain domain = domain_of(rule);
  if (domain.frames.size() == all_frames().size()) domain = {.frames = all_hyper_power_sets(), .emptied = true};
  domain.tiny = true;
  const auto property = [&] {
    const std::optional<Fused> fused = rule.combine(*random_sources(3, domain));
    if (!fused) return;
    RC_ASSERT(std::abs(total(fused->mass) - 1.0) <= kTolerance);
    RC_ASSERT(fused->conflict >= 0.0 && fused->conflict <= 1.0 + kTolerance);
    RC_ASSERT(std::ranges::all_of(fused->mass.focals(), [](const Focal& focal) { return focal.mass > 0.0; }));
  };
  const rc::detail::TestResult result = rc::detail::checkTestable(property, rc::detail::TestMetadata());
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  EXPECT_TRUE(result.is<rc::detail::SuccessResult>()) << text.str();
}

INSTANTIATE_TEST_SUITE_P(AllRules, RuleLaws, ::testing::ValuesIn(tested_rules()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace

// For GoogleTest.
static void PrintTo(const NamedRule& rule, std::ostream* out) { *out << rule.name; }

}  // namespace credo::evidence
