#include "halfspace/io/file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "mesh/samples.hpp"

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

TEST(WriteFile, KeepsThePermissions) {
  const samples::TemporaryFile file("a");
  samples::write(file.path(), "before");
  for (const mode_t mode : {0600u, 0640u, 0755u}) {
    ASSERT_EQ(chmod(file.path().c_str(), mode), 0);
    ASSERT_TRUE(write_file(file.path(), "after"));
    struct stat status {};
    ASSERT_EQ(stat(file.path().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777u, mode);
  }
}

TEST(WriteFile, PacksWhatEndsInGz) {
  const samples::TemporaryFile file("a.gz");
  for (const std::string& bytes :
       {std::string(), std::string("bytes"), std::string(3u << 20, 'x')}) {
    ASSERT_TRUE(write_file(file.path(), bytes));
    EXPECT_EQ(raw_bytes(file.path())->substr(0, 2), "\x1f\x8b");
    const Result<std::string> read = read_file(file.path());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, bytes);
  }
}

TEST(NewFile, IsNotThereUntilItIsFinished) {
  const samples::TemporaryFile file("a");
  samples::write(file.path(), "before");
  {
    NewFile begun(file.path());
    ASSERT_NE(begun.stream(), nullptr);
    std::fputs("half", begun.stream());
    EXPECT_EQ(begun.written_path(), part_name(file.path()));
    EXPECT_TRUE(std::filesystem::exists(part_name(file.path())));
  }
  EXPECT_EQ(count_beside(file.path()), 1u);
  EXPECT_EQ(raw_bytes(file.path()), "before");
  NewFile failed(file.path());
  samples::expect_error(
      failed.finish("no more paper"), ErrorCode::kUnwritable,
      file.path().string() + ": cannot be written: no more paper");
  EXPECT_EQ(count_beside(file.path()), 1u);
}

TEST(ReadFile, StopsAtTheLimitAndNamesTheFile) {
  const samples::TemporaryFile file("a");
  samples::write(file.path(), "12345");
  EXPECT_TRUE(read_file(file.path(), 5));
  samples::expect_error(read_file(file.path(), 4), ErrorCode::kOutOfRange,
                        file.path().string() + ": has more than 4 bytes");
  samples::expect_error(read_file("/dev/zero", 3u << 20),
                        ErrorCode::kOutOfRange,
                        "/dev/zero: has more than 3 MiB");
  samples::expect_error(read_file("/dev/zero"), ErrorCode::kOutOfRange,
                        "/dev/zero: has more than 16 MiB");
}

TEST(ReadFile, StopsWhereItIsAskedTo) {
  const samples::TemporaryFile plain("a");
  samples::write(plain.path(), std::string(5u << 20, 'x'));
  const samples::TemporaryFile packed("a.gz");
  ASSERT_TRUE(write_file(packed.path(), std::string(5u << 20, 'x')));
  for (const auto& path : {plain.path(), packed.path()}) {
    int all = 0;
    ASSERT_TRUE(read_file(path, kMostFileBytes, [&] {
      ++all;
      return false;
    }));
    EXPECT_GE(all, 5) << path;
    for (int at = 1; at <= all; ++at) {
      int asked = 0;
      const auto read =
          read_file(path, kMostFileBytes, [&] { return ++asked == at; });
      ASSERT_FALSE(read);
      EXPECT_EQ(read.error().code, ErrorCode::kStopped);
      EXPECT_EQ(asked, at);
    }
  }
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
