// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/pose.hpp"
#include "sim/lighting.hpp"
#include "sim/world.hpp"

namespace credo::sim {

/// The first surface that a ray meets.
struct SurfaceHit {
  static constexpr int kFloor = -1;
  static constexpr int kCeiling = -2;
  static constexpr int kNothing = -3;

  int panel = kNothing;                              ///< index into World::panels, and on into those that pass
  float t = std::numeric_limits<float>::infinity();  ///< of the ray
  float along_m = 0.0F;                              ///< from the panel's start
  float z_m = 0.0F;                                  ///< height above the floor
};

/// The world as seen from one camera pose: panels in the camera frame and, for every direction, those that can be met
/// there, nearest first. `look_from` refills it and keeps its memory.
class PanelView {
 public:
  explicit PanelView(const World& world) : world_(&world) {}

  /// \param T_map_camera  pose of the camera frame
  /// \param height_m      of the frame's origin above the floor
  /// \param passing       panels that are there besides the world's: people
  void look_from(const geometry::Pose2& T_map_camera, double height_m, std::span<const Panel> passing = {});

  /// The bin of a horizontal direction of the camera frame.
  [[nodiscard]] static std::uint16_t bin_of(double azimuth);

  /// \param bin  of the direction; a ray may be up to `kSlack_rad` beside its bin.
  [[nodiscard]] SurfaceHit trace(std::uint16_t bin, const float origin[3], const float direction[3]) const;

  /// The light that comes back along a ray that ends at `hit`; 1 is white paper in good light.
  /// \param direction  as long, horizontally, as the ray's image radius in pixels: the light is averaged over a pixel
  [[nodiscard]] float radiance(const SurfaceHit& hit, const LightMap& light, const float origin[3],
                               const float direction[3]) const;

  static constexpr double kSlack_rad = 0.025;

 private:
  struct Placed {
    float ax, ay, ex, ey;  // start and extent, camera frame [m]
    float z0, z1;          // above the floor [m]
    float length;
    float facing;  // 0..1
    int panel;
    int material;
    bool full_height;
  };
  struct Entry {
    int bin;
    int placed;
    float nearest, farthest;
    bool covers;  // the whole bin, from floor to ceiling
  };
  void place(const Panel& panel, const geometry::Pose2& T_camera_map);
  void enter(int placed);
  void sort_bins();

  const World* world_;
  float x_ = 0.0F, y_ = 0.0F, cos_ = 1.0F, sin_ = 0.0F;  // T_map_camera
  float height_ = 0.0F;
  std::vector<Placed> placed_;
  std::vector<Entry> entries_;
  std::vector<int> bin_start_;
  std::vector<Entry> sorted_;
};

}  // namespace credo::sim
