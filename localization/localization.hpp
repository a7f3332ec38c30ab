// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

#include "evidence/believed.hpp"
#include "geometry/pose.hpp"
#include "sensors/time.hpp"

namespace credo::localization {

enum class Status {
  kInitializing,  ///< no absolute pose yet
  kLocalized,
  kUncertain,  ///< the pose may be off
  kAmbiguous,  ///< several poses fit: see `hypotheses`
  kLost,       ///< the pose is believed wrong
};

/// One of several poses that fit, with how far it is believed.
struct Hypothesis {
  geometry::Pose2 pose;
  double belief = 0.0;
  double plausibility = 1.0;
};

/// How far off the pose can be at the integrity risk that was asked for; nan: no integrity monitor has looked. An
/// interval, as the frequency of faults is known to an interval only.
struct ProtectionLevels {
  double position_low_m = std::numeric_limits<double>::quiet_NaN();
  double position_high_m = std::numeric_limits<double>::quiet_NaN();
  double heading_low_rad = std::numeric_limits<double>::quiet_NaN();
  double heading_high_rad = std::numeric_limits<double>::quiet_NaN();
};

/// Where the robot is, and whether to believe it. Never a bare pose.
struct Localization {
  sensors::Timestamp time = 0;
  geometry::PoseEstimate estimate;  ///< T_map_base with covariance; in the start's frame while initializing
  evidence::BinaryMass belief;      ///< in "the localization is correct" (Clerentin et al., sec. 4.5)
  double conflict = 0.0;            ///< between its criteria
  double innovation = 0.0;          ///< squared Mahalanobis distance of the pose from where the wheels led it
  bool unrecognised = false;        ///< much of what the plan has in sight is not seen
  bool off_plan = false;            ///< much of the scan does not lie on the plan
  bool inconsistent = false;        ///< landmarks contradict each other
  bool contradicted = false;        ///< camera, range finder and wheels do not agree
  bool doubted = false;             ///< lately something spoke against the pose, and nothing has confirmed it since
  bool broken_off = false;          ///< much of what was followed is not seen any more
  bool elsewhere = false;           ///< another pose is far more plausible
  ProtectionLevels protection = {};
  Status status = Status::kInitializing;
  int detected = 0;                    ///< primitives in the scene
  int matched = 0;                     ///< of them, matched to the map and used for the pose
  int tracked = 0;                     ///< tracks alive
  std::vector<Hypothesis> hypotheses;  ///< empty unless there is more than one
  std::string reason;                  ///< why it is unsure, in words; empty while localized
};

/// Whether something that is seen now speaks against the pose.
[[nodiscard]] inline bool is_contested(const Localization& fix) {
  return fix.broken_off || fix.unrecognised || fix.off_plan || fix.inconsistent || fix.contradicted;
}

[[nodiscard]] const char* to_string(Status status);
std::ostream& operator<<(std::ostream& out, const Localization& localization);

}  // namespace credo::localization
