// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "localization/localizer.hpp"
#include "perception/criteria.hpp"

namespace credo::localization {
namespace {

using evidence::RampBelief;

/// The same belief on -x.
RampBelief mirrored(const RampBelief& s) {
  return {.max_yes = s.max_yes,
          .yes_full_until = -s.yes_full_until,
          .yes_zero_from = -s.yes_zero_from,
          .max_no = s.max_no,
          .no_zero_until = -s.no_zero_until,
          .no_full_from = -s.no_full_from};
}

bool same_belief(const RampBelief& a, const RampBelief& b) {
  for (double x = -50.0; x <= 50.0; x += 0.001) {
    const evidence::BinaryMass in_a = a(x), in_b = b(x);
    if (std::abs(in_a.yes - in_b.yes) > 1e-12 || std::abs(in_a.no - in_b.no) > 1e-12) return false;
  }
  return true;
}

struct Shape {
  const char* criterion;
  RampBelief used;
  RampBelief published;  ///< docs/equations.md, x growing with what is bad
};

TEST(PaperMethod, ItsBreakpointsAreThoseOfTheEquations) {
  const MapMatchingParams matching;
  const LocalizationBeliefParams belief;
  const perception::CriteriaParams criteria = perception::CriteriaParams::paper();
  const std::vector<Shape> shapes{{"wall angle [deg]", matching.paper_wall_angle_deg, {.9, 0, 10, .9, 10, 25}},
                                  {"wall length [m]", matching.paper_wall_length_m, {.6, 0, .5, .4, .5, 2}},
                                  {"wall centre [m]", matching.paper_wall_center_m, {.8, 0, .5, .8, .5, 1.5}},
                                  {"point range [m]", matching.paper_point_range_m, {.8, 0, .3, .8, .3, .8}},
                                  {"point azimuth [deg]", matching.paper_point_azimuth_deg, {.8, 0, 5, .8, 5, 12}},
                                  {"tracking [deg]", tracking::AssociationParams{}.azimuth_deg, {.9, 0, 5, .9, 5, 10}},
                                  {"alignment [m]", criteria.alignment, {.7, .01, .04, .4, .03, .08}},
                                  {"support", mirrored(criteria.support), {0, 0, 1, .6, -8, -3}},
                                  {"density [1/m]", mirrored(criteria.density), {.6, -20, -5, .3, -8, -3}},
                                  {"grey levels", criteria.gray, {.5, 5, 15, .4, 10, 40}},
                                  {"count", mirrored(belief.count), {.8, -6, -2, .6, -3, -1}},
                                  {"ratio", mirrored(belief.ratio), {.8, -.8, -.4, .6, -.5, -.2}}};
  for (const Shape& shape : shapes) EXPECT_TRUE(same_belief(shape.used, shape.published)) << shape.criterion;
}

}  // namespace
}  // namespace credo::localization
