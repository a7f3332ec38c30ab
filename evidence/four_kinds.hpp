// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <array>
#include <span>

#include "evidence/binary_mass.hpp"

namespace credo::evidence {

/// Masses on a frame of four exclusive kinds: three regular ones (0, 1, 2) and "other" (3). Only the focal sets that
/// two complementary criteria can leave (Clerentin et al., sec. 3.2): they never conflict. The masses sum to 1. The
/// caller gives the kinds their meaning: corner, edge, wall, other.
struct FourKindMass {
  std::array<double, 3> one{};           ///< m({i})
  std::array<double, 3> one_or_other{};  ///< m({i, other})
  double other = 0.0;                    ///< m({other})
  double regular = 0.0;                  ///< m({0, 1, 2})
  double unknown = 1.0;
};

/// First criterion: which of the regular kinds it would be, if it is one. m({i, other}), i = 0 .. 2; the rest is
/// ignorance.
struct WhichKind {
  std::array<double, 3> one_or_other{};
  double unknown = 1.0;
};

/// Second criterion: whether it is regular at all. m({0, 1, 2}), m({other}); the rest is ignorance.
struct WhetherRegular {
  double regular = 0.0;
  double other = 0.0;
  double unknown = 1.0;
};

/// Breakpoints of the first criterion, in the caller's unit. \see which_kind
struct WhichKindParams {
  double committed = 0.9;         ///< mass that is not ignorance
  double level_until = 10.0;      ///< |deviation| up to which it is kind 2 alone
  double level_zero_from = 25.0;  ///< |deviation| from which it is kind 0 or 1 alone
};

/// Breakpoints of the second criterion, in the caller's unit. \see whether_regular
struct WhetherRegularParams {
  double committed = 0.9;
  double regular_until = 0.05;
  double other_from = 0.20;
};

/// Kind 0 for a deviation well below zero, kind 1 well above, kind 2 about zero; linear between, in complementary
/// shares; nan is ignorance. For junctions: the interior angle on the robot's side minus 180 degrees -> corner, edge,
/// wall.
[[nodiscard]] WhichKind which_kind(double deviation, const WhichKindParams& params = {});

/// Regular for a small gap, other for a large one; nan is ignorance. For junctions: the distance between the ends of
/// the two segments.
[[nodiscard]] WhetherRegular whether_regular(double gap, const WhetherRegularParams& params = {});

/// The two criteria together; no intersection is empty, so all rules agree.
[[nodiscard]] FourKindMass combine(const WhichKind& which, const WhetherRegular& whether);

/// The kind (0 .. 3) that is believed most (belief of the singletons); equal ones, to 1e-12, go to the lowest.
[[nodiscard]] int most_believed(const FourKindMass& mass);

/// Belief and plausibility of one kind as a mass on {YES, NO}: yes = Bel, no = 1 - Pl, unknown = Pl - Bel.
/// \param kind  0 .. 3
[[nodiscard]] BinaryMass belief_in_kind(const FourKindMass& mass, int kind);

}  // namespace credo::evidence
