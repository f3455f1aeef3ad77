#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/io/read_mesh.hpp"

/// Small files for the tests, made in code.
namespace halfspace::io::samples {

/// Puts the bytes of a value over those at `at`, the least first.
template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

template <class T>
void append(std::string& bytes, T value, bool big = false) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

struct FloatTriangle {
  std::array<float, 3> a, b, c;
};

inline std::string binary_stl(const std::vector<FloatTriangle>& triangles) {
  std::string bytes(80, ' ');
  append(bytes, static_cast<std::uint32_t>(triangles.size()));
  for (const FloatTriangle& triangle : triangles) {
    for (int i = 0; i < 3; ++i) append(bytes, 0.f);
    for (const auto& corner : {triangle.a, triangle.b, triangle.c}) {
      for (const float value : corner) append(bytes, value);
    }
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// Four vertices of doubles, a triangle and a quad with colours.
inline std::string binary_ply(bool big) {
  std::string bytes =
      std::string("ply\nformat binary_") + (big ? "big" : "little") +
      "_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nelement face 2\nproperty uchar red\n"
      "property list ushort int vertex_indices\nproperty uchar green\n"
      "property uchar blue\nend_header\n";
  for (const double value :
       {0.0, 0.0, 0.0, 1.5, 0.0, -2.25, 0.1, 1.0, 0.0, 1.0, 1.0, 1.0}) {
    append(bytes, value, big);
  }
  const auto face = [&](std::uint8_t red, std::vector<std::int32_t> corners) {
    append(bytes, red);
    append(bytes, static_cast<std::uint16_t>(corners.size()), big);
    for (const std::int32_t corner : corners) append(bytes, corner, big);
    append(bytes, static_cast<std::uint8_t>(red + 10));
    append(bytes, static_cast<std::uint8_t>(red + 20));
  };
  face(10, {0, 1, 2});
  face(40, {3, 2, 1, 0});
  return bytes;
}

/// One file of every kind.
inline std::vector<std::pair<std::string, Format>> small_files() {
  const std::string points = "0 0 0\n1.5 0 0\n0 -1e1 0\n0 0 .25\n";
  return {
      {"v 0 0 0\nv 1.5 0 0 1 0 .5\nv 0 -1e1 0\nvt 0 0\nv 0 0 .25\n"
       "f 1 2 3\nf 1/1 2/1 \\\n -1/1\n",
       Format::kObj},
      {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
       "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
       Format::kStl},
      {binary_stl({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                   {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}),
       Format::kStl},
      {"ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
       "property float y\nproperty float z\nelement face 2\n"
       "property list uchar int vertex_indices\nproperty uchar red\n"
       "property uchar green\nproperty uchar blue\nend_header\n" +
           points + "3 0 1 2 1 2 3\n3 0 2 3 4 5 6\n",
       Format::kPly},
      {binary_ply(false), Format::kPly},
      {binary_ply(true), Format::kPly},
      {"OFF\n4 2 0\n" + points + "3 0 1 2 1 2 3\n3 0 2 3 0.5 0.5 0.5\n",
       Format::kOff},
      {"COFF\n3 1 0\n0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n3 0 1 2\n",
       Format::kOff},
  };
}

inline std::optional<std::string> raw_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

inline void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A file in a folder of its own, gone with the object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name) {
    std::string folder =
        (std::filesystem::temp_directory_path() / "halfspace-XXXXXX").string();
    folder_ = mkdtemp(folder.data());
    path_ = folder_ / name;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { std::filesystem::remove_all(folder_); }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path folder_;
  std::filesystem::path path_;
};

/// While this lives, no file grows beyond so many bytes.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t most_bytes) {
    // The signal that tells of it would end the program.
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit small = before_;
    small.rlim_cur = most_bytes;
    setrlimit(RLIMIT_FSIZE, &small);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

/// Checks that there is this error, to the letter, and no value.
template <class T>
void expect_error(const Result<T>& result, ErrorCode code,
                  const std::string& message, std::int64_t index = -1) {
  ASSERT_FALSE(result) << message;
  EXPECT_EQ(result.error().code, code) << message;
  EXPECT_EQ(result.error().message, message);
  EXPECT_EQ(result.error().index, index) << message;
}

/// A bad file, and all that is said of it.
struct Refused {
  std::string bytes;
  ErrorCode code;
  std::string message;
  std::int64_t index;
};

inline void expect_refused(const std::vector<Refused>& cases, Format format) {
  for (const Refused& bad : cases) {
    SCOPED_TRACE(bad.bytes);
    expect_error(read_mesh(bad.bytes, format), bad.code, bad.message,
                 bad.index);
  }
}

}  // namespace halfspace::io::samples
