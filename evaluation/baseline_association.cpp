// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evaluation/baseline_association.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tracking/assignment.hpp"

namespace credo::evaluation {
namespace {

/// The pairs of one track with their likelihood ratio against clutter.
struct Choice {
  std::size_t pair = 0;
  int observation = 0;
  double weight = 0.0;
};

/// Observations that are taken, of those that a later track still wants; with the summed weight of the joint events
/// that lead there. Growing, each set once.
using Taken = std::vector<int>;
using Layer = std::map<Taken, double>;

std::vector<std::vector<Choice>> choices_of(int tracks, std::span<const GatedPair> pairs, const JpdaParams& params) {
  std::vector<std::vector<Choice>> choices(static_cast<std::size_t>(tracks));
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const GatedPair& pair = pairs[k];
    const double density = std::exp(-0.5 * pair.distance_squared()) / std::sqrt(2.0 * std::numbers::pi * pair.variance);
    choices[static_cast<std::size_t>(pair.track)].push_back(
        {k, pair.observation, params.detection_probability * density / params.clutter_per_rad});
  }
  return choices;
}

/// `taken` and `observation`, without what no track from `track` on wants. \param last_wanted  by observation
Taken taken_with(Taken taken, int observation, std::size_t track, const std::vector<int>& last_wanted) {
  if (observation >= 0) taken.insert(std::ranges::upper_bound(taken, observation), observation);
  std::erase_if(taken, [&](int o) { return last_wanted[static_cast<std::size_t>(o)] < static_cast<int>(track); });
  return taken;
}

void keep_the_likeliest(Layer& layer, std::size_t most) {
  if (layer.size() <= most) return;
  std::vector<double> weights;
  for (const auto& [taken, weight] : layer) weights.push_back(weight);
  std::ranges::nth_element(weights, weights.end() - static_cast<std::ptrdiff_t>(most));
  const double least = weights[weights.size() - most];
  std::erase_if(layer, [least](const auto& state) { return state.second < least; });
}

/// What may become of a track in a state: every choice that is free, and none. `visit(choice or nullptr, weight,
/// next)`.
template <typename Visit>
void for_each_next(const Taken& taken, std::size_t track, const std::vector<Choice>& choices, double none,
                   const std::vector<int>& last_wanted, const Visit& visit) {
  visit(nullptr, none, taken_with(taken, -1, track + 1, last_wanted));
  for (const Choice& choice : choices)
    if (!std::ranges::binary_search(taken, choice.observation))
      visit(&choice, choice.weight, taken_with(taken, choice.observation, track + 1, last_wanted));
}

void normalise(Layer& layer) {
  double sum = 0.0;
  for (const auto& [taken, weight] : layer) sum += weight;
  for (auto& [taken, weight] : layer) weight /= sum;
}

}  // namespace

std::vector<int> nearest_neighbour(int tracks, std::span<const GatedPair> pairs) {
  std::vector<const GatedPair*> nearest(static_cast<std::size_t>(tracks), nullptr);
  for (const GatedPair& pair : pairs) {
    const GatedPair*& best = nearest[static_cast<std::size_t>(pair.track)];
    if (best == nullptr || pair.distance_squared() < best->distance_squared()) best = &pair;
  }
  std::vector<int> result;
  for (const GatedPair* pair : nearest) result.push_back(pair ? pair->observation : -1);
  return result;
}

std::vector<int> global_nearest_neighbour(int tracks, int observations, std::span<const GatedPair> pairs,
                                          double gate_squared) {
  std::vector<tracking::Candidate> candidates;
  for (const GatedPair& pair : pairs)
    candidates.push_back({pair.track, pair.observation, gate_squared - pair.distance_squared()});
  return tracking::Assigner().assign(tracks, observations, candidates);
}

std::vector<double> joint_probabilities(int tracks, int observations, std::span<const GatedPair> pairs,
                                        const JpdaParams& params) {
  const auto choices = choices_of(tracks, pairs, params);
  const double none = 1.0 - params.detection_probability * params.gate_probability;
  std::vector<int> last_wanted(static_cast<std::size_t>(observations), -1);
  for (const GatedPair& pair : pairs) {
    int& last = last_wanted[static_cast<std::size_t>(pair.observation)];
    last = std::max(last, pair.track);
  }

  std::vector<Layer> forward{{{Taken{}, 1.0}}};
  for (std::size_t track = 0; track < choices.size(); ++track) {
    Layer next_layer;
    for (const auto& [taken, weight] : forward[track])
      for_each_next(taken, track, choices[track], none, last_wanted,
                    [&](const Choice*, double factor, const Taken& next) { next_layer[next] += weight * factor; });
    keep_the_likeliest(next_layer, params.most_states);
    normalise(next_layer);
    forward.push_back(std::move(next_layer));
  }

  std::vector<double> probabilities(pairs.size(), 0.0);
  Layer backward = forward.back();
  for (auto& [taken, weight] : backward) weight = 1.0;
  for (std::size_t track = choices.size(); track-- > 0;) {
    Layer before;
    double total = 0.0;
    for (const auto& [taken, weight] : forward[track])
      for_each_next(taken, track, choices[track], none, last_wanted,
                    [&](const Choice* choice, double factor, const Taken& next) {
                      const auto rest = backward.find(next);
                      if (rest == backward.end()) return;
                      before[taken] += factor * rest->second;
                      total += weight * factor * rest->second;
                      if (choice) probabilities[choice->pair] += weight * factor * rest->second;
                    });
    for (const Choice& choice : choices[track]) probabilities[choice.pair] /= total;
    for (auto& [taken, weight] : before) weight /= total;
    backward = std::move(before);
  }
  return probabilities;
}

std::vector<int> joint_probabilistic(int tracks, int observations, std::span<const GatedPair> pairs, double at_least,
                                     const JpdaParams& params) {
  const std::vector<double> probabilities = joint_probabilities(tracks, observations, pairs, params);
  std::vector<double> beaten(static_cast<std::size_t>(tracks), 1.0);  // by track, first: that it has no observation
  for (std::size_t k = 0; k < pairs.size(); ++k) beaten[static_cast<std::size_t>(pairs[k].track)] -= probabilities[k];
  for (double& none : beaten) none = std::max(none, at_least);
  std::vector<int> result(static_cast<std::size_t>(tracks), -1);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto track = static_cast<std::size_t>(pairs[k].track);
    if (probabilities[k] <= beaten[track]) continue;
    beaten[track] = probabilities[k];
    result[track] = pairs[k].observation;
  }
  return result;
}

}  // namespace credo::evaluation
