// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "geometry/pose.hpp"
#include "sensors/acquisition.hpp"

namespace credo::sim {

/// How the albedo varies along a surface.
enum class Pattern {
  kPlain,
  kStripes,  ///< alternating bright and dark, one of each per period: the fins of a radiator
  kBooks     ///< one albedo per period and shelf board: a filled shelf
};

/// What a surface does to light, to the beam of a range finder and to ultrasound.
struct Material {
  std::string name;
  double albedo = 0.8;    ///< of visible light
  double emission = 0.0;  ///< radiance of its own: windows and lamps; 1 is white paper in good light
  Pattern pattern = Pattern::kPlain;
  double period_m = 0.08;            ///< of the pattern
  double contrast = 0.4;             ///< of the pattern: share of the albedo between its darkest and brightest part
  bool skirting = false;             ///< darker up to World::skirting_m
  double infrared = 0.8;             ///< reflectance met by a range finder
  double miss_share = 0.0;           ///< of beams that are lost (glass)
  double sonar_critical_rad = 0.24;  ///< incidence beyond which no echo comes back: smooth 0.24, rough 0.7
};

/// A vertical rectangle, opaque, seen from either side, and there for all or a part of the drive.
struct Panel {
  Eigen::Vector2d a = Eigen::Vector2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  double z0_m = 0.0;
  double z1_m = 0.0;
  int material = 0;      ///< index into World::materials
  bool in_plan = false;  ///< the floor plan shows it
  double from_s = 0.0;   ///< of the drive
  double to_s = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_there(double seconds) const { return from_s <= seconds && seconds < to_s; }
};

/// The leaf of an opening, which can be turned.
struct DoorLeaf {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< the middle of the opening
  Eigen::Vector2d hinge = Eigen::Vector2d::Zero();
  Eigen::Vector2d shut = Eigen::Vector2d::UnitX();  ///< unit direction from the hinge when shut
  Eigen::Vector2d away = Eigen::Vector2d::UnitY();  ///< unit direction into which it opens
  std::size_t panel = 0;                            ///< index into World::panels: the last place of the leaf
};

/// Something that comes, goes or moves during the drive; panels say what (Panel::from_s, Panel::to_s).
struct Change {
  double when_s = 0.0;  ///< from the start
  std::string event;    ///< obstacle_added, obstacle_moved, obstacle_removed, door_opened, door_closed
};

/// Lamps flush with the ceiling, on a square grid through the origin.
struct CeilingLamps {
  double spacing_m = 2.4;
  double length_m = 0.9;  ///< along x
  double width_m = 0.5;   ///< along y
  double emission = 2.0;
};

struct Drive {
  enum class Mode { kStopAndGo, kContinuous };
  Mode mode = Mode::kStopAndGo;
  double step_m = 0.3;   ///< between stops
  double pause_s = 0.8;  ///< length of a stop
  double speed_mps = 0.4;
  double acceleration_mps2 = 0.5;
  double turn_speed_radps = 0.7;  ///< when turning on the spot
  double turn_radius_m = 0.5;     ///< of the curves when driving continuously
  /// When the recording ends, wherever the robot is by then; it waits at the end of its path. Without, it ends there.
  std::optional<double> duration_s = std::nullopt;
};

struct Waypoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  bool carried_here = false;  ///< the robot is lifted and set down here without noticing (event `kidnapped`)
  /// Of one that is carried: set down turned by this against how it stood before; else heading for the next waypoint.
  std::optional<double> turn_rad = std::nullopt;
};

struct CameraSetup {
  sensors::OmniCamera camera;      ///< as calibrated; the true one differs by its accuracy
  double rate_hz = 0.0;            ///< 0: one image in the middle of each stop
  double strut_width_px = 3.0;     ///< of the bars that hold the mirror
  std::vector<double> struts_rad;  ///< their directions in the image
};

struct RangeFinderSetup {
  sensors::RangeFinder finder;   ///< as calibrated; the noise written is the law that the simulator follows
  double rate_hz = 0.0;          ///< 0: one scan in the middle of each stop
  double spot_m = 0.004;         ///< width of the light spot at the sensor
  double spot_rad = 0.005;       ///< and its growth
  double bias_per_m = 0.0;       ///< calibration error of triangulation: beta r^2, 1-sigma of beta [1/m]
  double outlier_share = 0.005;  ///< readings that have nothing to do with the scene
  double quantum_m = 0.001;      ///< step of a time-of-flight reading
  double faintest = 0.012;       ///< infrared * cos(incidence) / r^2 at which half of the readings are lost
};

