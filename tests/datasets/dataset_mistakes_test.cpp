// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/datasets/small_dataset.hpp"

namespace credo::datasets {
namespace {

struct Mistake {
  const char* name;
  const char* file;
  const char* from;
  const char* to;
  std::vector<std::string> said;  ///< what the complaint holds
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class MistakeInADataset : public SmallDataset, public testing::WithParamInterface<Mistake> {};

TEST_P(MistakeInADataset, IsReportedWithFileAndLine) {
  const Mistake& mistake = GetParam();
  const std::string said = complaint_with(mistake.file, mistake.from, mistake.to);
  EXPECT_THAT(said, testing::HasSubstr(folder_ / mistake.file));
  for (const std::string& part : mistake.said) EXPECT_THAT(said, testing::HasSubstr(part));
}

const Mistake kMistakes[] = {
    {"UnknownKey",
     "range0/sensor.yaml",
     "range_max",
     "range_mux",
     {"sensor.yaml:8: unknown key 'range_mux'", "did you mean 'range_max'"}},
    {"UnknownKeyInABlock",
     "range0/sensor.yaml",
     "{sigma_0:",
     "{sigma_O:",
     {"sensor.yaml:9: unknown key 'sigma_O' in noise", "'sigma_0'"}},
    {"DuplicateKey",
     "range0/sensor.yaml",
     "count: 5\n",
     "count: 5\ncount: 5\n",
     {"sensor.yaml:7:", "'count' comes twice; first in line 6"}},
    {"MissingKey", "range0/sensor.yaml", "count: 5\n", "", {"'count' is missing"}},
    {"ZeroBeams", "range0/sensor.yaml", "count: 5", "count: 0", {"sensor.yaml:6:", "from 1 to", "'0'"}},
    {"NegativeBeams", "range0/sensor.yaml", "count: 5", "count: -5", {"sensor.yaml:6:", "'-5'"}},
    {"HugeCount", "range0/sensor.yaml", "count: 5", "count: 99999999999999999999", {"sensor.yaml:6:"}},
    {"FractionalBeams", "range0/sensor.yaml", "count: 5", "count: 5.5", {"sensor.yaml:6:", "whole number"}},
    {"RangeMinAboveRangeMax",
     "range0/sensor.yaml",
     "range_min: 0.2",
     "range_min: 6.0",
     {"sensor.yaml:8:", "expected more than range_min"}},
    {"DegreesForRadians",
     "range0/sensor.yaml",
     "angle_increment: 0.5",
     "angle_increment: 45",
     {"sensor.yaml:5:", "radians"}},
    {"NanNumber", "range0/sensor.yaml", "range_max: 6", "range_max: .nan", {"sensor.yaml:8:", "'.nan'"}},
    {"InfinitePose",
     "range0/sensor.yaml",
     "pose: [0.05, 0, 3]",
     "pose: [.inf, 0, 3]",
     {"sensor.yaml:2: pose[0]", ".inf"}},
    {"FarPose",
     "range0/sensor.yaml",
     "pose: [0.05, 0, 3]",
     "pose: [1000, 0, 3]",
     {"sensor.yaml:2: pose[0]", "at most 100"}},
    {"OverflowingPose", "range0/sensor.yaml", "pose: [0.05, 0, 3]", "pose: [1e999, 0, 3]", {"sensor.yaml:2:", "1e999"}},
    {"ShortPose",
     "range0/sensor.yaml",
     "pose: [0.05, 0, 3]",
     "pose: [0.05, 0]",
     {"sensor.yaml:2:", "a list of 3", "a list of 2"}},
    {"TextForNumber",
     "range0/sensor.yaml",
     "range_max: 6",
     "range_max: six metres",
     {"sensor.yaml:8:", "'six metres'"}},
    {"ListForNumber", "range0/sensor.yaml", "range_max: 6", "range_max: [6]", {"sensor.yaml:8:", "a list of 1"}},
    {"NegativeNoise", "range0/sensor.yaml", "sigma_0: 0.005", "sigma_0: -0.005", {"sensor.yaml:9:", "at least 0"}},
    {"OtherSensorType", "range0/sensor.yaml", "range_scanner", "sonar_ring", {"sensor.yaml:1:", "'range_scanner'"}},
    {"NotYaml", "range0/sensor.yaml", "pose: [", "pose: [[", {"is not valid YAML"}},
    {"ModelUnknown", "camera0/sensor.yaml", "conic", "conik", {"sensor.yaml:5:", "did you mean 'conic'"}},
    {"AzimuthSignZero",
     "camera0/sensor.yaml",
     "azimuth_sign: 1",
     "azimuth_sign: 0",
     {"azimuth_sign: expected -1 or 1"}},
    {"CenterOutsideTheImage", "camera0/sensor.yaml", "center: [15.5", "center: [32.5", {"sensor.yaml:6:", "32 x 24"}},
    {"EmptyAnnulus",
     "camera0/sensor.yaml",
     "radius: [3, 11]",
     "radius: [11, 11]",
     {"sensor.yaml:7:", "inner below outer"}},
    {"AnnulusBeyondTheImage",
     "camera0/sensor.yaml",
     "radius: [3, 11]",
     "radius: [3, 110]",
     {"sensor.yaml:7:", "diagonal"}},
    {"BlockOfAnotherModel", "camera0/sensor.yaml", "model: conic", "model: mei", {"mirror: belongs to another model"}},
    {"FiringTimesOfAnotherLength",
     "sonar0/sensor.yaml",
     "firing_times: [-0.01, ",
     "firing_times: [",
     {"sensor.yaml:10:", "a list of 2"}},
    {"NoFloor",
     "floor_plan.yaml",
     "walls:\n  - [0.000000, 0.000000, 8.000000, 0.000000]\n"
     "  - [8.000000, 0.000000, 8.000000, 3.500000]\n",
     "walls: []\n",
     {"floor_plan.yaml:2:", "empty"}},
    {"WallWithoutLength",
     "floor_plan.yaml",
     "- [8.000000, 0.000000, 8.000000, 3.5",
     "- [8.000000, 3.5, 8.000000, 3.5",
     {"floor_plan.yaml:4:", "without length"}},
    {"WallOfThreeNumbers", "floor_plan.yaml", "- [0.000000, ", "- [", {"floor_plan.yaml:3:", "a list of 4"}},
    {"OtherFormat", "dataset.yaml", "credo-dataset/1", "credo-dataset/9", {"dataset.yaml:1:", "credo-dataset/1"}},
    {"InitialPoseNotANumber", "dataset.yaml", "initial_pose: [1.0", "initial_pose: [one", {"dataset.yaml:6:", "'one"}},
    {"InitialSigmaZero",
     "dataset.yaml",
     "initial_pose_sigma: [0.200000",
     "initial_pose_sigma: [0.0",
     {"dataset.yaml:7:", "above 0"}},
    {"HeaderMissing",
     "odometry0/data.csv",
     "#timestamp [ns],x [m],y [m],theta [rad]\n",
     "",
     {"data.csv:1: expected the header '#timestamp [ns],x [m]"}},
    {"HeaderOfOtherUnits", "odometry0/data.csv", "x [m]", "x [mm]", {"data.csv:1: column 2", "'x [m]'", "'x [mm]'"}},
    {"ColumnTooFew",
     "odometry0/data.csv",
     ",0.020000,0.000000,",
     ",0.020000,",
     {"data.csv:3: expected 4 columns, found 3"}},
    {"ColumnTooMany",
     "odometry0/data.csv",
     ",0.020000,0.000000,",
     ",0.02,0,0,0,",
     {"data.csv:3: expected 4 columns, found 6"}},
    {"TextInARow",
     "odometry0/data.csv",
     ",0.020000,",
     ",2 cm,",
     {"data.csv:3: x [m]: expected a number, found '2 cm'"}},
    {"InfiniteOdometry", "odometry0/data.csv", ",0.020000,", ",inf,", {"data.csv:3: expected a finite pose"}},
    {"HugeOdometry", "odometry0/data.csv", ",0.020000,", ",1e300,", {"data.csv:3: expected a finite pose"}},
    {"TimeInSeconds",
     "odometry0/data.csv",
     "1600000000050000000",
     "1600000000.05",
     {"data.csv:3:", "'1600000000.05'", "multiply them by 1e9"}},
    {"TimeTooLarge",
     "odometry0/data.csv",
     "1600000000050000000",
     "9223372036854775807",
     {"data.csv:3:", "nanoseconds"}},
    {"TimeRunningBackwards",
     "odometry0/data.csv",
     "1600000000050000000",
     "1500000000050000000",
     {"data.csv:3: the time 1500000000050000000 ns comes after 1600000000000000000 ns in line 2"}},
    {"ImageMissing", "camera0/data.csv", "01600000000250000000.png", "nowhere.png", {"data.csv:2:", "nowhere.png"}},
    {"EventWithoutName", "events.csv", "kidnapped, twice", "", {"events.csv:2:"}},
    {"VisibleShareAboveOne", "groundtruth0/verticals.csv", "0.5000", "1.5", {"verticals.csv:2:", "visible_share"}},

};

INSTANTIATE_TEST_SUITE_P(, MistakeInADataset, testing::ValuesIn(kMistakes),
                         [](const auto& mistake) { return std::string(mistake.param.name); });

}  // namespace
}  // namespace credo::datasets
