// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "datasets/format_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace credo::datasets {

using tests::TemporaryFolder;

inline std::string read_all(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Replaces the one `from` in a file by `to`; the test fails where it is not there.
inline void replace_in(const std::filesystem::path& file, std::string_view from, std::string_view to) {
  std::string content = read_all(file);
  const auto at = content.find(from);
  ASSERT_NE(at, std::string::npos) << file << " does not hold " << from;
  content.replace(at, from.size(), to);
  std::ofstream(file, std::ios::binary) << content;
}

/// The message of the FormatError that `action` throws; empty where it throws none.
template <typename Action>
std::string complaint(const Action& action) {
  try {
    action();
  } catch (const FormatError& error) {
    return error.what();
  }
  return {};
}

}  // namespace credo::datasets
