#include "work/recent.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <string>

namespace halfspace::viewer {
namespace {

namespace fs = std::filesystem;

TEST(Recent, TheLastOpenedIsFirstAndOnceAndADozenIsKept) {
  const fs::path folder = fs::temp_directory_path() /
                          ("halfspace-recent-" + std::to_string(::getpid()));
  const fs::path file = folder / "deep" / "recent";
  EXPECT_TRUE(read_recent(file).empty());
  for (int i = 0; i < 20; ++i) note_recent(file, "/a/" + std::to_string(i));
  note_recent(file, "/a/15");
  note_recent(file, "/two\nlines");
  const auto names = read_recent(file);
  ASSERT_EQ(names.size(), 12u);
  EXPECT_EQ(names[0], "/a/15");
  EXPECT_EQ(names[1], "/a/19");
  EXPECT_EQ(std::count(names.begin(), names.end(), "/a/15"), 1);
  fs::remove_all(folder);
}

TEST(Recent, WhatCannotBeWrittenDoesNoHarm) {
  note_recent("/proc/no/such/file", "/a");
  note_recent({}, "/a");
  EXPECT_TRUE(read_recent("/proc/no/such/file").empty());
}

}  // namespace
}  // namespace halfspace::viewer
