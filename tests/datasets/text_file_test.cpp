// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/text_file.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <stdexcept>

#include "tests/datasets/temporary_folder.hpp"

namespace credo::datasets {
namespace {

std::ptrdiff_t files_in(const TemporaryFolder& folder) {
  return std::distance(std::filesystem::directory_iterator(folder.path()), {});
}

TEST(WriteFileWhole, OfTwoWritersAtOnceNeitherSpoilsTheOthersFile) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "table.csv";
  write_file_whole(file, [&](std::ostream& out) {
    out << "first";
    write_file_whole(file, "second, and longer");
    EXPECT_EQ(read_text_file(file), "second, and longer");
    out << " of all";
  });
  EXPECT_EQ(read_text_file(file), "first of all");
  EXPECT_EQ(files_in(folder), 1);
}

TEST(WriteFileWhole, WhatIsLeftOfAWriterThatDiedIsInNobodysWay) {
  const TemporaryFolder folder;
  folder.write("table.csv.0.partial", "half");
  write_file_whole(folder / "table.csv", "whole");
  EXPECT_EQ(read_text_file(folder / "table.csv"), "whole");
}

TEST(WriteFileWhole, WhatWasThereStaysWhereItsWriterFails) {
  const TemporaryFolder folder;
  folder.write("table.csv", "before");
  EXPECT_THROW(write_file_whole(folder / "table.csv", [](std::ostream&) { throw std::runtime_error("no more"); }),
               std::runtime_error);
  EXPECT_EQ(read_text_file(folder / "table.csv"), "before");
  EXPECT_EQ(files_in(folder), 1);
}

}  // namespace
}  // namespace credo::datasets
