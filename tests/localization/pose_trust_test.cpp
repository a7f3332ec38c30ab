// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "localization/pose_trust.hpp"

#include <gtest/gtest.h>

namespace credo::localization {
namespace {

using evidence::BinaryMass;
using geometry::PoseEstimate;

constexpr double kSigma = 0.01;
const Eigen::Matrix3d kSmall = kSigma * kSigma * Eigen::Matrix3d::Identity();
const PoseEstimate kStep{{0.5, 0.0, 0.0}, 0.01 * kSmall};

/// Everything is matched and recognised; the camera cannot tell.
LocalizationEvidence good() {
  LocalizationEvidence evidence;
  evidence.matched = 20;
  evidence.detected = evidence.explained = 20.0;
  evidence.in_sight = evidence.recognised = 10;
  evidence.scan_agreement = 1.0;
  evidence.camera_seen = evidence.range_finder_seen = true;
  return evidence;
}

class PoseTrusted : public ::testing::Test {
 protected:
  /// Moves half a metre and weighs a pose so far aside of where that leads.
  Localization weigh(double aside_m, const LocalizationEvidence& evidence = good(), const Integrity& integrity = {}) {
    trust.follow(kStep);
    way += kStep.pose.x;
    Localization fix;
    fix.detected = 20;
    fix.estimate = {{way, aside_m, 0.0}, kSmall};
    trust.weigh(evidence, BinaryMass::vacuous(), &integrity, fix);
    trust.go_on_from(fix.estimate);
    return fix;
  }
  [[nodiscard]] bool as_foreseen(const Localization& fix) const { return fix.innovation <= status.max_innovation; }

  StatusParams status;
  PoseTrust trust{{{}, kSmall}, {}, {}, {}};
  double way = 0.0;
};

TEST_F(PoseTrusted, WhereTheWheelsLead) {
  for (int i = 0; i < 5; ++i) {
    const Localization fix = weigh(0.01);
    EXPECT_TRUE(as_foreseen(fix));
    EXPECT_FALSE(fix.doubted);
    EXPECT_GT(fix.belief.yes, 0.9);
  }
}

TEST_F(PoseTrusted, NotAfterAJumpHoweverWellItGoesOnFromThere) {
  const double before = weigh(0.0).belief.yes;
  for (int i = 0; i < 10; ++i) {
    const Localization fix = weigh(0.2);
    EXPECT_FALSE(as_foreseen(fix)) << i;
    EXPECT_LT(fix.belief.yes, 0.6 * before);
  }
  EXPECT_TRUE(as_foreseen(weigh(0.0))) << "back where the wheels led";
}

TEST_F(PoseTrusted, AfterAJumpThatTheCameraBearsOut) {
  LocalizationEvidence seen = good();
  seen.bearing_agreement = 0.7;
  EXPECT_FALSE(as_foreseen(weigh(0.2)));
  EXPECT_FALSE(as_foreseen(weigh(0.2, seen)));
  EXPECT_FALSE(as_foreseen(weigh(0.2, seen)));
  EXPECT_TRUE(as_foreseen(weigh(0.2)));
}

TEST_F(PoseTrusted, AWhileAfterAJumpWhereThereIsNoCamera) {
  LocalizationEvidence no_camera = good();
  no_camera.camera_seen = false;
  LocalizationEvidence unknown_place = no_camera;
  unknown_place.recognised = 1;
  weigh(0.2, unknown_place);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(as_foreseen(weigh(0.2, no_camera))) << i;
  EXPECT_TRUE(as_foreseen(weigh(0.2, no_camera)));
}

TEST_F(PoseTrusted, WhereASearchHasFoundIt) {
  trust.found({{0.0, 3.0, 0.0}, kSmall});
  EXPECT_TRUE(as_foreseen(weigh(3.0)));
}

TEST_F(PoseTrusted, NotBeforeAJumpIsConfirmed) {
  trust.jumped();
  EXPECT_TRUE(weigh(0.0).doubted);
  EXPECT_TRUE(weigh(0.0).doubted);
  trust.confirmed();
  EXPECT_FALSE(weigh(0.0).doubted);
}

TEST_F(PoseTrusted, DoubtLingers) {
  LocalizationEvidence unknown_place = good();
  unknown_place.recognised = 1;
  EXPECT_TRUE(weigh(0.0, unknown_place).unrecognised);
  EXPECT_TRUE(weigh(0.0).doubted);
  EXPECT_FALSE(weigh(0.0).doubted);
}

TEST_F(PoseTrusted, AWhileAfterADoubtWhereOneInstrumentIsAlone) {
  LocalizationEvidence no_scan = good();
  no_scan.range_finder_seen = false;
  LocalizationEvidence unknown_place = no_scan;
  unknown_place.recognised = 1;
  weigh(0.0, unknown_place);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(weigh(0.0, no_scan).doubted) << i;
  EXPECT_FALSE(weigh(0.0, no_scan).doubted);
}

TEST_F(PoseTrusted, NotBecauseTheWheelsHaveBecomeUncertain) {
  EXPECT_FALSE(as_foreseen(weigh(0.2)));
  Localization fix = weigh(0.2);
  for (int i = 0; i < 1000 && !as_foreseen(fix); ++i) {
    trust.follow({{}, kSmall});
    fix = weigh(0.2);
  }
  ASSERT_TRUE(as_foreseen(fix));
  EXPECT_TRUE(fix.doubted);
  EXPECT_FALSE(weigh(0.0).doubted) << "back where the wheels led";
}

TEST_F(PoseTrusted, WhereItHasStrayedItIsHereOrWhereTheWheelsLed) {
  const Localization fix = weigh(0.2);
  EXPECT_NEAR(fix.estimate.covariance(1, 1), kSmall(1, 1) + 0.5 * 0.2 * 0.2, 1e-12);
  EXPECT_DOUBLE_EQ(fix.estimate.covariance(0, 0), kSmall(0, 0));
}

TEST_F(PoseTrusted, NotWhereLandmarksContradictEachOther) {
  trust.follow(kStep);
  Localization fix;
  fix.estimate = {kStep.pose, kSmall};
  fix.detected = 20;
  fix.inconsistent = true;
  const Integrity integrity;
  trust.weigh(good(), BinaryMass::vacuous(), &integrity, fix);
  EXPECT_TRUE(fix.doubted);
}

TEST_F(PoseTrusted, InstrumentsThatDisagreeContradict) {
  Integrity apart;
  apart.instrument_separation = 3.5;
  EXPECT_TRUE(weigh(0.0, good(), apart).contradicted);
  LocalizationEvidence other_heading = good();
  other_heading.bearing_agreement = 0.2;
  EXPECT_TRUE(weigh(0.0, other_heading).contradicted);
}

TEST_F(PoseTrusted, WhatNoScanChecksIsBelievedLess) {
  LocalizationEvidence no_scan = good();
  no_scan.scan_agreement.reset();
  const double first = weigh(0.0, no_scan).belief.yes;
  for (int i = 0; i < 2; ++i) EXPECT_DOUBLE_EQ(weigh(0.0, no_scan).belief.yes, first);
  EXPECT_LT(weigh(0.0, no_scan).belief.yes, first);
}

TEST_F(PoseTrusted, BlindItFades) {
  Localization fix;
  fix.estimate = {{}, kSmall};
  const Integrity integrity;
  trust.weigh({}, {.yes = 0.5, .no = 0.0, .unknown = 0.5}, &integrity, fix);
  EXPECT_NEAR(fix.belief.yes, 0.4, 1e-12);
  EXPECT_EQ(fix.belief.no, 0.0);
}

}  // namespace
}  // namespace credo::localization
