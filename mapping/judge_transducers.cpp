// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/judge_transducers.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace credo::mapping {
namespace {

using evidence::FixedLogCommonality;
using grids::EvidentialGrid;

constexpr double kSurely = 1e-6;  // keeps odds finite
constexpr double kDoubted = 0.5;  // a reliability below is worth telling

/// The sweeps with the ranges of one transducer alone.
std::vector<sensors::SonarSweep> alone(std::span<const sensors::SonarSweep> sweeps, int ring, std::size_t transducer) {
  std::vector<sensors::SonarSweep> result;
  for (const sensors::SonarSweep& sweep : sweeps) {
    if (sweep.sensor != ring) continue;
    result.push_back(sweep);
    std::vector<float>& ranges_m = result.back().ranges_m;
    for (std::size_t i = 0; i < ranges_m.size(); ++i)
      if (i != transducer) ranges_m[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return result;
}

/// A sum of evidence, and how much of it is contradicted.
struct Opposed {
  double contradicted = 0.0, judged = 0.0;

  void add(double evidence, double mass_for, double mass_against) {
    contradicted += evidence * mass_against;
    judged += evidence * (mass_for + mass_against);
  }
  [[nodiscard]] double share() const { return judged > 0.0 ? contradicted / judged : 0.0; }
};

/// Fills in how far a transducer's contribution is opposed by the rest of the map that holds it.
void judge(TransducerVerdict& verdict, const EvidentialGrid& own, const EvidentialGrid& all) {
  Opposed occupied, empty;
  for (const auto& [index, tile] : own.tiles()) {
    for (int place = 0; place < grids::Tile::kCells; ++place) {
      const FixedLogCommonality said{tile.empty[place], tile.occupied[place], tile.unknown[place]};
      if (said == FixedLogCommonality{}) continue;
      const FixedLogCommonality others = all.at(grids::cell_of(index, place)) - said;
      if (others == FixedLogCommonality{}) continue;
      ++verdict.cells;
      const evidence::GridMass mass = evidence::normalised_masses(others.value());
      occupied.add(std::max(0.0, evidence::evidence_for_occupied(said.value())), mass.occupied, mass.empty);
      empty.add(std::max(0.0, evidence::evidence_for_empty(said.value())), mass.empty, mass.occupied);
    }
  }
  verdict.opposed = 0.5 * (occupied.share() + empty.share());
}

double odds_of_being_right(double opposed) {
  const double right = std::clamp(1.0 - opposed, kSurely, 1.0 - kSurely);
  return right / (1.0 - right);
}

void set_reliabilities(std::vector<TransducerVerdict>& verdicts) {
  std::vector<double> odds;
  for (const TransducerVerdict& verdict : verdicts)
    if (verdict.cells > 0) odds.push_back(odds_of_being_right(verdict.opposed));
  if (odds.empty()) return;
  const auto middle = odds.begin() + static_cast<std::ptrdiff_t>(odds.size() / 2);
  std::nth_element(odds.begin(), middle, odds.end());
  for (TransducerVerdict& verdict : verdicts)
    if (verdict.cells > 0) verdict.reliability = std::min(1.0, odds_of_being_right(verdict.opposed) / *middle);
}

}  // namespace

std::vector<TransducerVerdict> judge_transducers(const sensors::MotionPath& T_map_base, const sensors::Rig& rig,
                                                 std::span<const sensors::SonarSweep> sweeps,
                                                 const TrajectoryMappingParams& params) {
  TrajectoryMappingParams unweighted = params;
  unweighted.mapper.sensors = {};
  std::vector<TransducerVerdict> verdicts;
  std::vector<EvidentialGrid> contributions;
  EvidentialGrid all(params.mapper.georeference);
  for (std::size_t ring = 0; ring < rig.sonar_rings.size(); ++ring)
    for (std::size_t i = 0; i < rig.sonar_rings[ring].T_base_transducer.size(); ++i) {
      const auto number = static_cast<int>(ring);
      TrajectoryMap own = map_along(T_map_base, rig, {}, alone(sweeps, number, i), unweighted);
      verdicts.push_back(
          {.ring = number, .transducer = static_cast<int>(i), .readings = own.counts.echoes + own.counts.no_returns});
      all.merge(own.grid);
      contributions.push_back(std::move(own.grid));
    }
  for (std::size_t i = 0; i < verdicts.size(); ++i) judge(verdicts[i], contributions[i], all);
  set_reliabilities(verdicts);
  return verdicts;
}

std::vector<double> reliabilities(std::span<const TransducerVerdict> verdicts) {
  std::vector<double> result;
  for (const TransducerVerdict& verdict : verdicts) result.push_back(verdict.reliability);
  return result;
}

std::string summary(std::span<const TransducerVerdict> verdicts) {
  if (verdicts.empty()) return "no transducer";
  const auto worst = std::min_element(verdicts.begin(), verdicts.end(),
                                      [](const auto& a, const auto& b) { return a.reliability < b.reliability; });
  const auto doubted = std::count_if(verdicts.begin(), verdicts.end(),
                                     [](const auto& verdict) { return verdict.reliability < kDoubted; });
  char text[160];
  std::snprintf(text, sizeof text,
                "%td of %zu transducers doubted; least reliable: transducer %d of ring %d, %.2f (%.0f %% opposed)",
                doubted, verdicts.size(), worst->transducer, worst->ring, worst->reliability, 100.0 * worst->opposed);
  return text;
}

}  // namespace credo::mapping
