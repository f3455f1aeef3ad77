// The side of the seam without a file system, as in a browser. A program of its
// own: it has the functions of src/base/file.cpp a second time.
#include <gtest/gtest.h>

#include "halfspace/io/file.hpp"
#include "halfspace/io/memory_files.hpp"

namespace halfspace::io {
namespace {

TEST(FileMemory, WhatIsPutIsReadAndWhatIsWrittenIsTaken) {
  put_file("a.stl", "bytes");
  const auto read = read_file("a.stl");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, "bytes");
  ASSERT_TRUE(write_file("b/c.obj", std::string("v\0w", 3)));
  EXPECT_EQ(take_file("b/c.obj"), std::string("v\0w", 3));
  EXPECT_EQ(take_file("b/c.obj"), std::nullopt);
  put_file("a.stl", "others");
  EXPECT_EQ(*read_file("a.stl"), "others");
  EXPECT_EQ(take_file("a.stl"), "others");
}

TEST(FileMemory, TellsWhatIsNotThereTooLargeOrPacked) {
  const auto missing = read_file("none.obj");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kUnreadable);
  EXPECT_EQ(missing.error().message,
            "none.obj: cannot be read: no such file in memory");
  put_file("large", "12345");
  EXPECT_EQ(read_file("large", 4).error().code, ErrorCode::kOutOfRange);
  EXPECT_TRUE(read_file("large", 5));
  put_file("packed", "\x1f\x8b");
  EXPECT_EQ(read_file("packed").error().code, ErrorCode::kUnknownFormat);
  EXPECT_EQ(write_file("x.obj.gz", "").error().code, ErrorCode::kUnwritable);
  take_file("large");
  take_file("packed");
}

}  // namespace
}  // namespace halfspace::io
