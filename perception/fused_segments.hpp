// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <span>
#include <vector>

#include "evidence/binary_mass.hpp"
#include "perception/cooperation.hpp"
#include "perception/criteria.hpp"
#include "perception/scene.hpp"

namespace credo::perception {

/// What is believed of the range segments as wholes, and which sub-segments they have become.
struct FusedWholes {
  std::vector<evidence::FusedBinaryMass> existence;  ///< by range segment
  std::vector<int> cases;                            ///< endpoint case, by range segment
  std::vector<int> first_part;  ///< index into Scene::segments of the first sub-segment; one more entry than segments
};

/// Cuts the range segments as the cooperation says and judges the pieces and the wholes by the five criteria. Fills
/// Scene::segments and its conflicts from Scene::points, gray and camera_seen.
///
/// A whole is judged like a piece, with all its points and its own two ends; its grey levels are those of its pieces,
/// averaged by their widths, so that an edge that the camera has seen does not speak against it.
/// \param wholes  cleared first, keeps its memory
void fuse_segments(std::span<const RangeSegment> segments, const Cooperation& cooperation, double beam_increment,
                   const PointNoise& noise, const CriteriaParams& params, Scene& scene, FusedWholes& wholes);

}  // namespace credo::perception
