// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "perception/observer.hpp"
#include "tracking/track.hpp"

namespace credo::tracking {

struct TrackerParams {  // the owner of this file completes it
  perception::Method method = perception::Method::kDefault;
};

/// Scenes over time -> tracks with belief (Clerentin et al., sec. 4). Knows no map. One scene is handled in this order:
/// predict, associate, then for what appeared start (any number of times), then update.
class Tracker {
 public:
  explicit Tracker(const TrackerParams& params = {});
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  /// Where each track should be seen now.
  /// \param motion  T_previous_current of the base with covariance; without it, azimuths are extrapolated linearly.
  void predict(const std::optional<geometry::PoseEstimate>& motion);

  /// Sharpens the prediction of one track with knowledge from outside (a map and a predicted pose): the azimuth at which it
  /// should be seen in the coming scene. Between predict and associate.
  void expect(int track, double azimuth, double sigma_azimuth);

  /// Extended-open-world matching of the predictions with the scene's primitives, and their assignment.
  /// \returns the matches; what is in none of them has appeared (`appeared()`).
  const std::vector<Match>& associate(const perception::Scene& scene);
  /// Primitives of the latest scene that continue no track, by index.
  [[nodiscard]] const std::vector<int>& appeared() const;

  /// Starts a track with an appeared primitive, unless its belief says NO more than YES.
  /// \param match_yes  how far the primitive is believed to be the landmark (m_m(YES)); 0 for a track without a landmark
  /// \returns the index of the track, or nothing.
  std::optional<int> start(const perception::Scene& scene, int primitive, double match_yes, LandmarkId landmark);

  /// The initial matching that was given by hand: mass (.5, 0, .5) (Clerentin et al., sec. 5).
  int start_given(const perception::Scene& scene, int primitive, LandmarkId landmark);

  /// Gives a track another landmark, or none: a map match that has turned out wrong, or was found late.
  void relabel(int track, LandmarkId landmark);

  /// Beliefs, life cycle; drops the tracks that are believed not to exist. Indices change here.
  void update(const perception::Scene& scene);

  [[nodiscard]] const std::vector<Track>& tracks() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace credo::tracking
