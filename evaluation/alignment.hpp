// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "evaluation/association.hpp"

namespace credo::evaluation {

/// Localization in a known map has no gauge freedom: nothing is aligned unless it is asked for.
struct AlignmentParams {
  bool align = false;          ///< rotation and translation by Umeyama's method
  bool correct_scale = false;  ///< a scale too; alone: nothing but the scale
  bool align_origin = false;   ///< moves the estimate so that the first poses agree
  int n_to_align = -1;         ///< use the first n poses for the fit; -1: all
};

/// reference = scale * rotation * estimate + translation
struct Alignment {
  double scale = 1.0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

/// Least squares over the positions of a similarity or rigid transform (Umeyama, PAMI 1991). Planar data are fitted in
/// the plane, so that height, roll and pitch absorb no error.
/// \throws std::runtime_error if the positions lie on a straight line or fewer than two are asked for
[[nodiscard]] Alignment umeyama(const Trajectory& reference, const Trajectory& estimate, bool with_scale, int n = -1);

/// Applies what `params` ask for to pair.estimate.
Alignment align(AssociatedPair& pair, const AlignmentParams& params);

/// The line that says what was done: "(not aligned)", "(with SE(3) Umeyama alignment)", ...
[[nodiscard]] std::string describe(const AlignmentParams& params);

}  // namespace credo::evaluation
