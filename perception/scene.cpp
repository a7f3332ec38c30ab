// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "perception/scene.hpp"

#include <ostream>

namespace credo::perception {

int polarity_of(const Primitive& primitive, const Scene& scene) {
  const int line = primitive.radial_line;
  return line >= 0 && line < static_cast<int>(scene.radial_lines.size()) ? scene.radial_lines[line].polarity : 0;
}

const char* to_string(PrimitiveType type) {
  switch (type) {
    case PrimitiveType::kCorner: return "corner";
    case PrimitiveType::kEdge: return "edge";
    case PrimitiveType::kWall: return "wall";
    case PrimitiveType::kOther: return "other";
  }
  return "unknown";
}

const char* to_string(SegmentEnd end) {
  switch (end) {
    case SegmentEnd::kJoined: return "joined";
    case SegmentEnd::kFree: return "free";
    case SegmentEnd::kOpen: return "open";
    case SegmentEnd::kOccluded: return "occluded";
    case SegmentEnd::kUnseen: return "unseen";
  }
  return "unknown";
}

std::ostream& operator<<(std::ostream& out, const Primitive& primitive) {
  out << to_string(primitive.type) << " at " << geometry::to_degrees(primitive.azimuth) << " +- "
      << geometry::to_degrees(primitive.sigma_azimuth) << " deg";
  if (!primitive.bearing_only) out << ", " << primitive.range_m << " +- " << primitive.sigma_range_m << " m";
  if (primitive.type == PrimitiveType::kWall)
    out << ", " << primitive.extent << " (" << to_string(primitive.end_a) << ", " << to_string(primitive.end_b) << ")";
  return out << ", " << primitive.existence;
}

}  // namespace credo::perception
