#include "mesh/encode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "halfspace/io/number.hpp"
#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

/// A triangle and a quad, with or without colours.
struct FewFaces {
  std::vector<std::uint32_t> first_corner = {0, 3, 7};
  std::vector<VertexId> corners = {0, 1, 2, 3, 2, 1, 0};
  std::vector<Rgb> colors = {{1, 20, 255}, {0, 128, 64}};

  Faces plain() const { return {first_corner, corners, {}}; }
  Faces colored() const { return {first_corner, corners, colors}; }
};

const std::vector<std::string> kPoints = {"0 0 0", "1.5 0 0", "0 -1 0",
                                          "1 1 1e-5"};

TEST(Encode, WritesObjToTheLetter) {
  const FewFaces faces;
  EXPECT_EQ(obj_text(kPoints, faces.colored()),
            "# written by halfspace\nv 0 0 0\nv 1.5 0 0\nv 0 -1 0\n"
            "v 1 1 1e-5\nf 1 2 3\nf 4 3 2 1\n");
}

TEST(Encode, WritesOffToTheLetter) {
  const FewFaces faces;
  const std::string points = "OFF\n4 2 0\n0 0 0\n1.5 0 0\n0 -1 0\n1 1 1e-5\n";
  EXPECT_EQ(off_text(kPoints, faces.plain()), points + "3 0 1 2\n4 3 2 1 0\n");
  EXPECT_EQ(off_text(kPoints, faces.colored()),
            points + "3 0 1 2 1 20 255\n4 3 2 1 0 0 128 64\n");
}

std::string ply_start(const std::string& encoding, std::size_t points,
                      std::size_t faces, const std::string& length,
                      bool has_colors) {
  return "ply\nformat " + encoding +
         " 1.0\ncomment written by halfspace\nelement vertex " +
         std::to_string(points) +
         "\nproperty double x\nproperty double y\nproperty double z\n"
         "element face " +
         std::to_string(faces) + "\nproperty list " + length +
         " int vertex_indices\n" +
         (has_colors ? "property uchar red\nproperty uchar green\n"
                       "property uchar blue\n"
                     : "") +
         "end_header\n";
}

TEST(Encode, WritesPlyOfTextToTheLetter) {
  const FewFaces faces;
  const std::string points = "0 0 0\n1.5 0 0\n0 -1 0\n1 1 1e-5\n";
  EXPECT_EQ(ply_text(kPoints, faces.plain()),
            ply_start("ascii", 4, 2, "uchar", false) + points +
                "3 0 1 2\n4 3 2 1 0\n");
  EXPECT_EQ(ply_text(kPoints, faces.colored()),
            ply_start("ascii", 4, 2, "uchar", true) + points +
                "3 0 1 2 1 20 255\n4 3 2 1 0 0 128 64\n");
}

TEST(Encode, WritesPlyOfBytesToTheByte) {
  const FewFaces faces;
  const std::vector<DoublePoint> points = {{0, 0.1, -2}, {1e300, 5, 6}};
  for (const bool has_colors : {false, true}) {
    std::string want =
        ply_start("binary_little_endian", 2, 2, "uchar", has_colors);
    for (const double value : {0.0, 0.1, -2.0, 1e300, 5.0, 6.0}) {
      samples::append(want, value);
    }
    want += '\3';
    for (const int corner : {0, 1, 2}) samples::append(want, corner);
    if (has_colors) want += "\x01\x14\xff";
    want += '\4';
    for (const int corner : {3, 2, 1, 0}) samples::append(want, corner);
    if (has_colors) want += std::string("\0\x80\x40", 3);
    EXPECT_EQ(ply_binary(points, has_colors ? faces.colored() : faces.plain()),
              want);
  }
}

TEST(Encode, LengthsAreBytesWhereAllFitThem) {
  // The last entry is beyond the faces, and no face's end.
  const std::vector<VertexId> corners(1000);
  for (const std::uint32_t size : {255u, 256u}) {
    const std::vector<std::uint32_t> first = {0, 3, 3 + size, 6 + size, 1000};
    const Faces faces{std::span(first).first(4), corners, {}};
    const std::string length = size == 255 ? "uchar" : "uint";
    EXPECT_EQ(ply_text({}, faces).find(ply_start("ascii", 0, 3, length, false)),
              0u);
    std::string want = ply_start("binary_little_endian", 0, 3, length, false);
    for (const std::uint32_t corner_count : {3u, size, 3u}) {
      if (size == 255) {
        want += static_cast<char>(corner_count);
      } else {
        samples::append(want, corner_count);
      }
      want.append(4 * std::size_t{corner_count}, '\0');
    }
    EXPECT_EQ(ply_binary({}, faces), want);
  }
}

using FloatCorner = std::array<float, 3>;

