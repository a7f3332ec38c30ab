// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "evidence/track_belief.hpp"
#include "perception/observer.hpp"
#include "tracking/association.hpp"
#include "tracking/prediction.hpp"
#include "tracking/track.hpp"
#include "tracking/transition.hpp"

namespace credo::tracking {

struct TrackerParams {
  perception::Method method = perception::Method::kDefault;
  PredictionParams prediction;
  AssociationParams association;
  TransitionParams transition;
  evidence::TrackBeliefParams belief;
  /// Scenes in a row that may leave a track undecided (ambiguous, or the sensor that sees it is blind) before it counts
  /// as missed. Its mass is kept meanwhile.
  int max_undecided_in_a_row = 2;
  /// Of a matching that was given by hand (Clerentin et al., sec. 5).
  evidence::BinaryMass given{.yes = 0.5, .no = 0.0, .unknown = 0.5};
  /// Sightings in a row as one other type of point after which a track changes its type (default method).
  int sightings_to_change_type = 2;
};

/// \param before  what the names in a message are preceded by
/// \throws std::invalid_argument  for parameters out of their range, with the name, what was found and what is expected
void check(const TrackerParams& params, const std::string& before = "tracker: ");

/// Scenes over time -> tracks with belief (Clerentin et al., sec. 4). Knows no map. One scene is handled in this order:
/// predict, associate, then for what appeared start (any number of times), then update.
class Tracker {
 public:
  /// \throws std::invalid_argument for parameters out of their range
  explicit Tracker(const TrackerParams& params = {});
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  /// Where each track should be seen now.
  /// \param motion  T_previous_current of the base with covariance; without it, azimuths are extrapolated linearly.
  void predict(const std::optional<geometry::PoseEstimate>& motion);

  /// Sharpens the prediction of one track with knowledge from outside (a map and a predicted pose): the azimuth at
  /// which it should be seen in the coming scene, from the base origin. Between predict and associate. Under the
  /// default method walls are matched by their lines, which this leaves as they are.
  /// \param sigma_azimuth  of the landmark and the predicted pose together, without that of the coming observation
  ///   [rad]
  void expect(int track, double azimuth, double sigma_azimuth);
  /// The same for all that can be known of a point: its position in the base frame. [m, m^2]
  void expect_point(int track, const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance);

  /// Extended-open-world matching of the predictions with the scene's primitives, and their assignment.
  /// \returns the matches; what is in none of them has appeared (`appeared()`).
  const std::vector<Match>& associate(const perception::Scene& scene);
  /// Primitives of the latest scene that continue no track and that no undecided track may yet turn out to own, by
  /// index. Stays as it is while tracks are started.
  [[nodiscard]] const std::vector<int>& appeared() const;

  /// Starts a track with a primitive of the scene that was associated and that continues no track, unless its belief
  /// says NO more than YES.
  /// \param match_yes  how far the primitive is believed to be the landmark (m_m(YES)); 0 for a track without a
  ///   landmark
  /// \returns the index of the track, or nothing.
  std::optional<int> start(const perception::Scene& scene, int primitive, double match_yes, LandmarkId landmark);

  /// The initial matching that was given by hand: mass (.5, 0, .5) (Clerentin et al., sec. 5).
  int start_given(const perception::Scene& scene, int primitive, LandmarkId landmark);

  /// Gives a track another landmark, or none: a map match that has turned out wrong, or was found late.
  void relabel(int track, LandmarkId landmark);

  /// Beliefs, life cycle; drops the tracks that are believed not to exist. Indices change here, and only here; the
  /// order of the tracks is that of their ids. Of matched tracks the mass takes in the primitive and the match; a
  /// transition keeps it; total conflict under Dempster's rule keeps it.
  void update(const perception::Scene& scene);

  [[nodiscard]] const std::vector<Track>& tracks() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace credo::tracking
