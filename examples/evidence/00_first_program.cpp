// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <iostream>

#include "evidence/conjunctive.hpp"
#include "evidence/mass_function.hpp"
#include "evidence/measures.hpp"
#include "evidence/probability.hpp"

using namespace credo::evidence;

int main() {
  const Frame weather = Frame::shafer({"sun", "rain", "snow"});
  const MassFunction barometer(weather, {{"rain ∪ snow", 0.7}, {"Θ", 0.3}});   // bad weather, and no more than that
  const MassFunction thermometer(weather, {{"sun ∪ rain", 0.8}, {"Θ", 0.2}});  // too warm for snow

  const auto fused = dempster({barometer, thermometer});
  if (!fused) return 1;  // total conflict: the rule has no result, and says so by its type
  const Proposition rain = weather.parse("rain");
  std::cout << fused->mass << "\nconflict " << fused->conflict << "\nrain: Bel " << belief(fused->mass, rain)
            << ", BetP " << pignistic(fused->mass, rain) << ", Pl " << plausibility(fused->mass, rain) << '\n';
}
