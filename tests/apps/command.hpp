// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace credo::tests {

/// What a command said.
struct Answer {
  int status = -1;
  std::string out, error;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Runs the built command (CREDO_COMMAND) as a person does.
class Command : public testing::Test {
 protected:
  /// In the test's own folder.
  Answer credo(const std::string& arguments) const {
    const std::string line = "cd '" + folder_.string() + "' && '" CREDO_COMMAND "' " + arguments + " >.out 2>.error";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder_ / ".out"), text_of(folder_ / ".error")};
  }
  void write(const std::filesystem::path& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string read(const std::filesystem::path& name) const { return text_of(folder_ / name); }

  void write_fixture() const {
    write("ref.tum",
          "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 2 0 0 0 0 0.7071067811865476 0.7071067811865476\n"
          "3 2 1 0 0 0 0.7071067811865476 0.7071067811865476\n4 2 2 0 0 0 1 0\n");
    write("est.tum",
          "0 0.1 0 0 0 0 0 1\n1 1.1 0.1 0 0 0 0.009999833334166664 0.9999500004166653\n"
          "2 2.0 0.1 0 0 0 0.6892099936627883 0.7245616499893844\n"
          "3 2.1 1.0 0 0 0 0.7071067811865476 0.7071067811865476\n"
          "4 2.1 2.2 0 0 0 0.9987502603949663 0.04997916927067834\n");
  }
  /// A room without a camera: quick to simulate.
  void write_small_world() const {
    write("small.yaml",
          "format: credo-world/1\nname: small\ndescription: one room (simulated)\n"
          "building:\n  rooms:\n    - outline: [[0, 0], [4, 0], [4, 3], [2.5, 3], [2.5, 2.4], [0, 2.4]]\n"
          "path: [[0.8, 0.8], [3.0, 0.9], [3.2, 2.0]]\ndrive: {mode: stop_and_go, step: 0.3, pause: 0.4}\n"
          "sensors:\n  range_finders:\n    - {preset: opensimple, pose: [0.05, 0, 0], height: 0.8}\n"
          "  sonars:\n    - {preset: pioneer-16, rate: 5}\n  odometry: {rate: 10}\n");
  }

  TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path();
};

}  // namespace credo::tests