struct SonarSetup {
  sensors::SonarRing ring;
  double rate_hz = 10.0;
  double cross_talk_share = 0.02;  ///< phantom readings from a neighbour's pulse
  double relative_sigma = 0.01;    ///< of the range, where larger than the ring's sigma
};

struct OdometrySetup {
  sensors::OdometryNoise noise;
  double rate_hz = 10.0;
};

/// What keeps the image from being ideal. 1-sigma, drawn once per simulation unless said otherwise.
struct Nuisances {
  double noise_grey = 1.5;       ///< total temporal noise of a pixel of grey level 128
  double read_noise_grey = 0.7;  ///< its part that does not depend on the light
  double pixel_gain = 0.005;     ///< differences between pixels, fixed
  double blur_px = 0.7;          ///< defocus, 1-sigma of a Gaussian (not drawn)
  double center_px = 0.3;        ///< of the mirror axis in the image
  double tilt_rad = 0.0087;      ///< of the mirror axis, in each of two directions
  double mounting_m = 0.002;     ///< of the position of camera and range finders on the robot
  double mounting_rad = 0.0026;  ///< of their heading
  int dust = 6;                  ///< number of specks (not drawn)
  double glare = 0.03;           ///< share of saturated light that spreads around (not drawn)
};

/// A stretch of the drive in which a sensor does not work as calibrated. Events tell of it: `..._failed` where it says
/// nothing or nothing new, else `..._degraded`; and `..._restored`.
struct Failure {
  enum class Kind {
    kBlind,      ///< no scans, no odometry, black images
    kFrozen,     ///< the last reading before again and again, with new times
    kNoisy,      ///< 5 times the noise
    kDark,       ///< camera: a twelfth of the light
    kSaturated,  ///< camera: 8 times the light
    kLying,      ///< what it says is consistent and wrong: `scale`, `offset_m`, `turn_rad`
    kSlipping    ///< odometry: the wheels turn for `offset_m` more than the way, evenly from beginning to end
  };
  std::string sensor = "all";  ///< camera0, range0 ..., odometry0, or all of these
  Kind kind = Kind::kBlind;
  double from_s = 0.0;  ///< from the start
  double to_s = std::numeric_limits<double>::infinity();
  double scale = 1.0;     ///< of the ranges, and of the way that odometry counts
  double offset_m = 0.0;  ///< added to the ranges
  double turn_rad = 0.0;  ///< of the image or the scan, counter-clockwise
};

/// A building, a robot in it and what it does there: everything that a simulation is made of but the random numbers.
struct World {
  std::string name;
  std::string description;
  double ceiling_m = 2.6;
  double skirting_m = 0.1;
  double light_rad = 0.4;        ///< direction in the plane from which the walls are lit most
  double exposure_gain = 230.0;  ///< grey levels of white paper in good light
  std::vector<Material> materials;
  std::vector<Panel> panels;
  std::vector<Panel> only_planned;  ///< that the floor plan shows and that are not there
  /// Outlines of what is indoors; without any, all within the rectangle around the panels is.
  std::vector<std::vector<Eigen::Vector2d>> areas;
  std::vector<Eigen::Vector2d> marks;  ///< vertical lines without relief that the floor plan shows (door frames)
  std::vector<DoorLeaf> leaves;
  std::vector<Change> changes;  ///< by time
  CeilingLamps lamps;
  double floor_albedo = 0.45;
  double floor_tile_m = 0.0;         ///< 0: no tiles
  double plan_uncertainty_m = 0.01;  ///< 1-sigma of each coordinate of each junction of the floor plan
  /// Share of the length of the mapped walls, at the height of the range finder, that unmapped things hide. They are
  /// drawn from the seed of the simulation, clear of the robot's way.
  double clutter_share = 0.0;
  int people = 0;  ///< who walk about, each their own way, and keep clear of the robot

  double robot_radius_m = 0.25;
  Drive drive;
  std::vector<Waypoint> path;
  bool initial_pose_known = true;
  std::array<double, 3> initial_pose_sigma{0.05, 0.05, 0.035};  ///< m, m, rad
  std::array<double, 3> initial_pose_offset{0.0, 0.0, 0.0};     ///< what the robot is told is this far off, in the map
  std::optional<CameraSetup> camera;
  std::vector<RangeFinderSetup> range_finders;
  std::vector<SonarSetup> sonars;
  std::optional<OdometrySetup> odometry;
  Nuisances nuisances;
  std::vector<Failure> failures;
};

/// Reads a world file (sim/worlds/README.md lists every key).
/// \throws std::runtime_error  "file:line: ..." for a missing file, a wrong type, an impossible value, an unknown key
///   (with the nearest known one), or a path that the robot cannot drive.
[[nodiscard]] World load_world(const std::filesystem::path& file);

}  // namespace credo::sim
