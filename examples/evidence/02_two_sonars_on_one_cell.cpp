// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

// Two sonars that see one cell of a map differently
//
// Problem   One sonar has an echo from the cell, another sees through it. Is the cell occupied? And does a cell that is
//           seen both ways look like one that was never seen? (The setting of Li X. 2006, 2007 and Li P.)
//
// Symbols   E, O     the cell is empty, occupied; E∩O both (the paradox), E∪O unknown
//           m1, m2   what the sonars say
//           q        commonality; a cell of a map keeps ln q(E), ln q(O), ln q(E∪O)
//
// Model     Free: E and O may overlap, as in a cell that an obstacle fills in part. Hybrid: E∩O is declared empty,
//           which leaves Shafer's model and makes the mass on E∩O conflict.
//           m1: E 0.10  O 0.60  E∩O 0.04  E∪O 0.26
//           m2: E 0.50  O 0.10  E∩O 0.04  E∪O 0.36
//
// Shown     What each rule makes of the two. Then three cells with the same probability 0.5, which Bayes' rule could
//           not tell apart and their conflict does.

#include <iomanip>
#include <iostream>
#include <string>

#include "evidence/log_commonality.hpp"
#include "evidence/measures.hpp"
#include "evidence/probability.hpp"
#include "evidence/rules.hpp"

using namespace credo::evidence;

namespace {

MassFunction sonar(const Frame& cell, double empty, double occupied) {
  return MassFunction::with_rest_unknown(cell, {{"E", empty}, {"O", occupied}, {"E ∩ O", 0.04}});
}

void print(const std::string& name, const MassFunction& mass) {
  const Proposition occupied = mass.frame().parse("O");
  std::cout << std::left << std::setw(22) << name << std::right;
  for (const char* set : {"E", "O", "E ∩ O", "E ∪ O"}) std::cout << std::setw(8) << mass.mass(set);
  std::cout << std::setw(9) << belief(mass, occupied) << std::setw(8) << pignistic(mass, occupied) << std::setw(8)
            << plausibility(mass, occupied) << '\n';
}

void print_cell(const char* name, int echoes, int see_throughs) {
  constexpr double kReliability = 0.9;
  const LogCommonality echo = log_commonality(GridMass::from(0.0, 0.6), kReliability);
  const LogCommonality see_through = log_commonality(GridMass::from(0.6, 0.0), kReliability);
  LogCommonality cell;
  for (int i = 0; i < echoes; ++i) cell += echo;
  for (int i = 0; i < see_throughs; ++i) cell += see_through;
  std::cout << std::left << std::setw(22) << name << std::right << std::setw(8) << pignistic_occupied(cell)
            << std::setw(8) << normalised_masses(cell).unknown << std::setw(10) << conflict(cell) << std::setw(11)
            << contested(cell) << '\n';
}

}  // namespace

int main() {
  const std::string exclusive[] = {"E ∩ O"};
  const Frame free = Frame::free_dsm({"E", "O"}), hybrid = Frame::hybrid({"E", "O"}, exclusive);

  std::cout << std::fixed << std::setprecision(3);
  std::cout << "                             E       O     E∩O     E∪O   Bel(O) BetP(O)   Pl(O)\n";
  print("free    m1", sonar(free, 0.10, 0.60));
  print("free    m2", sonar(free, 0.50, 0.10));
  print("free    conjunctive", rule::Conjunctive::combine({sonar(free, 0.10, 0.60), sonar(free, 0.50, 0.10)})->mass);
  for (const char* name : {"conjunctive", "dempster", "yager", "dsmh", "pcr2", "pcr5"}) {
    const auto fused = rule_named(name).combine({sonar(hybrid, 0.10, 0.60), sonar(hybrid, 0.50, 0.10)});
    print(std::string("hybrid  ") + name, fused->mass);
  }

  std::cout << "\n                       BetP(O) unknown  conflict  contested\n";
  print_cell("never seen", 0, 0);
  print_cell("once each way", 1, 1);
  print_cell("eight times each way", 8, 8);
  print_cell("only echoes, eight", 8, 0);
}
