#include <gtest/gtest.h>
#include <zlib.h>

#include "halfspace/io/file.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

using samples::expect_error;

TEST(ReadErrors, OfGzippedFilesAreToTheLetter) {
  using enum ErrorCode;
  const samples::TemporaryFile file("a.off.gz");
  const auto pack = [&](const std::string& bytes) {
    gzFile packed = gzopen(file.path().c_str(), "wb");
    gzwrite(packed, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(packed);
    return *samples::raw_bytes(file.path());
  };
  // More than is unpacked at once, in two members.
  const std::string comment = "#" + std::string(3 << 20, 'x') + "\n";
  const std::string first = pack("OFF\n" + comment + "3 1\n0 0 0\n1 0");
  const std::string second = pack(" 0\n0 1 0\n" + comment + "3 0 1 2\n");
  samples::write(file.path(), first + second + "padding");
  const Result<std::string> text = read_file(file.path());
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text, "OFF\n" + comment + "3 1\n0 0 0\n1 0 0\n0 1 0\n" + comment +
                       "3 0 1 2\n");
  const std::string name = file.path().string() + ": ";
  samples::write(file.path(), first + second.substr(0, 10));
  expect_error(read_file(file.path()), kTruncated,
               name + "the gzipped data ends too early",
               static_cast<std::int64_t>(comment.size()) + 17);
  std::string damaged = pack("OFF\n");
  damaged[10] = '\7';  // a block of a kind that is none
  samples::write(file.path(), damaged);
  expect_error(read_file(file.path()), kSyntax,
               name + "the gzipped data is damaged: invalid block type", 0);
  expect_error(read_mesh(file.path()), kSyntax,
               name + "the gzipped data is damaged: invalid block type", 0);
}

TEST(ReadErrors, OfFilesAreToTheLetter) {
  using enum ErrorCode;
  const samples::TemporaryFile file("A.OFF");
  const std::string name = file.path().string() + ": ";
  expect_error(read_mesh(file.path()), kUnreadable,
               name + "cannot be read: No such file or directory");
  samples::write(file.path(), "");
  expect_error(read_mesh(file.path()), kEmpty, name + "the file is empty", 0);
  std::filesystem::remove(file.path());
  std::filesystem::create_directory(file.path());
  expect_error(read_mesh(file.path()), kUnreadable,
               name + "cannot be read: Is a directory");
  expect_error(read_mesh("/a/b.step"), kUnknownFormat,
               "/a/b.step: a mesh file ends in .obj, .stl, .ply, .off, .3mf, "
               ".glb or .gltf, "
               "perhaps with .gz after it");
  expect_error(read_mesh("x", static_cast<Format>(99)), kUnknownFormat,
               "the format is unknown");
  // A file of as much as is read at once, and of more.
  for (const std::size_t size : {std::size_t{1} << 20, std::size_t{2500000}}) {
    const samples::TemporaryFile large("large");
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i)
      bytes[i] = static_cast<char>(i % 251);
    samples::write(large.path(), bytes);
    const Result<std::string> back = read_file(large.path());
    ASSERT_TRUE(back);
    EXPECT_TRUE(*back == bytes);
  }
  for (const char* known : {"a.AZ", "a.off.Z"}) EXPECT_FALSE(format_of(known));
}

TEST(ReadErrors, OfNumbersBeyondDoublesNameTheLine) {
  const std::string large = "1e400";
  const std::string said =
      "'1e400' is beyond the greatest double, about 1.8 * "
      "10^308";
  const struct {
    Format format;
    std::string text;
    int line;
  } cases[] = {
      {Format::kOff, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 " + large + "\n", 5},
      {Format::kObj, "v 0 0 0\nv 1 0 0\nv 0 1 " + large + "\n", 3},
      {Format::kStl,
       "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 " + large + "\n",
       4},
      {Format::kPly,
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
       "property float y\nproperty float z\nelement face 0\n"
       "property list uchar int vertex_indices\nend_header\n0 0 " +
           large + "\n",
       10},
  };
  for (const auto& each : cases) {
    const auto mesh = read_mesh(each.text, each.format);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, ErrorCode::kOutOfRange);
    EXPECT_EQ(mesh.error().index, each.line);
    EXPECT_TRUE(mesh.error().message.ends_with(
        "line " + std::to_string(each.line) + ": " + said))
        << mesh.error().message;
  }
}

}  // namespace
}  // namespace halfspace::io
