// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "tests/support/vectors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "evidence/belief_shapes.hpp"
#include "evidence/binary_mass.hpp"
#include "evidence/conjunctive.hpp"
#include "evidence/discounting.hpp"
#include "evidence/four_kinds.hpp"
#include "evidence/gated_match.hpp"
#include "evidence/grid_mass.hpp"
#include "evidence/joint_existence.hpp"
#include "evidence/measures.hpp"
#include "evidence/open_world.hpp"
#include "evidence/probability.hpp"
#include "evidence/rules.hpp"
#include "evidence/track_belief.hpp"
#include "evidence/whole_belief.hpp"

namespace credo::evidence {
namespace {

using credo::testing::Operation;
using credo::testing::Operations;
using credo::testing::TotalConflict;
using nlohmann::json;

void only_elements(const json& mass, const std::string& allowed) {
  for (const auto& [element, value] : mass.items()) {
    if (allowed.find(" " + element + " ") == std::string::npos) throw std::invalid_argument("element " + element);
  }
}

BinaryMass binary(const json& mass) {
  only_elements(mass, " 1 2 1u2 ");
  return {mass.value("1", 0.0), mass.value("2", 0.0), mass.value("1u2", 0.0)};
}

GridMass grid(const json& mass) {
  only_elements(mass, " 1 2 1n2 1u2 ");
  return {mass.value("1", 0.0), mass.value("2", 0.0), mass.value("1n2", 0.0), mass.value("1u2", 0.0)};
}

template <typename Mass>
std::vector<Mass> all(const json& masses, Mass (*read)(const json&)) {
  std::vector<Mass> result;
  for (const json& mass : masses) result.push_back(read(mass));
  return result;
}

json written(const BinaryMass& mass) { return {{"1", mass.yes}, {"2", mass.no}, {"1u2", mass.unknown}}; }
json written(const OpenBinaryMass& mass) {
  return {{"1", mass.yes}, {"2", mass.no}, {"1u2", mass.unknown}, {"0", mass.conflict}};
}
json written(const GridMass& mass) {
  return {{"1", mass.empty}, {"2", mass.occupied}, {"1n2", mass.conflict}, {"1u2", mass.unknown}};
}
json written(const std::optional<FusedBinaryMass>& fused) {
  if (!fused) throw TotalConflict();
  return written(fused->mass);
}
json written(const std::optional<TrackBelief>& belief) {
  if (!belief) throw TotalConflict();
  return {{"m", written(belief->mass)}, {"keep", belief->keep}};
}

FusionRule rule_of(const json& in) {
  const std::string rule = in.at("rule");
  if (rule == "dempster") return FusionRule::kDempster;
  if (rule == "yager") return FusionRule::kConflictToIgnorance;
  throw std::invalid_argument("rule " + rule);
}

// In the vectors the elements are 1, 2, 3 .., ∪ is u and ∩ is n.
std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

Frame frame(const json& in) {
  std::vector<std::string> names;
  for (int i = 1; i <= in.at("n"); ++i) names.push_back(std::to_string(i));
  const std::string model = in.value("model", "free");
  if (model == "shafer") return Frame::shafer(names);
  if (model == "free") return Frame::free_dsm(names);
  std::vector<std::string> empty;
  for (const std::string constraint : in.at("empty")) empty.push_back(replaced(constraint, "n", "∩"));
  return Frame::hybrid(names, empty);
}

Proposition proposition(const Frame& frame, const std::string& name) {
  if (name == "0") return {};
  return frame.parse(replaced(replaced(name, "n", "∩"), "u", "∪"));
}

std::string name_of(const Frame& frame, const Proposition& set) {
  std::string name = frame.to_string(set);
  if (name == "Θ") {
    name.clear();
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (frame.cardinality(frame.element(i)) > 0) name += (name.empty() ? "" : "u") + frame.name(i);
    }
  }
  name = replaced(replaced(name, " ∩ ", "n"), " ∪ ", "u");
  return name == "∅" ? "0" : name;
}

MassFunction mass_function(const Frame& frame, const json& mass) {
  std::vector<Focal> focals;
  for (const auto& [name, value] : mass.items()) focals.push_back({proposition(frame, name), value});
  return MassFunction(frame, focals);
}

std::vector<MassFunction> mass_functions(const json& in) {
  std::vector<MassFunction> result;
  for (const json& mass : in.at("masses")) result.push_back(mass_function(frame(in), mass));
  return result;
}

json written(const MassFunction& mass) {
  json out = json::object();
  for (const Focal& focal : mass.focals()) out[name_of(mass.frame(), focal.set)] = mass.mass(focal.set);
  return out;
}
json written(const std::optional<Fused>& fused) {
  if (!fused) throw TotalConflict();
  return written(fused->mass);
}

template <CombinationRule R>
Operation combination() {
  return [](const json& in) { return written(R::combine(mass_functions(in))); };
}

json fold(const json& in) {
  const std::map<std::string, std::optional<Fused> (*)(const Sources&)> folds{
      {"dsmc", fold_in_order<rule::Conjunctive>},
      {"dempster", fold_in_order<rule::Dempster>},
      {"yager", fold_in_order<rule::ConflictToIgnorance>},
      {"dubois_prade", fold_in_order<rule::DuboisPrade>},
      {"dsmh", fold_in_order<rule::Dsmh>},
      {"pcr2", fold_in_order<rule::Pcr2>},
      {"pcr5", fold_in_order<rule::Pcr5>},
      {"pcr6", fold_in_order<rule::Pcr6>}};
  return written(folds.at(in.at("rule"))(mass_functions(in)));
}

json measures(const json& in) {
  const Frame of = frame(in);
  const MassFunction mass = mass_function(of, in.at("mass"));
  json out;
  for (const Proposition& set : of.propositions()) {
    const std::string name = name_of(of, set);
    out["bel"][name] = belief(mass, set);
    out["pl"][name] = plausibility(mass, set);
    out["q"][name] = commonality(mass, set);
    out["betp"][name] = pignistic(mass, set);
    out["dsmp"][name] = dsmp(mass, set, in.at("eps"));
  }
  return out;
}

// The closed forms of two elements, beside the general operations on any frame.
Operation on_two_elements(std::function<json(const json&)> operation) {
  return [operation = std::move(operation)](const json& in) -> std::optional<json> {
    if (in.at("n") != 2) return std::nullopt;
    return operation(in);
  };
}

json grid_measures(const json& in) {
  const GridModel model = in.at("model") == "free" ? GridModel::kFree : GridModel::kExclusive;
  const GridMass mass = grid(in.at("mass"));
  std::map<std::string, GridElement> elements{
      {"1", GridElement::kEmpty}, {"2", GridElement::kOccupied}, {"1u2", GridElement::kUnknown}};
  if (model == GridModel::kFree) elements["1n2"] = GridElement::kConflict;
  json out;
  for (const auto& [name, element] : elements) {
    out["bel"][name] = belief(mass, element, model);
    out["pl"][name] = plausibility(mass, element, model);
    out["q"][name] = commonality(mass, element, model);
    out["betp"][name] = pignistic(mass, element, model);
    out["dsmp"][name] = dsmp(mass, element, model, in.at("eps"));
  }
  return out;
}

json primitive_type(const json& in) {
  const WhichKind which = which_kind(in.at("alpha_deg").get<double>() - 180.0);
  const WhetherRegular whether = whether_regular(in.at("d"));
  const FourKindMass mass = combine(which, whether);
  const int kind = most_believed(mass);
  const BinaryMass is_kind = belief_in_kind(mass, kind);
  return {{"m1",
           {{"1u4", which.one_or_other[0]},
            {"2u4", which.one_or_other[1]},
            {"3u4", which.one_or_other[2]},
            {"1u2u3u4", which.unknown}}},
          {"m2", {{"1u2u3", whether.regular}, {"4", whether.other}, {"1u2u3u4", whether.unknown}}},
          {"m_type",
           {{"1", mass.one[0]},
            {"2", mass.one[1]},
            {"3", mass.one[2]},
            {"4", mass.other},
            {"1u4", mass.one_or_other[0]},
            {"2u4", mass.one_or_other[1]},
            {"3u4", mass.one_or_other[2]},
            {"1u2u3", mass.regular},
            {"1u2u3u4", mass.unknown}}},
          {"type", kind + 1},
          {"cr", is_kind.yes},
          {"m2prim", written(is_kind)}};
}

std::vector<BinaryMass> triplets(const json& in) {
  std::vector<BinaryMass> result;
  for (const json& triplet : in.at("triplets")) result.push_back({triplet.at(0), triplet.at(1), triplet.at(2)});
  return result;
}

json written(const OpenWorldMasses& masses, bool with_conflict) {
  json out{{"*", masses.none}, {"T", masses.unknown}};
  for (std::size_t i = 0; i < masses.match.size(); ++i) out["P" + std::to_string(i + 1)] = masses.match[i];
  if (with_conflict) out["0"] = masses.conflict;
  return out;
}

json open_world(const json& in, bool normalise) {
  OpenWorldMatcher matcher;
  matcher.combine(triplets(in));
  if (!normalise) return written(matcher.open(), true);
  if (matcher.total_conflict()) throw TotalConflict();
  return written(matcher.normalised(), false);
}

json gate(const json& in) {
  const GatedMatch result = gated_match(all(in.at("masses"), binary));
  return {{"m", written(result.mass)}, {"match", result.match}};
}

json track_life(const json& in) {
  const TrackBeliefParams params{.rule = rule_of(in)};
  BinaryMass track = binary(in.at("m0"));
  json out{{"history", json::array()}, {"dead_at", nullptr}};
  for (const json& event : in.at("events")) {
    const std::optional<TrackBelief> belief =
        event == "miss" ? miss_track(track, params)
                        : update_track(track, binary(event.at("m_prim")), event.at("y_match"), params);
    if (!belief) throw TotalConflict();
    track = belief->mass;
    out["history"].push_back({track.yes, track.no, track.unknown});
    if (belief->keep) continue;
    out["dead_at"] = out["history"].size();
    break;
  }
  return out;
}

json localization(const json& in) {
  std::vector<Part> tracks;
  for (const json& track : in.at("tracks")) {
    tracks.push_back({binary(track.at("m")), in.at("alpha").at(track.at("type").get<std::string>())});
  }
  const std::vector<BinaryMass> criteria{binary(in.at("m_count")), binary(in.at("m_ratio"))};
  return written(whole_from_all_parts(criteria, tracks, rule_of(in)));
}

Operations two_element_operations() {
  return {
      {"conj", on_two_elements([](const json& in) { return written(conjunctive(all(in.at("masses"), binary))); })},
      {"dempster", on_two_elements([](const json& in) { return written(dempster(all(in.at("masses"), binary))); })},
      {"yager", on_two_elements(
                    [](const json& in) { return written(conflict_to_ignorance(all(in.at("masses"), binary)).mass); })},
      {"dsmc", on_two_elements([](const json& in) { return written(dsmc(all(in.at("masses"), grid))); })},
      {"discount", on_two_elements([](const json& in) {
         const double reliability = in.at("alpha");
         return in.at("model") == "shafer" ? written(discount(binary(in.at("mass")), reliability))
                                           : written(discount(grid(in.at("mass")), reliability));
       })},
      {"measures", on_two_elements(grid_measures)},
  };
}

Operations covered_operations() {
  const Operation match = [](const json& in) { return gate(in); };
  return {
      {"conj", combination<rule::Conjunctive>()},
      {"dsmc", combination<rule::Conjunctive>()},
      {"dempster", combination<rule::Dempster>()},
      {"yager", combination<rule::ConflictToIgnorance>()},
      {"dubois_prade", combination<rule::DuboisPrade>()},
      {"dsmh", combination<rule::Dsmh>()},
      {"disjunctive", combination<rule::Disjunctive>()},
      {"pcr2", combination<rule::Pcr2>()},
      {"pcr5", combination<rule::Pcr5>()},
      {"pcr6", combination<rule::Pcr6>()},
      {"fold", fold},
      {"measures", measures},
      {"discount",
       [](const json& in) { return written(discount(mass_function(frame(in), in.at("mass")), in.at("alpha"))); }},
      {"discounted_dsmc",
       [](const json& in) {
         std::vector<MassFunction> masses = mass_functions(in);
         for (std::size_t i = 0; i < masses.size(); ++i) masses[i] = discount(masses[i], in.at("p").at(i));
         return written(conjunctive(masses));
       }},
      {"segment_fusion",
       [](const json& in) -> json {
         const FusedBinaryMass fused = conflict_to_ignorance(all(in.at("masses"), binary));
         return {{"m", written(fused.mass)}, {"conflict", fused.conflict}};
       }},
      {"ramp_bpa",
       [](const json& in) {
         return written(RampBelief{.max_yes = in.at("ymax"),
                                   .yes_full_until = in.at("y0"),
                                   .yes_zero_from = in.at("y1"),
                                   .max_no = in.at("nmax"),
                                   .no_zero_until = in.at("n0"),
                                   .no_full_from = in.at("n1")}(in.at("x")));
       }},
      {"primitive_type", primitive_type},
      {"primitive_existence",
       [](const json& in) {
         return written(
             joint_existence(binary(in.at("seg1")), binary(in.at("seg2")), binary(in.at("m2prim")), rule_of(in)));
       }},
      {"wall_existence",
       [](const json& in) {
         return written(fuse({binary(in.at("seg")), binary(in.at("m2prim"))}, rule_of(in)));
       }},
      {"open_world", [](const json& in) { return open_world(in, true); }},
      {"open_world_unnormalised", [](const json& in) { return open_world(in, false); }},
      {"wall_match", match},
      {"point_match", match},
      {"alpha_discount", [](const json& in) { return written(discount_by_own_denial(binary(in.at("m1")))); }},
      {"track_init",
       [](const json& in) {
         return written(start_track(binary(in.at("m_prim")), in.at("y_match"), {.rule = rule_of(in)}));
       }},
      {"track_update",
       [](const json& in) {
         return written(
             update_track(binary(in.at("m_track")), binary(in.at("m_prim")), in.at("y_match"), {.rule = rule_of(in)}));
       }},
      {"track_miss",
       [](const json& in) { return written(miss_track(binary(in.at("m_track")), {.rule = rule_of(in)})); }},
      {"track_life", track_life},
      {"localization", localization},
  };
}

void every_operation_agrees(const Operations& operations) {
  const auto tallies = credo::testing::run_vectors(credo::testing::vectors_path(), operations);
  for (const auto& [name, operation] : operations) {
    const auto tally = tallies.find(name);
    ASSERT_NE(tally, tallies.end()) << "no case of " << name;
    EXPECT_GT(tally->second.run, 0) << name;
    EXPECT_EQ(tally->second.failed, 0) << name << ", first: " << tally->second.first_failure;
  }
}

TEST(GoldenVectors, EveryOperationAgrees) { every_operation_agrees(covered_operations()); }

TEST(GoldenVectors, TheClosedFormsOfTwoElementsAgree) { every_operation_agrees(two_element_operations()); }

TEST(GoldenVectors, ADifferenceIsFound) {
  using credo::testing::run_case;
  const json test = json::parse(R"({"id": "x", "op": "discount", "in": {"n": 2, "model": "shafer", "alpha": 0.5,
                                   "mass": {"1": 1.0}}, "out": {"1": 0.5, "1u2": 0.5000000002}})");
  const Operations operations = covered_operations();
  EXPECT_EQ(run_case(test, operations.at("discount")), std::string());
  json wrong = test;
  wrong["out"]["1u2"] = 0.500000002;
  EXPECT_NE(run_case(wrong, operations.at("discount")), std::string());
  wrong = test;
  wrong["in"]["n"] = 3;
  EXPECT_EQ(run_case(wrong, two_element_operations().at("discount")), std::nullopt);
  wrong = test;
  wrong.erase("out");
  wrong["error"] = "total_conflict";
  EXPECT_NE(run_case(wrong, operations.at("discount")), std::string());
}

TEST(GoldenVectors, AMissingFileIsNamed) {
  EXPECT_THROW(credo::testing::run_vectors("/nowhere/vectors.json", {}), std::runtime_error);
}

}  // namespace
}  // namespace credo::evidence
