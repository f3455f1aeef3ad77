#include "file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "samples.hpp"

namespace halfspace::io {
namespace {

using samples::raw_bytes;

/// The files in the folder of this one.
std::size_t count_beside(const std::filesystem::path& path) {
  const std::filesystem::directory_iterator files(path.parent_path());
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

std::filesystem::path beside(const std::filesystem::path& path) {
  return path.string() + ".part-" + std::to_string(getpid());
}

TEST(WriteFile, ReplacesTheFileAsAWhole) {
  const samples::TemporaryFile file("a");
  ASSERT_TRUE(write_file(file.path(), "before"));
  // Who has the file before still has all of it.
  const std::filesystem::path other = file.path().parent_path() / "other";
  std::filesystem::create_hard_link(file.path(), other);
  const std::string bytes("new\0bytes\n", 10);
  ASSERT_TRUE(write_file(file.path(), bytes));
  EXPECT_EQ(raw_bytes(file.path()), bytes);
  EXPECT_EQ(raw_bytes(other), "before");
  EXPECT_EQ(count_beside(file.path()), 2u);
}

TEST(WriteFile, WritesNothingAndMuch) {
  const samples::TemporaryFile file("a");
  ASSERT_TRUE(write_file(file.path(), ""));
  EXPECT_EQ(raw_bytes(file.path()), "");
  const std::string much(300000, 'x');
  ASSERT_TRUE(write_file(file.path(), much));
  EXPECT_EQ(raw_bytes(file.path()), much);
}

TEST(WriteFile, KeepsASymbolicLink) {
  const samples::TemporaryFile file("a");
  samples::write(file.path(), "before");
  const std::filesystem::path folder = file.path().parent_path();
  std::filesystem::create_symlink("a", folder / "relative");
  std::filesystem::create_symlink(folder / "relative", folder / "absolute");
  ASSERT_TRUE(write_file(folder / "absolute", "through"));
  EXPECT_EQ(raw_bytes(file.path()), "through");
  // To nothing yet, too.
  std::filesystem::remove(file.path());
  ASSERT_TRUE(write_file(folder / "absolute", "again"));
  EXPECT_EQ(raw_bytes(file.path()), "again");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "relative"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "absolute"));
  EXPECT_EQ(count_beside(file.path()), 3u);
}

TEST(WriteFile, WritesIntoAPipeInPlace) {
  const samples::TemporaryFile file("pipe");
  ASSERT_EQ(mkfifo(file.path().c_str(), 0600), 0);
  const int reader = open(file.path().c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  EXPECT_TRUE(write_file(file.path(), "piped"));
  char bytes[16];
  EXPECT_EQ(read(reader, bytes, sizeof bytes), 5);
  EXPECT_EQ(std::string(bytes, 5), "piped");
  close(reader);
  EXPECT_TRUE(std::filesystem::is_fifo(file.path()));
  EXPECT_EQ(count_beside(file.path()), 1u);
}

TEST(WriteFile, WritesIntoWhatIsOpen) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  EXPECT_TRUE(write_file("/dev/fd/" + std::to_string(ends[1]), "piped"));
  close(ends[1]);
  char bytes[16];
  EXPECT_EQ(read(ends[0], bytes, sizeof bytes), 5);
  EXPECT_EQ(std::string(bytes, 5), "piped");
  close(ends[0]);
}

TEST(WriteFile, WritesInPlaceWhereNothingCanBeBeside) {
  const samples::TemporaryFile file("a");
  samples::write(beside(file.path()), "of somebody else");
  ASSERT_TRUE(write_file(file.path(), "bytes"));
  EXPECT_EQ(raw_bytes(file.path()), "bytes");
  EXPECT_EQ(raw_bytes(beside(file.path())), "of somebody else");
}

TEST(WriteFile, LeavesWhatWasThereIfItFails) {
  const samples::TemporaryFile file("a");
  samples::write(file.path(), "before");
  const std::string why =
      file.path().string() + ": cannot be written: File too large";
  for (const std::size_t size : {11u, 100000u}) {
    const Result<Done> done = [&] {
      const samples::SmallFiles small(10);
      return write_file(file.path(), std::string(size, 'x'));
    }();
    samples::expect_error(done, ErrorCode::kUnwritable, why);
    EXPECT_EQ(raw_bytes(file.path()), "before");
    EXPECT_EQ(count_beside(file.path()), 1u);
  }
  const samples::SmallFiles small(10);
  EXPECT_TRUE(write_file(file.path(), "0123456789"));
}

TEST(WriteFile, LeavesNoHalfFileInPlace) {
  const samples::TemporaryFile file("a");
  samples::write(beside(file.path()), "");
  const Result<Done> done = [&] {
    const samples::SmallFiles small(10);
    return write_file(file.path(), "0123456789x");
  }();
  samples::expect_error(
      done, ErrorCode::kUnwritable,
      file.path().string() + ": cannot be written: File too large");
  EXPECT_FALSE(std::filesystem::exists(file.path()));
}

TEST(WriteFile, ComesToAnEndWhereLinksDoNot) {
  const samples::TemporaryFile file("a");
  std::filesystem::create_symlink("a", file.path());
  ASSERT_TRUE(write_file(file.path(), "bytes"));
  EXPECT_EQ(raw_bytes(file.path()), "bytes");
}

TEST(WriteFile, SaysWhyItCannot) {
  samples::expect_error(
      write_file("/nowhere/at/all", "x"), ErrorCode::kUnwritable,
      "/nowhere/at/all: cannot be written: No such file or directory");
  const samples::TemporaryFile file("a");
  std::filesystem::create_directory(file.path());
  samples::expect_error(
      write_file(file.path(), "x"), ErrorCode::kUnwritable,
      file.path().string() + ": cannot be written: Is a directory");
  EXPECT_TRUE(std::filesystem::is_directory(file.path()));
  EXPECT_EQ(count_beside(file.path()), 1u);
}

}  // namespace
}  // namespace halfspace::io
