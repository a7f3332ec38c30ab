// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "mapping/sonar_choice.hpp"

#include <array>
#include <stdexcept>
#include <string>

namespace credo::mapping {
namespace {

// In the order of SonarParams.
constexpr std::array<std::string_view, 7> kNames{"li2007", "li2006", "lip", "su", "zhu", "bayes", "calibrated"};
static_assert(kNames.size() == std::variant_size_v<SonarParams>);

struct Maker {
  const sensors::SonarRing& ring;

  AnySonarModel operator()(const Li2007Params& p) const { return AnySonarModel(Li2007(ring, p)); }
  AnySonarModel operator()(const Li2006SonarParams& p) const { return AnySonarModel(Li2006Sonar(ring, p)); }
  AnySonarModel operator()(const LiPParams& p) const { return AnySonarModel(LiPSonar(ring, p)); }
  AnySonarModel operator()(const SuParams& p) const { return AnySonarModel(SuSonar(ring, p)); }
  AnySonarModel operator()(const ZhuParams& p) const { return AnySonarModel(ZhuSonar(ring, p)); }
  AnySonarModel operator()(const BayesSonarParams& p) const { return AnySonarModel(BayesSonar(ring, p)); }
  AnySonarModel operator()(const CalibratedSonarParams& p) const { return AnySonarModel(CalibratedSonar(ring, p)); }
};

}  // namespace

AnySonarModel sonar_model(const sensors::SonarRing& ring, const SonarParams& params) {
  return std::visit(Maker{ring}, params);
}

std::string_view name_of(const SonarParams& params) { return kNames[params.index()]; }

std::span<const std::string_view> sonar_model_names() { return kNames; }

SonarParams sonar_params(std::string_view name, double resolution_m) {
  if (name == "li2007") return Li2007Params{};
  if (name == "li2006") return Li2006SonarParams{};
  if (name == "lip") return LiPParams{};
  if (name == "su") return SuParams{.unit_m = resolution_m};
  if (name == "zhu") return ZhuParams{.cell_m = resolution_m};
  if (name == "bayes") return BayesSonarParams{};
  if (name == "calibrated") return CalibratedSonarParams{};
  throw std::invalid_argument("no sonar model is called '" + std::string(name) +
                              "': expected li2007, li2006, lip, su, zhu, bayes or calibrated");
}

}  // namespace credo::mapping
