// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// Every table of docs/evidence is what the library gives. CREDO_UPDATE_DOCS=1 in the environment writes the tables.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ostream>
#include <set>

#include "evidence/averaging.hpp"
#include "evidence/binary_rules.hpp"
#include "evidence/conflict_to_sets.hpp"
#include "evidence/conjunctive.hpp"
#include "evidence/decomposition.hpp"
#include "evidence/discounting.hpp"
#include "evidence/disjunctive.hpp"
#include "evidence/log_commonality.hpp"
#include "evidence/open_world.hpp"
#include "evidence/probability.hpp"
#include "evidence/proportional.hpp"
#include "evidence/rules.hpp"
#include "tests/evidence/docs_tables.hpp"

namespace credo::evidence::docs {
namespace {

// The two sources that all pages share.
const Frame kAbc = Frame::shafer({"A", "B", "C"});
const MassFunction kFirst(kAbc, {{"A", 0.6}, {"A ∪ B", 0.3}, {"Θ", 0.1}});
const MassFunction kSecond(kAbc, {{"B", 0.5}, {"B ∪ C", 0.2}, {"Θ", 0.3}});
const std::vector<std::string> kSets{"A", "B", "A ∪ B", "B ∪ C", "Θ", "∅"};

const Frame kAb = Frame::shafer({"A", "B"});

MassFunction on_ab(double a, double b) { return MassFunction::with_rest_unknown(kAb, {{"A", a}, {"B", b}}); }

// ------------------------------------------------------------------------------------------------ README and models

std::string all_rules_table() {
  std::vector<NamedMass> rows{{"m1", kFirst}, {"m2", kSecond}};
  for (const NamedRule& rule : all_rules()) {
    if (rule.name != "bold") rows.push_back({std::string(rule.name), rule.combine({kFirst, kSecond})->mass});
  }
  return masses(kSets, rows);
}

std::string sizes_table() {
  const std::vector<std::string> names{"A", "B", "C", "D", "E"};
  std::vector<Row> rows;
  for (std::size_t n = 1; n <= names.size(); ++n) {
    const Frame free = Frame::free_dsm({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(n)});
    const Frame power = Frame::shafer({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(n)});
    rows.push_back({std::to_string(n), std::to_string(power.propositions().size() + 1),
                    std::to_string(free.propositions().size() + 1), std::to_string(free.region_count())});
  }
  return markdown({"elements", "2^Θ", "D^Θ", "Venn regions"}, rows);
}

std::string models_table() {
  const std::vector<std::string> one{"A ∩ B"}, all{"A ∩ B", "A ∩ C", "B ∩ C"}, gone{"C"};
  const std::pair<const char*, Frame> models[] = {
      {"free", Frame::free_dsm({"A", "B", "C"})},
      {"hybrid: A ∩ B = ∅", Frame::hybrid({"A", "B", "C"}, one)},
      {"hybrid: C = ∅", Frame::hybrid({"A", "B", "C"}, gone)},
      {"hybrid: A ∩ B = A ∩ C = B ∩ C = ∅", Frame::hybrid({"A", "B", "C"}, all)},
      {"Shafer", kAbc}};
  std::vector<Row> rows;
  for (const auto& [name, frame] : models) {
    const Proposition a = frame.parse("A");
    rows.push_back({name, std::to_string(frame.cardinality(frame.all())),
                    std::to_string(frame.propositions().size() + 1), std::to_string(frame.cardinality(a)),
                    frame.to_string(frame.canonical(frame.parse("A ∩ C ∪ A ∩ B")))});
  }
  return markdown({"model", "regions", "propositions", "C_M(A)", "A ∩ B ∪ A ∩ C is"}, rows);
}

// ------------------------------------------------------------------------------------------------------ conjunctive

std::string conjunctive_table() {
  const MassFunction open = conjunctive({kFirst, kSecond});
  return masses(kSets, {{"m1", kFirst},
                        {"m2", kSecond},
                        {"conjunctive", open},
                        {"Dempster", dempster({kFirst, kSecond})->mass},
                        {"m1 if B ∪ C", condition(kFirst, kAbc.parse("B ∪ C"))->mass},
                        {"conjunctive without m2", *decombine(open, kSecond)}});
}

std::string dsmc_table() {
  const Frame free = Frame::free_dsm({"A", "B", "C"});
  const MassFunction first(free, {{"A", 0.6}, {"A ∪ B", 0.3}, {"Θ", 0.1}});
  const MassFunction second(free, {{"B", 0.5}, {"B ∪ C", 0.2}, {"Θ", 0.3}});
  return masses({"A", "B", "A ∪ B", "B ∪ C", "B ∪ A ∩ C", "A ∩ B", "A ∩ B ∪ A ∩ C", "Θ", "∅"},
                {{"free model", conjunctive({first, second})}});
}

// ------------------------------------------------------------------------------------------------- conflict to sets

std::string conflict_to_sets_table() {
  const MassFunction vacuous = MassFunction::vacuous(kAbc);
  return masses(kSets, {{"conjunctive", conjunctive({kFirst, kSecond})},
                        {"Yager", conflict_to_ignorance({kFirst, kSecond}).mass},
                        {"Dubois-Prade = DSmH", dubois_prade({kFirst, kSecond}).mass},
                        {"Yager, and a vacuous source", conflict_to_ignorance({kFirst, kSecond, vacuous}).mass},
                        {"Dubois-Prade, and a vacuous source", dubois_prade({kFirst, kSecond, vacuous}).mass}});
}

std::string hybrid_table() {
  const std::vector<std::string> empty{"E ∩ O"};
  const Frame cell = Frame::hybrid({"E", "O"}, empty);
  const std::pair<const char*, const char*> pairs[] = {
      {"E", "O"}, {"E ∩ O", "O"}, {"E ∩ O", "E ∪ O"}, {"E ∩ O", "E ∩ O"}};
  std::vector<Row> rows;
  for (const auto& [a, b] : pairs) {
    Row row{std::string(a) + ", " + b};
    for (const NamedRule* rule : {&rule_named("dubois_prade"), &rule_named("dsmh"), &rule_named("pcr2")}) {
      const auto fused = rule->combine({MassFunction(cell, {{a, 1.0}}), MassFunction(cell, {{b, 1.0}})});
      std::string text;
      for (const Focal& focal : fused->mass.focals()) {
        text += (text.empty() ? "" : ", ") + cell.to_string(focal.set) + ": " + number(focal.mass);
      }
      row.push_back(text);
    }
    rows.push_back(row);
  }
  return markdown({"m1, m2", "Dubois-Prade", "DSmH", "PCR2"}, rows);
}

// Three sources at once, and folded in all six orders.
const std::vector<MassFunction> kThree{on_ab(0.6, 0.3), on_ab(0.2, 0.7), on_ab(0.1, 0.8)};

template <CombinationRule R>
Row order_row() {
  std::array<std::size_t, 3> order{0, 1, 2};
  double least = 1.0, largest = 0.0;
  do {
    const std::vector<MassFunction> sources{kThree[order[0]], kThree[order[1]], kThree[order[2]]};
    const double a = fold_in_order<R>(sources)->mass.mass("A");
    least = std::min(least, a);
    largest = std::max(largest, a);
  } while (std::ranges::next_permutation(order).found);
  return {std::string(R::kName), number(R::combine(kThree)->mass.mass("A")), number(least), number(largest)};
}

const Row kOrderHeader{"m(A)", "at once", "folded, least", "folded, largest"};

std::string order_of_sets_table() {
  return markdown(kOrderHeader, {order_row<rule::Dempster>(), order_row<rule::ConflictToIgnorance>()});
}

// ----------------------------------------------------------------------------------------------------- proportional

std::string proportional_table() {
  return masses(kSets, {{"conjunctive", conjunctive({kFirst, kSecond})},
                        {"PCR2", pcr2({kFirst, kSecond}).mass},
                        {"PCR5 = PCR6", pcr5({kFirst, kSecond}).mass}});
}

std::string vacuous_table() {
  using Rule = FusedBinaryMass (*)(const BinarySources&);
  const std::pair<const char*, Rule> rules[] = {
      {"PCR2", pcr2}, {"PCR5", pcr5}, {"PCR6", pcr6}, {"PCR5+", pcr5_plus}, {"PCR6+", pcr6_plus}};
  std::vector<Row> rows;
  for (const auto& [name, rule] : rules) {
    rows.push_back({name});
    for (const std::size_t vacuous : {0, 1, 3}) {
      std::vector<BinaryMass> sources(2 + vacuous, BinaryMass::vacuous());
      sources[0] = BinaryMass::from(0.6, 0.3);
      sources[1] = BinaryMass::from(0.2, 0.7);
      const BinaryMass mass = rule(sources).mass;
      rows.back().push_back(number(mass.yes));
      rows.back().push_back(number(mass.unknown));
    }
  }
  return markdown({"", "m(A)", "m(Θ)", "m(A), and one vacuous", "m(Θ)", "m(A), and three vacuous", "m(Θ)"}, rows);
}

std::string order_of_proportional_table() {
  return markdown(kOrderHeader, {order_row<rule::Pcr2>(), order_row<rule::Pcr5>(), order_row<rule::Pcr6>()});
}

std::string forgetting_table() {
  constexpr double kTie = 1e-9;
  std::vector<Row> rows;
  for (const char* name : {"dempster", "yager", "pcr2", "pcr5"}) {
    const NamedRule& rule = rule_named(name);
    MassFunction map = MassFunction::vacuous(kAb);
    for (int i = 0; i < 100; ++i) map = rule.combine({map, on_ab(0.05, 0.65)})->mass;
    int contrary = 0;
    for (; map.mass("A") <= map.mass("B") + kTie && contrary < 1000; ++contrary) {
      map = rule.combine({map, on_ab(0.65, 0.05)})->mass;
    }
    rows.push_back({name, std::to_string(contrary)});
  }
  return markdown({"rule", "contrary readings"}, rows);
}

std::string votes_table() {
  const MassFunction a(kAb, {{"A", 1.0}}), b(kAb, {{"B", 1.0}});
  std::vector<Row> rows;
  for (const char* name : {"pcr2", "pcr5", "pcr6", "average", "yager", "dempster"}) {
    const auto fused = rule_named(name).combine({a, a, a, b});
    rows.push_back(
        fused ? Row{name, number(fused->mass.mass("A")), number(fused->mass.mass("B")), number(fused->mass.mass("Θ"))}
              : Row{name, "-", "-", "-"});
  }
  return markdown({"rule", "A", "B", "Θ"}, rows);
}

// ----------------------------------------------------------------------------------------- sources that share or err

std::string sharing_table() {
  const MassFunction third(kAbc, {{"A", 0.5}, {"A ∪ B", 0.2}, {"Θ", 0.3}});
  return masses(kSets, {{"m1", kFirst},
                        {"m3", third},
                        {"conjunctive", conjunctive({kFirst, third})},
                        {"cautious", cautious({kFirst, third})},
                        {"disjunctive", disjunctive({kFirst, third})}});
}

std::string idempotent_table() {
  const MassFunction open(kAbc, {{"A", 0.3}, {"A ∪ B", 0.5}, {"∅", 0.2}});
  return masses(kSets, {{"m1", kFirst},
                        {"conjunctive", conjunctive({kFirst, kFirst})},
                        {"cautious", cautious({kFirst, kFirst})},
                        {"m", open},
                        {"disjunctive", disjunctive({open, open})},
                        {"bold", bold({open, open})}});
}

std::string averaging_table() {
  return masses(kSets, {{"m1", kFirst},
                        {"m2", kSecond},
                        {"average", average({kFirst, kSecond})},
                        {"Murphy", murphy({kFirst, kSecond})->mass},
                        {"Dempster", dempster({kFirst, kSecond})->mass}});
}

std::string discounting_table() {
  std::vector<NamedMass> rows;
  for (const double reliability : {1.0, 0.9, 0.5, 0.0}) {
    rows.push_back({"r = " + number(reliability), discount(kFirst, reliability)});
  }
  return masses({"A", "A ∪ B", "Θ"}, rows);
}

std::string contextual_table() {
  const MassFunction m(kAbc, {{"A", 0.5}, {"B", 0.3}, {"C", 0.2}});
  const double all[] = {1.0, 1.0, 1.0}, not_c[] = {1.0, 1.0, 0.6}, not_b_c[] = {1.0, 0.6, 0.6};
  return masses({"A", "B", "C", "A ∪ C", "B ∪ C", "A ∪ B", "Θ"},
                {{"r = (1, 1, 1)", contextual_discount(m, all)},
                 {"r = (1, 1, 0.6)", contextual_discount(m, not_c)},
                 {"r = (1, 0.6, 0.6)", contextual_discount(m, not_b_c)}});
}

std::string decay_table() {
  return masses({"A", "A ∪ B", "Θ"}, {{"now", decay(kFirst, 0.0, 1.0)},
                                      {"after one half-life", decay(kFirst, 1.0, 1.0)},
                                      {"after two", decay(kFirst, 2.0, 1.0)},
                                      {"after five", decay(kFirst, 5.0, 1.0)}});
}

// --------------------------------------------------------------------------------------------- matching, fast paths

std::string matching_table() {
  const std::vector<BinaryMass> evidence{BinaryMass::from(0.6, 0.1), BinaryMass::from(0.3, 0.2),
                                         BinaryMass::from(0, 0.7)};
  OpenWorldMatcher matcher;
  matcher.combine(evidence);
  const OpenWorldMasses &open = matcher.open(), &mass = matcher.normalised();
  const OpenWorldValues &pl = matcher.plausibility(), &bet = matcher.pignistic();
  std::vector<Row> rows;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    rows.push_back({"P" + std::to_string(i + 1), number(evidence[i].yes), number(evidence[i].no), number(open.match[i]),
                    number(mass.match[i]), number(pl.match[i]), number(bet.match[i]),
                    number(assignment_weight(evidence[i]))});
  }
  rows.push_back({"*", "", "", number(open.none), number(mass.none), number(pl.none), number(bet.none), "0"});
  rows.push_back({"Θ", "", "", number(open.unknown), number(mass.unknown), "", "", ""});
  rows.push_back({"∅", "", "", number(open.conflict), "", "", "", ""});
  return markdown({"", "a", "b", "open mass", "m = Bel", "Pl", "BetP", "weight"}, rows);
}

std::string long_run_table() {
  constexpr double kReliability = 0.99;
  const GridMass reading = discount(GridMass::from(0.02, 0.78, 0.10), kReliability);
  const LogCommonality increment = log_commonality(GridMass::from(0.02, 0.78, 0.10), kReliability);
  GridMass linear = GridMass::vacuous();
  LogCommonality cell;
  std::vector<Row> rows;
  int n = 0;
  for (const int readings : {1, 10, 100, 1000}) {
    for (; n < readings; ++n) {
      linear = dsmc(linear, reading);
      cell += increment;
    }
    rows.push_back({std::to_string(readings), number(linear.conflict), number(linear.occupied), number(linear.unknown),
                    number(evidence_for_occupied(cell) - evidence_for_empty(cell)),
                    number(normalised_masses(cell).occupied), number(contested(cell))});
  }
  return markdown({"readings", "m(E∩O)", "m(O)", "m(E∪O)", "log-odds", "m(O), normalised", "contested"}, rows);
}

// ------------------------------------------------------------------------------------------------------- criticisms

std::string bayes_table() {
  const MassFunction reading = on_ab(0.5, 0.1);
  const std::vector<double> likelihood = plausibility_transform(reading);
  std::vector<Row> rows;
  for (const int readings : {1, 2, 5, 10}) {
    const double odds = std::pow(likelihood[0] / likelihood[1], readings);
    const MassFunction mass = dempster(std::vector<MassFunction>(static_cast<std::size_t>(readings), reading))->mass;
    rows.push_back({std::to_string(readings), number(odds / (1.0 + odds)), number(plausibility_transform(mass)[0]),
                    number(pignistic(mass, kAb.parse("A"))), number(mass.mass("A")), number(mass.mass("Θ"))});
  }
  return markdown({"readings", "Bayes", "Dempster, PlP", "BetP", "m(A)", "m(Θ)"}, rows);
}

std::string saturation_table() {
  const GridMass reading = GridMass::from(0.6, 0.1, 0.05);
  GridMass cell = GridMass::vacuous();
  std::vector<Row> rows;
  int n = 0;
  for (const int readings : {1, 3, 10, 30}) {
    for (; n < readings; ++n) cell = dsmc(cell, reading);
    rows.push_back({std::to_string(readings), number(cell.conflict),
                    number(belief(cell, GridElement::kEmpty, GridModel::kFree)),
                    number(belief(cell, GridElement::kOccupied, GridModel::kFree)),
                    number(without_conflict(cell)->empty), number(without_conflict(cell)->occupied)});
  }
  return markdown({"readings", "m(E∩O)", "Bel(E)", "Bel(O)", "m(E), normalised", "m(O), normalised"}, rows);
}

struct Case {
  const char* page;
  const char* table;
  std::string (*compute)();

