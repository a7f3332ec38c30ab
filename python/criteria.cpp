// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <optional>

#include "evidence/gated_match.hpp"
#include "evidence/joint_existence.hpp"
#include "evidence/track_belief.hpp"
#include "evidence/whole_belief.hpp"
#include "python/bindings.hpp"

namespace credo::python {
namespace {

using evidence::BinaryMass;
using evidence::FusedBinaryMass;
using evidence::FusionRule;
using evidence::GatedMatch;
using evidence::Part;
using evidence::TrackBelief;
using evidence::TrackBeliefParams;

constexpr std::array<std::pair<std::string_view, FusionRule>, 2> kFusionRules{
    {{"dempster", FusionRule::kDempster}, {"yager", FusionRule::kConflictToIgnorance}}};

FusionRule fusion_rule(const std::string& word) { return chosen(word, "rule", kFusionRules); }

GatedMatch matched(const py::args& criteria, double max_conflict) {
  const std::vector<BinaryMass> masses = sources_of<BinaryMass>(listed(criteria), "BinaryMass");
  return evidence::gated_match(masses, max_conflict);
}

BinaryMass support(double match_yes) {
  if (!(match_yes >= 0.0 && match_yes <= 1.0)) {
    throw std::invalid_argument("match_yes must be in [0, 1]; got " + std::to_string(match_yes));
  }
  return evidence::match_support(match_yes);
}

std::optional<TrackBelief> started(const BinaryMass& observation, double match_yes, const std::string& rule) {
  return evidence::start_track(observation, support(match_yes).yes, {.rule = fusion_rule(rule)});
}

std::optional<TrackBelief> continued(const BinaryMass& track, const BinaryMass& observation, double match_yes,
                                     const std::string& rule) {
  return evidence::update_track(track, observation, support(match_yes).yes, {.rule = fusion_rule(rule)});
}

std::optional<TrackBelief> missed(const BinaryMass& track, const std::optional<BinaryMass>& miss,
                                  const std::string& rule) {
  return evidence::miss_track(track, {.rule = fusion_rule(rule), .miss = miss.value_or(TrackBeliefParams{}.miss)});
}

std::vector<Part> parts_from(const std::vector<std::pair<BinaryMass, double>>& pairs) {
  std::vector<Part> parts;
  for (const auto& [mass, reliability] : pairs) parts.push_back({mass, checked_reliability(reliability)});
  return parts;
}

void bind_match(py::module_& module) {
  py::class_<GatedMatch>(module, "GatedMatch", "Whether two things are the same; unpacks into mass and match.")
      .def_readonly("mass", &GatedMatch::mass, "What the criteria say together, an OpenBinaryMass.")
      .def_readonly("match", &GatedMatch::match, "Little enough conflict, and YES above NO.")
      .def("__iter__", [](const GatedMatch& self) { return py::iter(py::make_tuple(self.mass, self.match)); })
      .def("__repr__", [](const GatedMatch& self) {
        return record("GatedMatch", {{"mass", py::cast(self.mass)}, {"match", py::cast(self.match)}});
      });
  module.def("gated_match", matched, py::arg("max_conflict") = evidence::kMaxMatchConflict,
             R"(gated_match(*criteria, max_conflict=0.7)
--

BinaryMasses that are left in conflict (TBM): a match where the conflict is at most max_conflict and YES is above NO
(Clerentin et al., sec. 4.2).)");
}

void bind_tracks(py::module_& module) {
  py::class_<TrackBelief>(module, "TrackBelief", "Belief that a track follows something real.")
      .def_readonly("mass", &TrackBelief::mass, "A BinaryMass.")
      .def_readonly("conflict", &TrackBelief::conflict, "Met in this step.")
      .def_readonly("keep", &TrackBelief::keep, "False where NO exceeds YES: drop the track.")
      .def("__repr__", [](const TrackBelief& self) {
        return record(
            "TrackBelief",
            {{"mass", py::cast(self.mass)}, {"conflict", py::cast(self.conflict)}, {"keep", py::cast(self.keep)}});
      });
  module.def("discount_by_own_denial", evidence::discount_by_own_denial, py::arg("observation"),
             R"(discount_by_own_denial(observation)
--

An observation that denies itself, discounted by the reliability 1 - m(NO); one without any YES is kept as it is
(Clerentin et al., sec. 4.4).)");
  module.def("match_support", support, py::arg("match_yes"),
             "match_support(match_yes)\n--\n\nWhat a match contributes to a track: its YES in [0, 1], never NO.");
  module.def("start_track", started, py::arg("observation"), py::arg("match_yes"), py::arg("rule") = "yager",
             R"(start_track(observation, match_yes, rule='yager')
--

A new track, a TrackBelief: discount_by_own_denial(observation) and match_support(match_yes). rule: "yager", with which
no track outlives six misses, or "dempster", which gives None at total conflict.)");
  module.def("update_track", continued, py::arg("track"), py::arg("observation"), py::arg("match_yes"),
             py::arg("rule") = "yager", R"(update_track(track, observation, match_yes, rule='yager')
--

A track that was matched: the same two and its mass so far, all at once.)");
  module.def("miss_track", missed, py::arg("track"), py::arg("miss") = py::none(), py::arg("rule") = "yager",
             R"(miss_track(track, miss=None, rule='yager')
--

A track that matched nothing. miss: what that says; None for BinaryMass(no=0.2) (Clerentin et al., sec. 4.4).

>>> track = start_track(BinaryMass(yes=0.8), match_yes=0.7).mass
>>> track, misses = miss_track(track), 1
>>> while track.keep: track, misses = miss_track(track.mass), misses + 1
>>> misses
6)");
}

void bind_wholes(py::module_& module) {
  using Pairs = std::vector<std::pair<BinaryMass, double>>;
  module.def(
      "whole_from_all_parts",
      [](const std::vector<BinaryMass>& criteria, const Pairs& parts, const std::string& rule) {
        return evidence::whole_from_all_parts(criteria, parts_from(parts), fusion_rule(rule));
      },
      py::arg("criteria"), py::arg("parts"), py::arg("rule"), R"(whole_from_all_parts(criteria, parts, rule)
--

Belief in a whole from criteria of its own and from its parts, pairs of a BinaryMass and its reliability in [0, 1], all
combined at once (Clerentin et al., sec. 4.5). rule: "dempster", which saturates with many parts and gives None at total
conflict, or "yager", which falls with their number.)");
  module.def(
      "whole_from_mean_part",
      [](const std::vector<BinaryMass>& criteria, const Pairs& parts) {
        return evidence::whole_from_mean_part(criteria, parts_from(parts));
      },
      py::arg("criteria"), py::arg("parts"), R"(whole_from_mean_part(criteria, parts)
--

The same with the mean of the discounted parts, conflict to ignorance: does not depend on the number of equal parts.)");
  module.def(
      "mean_part", [](const Pairs& parts) { return evidence::mean_part(parts_from(parts)); }, py::arg("parts"),
      "mean_part(parts)\n--\n\nThe mean of the discounted parts, a BinaryMass; vacuous without parts.");
  module.def(
      "joint_existence",
      [](const BinaryMass& a, const BinaryMass& b, const BinaryMass& kind, const std::string& rule) {
        return evidence::joint_existence(a, b, kind, fusion_rule(rule));
      },
      py::arg("part_a"), py::arg("part_b"), py::arg("kind"), py::arg("rule"),
      R"(joint_existence(part_a, part_b, kind, rule)
--

Belief in what rests on two parts and on a judgement of its kind: rule(rule(part_a, part_b), kind) (Clerentin et al.,
sec. 3.2). rule: "dempster", which gives None at total conflict, or "yager".)");
}

}  // namespace

void bind_criteria(py::module_& module) {
  bind_match(module);
  bind_tracks(module);
  bind_wholes(module);
}

}  // namespace credo::python
