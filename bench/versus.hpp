// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

namespace credo::bench {

/// Upper median of what was measured. Precondition: not empty.
[[nodiscard]] inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <typename Work>
[[nodiscard]] double seconds_of(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Times ours and the peer in turn, round by round, so that what slows the machine down slows both. The time reported
/// is that of our part of a round; counters: the median times of a call, the median over the rounds of peer / ours, how
/// many times as fast we are, and the same of the fastest rounds of both, as on a machine that has nothing else to do.
/// For benchmarks that `UseManualTime`.
/// \param calls  of ours and of the peer that a round is made of
template <typename Ours, typename Peer>
void versus(benchmark::State& state, int calls, const Ours& ours, const std::string& peer_name, const Peer& peer) {
  ours();  // makes tiles, tables and working memory
  peer();
  std::vector<double> our_us, peer_us, ratios;
  for (auto _ : state) {
    const double our_time = seconds_of(ours), peer_time = seconds_of(peer);
    state.SetIterationTime(our_time);
    our_us.push_back(1e6 * our_time / calls);
    peer_us.push_back(1e6 * peer_time / calls);
    ratios.push_back(peer_time / our_time);
  }
  state.counters["ours_us"] = median(our_us);
  state.counters[peer_name + "_us"] = median(peer_us);
  state.counters[peer_name + "/ours"] = median(ratios);
  state.counters[peer_name + "/ours_best"] = std::ranges::min(peer_us) / std::ranges::min(our_us);
  state.counters["ours_best_us"] = std::ranges::min(our_us);
}

/// The same without a peer.
template <typename Ours>
void alone(benchmark::State& state, int calls, const Ours& ours) {
  ours();
  std::vector<double> our_us;
  for (auto _ : state) {
    const double our_time = seconds_of(ours);
    state.SetIterationTime(our_time);
    our_us.push_back(1e6 * our_time / calls);
  }
  state.counters["ours_us"] = median(our_us);
}

}  // namespace credo::bench
