#include "halfspace/solid_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "../src/crc32c.hpp"

namespace halfspace {
namespace {

/// A tetrahedron: three corners on the axes, and the origin as a meet.
SolidData tetrahedron() {
  SolidData data;
  data.unit = {10, -3};
  data.is_checked = true;
  data.points = {{5, 0, 0}, {0, 5, 0}, {0, 0, 5}};
  data.planes = {{{1, 0, 0}, {0, 0, 0}},
                 {{0, 1, 0}, {0, 0, 0}},
                 {{0, 0, 1}, {0, 0, 0}},
                 {{1, 1, 1}, {5, 0, 0}}};
  data.meets = {{0, 1, 2}};
  data.parts = {"", "a b#%\n.off"};
  data.origins = {{1, 7}, {0, 0}};
  data.faces = {{0, true, {1, 2, 3}, 0, 1},
                {1, true, {1, 2, 3}, 1, 1},
                {2, true, {1, 2, 3}, 0, 1},
                {3, false, {1, 2, 3}, 0, 1}};
  data.loops = {3, 3, 3, 3};
  data.corners = {{3, 1}, {2, 3}, {1, 2}, {3, 2}, {0, 3}, {2, 0},
                  {3, 0}, {1, 3}, {0, 1}, {0, 2}, {1, 0}, {2, 1}};
  return data;
}

constexpr SolidForm kForms[] = {SolidForm::kBinary, SolidForm::kText};

ErrorCode code_of(const SolidData& data) {
  const Result<SolidData> read =
      read_solid(write_solid(data, SolidForm::kBinary));
  return read ? ErrorCode::kEmpty : read.error().code;
}

TEST(SolidFile, BothFormsReadBack) {
  for (const SolidForm form : kForms) {
    const std::string bytes = write_solid(tetrahedron(), form);
    EXPECT_TRUE(is_solid_file(bytes));
    const Result<SolidData> read = read_solid(bytes);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, tetrahedron());
  }
}

/// The tetrahedron with a slit in a face, and a face without a colour.
SolidData second_version() {
  SolidData data = tetrahedron();
  data.faces[1].has_color = false;
  data.faces[1].color = {};
  data.faces[3].loop_count = 2;
  data.loops.push_back(2);
  data.corners.insert(data.corners.end(), {{1, 1}, {2, 0}});
  return data;
}

TEST(SolidFile, SlitsAndFacesWithoutColorsReadBack) {
  for (const SolidForm form : kForms) {
    const Result<SolidData> read =
        read_solid(write_solid(second_version(), form));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, second_version());
  }
  std::string text = write_solid(second_version(), SolidForm::kText);
  EXPECT_TRUE(text.starts_with("halfspace-solid 2\n"));
  EXPECT_NE(text.find("\nface 1 - - 1\n"), std::string::npos);
  // What has neither is of the first version, which has no such faces.
  EXPECT_TRUE(write_solid(tetrahedron(), SolidForm::kText)
                  .starts_with("halfspace-solid 1\n"));
  text = text.substr(0, text.rfind("checksum")) + "checksum -\n";
  EXPECT_TRUE(read_solid(text));
  text[std::string_view("halfspace-solid ").size()] = '1';
  const Result<SolidData> read = read_solid(text);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kSyntax);
}

TEST(SolidFile, TheChecksumIsThePublishedOne) {
  EXPECT_EQ(crc32c("123456789"), 0xE3069283u);
}

TEST(SolidFile, AnyChangedByteIsFound) {
  for (const SolidForm form : kForms) {
    const std::string bytes = write_solid(tetrahedron(), form);
    // The last byte of a text is its line feed.
    const std::size_t end = bytes.size() - (form == SolidForm::kText ? 1 : 0);
    for (std::size_t i = 0; i < end; ++i) {
      for (const int bit : {1, 4, 64}) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ bit);
        EXPECT_FALSE(read_solid(damaged)) << "byte " << i;
      }
    }
  }
}

