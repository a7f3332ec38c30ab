// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "sim/world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "geometry/angles.hpp"
#include "sim/presets.hpp"
#include "tests/support/temporary_folder.hpp"

namespace credo::sim {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kGood = R"(format: credo-world/1
name: tiny
building:
  rooms:
    - outline: [[0, 0], [4, 0], [4, 3], [0, 3]]
path: [[1, 1], [2, 1]]
sensors:
  range_finders:
    - {preset: opensimple}
)";

/// What loading this text complains about; empty if it does not.
std::string complaint(const std::string& text) {
  const tests::TemporaryFolder folder;
  const fs::path file = folder.write("world.yaml", text);
  try {
    (void)load_world(file);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(WorldFile, AMinimalOneLoads) { EXPECT_EQ(complaint(kGood), ""); }

TEST(WorldFile, ComplaintsNameFileLineAndWhatToDo) {
  struct Case {
    const char *from, *to, *line, *says;
  };
  const Case cases[] = {
      {"credo-world/1", "credo-world/9", ":1:", "credo-world/1"},
      {"  rooms:", "  roms:", ":4:", "did you mean 'rooms'"},
      {"building:", "bulding:", ":1:", "building"},
      {"[4, 0]", "[4, zero]", ":5:", "2 numbers"},
      {"[4, 0]", "[4, .nan]", ":5:", "2 numbers"},
      {"[[0, 0], [4, 0], [4, 3], [0, 3]]", "[[0, 0], [4, 0]]", ":5:", "at least 3 corners"},
      {"opensimple", "opensimpel", ":9:", "did you mean 'opensimple'"},
      {"preset: opensimple", "preset: opensimple, k: -1", ":9:", "from 0 to 1e+06, not -1"},
      {"preset: opensimple", "preset: opensimple, count: 1000000000", ":9:", "from 1 to 100000"},
      {"preset: opensimple", "preset: opensimple, rate: 1e300", ":9:", "finite number"},
      {"preset: opensimple", "preset: opensimple, rate: .nan", ":9:", "finite number"},
      {"preset: opensimple", "preset: opensimple, k: 0, k: 1", ":9:", "comes twice"},
      {"preset: opensimple", "preset: opensimple, [1]: 1", ":9:", "expected a key"},
      {"preset: opensimple", "preset: opensimple, field: 7", ":9:", "from 0.01 to 6.28"},
      {"path:", "  pillars: [{at: [2, 2], sides: 2000000000}]\npath:", ":6:", "from 3 to 360"},
      {"path:", "drive: {step: 1e-12}\npath:", ":6:", "from 0.01"},
      {"path:", "drive: {speed: 1e-9}\npath:", ":6:", "from 0.01"},
      {"path:", "initial_pose_sigma: [0, 1, 1]\npath:", ":6:", "larger than 0"},
      {"[4, 0]", "[1e300, 0]", ":5:", "2 numbers"},
      {"[4, 0]", "[90000, 0]", ":5:", "at most 500"},
      {"preset: opensimple", "preset: opensimple, count: many", ":9:", "whole number"},
      {"preset: opensimple", "preset: opensimple, rnage_max: 3", ":9:", "did you mean 'range_max'"},
      {"path: [[1, 1], [2, 1]]", "path: [[1, 1]]", ":6:", "at least two waypoints"},
      {"path: [[1, 1], [2, 1]]", "path: [{carried_to: [1, 1]}, [2, 1]]", ":6:", "cannot be carried"},
      {"name: tiny", "extends: nowhere.yaml", "nowhere.yaml", "cannot read"},
      {"name: tiny", "extends: world.yaml", ":1:", "cannot extend itself"},
      {"name: tiny", "name: [", "", "not valid YAML"},
      {"  range_finders:\n    - {preset: opensimple}", "  odometry: {rate: 10}", ":8:", "needs a camera"},
      {"path:", "drive: {mode: fly}\npath:", ":6:", "stop_and_go or continuous"},
      {"path:", "clutter: 1.5\npath:", ":6:", "from 0 to 1, not 1.5"},
      {"path:", "people: -1\npath:", ":6:", "from 0 to 100, not -1"},
      {"path:", "initial_pose_offset: [1, 2]\npath:", ":6:", "3 numbers"},
      {"path:", "failures: [{sensor: range0, kind: broken}]\npath:", ":6:", "'kind' must be blind"},
      {"path:", "failures: [{sensor: range1, kind: blind}]\npath:", ":6:", "no sensor 'range1'"},
      {"path:", "failures: [{sensor: range0, kind: blind, form: 1}]\npath:", ":6:", "did you mean 'from'"},
      {"path:", "  moved: [{at: [2, 1.5], by: [0, 1]}]\npath:", ":6:", "nothing within 0.5 m"},
  };
  for (const Case& c : cases) {
    const std::string text = complaint(changed(c.from, c.to));
    EXPECT_THAT(text, HasSubstr(c.says)) << c.to;
    EXPECT_THAT(text, HasSubstr(c.line)) << c.to;
  }
}

/// The tiny world with these keys of a sonar ring in the place of its range finder.
std::string with_ring(const std::string& keys) {
  return changed("  range_finders:\n    - {preset: opensimple}", "  sonars:\n    - {" + keys + "}");
}

World loaded(const std::string& text) {
  const tests::TemporaryFolder folder;
  return load_world(folder.write("world.yaml", text));
}

TEST(WorldFile, ALaserOfHalfATurnHasABeamOnEitherEdge) {
  const World world = loaded(changed("preset: opensimple", "preset: tof-lms, count: 181, field: 3.14159265358979"));
  const sensors::RangeFinder& finder = world.range_finders.front().finder;
  EXPECT_NEAR(finder.beam_angle(0), -geometry::to_radians(90.0), 1e-12);
  EXPECT_NEAR(finder.beam_angle(90), 0.0, 1e-12);
  EXPECT_NEAR(finder.beam_angle(180), geometry::to_radians(90.0), 1e-12);
}

TEST(WorldFile, ARingOfItsOwnFiresAtOnceOrInGroups) {
  const std::string transducers = "transducers: [[0, 0.1, 1.57], [0.1, 0, 0], [0, -0.1, -1.57]]";
  const sensors::SonarRing at_once = loaded(with_ring(transducers)).sonars.front().ring;
  ASSERT_EQ(at_once.T_base_transducer.size(), 3U);
  EXPECT_EQ(at_once.T_base_transducer[2].theta, -1.57);
  EXPECT_TRUE(at_once.firing_times_s.empty());
  const World in_groups = loaded(with_ring(transducers + ", firing_times: [0, 0.1, 0]"));
  EXPECT_EQ(in_groups.sonars.front().ring.firing_times_s, (std::vector<double>{0.0, 0.1, 0.0}));
  EXPECT_THAT(complaint(with_ring(transducers + ", firing_times: [0, 0.1]")), HasSubstr(":9: 'firing_times'"));
  EXPECT_THAT(complaint(with_ring("firing_times: [0, 1]")), HasSubstr("list of 16 numbers"));
  EXPECT_THAT(complaint(with_ring(transducers + ", firing_times: [0, 61, 0]")), HasSubstr("within 60 s"));
  EXPECT_THAT(complaint(with_ring("transducers: []")), HasSubstr("at least one [x, y, theta]"));
  EXPECT_THAT(complaint(with_ring("transducers: [[0, 1]]")), HasSubstr("3 numbers"));
}

TEST(WorldFile, ThingsThatFindNoWallSayWhere) {
  const std::string door =
      changed("    - outline", "    - outline: [[9, 9], [12, 9], [12, 12], [9, 12]]\n    - outline");
  EXPECT_EQ(complaint(door), "");
  EXPECT_THAT(complaint(changed("path:", "  doors: [{at: [2, 1.5]}]\npath:")),
              HasSubstr(":6: there is no wall within 0.5 m of [2, 1.5]"));
  EXPECT_THAT(complaint(changed("path:", "  posters: [{at: [2, 0], material: papre}]\npath:")),
              HasSubstr("unknown material 'papre'"));
}

TEST(WorldFile, APathThatCannotBeDrivenSaysWhereAndWhatToDo) {
  struct Case {
    const char *from, *to, *line, *says;
  };
  const Case cases[] = {
      {"[2, 1]", "[9, 1]", ":6:", "waypoint [9, 1] is outside of the building: move it into a room"},
      {"[2, 1]]", "[2, 1], {carried_to: [-3, 1]}]", ":6:", "waypoint [-3, 1] is outside"},
      {"[2, 1]]", "[2, 1],\n  [3.9, 1]]", ":7:", "comes within 0.1 m of 'wall' at [4, 1]"},
      {"path:", "  walls: [{points: [[1.5, 0], [1.5, 3]]}]\npath:", ":7:", "drives through 'wall' at [1.5, 1]"},
      {"path:", "  boxes: [{at: [1.5, 1], size: [0.2, 0.2]}]\npath:", ":7:", "drives through 'cabinet'"},
      {"path:", "robot_radius: 3\npath:", ":7:", "of radius 3 m, comes within 1 m"},
      {"path:", "drive: {mode: continuous, turn_radius: 9}\npath: [[0.5, 0.5], [3.5, 0.5], [3.5, 2.95]]\n#",
       ":7:", "keep the path further away"},
      {"[[1, 1], [2, 1]]", "[[1, 1], [1, 1]]", ":6:", "two waypoints that are apart"},
  };
  for (const Case& c : cases) {
    const std::string text = complaint(changed(c.from, c.to));
    EXPECT_THAT(text, HasSubstr(c.says)) << c.to;
    EXPECT_THAT(text, HasSubstr(c.line)) << c.to;
  }
}

TEST(WorldFile, ThePathMayPassUnderALintelAndOverNothing) {
  EXPECT_EQ(complaint(changed(
                "path: [[1, 1], [2, 1]]",
                "    - outline: [[4.2, 0], [8, 0], [8, 3], [4.2, 3]]\n  doors: [{at: [4.0, 1], kind: opening}]\n"
                "path: [[1, 1], [4.1, 1], [6, 1]]")),
            "");
  EXPECT_THAT(complaint(changed("path: [[1, 1], [2, 1]]",
                                "    - outline: [[4.2, 0], [8, 0], [8, 3], [4.2, 3]]\n  doors: [{at: [4.0, 1]}]\n"
                                "path: [[1, 1], [6, 1]]")),
              HasSubstr("drives through"));
}

TEST(WorldFile, ThePathStaysIndoorsBetweenRoomsToo) {
  EXPECT_THAT(complaint(changed("path: [[1, 1], [2, 1]]",
                                "    - outline: [[9, 0], [13, 0], [13, 3], [9, 3]]\n  doors: [{at: [4.0, 1], kind: "
                                "opening}, {at: [9.0, 1], kind: opening}]\npath: [[1, 1], [11, 1]]")),
              HasSubstr("is outside of the building at [4."));
  EXPECT_THAT(complaint(changed("[[1, 1], [2, 1]]", "[[-0.4, 1], [-0.4, 2]]")),
              HasSubstr("waypoint [-0.4, 1] is outside"));
}

TEST(WorldFile, APathMayBeLanesThatFitTheBuildingAtHand) {
  const std::string lanes = changed("path: [[1, 1], [2, 1]]", "path: {lanes: {start: [0.6, 0.6], spacing: 0.9}}");
  EXPECT_EQ(loaded(lanes).path.size(), 6U);
  const auto with = [&](const std::string& keys) {
    return complaint(changed("path: [[1, 1], [2, 1]]", "path: {lanes: {" + keys + "}}"));
  };
  EXPECT_THAT(with("spacing: 1"), HasSubstr(":6:"));
  EXPECT_THAT(with("start: [0.1, 0.1]"), HasSubstr(":6: there is no room for the robot at the start of the lanes"));
  EXPECT_THAT(with("start: [1, 1], spacing: 0.01"), HasSubstr("from 0.1"));
  EXPECT_THAT(with("start: [1, 1], spaceing: 1"), HasSubstr("did you mean 'spacing'"));
  EXPECT_THAT(complaint(changed("path: [[1, 1], [2, 1]]", "path: {lane: {start: [1, 1]}}")), HasSubstr("'lanes'"));

  const tests::TemporaryFolder folder;
  folder.write("small.yaml", lanes);
  const std::string larger =
      "format: credo-world/1\nextends: small.yaml\nbuilding:\n  rooms:\n"
      "    - outline: [[0, 0], [4, 0], [4, 5], [0, 5]]\n";
  EXPECT_EQ(load_world(folder.write("large.yaml", larger)).path.size(), 10U);
  const std::string other = "format: credo-world/1\nextends: small.yaml\npath: [[1, 1], [2, 1]]\n";
  EXPECT_EQ(load_world(folder.write("other.yaml", other)).path.size(), 2U);
}

TEST(WorldFile, AnExtendedWorldsDriveIsReplacedAsAWhole) {
  const tests::TemporaryFolder folder;
  folder.write("first.yaml", changed("path:", "drive: {mode: continuous, speed: 0.7, duration: 9}\npath:"));
  const std::string second = "format: credo-world/1\nextends: first.yaml\n";
  EXPECT_EQ(load_world(folder.write("second.yaml", second)).drive.speed_mps, 0.7);
  const World other = load_world(folder.write("other.yaml", second + "drive: {speed: 0.3}\n"));
  EXPECT_EQ(other.drive.mode, Drive::Mode::kStopAndGo);
  EXPECT_FALSE(other.drive.duration_s);
}

/// The tiny world with a door and a box, and what changes in it.
std::string with_changes(const std::string& changes) {
  return changed("path:",
                 "  boxes: [{at: [2, 2.4], size: [0.4, 0.4]}]\n  doors: [{at: [4, 2], kind: opening, leaf: 0}]\n"
                 "drive: {duration: 60}\nchanges: [" +
                     changes + "]\npath:");
}

TEST(WorldFile, ChangesComeInTheirOrder) {
  const World world =
      loaded(with_changes("{when: 5, door: [4, 2], leaf: 1.5}, {when: 5, move: [2, 2.4], by: [1, 0]}, "
                          "{when: 8, take: [3, 2.4]}, {when: 9, put: {at: [2, 2], size: [0.2, 0.2]}}"));
  std::vector<std::string> events;
  for (const Change& change : world.changes) events.push_back(change.event);
  EXPECT_THAT(events, testing::ElementsAre("door_opened", "obstacle_moved", "obstacle_removed", "obstacle_added"));
}

TEST(WorldFile, AChangeThatCannotBeSaysWhere) {
  struct Case {
    const char *change, *says;
  };
  const Case cases[] = {{"{door: [4, 2], leaf: 1}", "needs the key 'when'"},
                        {"{when: 0, door: [4, 2], leaf: 1}", "after the start"},
                        {"{when: 5, door: [4, 2], leaf: 1}, {when: 4, take: [2, 2.4]}", "not before the change above"},
                        {"{when: 5}", "needs one of the keys 'put', 'take', 'move' and 'door'"},
                        {"{when: 5, take: [2, 2.4], move: [2, 2.4]}", "not two"},
                        {"{when: 5, take: [3.5, 2.4]}", "nothing that can be moved stands within 0.5 m of [3.5, 2.4]"},
                        {"{when: 5, take: [2, 2.4]}, {when: 6, take: [2, 2.4]}", "nothing that can be moved"},
                        {"{when: 5, door: [0, 2], leaf: 1}", "no opening with a leaf within 0.5 m of [0, 2]"},
                        {"{when: 5, take: [2, 2.4], leaf: 1}", "unknown key 'leaf'"},
                        {"{when: 5, put: {at: [2, 2], size: [0, 1]}}", "two lengths larger than 0"},
                        {"{when: 60, take: [2, 2.4]}", "the drive is over after 60"}};
  for (const Case& c : cases) {
    const std::string text = complaint(with_changes(c.change));
    EXPECT_THAT(text, HasSubstr(c.says)) << c.change;
    EXPECT_THAT(text, HasSubstr(":9:")) << c.change;
  }
}

TEST(WorldFile, TheRobotMayGoWhereSomethingStoodOrWillStand) {
  const auto with = [](const std::string& change) {
    return complaint(changed("path:", "  boxes: [{at: [3.5, 1], size: [0.2, 0.2]}]\nchanges: [" + change +
                                          "]\npath: [[1, 1], [3.4, 1], [1, 1]] #"));
  };
  EXPECT_THAT(with("{when: 1, put: {at: [1, 2], size: [0.2, 0.2]}}"), HasSubstr("drives through 'cabinet'"));
  EXPECT_EQ(with("{when: 3, take: [3.5, 1]}"), "");
  EXPECT_THAT(with("{when: 25, take: [3.5, 1]}"), HasSubstr("drives through 'cabinet'"));
  EXPECT_EQ(with("{when: 3, take: [3.5, 1]}, {when: 35, put: {at: [3.5, 1], size: [0.2, 0.2]}}"), "");
  EXPECT_THAT(with("{when: 3, take: [3.5, 1]}, {when: 6, put: {at: [2, 1], size: [0.2, 0.2]}}"),
              HasSubstr("'cabinet' at [1.9, 1]"));
}

TEST(WorldFile, AnEmptyOneIsCalledSo) {
  EXPECT_THAT(complaint(""), testing::EndsWith("world.yaml: is empty; expected a world file"));
  EXPECT_THAT(complaint("# nothing\n"), HasSubstr("is empty"));
}

/// The example in the manual uses every key; what it calls a default is one.
TEST(WorldFile, TheManualsExampleLoadsAndItsDefaultsAreTrue) {
  std::ifstream manual(std::string(CREDO_SOURCE_DIR) + "/sim/worlds/README.md");
  std::string line, yaml;
  bool inside = false;
  while (std::getline(manual, line)) {
    if (line.starts_with("```")) {
      inside = line == "```yaml";
      continue;
    }
    if (inside) yaml += line + "\n";
  }
  const tests::TemporaryFolder folder;
  const fs::path file = folder.write("manual.yaml", yaml);
  World world;
  ASSERT_NO_THROW(world = load_world(file));
  EXPECT_EQ(world.path.size(), 4U);
  const World defaults;
  EXPECT_EQ(world.ceiling_m, defaults.ceiling_m);
  EXPECT_EQ(world.exposure_gain, defaults.exposure_gain);
  EXPECT_EQ(world.drive.pause_s, defaults.drive.pause_s);
  EXPECT_EQ(world.drive.turn_speed_radps, defaults.drive.turn_speed_radps);
  EXPECT_EQ(world.nuisances.noise_grey, defaults.nuisances.noise_grey);
  EXPECT_EQ(world.nuisances.tilt_rad, defaults.nuisances.tilt_rad);
  EXPECT_EQ(world.nuisances.glare, defaults.nuisances.glare);
  EXPECT_EQ(world.initial_pose_sigma, defaults.initial_pose_sigma);
  EXPECT_EQ(world.range_finders[0].finder.noise, range_finder_preset("opensimple").finder.noise);
  EXPECT_EQ(world.range_finders[0].faintest, range_finder_preset("opensimple").faintest);
  EXPECT_EQ(world.camera->struts_rad, camera_preset("conic-640").struts_rad);
  EXPECT_EQ(world.camera->strut_width_px, camera_preset("conic-640").strut_width_px);
  EXPECT_NEAR(world.range_finders[0].finder.angle_increment_rad, geometry::to_radians(2.0), 1e-12);
  EXPECT_EQ(world.sonars[1].ring.firing_times_s.size(), 3U);
  EXPECT_EQ(world.sonars[0].cross_talk_share, SonarSetup{}.cross_talk_share);
  EXPECT_EQ(world.clutter_share, defaults.clutter_share);
  EXPECT_EQ(world.people, defaults.people);
  EXPECT_EQ(world.initial_pose_offset, defaults.initial_pose_offset);
  EXPECT_EQ(world.path[2].turn_rad, 0.6);
  ASSERT_EQ(world.failures.size(), 2U);
  EXPECT_EQ(world.failures[0].scale, Failure{}.scale);
  EXPECT_EQ(world.failures[1].to_s, Failure{}.to_s);
  EXPECT_EQ(world.only_planned.size(), 3U);  // of the shelf
  EXPECT_EQ(world.changes.size(), 4U);
}

TEST(WorldFile, AFolderIsNone) {
  const tests::TemporaryFolder folder;
  EXPECT_THAT([&] { (void)load_world(folder.path()); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("is a folder; expected a world file")));
}

TEST(WorldFile, AMissingFileSaysSo) {
  EXPECT_THROW(
      {
        try {
          (void)load_world("/nowhere/at/all.yaml");
        } catch (const std::runtime_error& error) {
          EXPECT_THAT(error.what(), HasSubstr("cannot read this world file"));
          throw;
        }
      },
      std::runtime_error);
}

}  // namespace
}  // namespace credo::sim
