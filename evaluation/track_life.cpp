// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/track_life.hpp"

#include <algorithm>
#include <cassert>
#include <map>

namespace credo::evaluation {
namespace {

using perception::PrimitiveType;
using results::TrackSample;

bool is_seen(const TrackSample& sample) { return sample.state == tracking::TrackState::kTracked; }

}  // namespace

std::vector<TrackSample> TrackLife::with_loss() const {
  std::vector<TrackSample> all = samples;
  if (!lost_with) return all;
  all.push_back(samples.back());
  all.back().existence = *lost_with;
  all.back().state = tracking::TrackState::kMissed;
  return all;
}

std::size_t TrackLife::last_seen() const {
  const auto last = std::find_if(samples.rbegin(), samples.rend(), is_seen);
  return first + static_cast<std::size_t>(samples.rend() - last) - 1;
}

int TrackLife::sightings() const { return static_cast<int>(std::count_if(samples.begin(), samples.end(), is_seen)); }

int TrackLife::until_lost() const {
  assert(lost_with);
  return static_cast<int>(first + samples.size() - last_seen());
}

bool TrackLife::was_wall_between() const {
  const auto is_wall = [](const TrackSample& sample) { return sample.type == PrimitiveType::kWall; };
  const auto junction = std::find_if_not(samples.begin(), samples.end(), is_wall);
  const auto wall = std::find_if(junction, samples.end(), is_wall);
  return std::find_if_not(wall, samples.end(), is_wall) != samples.end();
}

std::vector<TrackLife> track_lives(std::span<const results::Moment> history,
                                   const evidence::TrackBeliefParams& params) {
  std::map<int, TrackLife> lives;
  for (std::size_t i = 0; i < history.size(); ++i) {
    for (const TrackSample& sample : history[i].tracks) {
      TrackLife& life = lives.try_emplace(sample.id, TrackLife{sample.id, i, {}, {}}).first->second;
      life.samples.push_back(sample);
    }
  }
  std::vector<TrackLife> result;
  for (auto& [id, life] : lives) {
    if (life.first + life.samples.size() < history.size()) {
      const auto missed = evidence::miss_track(life.samples.back().existence, params);
      if (missed && !missed->keep) life.lost_with = missed->mass;
    }
    result.push_back(std::move(life));
  }
  return result;
}

}  // namespace credo::evaluation
