// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/sensor_reliability.hpp"

#include <stdexcept>
#include <string>

namespace credo::mapping {
namespace {

/// All 1 where none is given.
std::vector<double> checked(const std::vector<double>& given, std::size_t expected, const std::string& what) {
  if (given.empty()) return std::vector<double>(expected, 1.0);
  if (given.size() != expected)
    throw std::invalid_argument("the rig has " + std::to_string(expected) + ' ' + what + ", but " +
                                std::to_string(given.size()) + " reliabilities are given: expected one for each");
  for (const double reliability : given)
    if (!(reliability >= 0.0 && reliability <= 1.0))
      throw std::invalid_argument("a reliability of the " + what + " must be in [0, 1], not " +
                                  std::to_string(reliability));
  return given;
}

}  // namespace

SensorReliability::SensorReliability(const sensors::Rig& rig, const SensorReliabilityParams& params)
    : finders_(checked(params.range_finders, rig.range_finders.size(), "range finders")) {
  std::size_t transducers = 0;
  for (const sensors::SonarRing& ring : rig.sonar_rings) transducers += ring.T_base_transducer.size();
  const std::vector<double> all = checked(params.transducers, transducers, "transducers");
  auto next = all.begin();
  for (const sensors::SonarRing& ring : rig.sonar_rings) {
    const auto end = next + static_cast<std::ptrdiff_t>(ring.T_base_transducer.size());
    rings_.emplace_back(next, end);
    next = end;
  }
}

}  // namespace credo::mapping
