// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include "localization/integrity_monitor.hpp"
#include "localization/localization.hpp"
#include "localization/localization_belief.hpp"
#include "localization/localization_evidence.hpp"

namespace credo::localization {

struct PoseTrustParams {
  double contradiction_reliability = 0.5;  ///< of the belief where the pose contradicts where the wheels have led
  /// Integrity::instrument_separation from which camera, range finder and wheels contradict each other: the root of a
  /// third of chi-square with 3 degrees of freedom at 1e-5.
  double max_instrument_separation = 2.9;
  int checked_for = 3;                  ///< so many acquisitions a scan that lay on the plan vouches for;
  double unchecked_reliability = 0.75;  ///< of the belief after that: nothing but what was matched speaks for the pose
  double blind_reliability = 0.8;       ///< of the last belief where nothing at all is seen
  /// A pose that has strayed from where the wheels have led is back there below this squared Mahalanobis distance,
  /// though what is foreseen becomes ever less certain: chi-square with 3 degrees of freedom at 10 %.
  double returned_innovation = 6.25;
  int borne_out_after = 2;            ///< acquisitions in which the camera alone sees the plan under the heading, or
  int borne_out_blind_after = 5;      ///< so many without doubt where there is no camera
  int trusted_again_after = 2;        ///< acquisitions without doubt after one with, until the pose is trusted again,
  int trusted_again_alone_after = 5;  ///< or so many where the camera or the range finder is alone
};

/// What speaks for a pose and against it beyond one acquisition. One wrong match makes a wrong pose, from which more is
/// matched wrongly, and one lying instrument likewise: a moment later everything agrees again. So a pose that was
/// doubted has to be borne out before it is trusted, and one that is not where the wheels have led, since it was last
/// borne out, is not trusted until the camera alone sees the plan under its heading. Without a camera nothing tells a
/// range finder that lies from wheels that have slipped, which are the likelier of the two.
class PoseTrust {
 public:
  PoseTrust(const geometry::PoseEstimate& start, const LocalizationBeliefParams& belief, const StatusParams& status,
            const PoseTrustParams& params)
      : belief_(belief), status_(status), params_(params), reckoned_(start) {}

  /// The robot has moved. \param motion  T_previous_current
  void follow(const geometry::PoseEstimate& motion) { reckoned_ = geometry::compose(reckoned_, motion); }
  /// The pose is this one, whatever was thought before: the search over all places has found it.
  void found(const geometry::PoseEstimate& pose);
  /// The pose is this one, as a person says, who may be wrong: it is doubted until what is seen bears it out.
  void given(const geometry::PoseEstimate& pose);
  /// The pose has jumped, and is not trusted before a search over all places has confirmed it.
  void jumped() { unconfirmed_ = true; }
  void confirmed();
  [[nodiscard]] bool waits_for_a_search() const { return unconfirmed_; }

  /// The belief in the pose and what speaks against it, written into `fix`, whose estimate is the pose.
  /// \param before  the belief at the acquisition before
  /// \param integrity  null under the paper's method, which knows its p + 2 criteria alone
  void weigh(const LocalizationEvidence& evidence, const evidence::BinaryMass& before, const Integrity* integrity,
             Localization& fix);
  /// The wheels lead on from this pose, if it was borne out. \param pose  the one weighed, doubts included
  void go_on_from(const geometry::PoseEstimate& pose);

 private:
  [[nodiscard]] bool borne_out(const LocalizationEvidence& evidence);
  [[nodiscard]] bool recovering(const LocalizationEvidence& evidence) const;
  [[nodiscard]] evidence::FusedBinaryMass believe(const LocalizationEvidence& evidence,
                                                  const evidence::BinaryMass& before, bool blind) const;

  LocalizationBeliefParams belief_;
  StatusParams status_;
  PoseTrustParams params_;
  geometry::PoseEstimate reckoned_;  ///< where the wheels have brought the robot since its pose was last borne out
  bool in_place_ = true;             ///< the pose is where the wheels have led, or else the camera bears it out
  bool strayed_ = false;             ///< the pose has left where the wheels lead, and nothing has borne it out
  bool unconfirmed_ = false;         ///< the pose has jumped, and no search has confirmed it yet
  int borne_out_ = 0;     ///< acquisitions in a row in which the camera alone saw the plan under the pose's heading
  int undoubted_ = 1000;  ///< acquisitions in a row in which nothing spoke against the pose; at the start it was given
  int unchecked_ = 0;     ///< acquisitions since the scan last lay on the plan
};

}  // namespace credo::localization
