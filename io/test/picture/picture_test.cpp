#include "halfspace/io/picture.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <vector>

#include "mesh/samples.hpp"

namespace halfspace::io {
namespace {

/// The pixels of a file, read by the library's own reader.
std::vector<std::uint8_t> pixels_of(const std::filesystem::path& path,
                                    png_uint_32 format) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) return {};
  png.format = format;
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr) == 0)
    return {};
  return bytes;
}

TEST(WritePng, HoldsThePixels) {
  ColorImage image(3, 2, {0, 0, 0});
  for (std::uint8_t i = 0; i < 6; ++i) {
    image.pixels[i] = {i, static_cast<std::uint8_t>(10 * i),
                       static_cast<std::uint8_t>(255 - i)};
  }
  const samples::TemporaryFile file("a.png");
  ASSERT_TRUE(write_png(file.path(), image));
  const auto pixels = pixels_of(file.path(), PNG_FORMAT_RGB);
  ASSERT_EQ(pixels.size(), 18u);
  EXPECT_TRUE(
      std::equal(pixels.begin(), pixels.end(), &image.pixels.data()->r));
}

/// Pixels of which some rows are noise and some are repeated.
ColorImage large_image(std::int32_t width_px, std::int32_t height_px) {
  ColorImage image(width_px, height_px, {9, 8, 7});
  std::uint32_t number = 1;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    number = number * 1664525 + 1013904223;
    if (i / static_cast<std::size_t>(width_px) % 3 == 0)
      image.pixels[i].g = static_cast<std::uint8_t>(number >> 24);
  }
  return image;
}

TEST(WritePng, HasTheSameBytesWithAnyThreads) {
  // Bands of 1 MiB: 9 rows of the first, less than a band and just one in the
  // next two, single rows longer than a band in the last.
  constexpr std::array<std::array<std::int32_t, 2>, 4> kSizes = {
      {{38000, 40}, {700, 3}, {38000, 9}, {400000, 5}}};
  for (const auto& [width_px, height_px] : kSizes) {
    const ColorImage image = large_image(width_px, height_px);
    const samples::TemporaryFile one("one.png"), many("many.png");
    ASSERT_TRUE(write_png(one.path(), image, {}, 1));
    const auto bytes = samples::raw_bytes(one.path());
    for (const int threads : {2, 16, 0}) {
      ASSERT_TRUE(write_png(many.path(), image, {}, threads));
      EXPECT_EQ(samples::raw_bytes(many.path()), bytes) << threads;
    }
    const auto pixels = pixels_of(many.path(), PNG_FORMAT_RGB);
    ASSERT_EQ(pixels.size(), 3 * image.pixels.size());
    EXPECT_TRUE(
        std::equal(pixels.begin(), pixels.end(), &image.pixels.data()->r));
  }
}

TEST(WritePng, KeepsTheAlphaOfLargePictures) {
  const ColorImage image = large_image(3000, 400);
  CoverageImage coverage(3000, 400, 0);
  for (std::size_t i = 0; i < coverage.pixels.size(); i += 7)
    coverage.pixels[i] = static_cast<std::uint8_t>(i);
  const samples::TemporaryFile file("alpha.png");
  ASSERT_TRUE(write_png_cut_out(file.path(), image, coverage, 2));
  const auto pixels = pixels_of(file.path(), PNG_FORMAT_RGBA);
  ASSERT_EQ(pixels.size(), 4 * image.pixels.size());
  for (std::size_t i = 0; i < coverage.pixels.size(); ++i) {
    ASSERT_EQ(pixels[4 * i + 1], image.pixels[i].g) << i;
    ASSERT_EQ(pixels[4 * i + 3], coverage.pixels[i]) << i;
  }
}

TEST(WritePng, SaysWhyItCannot) {
  const Result<Done> done =
      write_png("/nowhere/at/all.png", ColorImage(1, 1, {0, 0, 0}));
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kUnwritable);
  EXPECT_NE(done.error().message.find("/nowhere/at/all.png"),
            std::string::npos);
}

ItemImage sample_image() {
  ItemImage image(3, 2, kBackground);
  image.at(0, 1) = 7;
  image.at(2, 0) = 2147483647;
  return image;
}

/// The file of the sample image.
class Npy : public ::testing::Test {
 protected:
  Npy() {
    EXPECT_TRUE(write_npy(file_.path(), sample_image()));
    good_ = *samples::raw_bytes(file_.path());
  }

  /// The file's bytes, changed in one place.
  std::string with(const std::string& from, const std::string& to) const {
    std::string bytes = good_;
    return bytes.replace(bytes.find(from), from.size(), to);
  }

  Result<ItemImage> read(const std::string& bytes) const {
    samples::write(file_.path(), bytes);
    return read_npy(file_.path());
  }

  samples::TemporaryFile file_{"a.npy"};
  std::string good_;
};

TEST_F(Npy, RoundTrips) {
  const Result<ItemImage> back = read_npy(file_.path());
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, sample_image());
}

