// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "results/calibration_file.hpp"

#include <gmock/gmock.h>
#include <yaml-cpp/yaml.h>

namespace credo::results {
namespace {

using testing::HasSubstr;

sensors::Rig rig() {
  sensors::Rig rig;
  rig.camera.emplace().center_px = {320.0, 240.0};
  rig.range_finders.emplace_back();
  return rig;
}

localization::RigCalibration learned() {
  return {.range = localization::RangeCalibration{{0.05, -0.001, 0.002}, {0.001, 0.002, 0.0005}},
          .camera = localization::CameraCalibration{.theta_rad = -0.003,
                                                    .theta_sigma_rad = 0.0004,
                                                    .center_px = {320.5, 239.75},
                                                    .center_sigma_px = 0.04,
                                                    .tilt_rad = {0.004, 0.0},
                                                    .tilt_sigma_rad = 0.001}};
}

TEST(CalibrationFile, HasTheKeysOfSensorFiles) {
  const YAML::Node file = YAML::Load(to_yaml(learned(), rig()));
  EXPECT_EQ(file["camera0"]["center"][0].as<double>(), 320.5);
  EXPECT_EQ(file["camera0"]["pose"][2].as<double>(), -0.003);
  EXPECT_EQ(file["camera0"]["accuracy"]["pose"][2].as<double>(), 0.0004);
  EXPECT_EQ(file["camera0"]["accuracy"]["tilt"].as<double>(), 0.001);
  EXPECT_EQ(file["range0"]["pose"][0].as<double>(), 0.05);
  EXPECT_EQ(file["range0"]["accuracy"]["pose"][1].as<double>(), 0.002);
}

TEST(CalibrationFile, PeopleReadHowFarTheInstrumentsAreOff) {
  const std::string text = to_text(learned(), rig());
  EXPECT_THAT(text, HasSubstr("camera0  heading -3.00 +- 0.40 mrad, center +0.50 -0.25 +- 0.04 px"));
  EXPECT_THAT(text, HasSubstr("range0   heading +2.00 +- 0.50 mrad, x +50.0 +- 1.0 mm, y -1.0 +- 2.0 mm"));
}

TEST(CalibrationFile, IsEmptyOfInstrumentsThatAreNotThere) {
  EXPECT_EQ(to_text({}, {}), "");
  EXPECT_TRUE(YAML::Load(to_yaml({}, {})).IsNull());
}

}  // namespace
}  // namespace credo::results