TEST(SolidFile, AFileCutOffSaysSo) {
  for (const SolidForm form : kForms) {
    const std::string bytes = write_solid(tetrahedron(), form);
    for (std::size_t size = 15; size + 12 < bytes.size(); ++size) {
      const Result<SolidData> read = read_solid(bytes.substr(0, size));
      ASSERT_FALSE(read);
      EXPECT_EQ(read.error().code, ErrorCode::kTruncated) << size;
    }
  }
}

TEST(SolidFile, WithoutAChecksumNobodyVouches) {
  std::string text = write_solid(tetrahedron(), SolidForm::kText);
  text = text.substr(0, text.rfind("checksum")) + "checksum - # edited\n";
  const Result<SolidData> read = read_solid(text);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(read->is_checked);
}

TEST(SolidFile, ErrorsAreFoundWhateverTheChecksumSays) {
  const auto spoilt = [](auto&& spoil) {
    SolidData data = tetrahedron();
    spoil(data);
    return code_of(data);
  };
  using D = SolidData;
  EXPECT_EQ(spoilt([](D&) {}), ErrorCode::kEmpty);
  EXPECT_EQ(spoilt([](D& d) { d.points[0].x = 1 << 25; }),
            ErrorCode::kOutOfRange);
  EXPECT_EQ(spoilt([](D& d) { d.grid_bits = 27; }), ErrorCode::kOutOfRange);
  EXPECT_EQ(spoilt([](D& d) { d.unit.base = 3; }), ErrorCode::kOutOfRange);
  EXPECT_EQ(spoilt([](D& d) {
              d.planes[0].normal = {2, 0, 0};
            }),
            ErrorCode::kSyntax);
  EXPECT_EQ(spoilt([](D& d) {
              d.planes[0].normal = {-1, 0, 0};
            }),
            ErrorCode::kSyntax);
  EXPECT_EQ(spoilt([](D& d) { d.planes[0].normal = {}; }),
            ErrorCode::kZeroArea);
  EXPECT_EQ(spoilt([](D& d) {
              d.planes[0].normal = {1, 0, Int128{1} << 53};
            }),
            ErrorCode::kOutOfRange);
  EXPECT_EQ(spoilt([](D& d) { d.meets[0] = {0, 1, 0}; }), ErrorCode::kZeroArea);
  EXPECT_EQ(spoilt([](D& d) { d.meets[0] = {0, 1, 4}; }), ErrorCode::kBadIndex);
  EXPECT_EQ(spoilt([](D& d) { d.origins[0].part = 2; }), ErrorCode::kBadIndex);
  EXPECT_EQ(spoilt([](D& d) { d.faces[0].origin = 2; }), ErrorCode::kBadIndex);
  EXPECT_EQ(spoilt([](D& d) { d.faces[0].plane = 4; }), ErrorCode::kBadIndex);
  EXPECT_EQ(spoilt([](D& d) { d.corners[0].vertex = 4; }),
            ErrorCode::kBadIndex);
  EXPECT_EQ(spoilt([](D& d) { d.corners[0].plane = 0; }), ErrorCode::kBadIndex);
  EXPECT_EQ(spoilt([](D& d) { d.corners[0].plane = D::kNoPlane; }),
            ErrorCode::kSyntax);
  EXPECT_EQ(spoilt([](D& d) { d.corners[0].vertex = 2; }),
            ErrorCode::kRepeatedVertex);
  EXPECT_EQ(spoilt([](D& d) { d.loops[0] = 1; }), ErrorCode::kTooFewVertices);
  EXPECT_EQ(spoilt([](D& d) { d.faces[3].loop_count = 2; }),
            ErrorCode::kTooFewVertices);
  EXPECT_EQ(spoilt([](D& d) { d.corners.push_back({}); }), ErrorCode::kSyntax);
}

TEST(SolidFile, ALongListIsNotMadeRoomFor) {
  std::string bytes = write_solid(SolidData(), SolidForm::kBinary);
  // The count of the points, after the magic and five numbers.
  bytes.replace(11 + 20, 4, "\xff\xff\xff\x7f");
  const Result<SolidData> read = read_solid(bytes);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kTruncated);
}

}  // namespace
}  // namespace halfspace
