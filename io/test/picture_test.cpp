#include "halfspace/io/picture.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include "samples.hpp"

namespace halfspace::io {
namespace {

TEST(WritePng, HoldsThePixels) {
  ColorImage image(3, 2, {0, 0, 0});
  for (std::uint8_t i = 0; i < 6; ++i) {
    image.pixels[i] = {i, static_cast<std::uint8_t>(10 * i),
                       static_cast<std::uint8_t>(255 - i)};
  }
  const samples::TemporaryFile file("a.png");
  ASSERT_TRUE(write_png(file.path(), image));
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&png, file.path().c_str()), 0);
  EXPECT_EQ(png.width, 3u);
  EXPECT_EQ(png.height, 2u);
  png.format = PNG_FORMAT_RGB;
  std::vector<Rgb> pixels(6);
  ASSERT_NE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr), 0);
  EXPECT_EQ(pixels, image.pixels);
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

TEST(Npy, RoundTrips) {
  const samples::TemporaryFile file("a.npy");
  ASSERT_TRUE(write_npy(file.path(), sample_image()));
  const Result<ItemImage> back = read_npy(file.path());
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, sample_image());
}

TEST(Npy, IsWhatNumPyWrites) {
  const samples::TemporaryFile file("a.npy");
  ASSERT_TRUE(write_npy(file.path(), sample_image()));
  const std::string bytes = *samples::raw_bytes(file.path());
  std::string want("\x93NUMPY\x01\x00\x76\x00", 10);
  want += "{'descr': '<i4', 'fortran_order': False, 'shape': (2, 3), }";
  want.resize(127, ' ');
  want += '\n';
  for (const std::int32_t id : {-1, -1, 2147483647, 7, -1, -1}) {
    samples::append(want, id);
  }
  EXPECT_EQ(bytes, want);
}

TEST(Npy, NamesWhatIsWrong) {
  const samples::TemporaryFile file("a.npy");
  ASSERT_TRUE(write_npy(file.path(), sample_image()));
  const std::string good = *samples::raw_bytes(file.path());
  const auto code_of = [&file](const std::string& bytes) {
    samples::write(file.path(), bytes);
    const Result<ItemImage> image = read_npy(file.path());
    EXPECT_FALSE(image);
    return image ? static_cast<ErrorCode>(-1) : image.error().code;
  };
  const auto with = [&good](const std::string& from, const std::string& to) {
    std::string bytes = good;
    return bytes.replace(bytes.find(from), from.size(), to);
  };
  for (std::size_t size = 6; size < good.size(); ++size) {
    EXPECT_EQ(code_of(good.substr(0, size)), ErrorCode::kTruncated) << size;
  }
  EXPECT_EQ(code_of("PK"), ErrorCode::kUnknownFormat);
  EXPECT_EQ(code_of(good + "x"), ErrorCode::kSyntax);
  EXPECT_EQ(code_of(with("<i4", "<i8")), ErrorCode::kUnknownFormat);
  EXPECT_EQ(code_of(with("False", "True ")), ErrorCode::kUnknownFormat);
  EXPECT_EQ(code_of(with("(2, 3)", "(6,)  ")), ErrorCode::kSyntax);
  EXPECT_EQ(code_of(with("(2, 3)", "(2, 0)")), ErrorCode::kOutOfRange);
  EXPECT_EQ(code_of(with("(2, 3), }", "(9, 99999)")), ErrorCode::kOutOfRange);
  EXPECT_EQ(read_npy("/nowhere/a.npy").error().code, ErrorCode::kUnreadable);
}

}  // namespace
}  // namespace halfspace::io
