// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "datasets/staged_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/datasets/temporary_folder.hpp"

namespace credo::datasets {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

void allow(const fs::path&) {}
void refuse(const fs::path& there) { throw std::runtime_error(there.string() + " stays"); }

TEST(StagedFolder, AppearsWholeOrNotAtAll) {
  const TemporaryFolder folder;
  {
    const StagedFolder staged(folder / "set", refuse);
    std::ofstream(staged.path() / "half") << "x";
    EXPECT_FALSE(fs::exists(folder / "set"));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
  StagedFolder staged(folder / "set/", refuse);
  std::ofstream(staged.path() / "whole") << "x";
  staged.commit();
  EXPECT_TRUE(fs::exists(folder / "set/whole"));
}

TEST(StagedFolder, FoldersMadeAboveItGoWithIt) {
  const TemporaryFolder folder;
  folder.write("mine/file", "x");
  { const StagedFolder staged(folder / "mine/new/newer/set", refuse); }
  EXPECT_FALSE(fs::exists(folder / "mine/new"));
  EXPECT_TRUE(fs::exists(folder / "mine/file"));
  {
    const StagedFolder staged(folder / "mine/new/newer/set", refuse);
    folder.write("mine/new/note", "of somebody else");
  }
  EXPECT_FALSE(fs::exists(folder / "mine/new/newer"));
  EXPECT_TRUE(fs::exists(folder / "mine/new/note"));
  StagedFolder staged(folder / "kept/set", refuse);
  staged.commit();
  EXPECT_TRUE(fs::exists(folder / "kept/set"));
}

TEST(StagedFolder, WhatADeadProcessLeftIsRemoved) {
  const TemporaryFolder folder;
  folder.write(".set.unfinished/old", "x");
  StagedFolder staged(folder / "set", refuse);
  EXPECT_TRUE(fs::is_empty(staged.path()));
}

TEST(StagedFolder, WhatALivingOneWritesIsLeftAlone) {
  const TemporaryFolder folder;
  const StagedFolder first(folder / "set", allow);
  std::ofstream(first.path() / "half") << "x";
  EXPECT_THAT([&] { StagedFolder(folder / "set", allow); },
              ThrowsMessage<std::runtime_error>(HasSubstr("another process is writing")));
  EXPECT_TRUE(fs::exists(first.path() / "half"));
}

TEST(StagedFolder, WhatIsThereIsReplacedOnlyIfItMayBe) {
  const TemporaryFolder folder;
  folder.write("set/old", "x");
  EXPECT_THAT([&] { StagedFolder(folder / "set", refuse); }, ThrowsMessage<std::runtime_error>(HasSubstr("stays")));
  StagedFolder(folder / "set", allow).commit();
  EXPECT_TRUE(fs::is_empty(folder / "set"));
}

TEST(StagedFolder, WhatCameInTheMeantimeIsNotReplaced) {
  const TemporaryFolder folder;
  StagedFolder staged(folder / "set", refuse);
  folder.write("set/new", "x");
  EXPECT_THROW(staged.commit(), std::runtime_error);
  EXPECT_TRUE(fs::exists(folder / "set/new"));
}

TEST(StagedFolder, APlaceThatCannotBeMadeIsNamed) {
  const TemporaryFolder folder;
  folder.write("file", "x");
  EXPECT_THAT([&] { StagedFolder(folder / "file/set", allow); },
              ThrowsMessage<std::runtime_error>(HasSubstr("file/set: cannot be made")));
}

}  // namespace
}  // namespace credo::datasets
