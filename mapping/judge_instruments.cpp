// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/judge_instruments.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace credo::mapping {
namespace {

using evidence::FixedLogCommonality;
using grids::EvidentialGrid;

constexpr double kSurely = 1e-6;  // keeps odds finite
constexpr double kDoubted = 0.5;  // a reliability below is worth telling

/// A sum of evidence, how much of it is judged, and how much contradicted.
struct Opposed {
  double said = 0.0, judged = 0.0, contradicted = 0.0;

  void add(double evidence, double mass_for, double mass_against) {
    said += evidence;
    contradicted += evidence * mass_against;
    judged += evidence * (mass_for + mass_against);
  }
  [[nodiscard]] double share() const { return judged > 0.0 ? contradicted / judged : 0.0; }
};

/// How far an instrument's contribution is opposed by the rest of the map that holds it.
InstrumentVerdict judge(const InstrumentMap& own, const EvidentialGrid& all) {
  InstrumentVerdict verdict{.instrument = own.instrument, .readings = own.readings};
  Opposed occupied, empty;
  for (const auto& [index, tile] : own.grid.tiles()) {
    for (int place = 0; place < grids::Tile::kCells; ++place) {
      const FixedLogCommonality said{tile.empty[place], tile.occupied[place], tile.unknown[place]};
      if (said == FixedLogCommonality{}) continue;
      const FixedLogCommonality others = all.at(grids::cell_of(index, place)) - said;
      if (others != FixedLogCommonality{}) ++verdict.cells;
      const evidence::GridMass mass = evidence::normalised_masses(others.value());
      occupied.add(std::max(0.0, evidence::evidence_for_occupied(said.value())), mass.occupied, mass.empty);
      empty.add(std::max(0.0, evidence::evidence_for_empty(said.value())), mass.empty, mass.occupied);
    }
  }
  verdict.opposed = 0.5 * (occupied.share() + empty.share());
  const double said = occupied.said + empty.said;
  verdict.judged = said > 0.0 ? own.sweeps * (occupied.judged + empty.judged) / said : 0.0;
  return verdict;
}

double odds_of_being_right(double opposed) {
  const double right = std::clamp(1.0 - opposed, kSurely, 1.0 - kSurely);
  return right / (1.0 - right);
}

/// Of the instruments of one kind: each against the median, and drawn towards full trust where little was judged.
void set_reliabilities(std::vector<InstrumentVerdict>& verdicts, bool sonar) {
  const auto counts = [&](const InstrumentVerdict& verdict) {
    return verdict.cells > 0 && verdict.instrument.is_sonar() == sonar;
  };
  std::vector<double> odds;
  for (const InstrumentVerdict& verdict : verdicts)
    if (counts(verdict)) odds.push_back(odds_of_being_right(verdict.opposed));
  if (odds.empty()) return;
  const auto middle = odds.begin() + static_cast<std::ptrdiff_t>(odds.size() / 2);
  std::nth_element(odds.begin(), middle, odds.end());
  for (InstrumentVerdict& verdict : verdicts)
    if (counts(verdict)) {
      const double seen = std::min(1.0, odds_of_being_right(verdict.opposed) / *middle);
      verdict.reliability = (kTrustedSweeps + verdict.judged * seen) / (kTrustedSweeps + verdict.judged);
    }
}

}  // namespace

std::vector<InstrumentVerdict> judge_instruments(std::span<const InstrumentMap> maps, const EvidentialGrid& sum) {
  std::vector<InstrumentVerdict> verdicts;
  for (const InstrumentMap& map : maps) verdicts.push_back(judge(map, sum));
  for (const bool sonar : {false, true}) set_reliabilities(verdicts, sonar);
  return verdicts;
}

SensorReliabilityParams reliabilities(std::span<const InstrumentVerdict> verdicts, const sensors::Rig& rig) {
  SensorReliabilityParams result;
  result.range_finders.assign(rig.range_finders.size(), 1.0);
  std::vector<std::size_t> first;  // of each ring
  for (const sensors::SonarRing& ring : rig.sonar_rings) {
    first.push_back(result.transducers.size());
    result.transducers.resize(result.transducers.size() + ring.T_base_transducer.size(), 1.0);
  }
  for (const InstrumentVerdict& verdict : verdicts) {
    const Instrument& which = verdict.instrument;
    double& place =
        which.is_sonar()
            ? result
                  .transducers[first[static_cast<std::size_t>(which.ring)] + static_cast<std::size_t>(which.transducer)]
            : result.range_finders[static_cast<std::size_t>(which.finder)];
    place = verdict.reliability;
  }
  return result;
}

std::string summary(std::span<const InstrumentVerdict> verdicts) {
  if (verdicts.empty()) return "no instrument";
  const auto worst = std::ranges::min_element(verdicts, [](const auto& a, const auto& b) {
    return std::pair(a.reliability, -a.opposed) < std::pair(b.reliability, -b.opposed);
  });
  const auto doubted =
      std::ranges::count_if(verdicts, [](const auto& verdict) { return verdict.reliability < kDoubted; });
  char text[160];
  std::snprintf(text, sizeof text, "%td of %zu instruments doubted; least reliable: %s, %.2f (%.0f %% opposed)",
                doubted, verdicts.size(), worst->instrument.name().c_str(), worst->reliability, 100.0 * worst->opposed);
  return text;
}

}  // namespace credo::mapping