/// What stands in the STL of one triangle: its normal and its corners.
std::array<FloatCorner, 4> written(const std::array<DoublePoint, 3>& corners) {
  const std::array<VertexId, 3> triangle = {0, 1, 2};
  const Result<std::string> bytes = stl_binary(corners, {&triangle, 1});
  std::array<FloatCorner, 4> values{};
  EXPECT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(bytes->size(), 134u);
  std::memcpy(&values, bytes->data() + 84, sizeof values);
  return values;
}

/// With the normal (2, 3, 6) in size and direction, before it is scaled.
TEST(Encode, NormalsOfAnStlHaveLengthOne) {
  const FloatCorner normal = {2.f / 7, 3.f / 7, 6.f / 7};
  const FloatCorner back = {-2.f / 7, -3.f / 7, -6.f / 7};
  const DoublePoint a = {1, -2, 5};
  const DoublePoint b = {4, -4, 5};
  const DoublePoint c = {1, 0, 4};
  EXPECT_EQ(written({a, b, c})[0], normal);
  EXPECT_EQ(written({b, c, a})[0], normal);
  EXPECT_EQ(written({c, a, b})[0], normal);
  EXPECT_EQ(written({a, c, b})[0], back);
  EXPECT_EQ(written({c, b, a})[0], back);
  EXPECT_EQ(written({a, b, c})[1], (FloatCorner{1, -2, 5}));
  EXPECT_EQ(written({a, b, c})[2], (FloatCorner{4, -4, 5}));
  EXPECT_EQ(written({a, b, c})[3], (FloatCorner{1, 0, 4}));
  // A small triangle has one, too; a triangle without area has none.
  const auto small = [](const DoublePoint& point) {
    return DoublePoint{point[0] / 1024, point[1] / 1024, point[2] / 1024};
  };
  EXPECT_EQ(written({small(a), small(b), small(c)})[0], normal);
  EXPECT_EQ(written({a, b, b})[0], (FloatCorner{}));
}

TEST(Encode, WritesStlToTheByte) {
  const std::vector<DoublePoint> points = {
      {0, 0, 0}, {0.1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::array<VertexId, 3>> triangles = {{0, 1, 2}, {3, 2, 0}};
  std::string want = "binary STL written by halfspace";
  want.resize(80, ' ');
  samples::append(want, 2);
  for (const float value :
       {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 0.1f, 0.f, 0.f, 0.f, 1.f, 0.f}) {
    samples::append(want, value);
  }
  want.append(2, '\0');
  for (const float value :
       {-1.f, 0.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 0.f, 0.f, 0.f, 0.f}) {
    samples::append(want, value);
  }
  want.append(2, '\0');
  const Result<std::string> bytes = stl_binary(points, triangles);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(*bytes, want);
}

TEST(Encode, RefusesWhatAnStlDoesNotHold) {
  std::vector<DoublePoint> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::array<VertexId, 3> triangle = {0, 1, 2};
  points[2][0] = -double{std::numeric_limits<float>::max()};
  EXPECT_TRUE(stl_binary(points, {&triangle, 1}));
  points[1][2] = 0x1p128;
  samples::expect_error(
      stl_binary(points, {&triangle, 1}), ErrorCode::kNotFinite,
      "vertex 1 has the coordinate 340282366920938463463374607431768211456."
      "000000, which no float holds",
      1);
  // Refused before any is looked at.
  samples::expect_error(
      stl_binary(points, {&triangle, std::size_t{1} << 32}),
      ErrorCode::kOutOfRange,
      "an STL holds at most 4294967295 triangles, not 4294967296");
}

/// Of any length: what words of 128 bits hold, and what they do not.
TEST(Encode, AllDigitsAreThoseOfTheDouble) {
  std::mt19937_64 random(4);
  std::size_t most = 0;
  for (int k = 0; k < 4000; ++k) {
    const auto digits = static_cast<double>(random() >> (11 + random() % 53));
    const int exponent = static_cast<int>(random() % 300) - 200;
    const double value =
        std::ldexp(random() % 2 != 0 ? digits : -digits, exponent);
    const std::string text = all_digits(value);
    const Result<Number> read = parse_number(text);
    ASSERT_TRUE(read) << text;
    EXPECT_EQ(*read, number_of(value)) << text;
    // No zero too many, but for that before the point.
    const bool has_point = text.find('.') != std::string::npos;
    if (has_point && text.find('e') == std::string::npos) {
      EXPECT_NE(text.back(), '0');
    }
    EXPECT_NE(text.substr(0, 2), "00");
    most = std::max(most, text.size());
  }
  EXPECT_GT(most, 150u);
  EXPECT_EQ(all_digits(-0.75), "-0.75");
  EXPECT_EQ(all_digits(0x1p-20), "9.5367431640625e-7");
  EXPECT_EQ(all_digits(1e22), "10000000000000000000000");
}

}  // namespace
}  // namespace halfspace::io
