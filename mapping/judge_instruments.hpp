// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mapping/instrument_maps.hpp"

namespace credo::mapping {

/// What the others say of an instrument.
struct InstrumentVerdict {
  Instrument instrument;
  std::int64_t readings = 0;  ///< of it that were mapped
  std::int64_t cells = 0;     ///< that it speaks of, and others do
  double opposed = 0.0;      ///< share of its evidence that the others contradict, in [0, 1]; 0 where nothing is shared
  double judged = 0.0;       ///< sweeps or scans, new ones, that the others could judge: by the share of its evidence
  double reliability = 1.0;  ///< that it deserves, in [0, 1]

  friend bool operator==(const InstrumentVerdict&, const InstrumentVerdict&) = default;
};

/// Sweeps or scans in order that full trust is worth before any is judged: on fewer than these nobody is doubted, i.e.
/// has a reliability below 1/2.
inline constexpr double kTrustedSweeps = 5.0;

/// Judges each range finder and each sonar transducer by its conflict with what all others have said of the same
/// cells: the map is a sum, so that an instrument's own contribution is taken out of it exactly. Its evidence for
/// "occupied" is opposed by the mass of "empty" that the others leave after Dempster's rule, its evidence for "empty"
/// by that of "occupied"; `opposed` is the mean of the two shares, each over the cells that the others decide, so that
/// the many empty cells do not hide a few false walls. Instruments in order contradict each other, too, where cones
/// reach round corners; what is seen of the reliability is therefore the odds of being right against those of the
/// median instrument of the same kind, 1 at most. A few sweeps show little, however many cells they fill: these share
/// one cone's error, or the others'. So what n judged sweeps show is averaged with kTrustedSweeps sweeps of full trust:
/// reliability = (kTrustedSweeps + n seen) / (kTrustedSweeps + n). Of two range finders that contradict each other
/// neither can be told to be right but by how much it says; a single one, beside sonar, is told how far it is opposed,
/// and keeps its trust.
/// \param maps  of the drive, from poses that all share
/// \param sum   of all of them, merged
/// \returns one for each of the maps, in their order
[[nodiscard]] std::vector<InstrumentVerdict> judge_instruments(std::span<const InstrumentMap> maps,
                                                               const grids::EvidentialGrid& sum);

/// The verdicts as the mapper takes them.
[[nodiscard]] SensorReliabilityParams reliabilities(std::span<const InstrumentVerdict> verdicts,
                                                    const sensors::Rig& rig);

/// One line for a person: how many instruments are doubted, and the one that is most.
[[nodiscard]] std::string summary(std::span<const InstrumentVerdict> verdicts);

}  // namespace credo::mapping
