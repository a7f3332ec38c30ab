// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// Five sensors on one obstacle, one of them lies
//
// Problem   Four sensors take the obstacle for a car, with different care; the fifth is broken and quite sure of a
//           person. What is to be believed, and who is it that lies?
//
// Symbols   m1 .. m5   what the sensors say
//           k(i, j)    conflict of two sensors under the conjunctive rule
//           d(i, j)    Jousselme's distance of two sensors
//           r          reliability
//
// Model     Shafer's frame {car, bike, person}. The fifth leaves a thousandth to ignorance; without it, it would have a
//           veto under Dempster's rule, and the cautious rule would refuse it.
//
// Shown     The rules on all five: those that look for agreement (Dempster, cautious) follow the liar, as it leaves
//           nothing open; PCR6 and conflict to ignorance leave it just ahead; only the averages do not. Then who it
//           is: the one that is far from all others. Known and discounted, it no longer harms Dempster's rule.

#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

#include "evidence/discounting.hpp"
#include "evidence/measures.hpp"
#include "evidence/probability.hpp"
#include "evidence/rules.hpp"

using namespace credo::evidence;

namespace {

const Frame kObstacle = Frame::shafer({"car", "bike", "person"});

std::vector<MassFunction> sensors() {
  return {MassFunction(kObstacle, {{"car", 0.6}, {"car ∪ bike", 0.2}, {"Θ", 0.2}}),
          MassFunction(kObstacle, {{"car", 0.5}, {"bike", 0.1}, {"Θ", 0.4}}),
          MassFunction(kObstacle, {{"car ∪ bike", 0.7}, {"Θ", 0.3}}),
          MassFunction(kObstacle, {{"car", 0.4}, {"person", 0.1}, {"Θ", 0.5}}),
          MassFunction(kObstacle, {{"person", 0.999}, {"Θ", 0.001}})};
}

void print(const std::string& name, const std::optional<Fused>& fused) {
  std::cout << std::left << std::setw(32) << name << std::right;
  for (const double probability : pignistic_regions(fused->mass)) std::cout << std::setw(8) << probability;
  std::cout << std::setw(10) << fused->conflict << '\n';
}

template <typename Measure>
double mean_to_others(const std::vector<MassFunction>& all, std::size_t i, Measure measure) {
  double sum = 0.0;
  for (std::size_t j = 0; j < all.size(); ++j) sum += j == i ? 0.0 : measure(all[i], all[j]);
  return sum / static_cast<double>(all.size() - 1);
}

}  // namespace

int main() {
  const std::vector<MassFunction> all = sensors();
  std::cout << std::fixed << std::setprecision(3);
  std::cout << "BetP                                 car    bike  person  conflict\n";
  for (const char* name : {"dempster", "yager", "pcr6", "average", "murphy", "cautious"}) {
    print(name, rule_named(name).combine(all));
  }

  std::cout << "\nwho lies: means to the other four\nsensor  conflict  distance\n";
  std::vector<MassFunction> by_distance;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double conflict = mean_to_others(all, i, conflict_between);
    const double distance = mean_to_others(all, i, jousselme_distance);
    by_distance.push_back(discount(all[i], 1.0 - distance));
    std::cout << std::setw(6) << i + 1 << std::setw(10) << conflict << std::setw(10) << distance << '\n';
  }

  std::vector<MassFunction> liar_discounted = all, liar_in_context = all;
  liar_discounted[4] = discount(all[4], 0.1);
  const double blind_to_cars[] = {0.1, 1.0, 1.0};  // what it says of a car is worth a tenth, else it is believed
  liar_in_context[4] = contextual_discount(all[4], blind_to_cars);
  std::cout << "\nBetP, Dempster's rule                car    bike  person  conflict\n";
  print("all by 1 - their distance", rule::Dempster::combine(by_distance));
  print("the fifth by r = 0.1", rule::Dempster::combine(liar_discounted));
  print("the fifth by r(car) = 0.1", rule::Dempster::combine(liar_in_context));
  print("without the fifth", rule::Dempster::combine(std::span(all).first(4)));
}
