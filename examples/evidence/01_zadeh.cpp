// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// Zadeh's example: two experts who are almost sure, each of something else
//
// Problem   A patient has meningitis, a concussion or a tumour. The first doctor is almost sure of meningitis, the
//           second of a concussion; both leave a hundredth to the tumour. What is to be believed? (Zadeh 1979)
//
// Symbols   M, C, T   meningitis, concussion, tumour
//           m1, m2    what the doctors believe
//           k         the conflict: mass of the products that nothing fulfils
//           r         reliability of both doctors
//
// Model     Shafer's: the patient has exactly one of the three.
//           m1(M) = 0.99   m1(T) = 0.01
//           m2(C) = 0.99   m2(T) = 0.01     k = 0.9999
//
// Shown     Every rule at once. Then Dempster's rule and the conflict moved to ignorance, where the doctors may err:
//           a reliability of 0.99 is all it takes for Dempster's rule to stop choosing the tumour.

#include <iomanip>
#include <iostream>
#include <stdexcept>

#include "evidence/conflict_to_sets.hpp"
#include "evidence/conjunctive.hpp"
#include "evidence/discounting.hpp"
#include "evidence/probability.hpp"
#include "evidence/rules.hpp"

using namespace credo::evidence;

namespace {

const Frame kIllness = Frame::shafer({"M", "C", "T"});
const MassFunction kFirst(kIllness, {{"M", 0.99}, {"T", 0.01}});
const MassFunction kSecond(kIllness, {{"C", 0.99}, {"T", 0.01}});

void print_masses(const NamedRule& rule) {
  std::cout << std::left << std::setw(14) << rule.name << std::right;
  try {
    const auto fused = rule.combine({kFirst, kSecond});
    if (!fused) {
      std::cout << "  no result at total conflict\n";
      return;
    }
    const MassFunction& m = fused->mass;
    for (const char* set : {"M", "C", "T", "M ∪ C", "M ∪ T", "C ∪ T", "Θ", "∅"})
      std::cout << std::setw(8) << m.mass(set);
    std::cout << std::setw(10) << fused->conflict << '\n';
  } catch (const std::invalid_argument& error) {
    std::cout << "  " << error.what() << '\n';
  }
}

void print_probabilities(double reliability) {
  const MassFunction first = discount(kFirst, reliability), second = discount(kSecond, reliability);
  const auto normalised = dempster({first, second});
  const Fused moved = conflict_to_ignorance({first, second});
  std::cout << std::setw(6) << reliability;
  for (const MassFunction& mass : {normalised->mass, moved.mass}) {
    for (const char* set : {"M", "C", "T"}) std::cout << std::setw(8) << pignistic(mass, kIllness.parse(set));
  }
  std::cout << std::setw(10) << moved.conflict << '\n';
}

}  // namespace

int main() {
  std::cout << std::fixed << std::setprecision(5);
  std::cout << "rule                 M       C       T     M∪C     M∪T     C∪T       Θ       ∅  conflict\n";
  for (const NamedRule& rule : all_rules()) print_masses(rule);

  std::cout << "\nBetP       Dempster's rule         conflict to ignorance\n"
            << "     r       M       C       T       M       C       T  conflict\n";
  for (const double reliability : {1.0, 0.99, 0.95, 0.9, 0.5}) print_probabilities(reliability);
}
