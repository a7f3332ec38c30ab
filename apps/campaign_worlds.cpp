// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/campaign_worlds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "apps/shipped.hpp"
#include "datasets/nearest_word.hpp"
#include "sim/random_world.hpp"

namespace credo::apps {
namespace {

constexpr std::string_view kOfAKind = "random:";  // and the kind

/// The kind in random:KIND; nothing for another world.
std::optional<std::string> kind_in(const std::string& world) {
  return world.starts_with(kOfAKind) ? std::optional(world.substr(kOfAKind.size())) : std::nullopt;
}

std::string complaint_about_kind(const std::string& world, const std::string& kind) {
  std::vector<std::string> known;
  for (const sim::BuildingKind one : sim::building_kinds()) known.emplace_back(sim::name_of(one));
  if (std::find(known.begin(), known.end(), kind) != known.end()) return "";
  const auto nearest = datasets::nearest_word(kind, known);
  return fmt::format("{}: no such kind of building{}; kinds are: {}", world,
                     nearest ? fmt::format("; did you mean '{}{}'?", kOfAKind, *nearest) : "", fmt::join(known, " "));
}

}  // namespace

bool is_drawn(const std::string& world) { return world == kRandomWorld || kind_in(world); }

std::string complaint_about_world(const std::string& world) {
  if (const auto kind = kind_in(world)) return complaint_about_kind(world, *kind);
  if (is_drawn(world)) return "";
  try {
    (void)find_shipped(world, kWorlds);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

sim::World campaign_world(const std::string& world, std::uint64_t seed) {
  if (!is_drawn(world)) return sim::load_world(find_shipped(world, kWorlds));
  sim::RandomWorldParams params;
  if (const auto kind = kind_in(world)) params.kind = sim::building_kind(*kind);
  return sim::random_world(seed, params);
}

}  // namespace credo::apps
