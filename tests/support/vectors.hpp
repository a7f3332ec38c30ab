// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

namespace credo::testing {

/// Golden vectors: files of the form of tests/data/vectors.json, whose `doc` explains it.

/// What an operation throws where a vector may expect the error 'total_conflict'.
struct TotalConflict : std::runtime_error {
  TotalConflict() : std::runtime_error("total_conflict") {}
};

/// Computes the `out` of a case from its `in`; nothing where it does not cover the case (a larger frame, say).
using Operation = std::function<std::optional<nlohmann::json>(const nlohmann::json& in)>;
using Operations = std::map<std::string, Operation>;

struct Tally {
  int run = 0;
  int failed = 0;
  int not_covered = 0;
  std::string first_failure;
};

/// The file that CREDO_VECTORS names, or the project's own.
inline std::string vectors_path() {
  const char* path = std::getenv("CREDO_VECTORS");
  return path != nullptr && *path != '\0' ? path : CREDO_SOURCE_DIR "/tests/data/vectors.json";
}

/// Where `actual` differs from `expected` by more than 1e-11 + 1e-9 |expected|; empty where it does not. A number that
/// one of two objects does not name is 0.
inline std::string difference(const nlohmann::json& expected, const nlohmann::json& actual,
                              const std::string& at = "out") {
  if (expected.is_object() && actual.is_object()) {
    static const nlohmann::json zero = 0.0;
    std::set<std::string> keys;
    for (const auto& [key, value] : expected.items()) keys.insert(key);
    for (const auto& [key, value] : actual.items()) keys.insert(key);
    for (const std::string& key : keys) {
      const std::string found = difference(expected.contains(key) ? expected[key] : zero,
                                           actual.contains(key) ? actual[key] : zero, at + "." + key);
      if (!found.empty()) return found;
    }
    return {};
  }
  if (expected.is_array() && actual.is_array() && expected.size() == actual.size()) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const std::string found = difference(expected[i], actual[i], at + "[" + std::to_string(i) + "]");
      if (!found.empty()) return found;
    }
    return {};
  }
  if (expected.is_number() && actual.is_number()) {
    const double want = expected.get<double>(), got = actual.get<double>();
    if (std::abs(got - want) <= 1e-11 + 1e-9 * std::abs(want)) return {};
  } else if (expected == actual) {
    return {};
  }
  return at + ": expected " + expected.dump() + ", got " + actual.dump();
}

/// Why a case fails; empty where it passes, nothing where it is not covered.
inline std::optional<std::string> run_case(const nlohmann::json& test, const Operation& operation) {
  const bool must_refuse = test.contains("error");
  try {
    const std::optional<nlohmann::json> out = operation(test.at("in"));
    if (!out) return std::nullopt;
    return must_refuse ? "expected the error " + test["error"].dump() : difference(test.at("out"), *out);
  } catch (const TotalConflict& error) {
    return must_refuse && test["error"] == error.what() ? std::string() : std::string("unexpected total conflict");
  } catch (const std::exception& error) {
    return std::string("threw: ") + error.what();
  }
}

/// Runs every case of the file whose operation is among `operations` and prints cases run, failed and not covered for
/// each operation of the file.
/// \throws std::runtime_error if the file cannot be read.
inline std::map<std::string, Tally> run_vectors(const std::string& path, const Operations& operations) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be opened; CREDO_VECTORS must name a file of golden vectors");
  const nlohmann::json vectors = nlohmann::json::parse(file);
  std::map<std::string, Tally> tallies;
  for (const auto& test : vectors.at("cases")) {
    Tally& tally = tallies[test.at("op").get<std::string>()];
    const auto operation = operations.find(test["op"].get<std::string>());
    const std::optional<std::string> failure =
        operation == operations.end() ? std::nullopt : run_case(test, operation->second);
    if (!failure) {
      ++tally.not_covered;
      continue;
    }
    ++tally.run;
    if (failure->empty()) continue;
    ++tally.failed;
    if (tally.first_failure.empty()) tally.first_failure = test.at("id").get<std::string>() + ": " + *failure;
  }
  std::printf("%s\n%-28s %6s %6s %12s\n", path.c_str(), "operation", "run", "failed", "not covered");
  for (const auto& [name, tally] : tallies) {
    std::printf("%-28s %6d %6d %12d%s%s\n", name.c_str(), tally.run, tally.failed, tally.not_covered,
                tally.failed > 0 ? "  first: " : "", tally.first_failure.c_str());
  }
  return tallies;
}

}  // namespace credo::testing
