#include <gtest/gtest.h>

#include "halfspace/io/picture.hpp"
#include "picture/join_parts.hpp"
#include "picture/npy.hpp"

namespace halfspace::io {
namespace {

using samples::expect_error;
using samples::Paths;
using samples::raw_bytes;

using NpyParts = samples::JoinTest;

ItemImage items(std::int32_t width_px, std::int32_t height_px,
                PolygonId first) {
  ItemImage image(width_px, height_px, kBackground);
  for (PolygonId& id : image.pixels) id = 7919 * first++;
  return image;
}

TEST_F(NpyParts, MakeTheWholeImage) {
  // Some are more than is copied at once.
  const std::int32_t rows[] = {1, 300, 2, 64, 256};
  Paths parts;
  std::int32_t first = 0;
  for (const std::int32_t count : rows) {
    parts.push_back(at(std::to_string(first) + ".npy"));
    ASSERT_TRUE(write_npy(parts.back(), items(101, count, 101 * first)));
    first += count;
  }
  ASSERT_TRUE(write_npy(at("want.npy"), items(101, first, 0)));
  expect_whole(join_npy(parts, path()), 101, 623, raw_bytes(at("want.npy")));
}

TEST_F(NpyParts, FitTogether) {
  ASSERT_TRUE(write_npy(at("a.npy"), items(1, 65535, 0)));
  ASSERT_TRUE(write_npy(at("b.npy"), items(1, 1, 0)));
  ASSERT_TRUE(write_npy(at("c.npy"), items(2, 1, 0)));
  const Result<JoinedSize> size = join_npy({at("a.npy"), at("b.npy")}, path());
  ASSERT_TRUE(size) << size.error().message;
  EXPECT_EQ(size->height_px, 65536);
  std::filesystem::remove(path());
  expect_error(
      join_npy({at("a.npy"), at("b.npy"), at("b.npy")}, path()),
      ErrorCode::kOutOfRange,
      about(at("b.npy"), "with this the image has more than 65536 rows"), 2);
  expect_error(join_npy({at("b.npy"), at("c.npy")}, path()),
               ErrorCode::kOutOfRange,
               about(at("c.npy"), "has 2 columns, the parts before it 1"), 1);
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(NpyParts, HaveTheSizeThatTheySay) {
  ASSERT_TRUE(write_npy(at("good.npy"), items(3, 5, 0)));
  const std::string good = *raw_bytes(at("good.npy"));
  ASSERT_EQ(good.size(), 188u);
  const auto join = [&](const std::string& bytes) {
    samples::write(at("a.npy"), bytes);
    return join_npy({at("good.npy"), at("a.npy")}, path());
  };
  expect_error(join(good + "x"), ErrorCode::kSyntax,
               about(at("a.npy"), "has 189 bytes, not 188"), 1);
  expect_error(join(good.substr(0, 187)), ErrorCode::kSyntax,
               about(at("a.npy"), "has 187 bytes, not 188"), 1);
  expect_error(join(good.substr(0, 127)), ErrorCode::kTruncated,
               about(at("a.npy"), "the file ends in its header"), 1);
  expect_error(join("PK"), ErrorCode::kUnknownFormat,
               about(at("a.npy"), "this is no NumPy array"), 1);
  expect_error(join(""), ErrorCode::kUnreadable,
               about(at("a.npy"), "cannot be read"), 1);
  std::filesystem::remove(at("a.npy"));
  std::filesystem::create_directory(at("a.npy"));
  expect_error(join_npy({at("a.npy")}, path()), ErrorCode::kUnreadable,
               about(at("a.npy"), "cannot be read"), 0);
  expect_error(join_npy({at("none.npy")}, path()), ErrorCode::kUnreadable,
               about(at("none.npy"), "cannot be read"), 0);
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(NpyParts, HaveHeadersOfAPage) {
  for (const std::size_t size : {4096u, 4097u}) {
    std::string header =
        "{'descr': '<i4', 'fortran_order': False, 'shape': (1, 1), }";
    header.resize(size - 10, ' ');
    std::string bytes = "\x93NUMPY\x01";
    bytes += '\0';
    samples::append(bytes, static_cast<std::uint16_t>(header.size()));
    bytes += header;
    samples::append(bytes, 5);
    samples::write(at("a.npy"), bytes);
    const Result<JoinedSize> joined = join_npy({at("a.npy")}, path());
    if (size == 4097) {
      expect_error(joined, ErrorCode::kTruncated,
                   about(at("a.npy"), "the file ends in its header"), 0);
      continue;
    }
    ASSERT_TRUE(joined) << joined.error().message;
    EXPECT_EQ(raw_bytes(path()), npy_header(1, 1) + std::string("\5\0\0", 4));
  }
}

TEST_F(NpyParts, LeaveNothingWhereTheWholeCannotBeWritten) {
  ASSERT_TRUE(write_npy(at("few.npy"), items(3, 2, 0)));
  ASSERT_TRUE(write_npy(at("many.npy"), items(300, 200, 0)));
  expect_error(join_npy({at("few.npy")}, "/nowhere/at/all.npy"),
               ErrorCode::kUnwritable,
               "/nowhere/at/all.npy: cannot be written: No such file or "
               "directory");
  for (const char* part : {"few.npy", "many.npy"}) {
    const Result<JoinedSize> joined = [&] {
      const samples::SmallFiles small(140);
      return join_npy({at(part)}, path());
    }();
    expect_error(joined, ErrorCode::kUnwritable,
                 about(path(), "cannot be written: File too large"));
    EXPECT_FALSE(std::filesystem::exists(path()));
  }
  std::filesystem::create_symlink("/dev/full", path());
  expect_error(join_npy({at("few.npy")}, path()), ErrorCode::kUnwritable,
               about(path(), "cannot be written: No space left on device"));
  EXPECT_TRUE(std::filesystem::is_symlink(path()));
}

}  // namespace
}  // namespace halfspace::io