TEST_F(Npy, IsWhatNumPyWrites) {
  std::string want("\x93NUMPY\x01\x00\x76\x00", 10);
  want += "{'descr': '<i4', 'fortran_order': False, 'shape': (2, 3), }";
  want.resize(127, ' ');
  want += '\n';
  for (const std::int32_t id : {-1, -1, 2147483647, 7, -1, -1}) {
    samples::append(want, id);
  }
  EXPECT_EQ(good_, want);
}

TEST_F(Npy, NamesWhatIsWrong) {
  const auto code_of = [this](const std::string& bytes) {
    const Result<ItemImage> image = read(bytes);
    EXPECT_FALSE(image);
    return image ? static_cast<ErrorCode>(-1) : image.error().code;
  };
  for (std::size_t size = 6; size < good_.size(); ++size) {
    EXPECT_EQ(code_of(good_.substr(0, size)), ErrorCode::kTruncated) << size;
  }
  EXPECT_EQ(code_of("PK"), ErrorCode::kUnknownFormat);
  EXPECT_EQ(code_of(good_ + "x"), ErrorCode::kSyntax);
  EXPECT_EQ(code_of(with("<i4", "<i8")), ErrorCode::kUnknownFormat);
  EXPECT_EQ(code_of(with("False", "True ")), ErrorCode::kUnknownFormat);
  EXPECT_EQ(code_of(with("(2, 3)", "(6,)  ")), ErrorCode::kSyntax);
  EXPECT_EQ(code_of(with("(2, 3)", "(2, 0)")), ErrorCode::kOutOfRange);
  EXPECT_EQ(code_of(with("(2, 3), }", "(9, 99999)")), ErrorCode::kOutOfRange);
  EXPECT_EQ(read_npy("/nowhere/a.npy").error().code, ErrorCode::kUnreadable);
}

TEST_F(Npy, ErrorsAreToTheLetter) {
  const std::string name = file_.path().string() + ": ";
  samples::expect_error(read("\x93NUMPX" + good_), ErrorCode::kUnknownFormat,
                        name + "this is no NumPy array");
  for (const std::size_t size : {6u, 11u, 12u, 127u}) {
    samples::expect_error(read(good_.substr(0, size)), ErrorCode::kTruncated,
                          name + "the file ends in its header");
  }
  for (const std::size_t size : {128u, 151u}) {
    samples::expect_error(
        read(good_.substr(0, size)), ErrorCode::kTruncated,
        name + "the file holds " + (size == 128u ? "0" : "5") + " of 6 pixels");
  }
  for (const char* more : {"x", "more"}) {
    samples::expect_error(read(good_ + more), ErrorCode::kSyntax,
                          name + "the file goes on after its pixels");
  }
  const std::string kind =
      name + "an item image is an array of '<i4' in C order";
  // A header of two bytes, and no other byte.
  samples::expect_error(read(std::string("\x93NUMPY\1\0\2\0{}", 12)),
                        ErrorCode::kUnknownFormat, kind);
  samples::expect_error(read(with("<i4", "<u4")), ErrorCode::kUnknownFormat,
                        kind);
  samples::expect_error(read(with("False", "True ")), ErrorCode::kUnknownFormat,
                        kind);
  for (const char* shape :
       {"(6,)  ", "[2, 3)", "(2; 3)", "(2, 3]", "(x, 3)", "(2, x)", "(2  3)"}) {
    samples::expect_error(read(with("(2, 3)", shape)), ErrorCode::kSyntax,
                          name + "an item image has the shape (height, width)");
  }
  samples::expect_error(read(with("'shape'", "'shaqe'")), ErrorCode::kSyntax,
                        name + "an item image has the shape (height, width)");
  const struct {
    std::string shape, size;
  } cases[] = {{"(2, 0),", "0"},
               {"(0, 3),", "0"},
               {"(-1, 3)", "-1"},
               {"(65537, 3), }", "65537"},
               {"(3, 65537), }", "65537"}};
  for (const auto& [shape, size] : cases) {
    const std::string from = shape.size() > 7 ? "(2, 3), }    " : "(2, 3),";
    samples::expect_error(
        read(with(from, shape)), ErrorCode::kOutOfRange,
        name + "an image has 1 to 65536 rows and columns, not " + size);
  }
}

TEST_F(Npy, ReadsWhatNumPyMayWrite) {
  // Version 2, other blanks and another order.
  std::string bytes("\x93NUMPY\2\0", 8);
  const std::string header =
      "{'shape':(1 ,  2 ),'fortran_order': False, 'descr': '<i4'}" +
      std::string(300, ' ');
  samples::append(bytes, static_cast<std::uint32_t>(header.size()));
  bytes += header;
  samples::append(bytes, 7);
  samples::append(bytes, -1);
  const Result<ItemImage> image = read(bytes);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width_px, 2);
  EXPECT_EQ(image->height_px, 1);
  EXPECT_EQ(image->pixels, (std::vector<PolygonId>{7, -1}));
}

TEST_F(Npy, HoldsTheLargestImages) {
  for (const auto& [width, height] : {std::pair{65536, 1}, {1, 65536}}) {
    const ItemImage image(width, height, 3);
    ASSERT_TRUE(write_npy(file_.path(), image));
    const Result<ItemImage> back = read_npy(file_.path());
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(*back, image);
  }
}

}  // namespace
}  // namespace halfspace::io
