// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "localization/integrity_monitor.hpp"
#include "localization/landmark_map.hpp"
#include "localization/wall_grid.hpp"

namespace credo::localization {

struct RepeatedModuleParams {
  double farthest_m = 3.0;        ///< longer shifts are not looked for: wheels do not slip that far
  double tolerance_m = 0.1;       ///< what lies this near its shifted place, or nearer than
  double tolerance_sigmas = 3.0;  ///< so many uncertainties of the plan, would be matched there
  double parallel_rad = 0.035;    ///< 2 degrees: walls that differ by less are parallel
  double least_share = 0.8;       ///< of the matched points would be matched after the shift,
  int least_points = 4;    ///< and so many: fewer repeat by chance, and the monitor takes them for wrong together
  double capture_m = 0.3;  ///< a prediction this near the shifted pose is drawn to it
};

/// Where else in the plan the robot would see what it sees: what is built in modules (doors along a corridor, windows,
/// racks) looks the same one module on, and a pose that has slipped there matches everything wrongly in the same way.
/// Translations only. What hides the shifted landmarks is not asked for, so there may be more aliases than real ones.
/// Keeps its memory.
class RepeatedModules {
 public:
  /// \param map    must outlive this
  /// \param slips  how often and how far wheels slip: prediction_fault and slip_m
  explicit RepeatedModules(const LandmarkMap& map, const IntegrityParams& slips = {},
                           const RepeatedModuleParams& params = {});

  /// The shifts after which every wall and nearly all points that the pose rests on would be matched as well, nearest
  /// first. Shifts below two tolerances are the pose itself.
  /// \param observations  those of the solution, of landmarks of the map; its outliers do not count
  /// \returns a view that stays valid until the next call
  [[nodiscard]] std::span<const Alias> find(std::span<const Observation> observations, const PoseSolution& solution);

 private:
  /// From a point of the plan to another one of the same kind.
  struct Way {
    Eigen::Vector2d shift = Eigen::Vector2d::Zero();
    std::size_t to = 0;
  };
  struct SeenPoint {
    std::size_t point = 0;
    std::optional<perception::PrimitiveType> type;
  };
  struct SeenWall {
    const WallLandmark* wall = nullptr;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< on its line, the middle of what was seen
  };

  [[nodiscard]] std::span<const Way> ways_from(std::size_t point) const;
  [[nodiscard]] const Way* way_near(const SeenPoint& seen, const Eigen::Vector2d& shift, double tolerance_m) const;
  [[nodiscard]] bool stands(const SeenWall& seen, const Eigen::Vector2d& shift);
  [[nodiscard]] bool proposed_before(std::size_t seed, const Eigen::Vector2d& shift) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> confirmed(const Eigen::Vector2d& proposed, std::size_t absent);
  void list_seen(std::span<const Observation> observations, const PoseSolution& solution);
  void add(const Eigen::Vector2d& shift);
  [[nodiscard]] Alias alias_at(const Eigen::Vector2d& shift) const;

  const LandmarkMap* map_;
  IntegrityParams slips_;
  RepeatedModuleParams params_;
  double tolerance_m_;
  WallGrid walls_;                  ///< of the map's, by their index
  std::vector<Way> ways_;           ///< by point, then by x
  std::vector<std::size_t> begin_;  ///< by point, one more than there are: the first of its ways
  Eigen::Vector2d viewpoint_ = Eigen::Vector2d::Zero();
  std::vector<SeenPoint> seen_points_;  ///< different ones, those with the fewest ways first
  std::vector<SeenWall> seen_walls_;
  std::vector<int> near_;
  std::vector<Eigen::Vector2d> shifts_;
  std::vector<Alias> aliases_;
};

}  // namespace credo::localization