  friend std::ostream& operator<<(std::ostream& out, const Case& each) { return out << each.table; }
};

constexpr Case kCases[] = {
    {"README.md", "all rules", all_rules_table},
    {"models.md", "sizes", sizes_table},
    {"models.md", "models", models_table},
    {"conjunctive.md", "conjunctive", conjunctive_table},
    {"conjunctive.md", "dsmc", dsmc_table},
    {"conflict-to-sets.md", "conflict to sets", conflict_to_sets_table},
    {"conflict-to-sets.md", "hybrid", hybrid_table},
    {"conflict-to-sets.md", "order", order_of_sets_table},
    {"proportional.md", "proportional", proportional_table},
    {"proportional.md", "vacuous", vacuous_table},
    {"proportional.md", "order", order_of_proportional_table},
    {"proportional.md", "forgetting", forgetting_table},
    {"proportional.md", "votes", votes_table},
    {"disjunctive-cautious-bold.md", "sharing", sharing_table},
    {"disjunctive-cautious-bold.md", "idempotent", idempotent_table},
    {"averaging.md", "averaging", averaging_table},
    {"discounting.md", "classical", discounting_table},
    {"discounting.md", "contextual", contextual_table},
    {"discounting.md", "decay", decay_table},
    {"matching.md", "matching", matching_table},
    {"fast-paths.md", "long run", long_run_table},
    {"criticisms.md", "bayes", bayes_table},
    {"criticisms.md", "saturation", saturation_table},
};

class DocsTable : public ::testing::TestWithParam<Case> {};

TEST_P(DocsTable, IsWhatTheLibraryGives) {
  Page page(GetParam().page);
  const std::string computed = GetParam().compute();
  if (std::getenv("CREDO_UPDATE_DOCS") != nullptr) page.replace(GetParam().table, computed);
  EXPECT_EQ(page.table(GetParam().table), computed) << "in docs/evidence/" << GetParam().page;
}

INSTANTIATE_TEST_SUITE_P(Pages, DocsTable, ::testing::ValuesIn(kCases));

TEST(DocsTables, AreAllComputed) {
  std::set<std::pair<std::string, std::string>> computed, shown;
  for (const Case& each : kCases) {
    computed.emplace(each.page, each.table);
    for (const std::string& table : Page(each.page).tables()) shown.emplace(each.page, table);
  }
  EXPECT_EQ(shown, computed);
}

}  // namespace
}  // namespace credo::evidence::docs
