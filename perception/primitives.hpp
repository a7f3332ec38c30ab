// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>

#include "evidence/belief_shapes.hpp"
#include "evidence/binary_mass.hpp"
#include "evidence/four_kinds.hpp"
#include "perception/cooperation.hpp"
#include "perception/fused_segments.hpp"

namespace credo::perception {

/// What makes a corner, an edge, a wall or another landmark, and how far it is believed (Clerentin et al., sec. 3.2).
struct PrimitiveParams {
  // First criterion: the interior angle's deviation from 180 degrees. Up to level_until a wall goes on, from level_zero
  // it does not; from turn_from it is a corner or an edge: between, a chain of faces may be a curve.
  double angle_committed = 0.9;
  double level_until_rad = 0.1745;
  double level_zero_rad = 0.4363;
  double turn_zero_rad = 0.4363;
  double turn_from_rad = 0.7854;
  double angle_sigma_good_rad = 0.14;  ///< an angle known better than this counts in full,
  double angle_sigma_bad_rad = 0.52;   ///< one known worse than this not at all
  // Second criterion: the distance between the ends, in expected standard deviations.
  evidence::WhetherRegularParams joined{.committed = 0.9, .regular_until = 3.0, .other_from = 6.0};
  // An end with something farther beside it: one face of an edge. How far the jump speaks for it, in expected standard
  // deviations of the two ranges' difference.
  double free_end_committed = 0.6;
  double open_end_committed = 0.3;  ///< the same for an end beside which nothing came back
  double free_end_none_sigmas = 3.0;
  double free_end_full_sigmas = 9.0;
  double least_believed = 0.1;  ///< Cr of the type of a junction, at least
  int free_end_support = 4;     ///< points, at least, of the face that ends there
  double free_end_sine = 0.17;  ///< of the angle between beam and face, at least
  // A radial line without a segment: belief from the line itself.
  evidence::RampBelief line_support{.max_yes = 0.5,
                                    .yes_full_until = 0.7,
                                    .yes_zero_from = 0.2,
                                    .max_no = 0.1,
                                    .no_zero_until = 0.3,
                                    .no_full_from = 0.1};  ///< by visible share
  evidence::RampBelief line_contrast{.max_yes = 0.5,
                                     .yes_full_until = 20.0,
                                     .yes_zero_from = 4.0,
                                     .max_no = 0.1,
                                     .no_zero_until = 6.0,
                                     .no_full_from = 2.0};  ///< in grey-level sigmas
  // The paper's method.
  bool absolute = false;  ///< angles by evidence::which_kind in degrees, distances in metres, type other for a gap
  bool walls_are_unions = true;  ///< of collinear touching sub-segments; else each of these is a wall of its own

  [[nodiscard]] static PrimitiveParams paper();
};

/// What a scene has been found to consist of, before it is named.
struct SceneParts {
  std::span<const RangeSegment> segments;
  const Cooperation& cooperation;
  const FusedWholes& wholes;
  double beam_increment = 0.0;
};

/// The type of a junction of two consecutive segments.
struct JunctionType {
  PrimitiveType type = PrimitiveType::kOther;
  evidence::BinaryMass kind;  ///< belief in that type, m_2prim
  double believed = 0.0;      ///< Cr(type)
};

/// \param interior_angle  on the robot's side, in (0, 2 pi)
/// \param sigma_angle     of it
/// \param gap             between the ends: [m] for absolute params, in expected standard deviations else
[[nodiscard]] JunctionType junction_type(double interior_angle, double sigma_angle, double gap,
                                         const PrimitiveParams& params = {});

/// A single face that ends in front of something farther.
/// \param end          kFree or kOpen
/// \param jump_sigmas  of a free end: range difference in expected standard deviations
[[nodiscard]] JunctionType free_end_type(SegmentEnd end, double jump_sigmas, const PrimitiveParams& params = {});

/// Belief in a radial line that meets no segment.
/// \param gray_noise  1-sigma of a grey level
[[nodiscard]] evidence::FusedBinaryMass radial_line_existence(const RadialLine& line, double gray_noise,
                                                              const PrimitiveParams& params = {});

/// Fills Scene::primitives from its points, segments, radial lines and `parts`: walls, junctions, free ends, and last,
/// each as an `other`, the radial lines that are at none of these: on a segment, or as bearings only. No radial line is
/// at two.
void name_primitives(const SceneParts& parts, const PrimitiveParams& params, Scene& scene);

}  // namespace credo::perception
