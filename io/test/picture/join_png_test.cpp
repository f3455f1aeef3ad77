#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include "halfspace/io/picture.hpp"
#include "picture/join_parts.hpp"
#include "picture/png_rows.hpp"

namespace halfspace::io {
namespace {

using samples::expect_error;
using samples::Paths;
using samples::raw_bytes;

std::uint8_t noise(std::uint32_t i) {
  i = (i ^ (i >> 15)) * 0x2c1b3c6du;
  return static_cast<std::uint8_t>((i ^ (i >> 12)) * 0x297a2d39u >> 24);
}

ColorImage picture(std::int32_t width_px, std::int32_t height_px) {
  ColorImage image(width_px, height_px, {0, 0, 0});
  std::uint32_t i = 0;
  for (Rgb& pixel : image.pixels) {
    pixel = {noise(i), noise(i + 1), noise(i + 2)};
    i += 3;
  }
  return image;
}

ColorImage rows_of(const ColorImage& whole, std::int32_t first,
                   std::int32_t count) {
  ColorImage rows(whole.width_px, count, {0, 0, 0});
  const auto from = whole.pixels.begin() + first * whole.width_px;
  std::copy(from, from + count * whole.width_px, rows.pixels.begin());
  return rows;
}

using PngParts = samples::JoinTest;

TEST_F(PngParts, MakeTheWholePicture) {
  const ColorImage whole = picture(5, 7);
  ASSERT_TRUE(write_png(at("want.png"), whole));
  const Paths parts = {at("0.png"), at("1.png"), at("2.png")};
  for (const bool has_notes : {false, true}) {
    std::int32_t first = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t count = k == 1 ? 1 : 3;
      ASSERT_TRUE(write_png(
          parts[k], rows_of(whole, first, count),
          has_notes ? std::optional<PartOfPicture>({first, whole.height_px})
                    : std::nullopt));
      first += count;
    }
    std::filesystem::remove(path());
    expect_whole(join_png(parts, path()), 5, 7, raw_bytes(at("want.png")));
  }
}

TEST_F(PngParts, AreRefusedOutOfOrderOrMissing) {
  const ColorImage whole = picture(2, 7);
  const auto part = [&](std::int32_t first, std::int32_t count) {
    const std::filesystem::path path = at(std::to_string(first) + ".png");
    EXPECT_TRUE(write_png(path, rows_of(whole, first, count),
                          PartOfPicture{first, whole.height_px}));
    return path;
  };
  const Paths parts = {part(0, 3), part(3, 1), part(4, 3)};
  expect_error(join_png({parts[1], parts[0]}, path()), ErrorCode::kBadIndex,
               about(parts[1], "begins with row 3, but row 0 comes next"), 0);
  expect_error(join_png({parts[0], parts[2]}, path()), ErrorCode::kBadIndex,
               about(parts[2], "begins with row 4, but row 3 comes next"), 1);
  expect_error(
      join_png({parts[0], parts[1]}, path()), ErrorCode::kBadIndex,
      about(parts[1], "is the last part and ends with row 3 of 7 rows"), 1);
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(PngParts, HaveOneWidth) {
  ASSERT_TRUE(write_png(at("a.png"), picture(5, 1)));
  ASSERT_TRUE(write_png(at("b.png"), picture(4, 1)));
  expect_error(join_png({at("a.png"), at("a.png"), at("b.png")}, path()),
               ErrorCode::kOutOfRange,
               about(at("b.png"), "has 4 columns, the parts before it 5"), 2);
}

TEST_F(PngParts, HaveNoMoreRowsThanAnImage) {
  ASSERT_TRUE(write_png(at("a.png"), picture(1, 65535)));
  ASSERT_TRUE(write_png(at("b.png"), picture(1, 1)));
  const Result<JoinedSize> size = join_png({at("a.png"), at("b.png")}, path());
  ASSERT_TRUE(size) << size.error().message;
  EXPECT_EQ(size->height_px, 65536);
  expect_error(
      join_png({at("a.png"), at("b.png"), at("b.png")}, path()),
      ErrorCode::kOutOfRange,
      about(at("b.png"), "with this the image has more than 65536 rows"), 2);
}

TEST_F(PngParts, AreNotOverwritten) {
  ASSERT_TRUE(write_png(at("a.png"), picture(5, 1)));
  ASSERT_TRUE(write_png(at("b.png"), picture(5, 1)));
  const auto before = raw_bytes(at("b.png"));
  std::filesystem::create_symlink("b.png", at("link"));
  expect_error(join_png({at("a.png"), at("b.png")}, at("link")),
               ErrorCode::kUnwritable, about(at("link"), "is a part itself"),
               1);
  expect_error(join_npy({at("a.png"), at("b.png")}, at("b.png")),
               ErrorCode::kUnwritable, about(at("b.png"), "is a part itself"),
               1);
  expect_error(join_png({at("b.png"), at("a.png")}, at("b.png")),
               ErrorCode::kUnwritable, about(at("b.png"), "is a part itself"),
               0);
  EXPECT_EQ(raw_bytes(at("b.png")), before);
}

/// A piece of a PNG file: its length, type, data and sum.
std::string png_chunk(const std::string& type, const std::string& data) {
  std::string bytes;
  samples::append(bytes, static_cast<std::uint32_t>(data.size()), true);
  const std::string summed = type + data;
  const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(summed.data()),
                          static_cast<uInt>(summed.size()));
  bytes += summed;
  samples::append(bytes, static_cast<std::uint32_t>(sum), true);
  return bytes;
}

/// The start of a PNG file 3 pixels wide and 2 high.
std::string png_start(char depth, char color, char interlaced) {
  std::string size;
  samples::append(size, 3u, true);
  samples::append(size, 2u, true);
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR", size + depth + color + '\0' + '\0' + interlaced);
}

TEST_F(PngParts, AreOfTheKindThatIsWritten) {
  const std::string pixels = png_chunk("IDAT", "");
  for (const std::string& bytes : {png_start(16, 2, 0), png_start(8, 0, 0),
                                   png_start(8, 6, 0), png_start(8, 2, 1)}) {
    samples::write(at("a.png"), bytes + pixels);
    expect_error(join_png({at("a.png")}, path()), ErrorCode::kUnknownFormat,
                 about(at("a.png"),
                       "pictures have 8 bits each of red, green and blue, row "
                       "by row; this is another kind of PNG"));
  }
  samples::write(at("a.png"), png_start(8, 2, 0) + pixels);
  const PngReader reader(at("a.png"));
  EXPECT_FALSE(reader.error());
  EXPECT_EQ(reader.width_px(), 3);
  EXPECT_EQ(reader.height_px(), 2);
}

TEST_F(PngParts, AreToldByTheirNotes) {
  const auto note = [](const std::string& key, const std::string& text) {
    return png_chunk("tEXt", key + '\0' + text);
  };
  const auto part = [&](const std::string& notes) {
    samples::write(at("a.png"),
                   png_start(8, 2, 0) + notes + png_chunk("IDAT", ""));
    const PngReader reader(at("a.png"));
    EXPECT_FALSE(reader.error());
    return reader.part();
  };
  const std::string ours = note("Halfspace rows", "30 of 900");
  for (const std::string& notes :
       {ours, note("Comment", "1 of 2") + ours, ours + note("Title", "3 of 4"),
        ours + note("Halfspace rows", "7 of")}) {
    const std::optional<PartOfPicture> found = part(notes);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->first_row, 30);
    EXPECT_EQ(found->whole_height_px, 900);
  }
  EXPECT_FALSE(part(""));
  EXPECT_FALSE(part(note("Comment", "1 of 2")));
  EXPECT_FALSE(part(note("Halfspace rows", "x of 9")));
}

TEST_F(PngParts, SayWhatTheyAre) {
  ASSERT_TRUE(write_png(path(), picture(3, 2), PartOfPicture{30, 900}));
  const std::string start =
      png_start(8, 2, 0) + png_chunk("sRGB", std::string(1, '\0'));
  const std::string note = png_chunk("tEXt", std::string("Halfspace rows\0"
                                                         "30 of 900",
                                                         24));
  EXPECT_EQ(raw_bytes(path())->find(start + note + std::string(2, '\0')), 0u);
  ASSERT_TRUE(write_png(path(), picture(3, 2)));
  EXPECT_EQ(raw_bytes(path())->find(start + std::string(2, '\0')), 0u);
}

TEST_F(PngParts, NameWhatIsWrongWithThem) {
  const auto join = [&] { return join_png({at("a.png")}, path()); };
  expect_error(join(), ErrorCode::kUnreadable,
               about(at("a.png"), "cannot be read: No such file or directory"));
  ASSERT_TRUE(write_png(at("a.png"), picture(3, 2)));
  const std::string good = *raw_bytes(at("a.png"));
  for (const std::string& bytes : {std::string(), good.substr(0, 7), "x" + good,
                                   good.substr(0, 7) + "x" + good.substr(8)}) {
    samples::write(at("a.png"), bytes);
    expect_error(join(), ErrorCode::kUnknownFormat,
                 about(at("a.png"), "this is no PNG picture"));
  }
  // The library's own words, whatever they are, after the name.
  for (std::size_t size = 8; size + 12 < good.size(); ++size) {
    samples::write(at("a.png"), good.substr(0, size));
    const Result<JoinedSize> cut = join();
    // The last bytes hold the sum of what is there already.
    if (cut && size + 20 > good.size()) continue;
    ASSERT_FALSE(cut) << size;
    EXPECT_EQ(cut.error().code, ErrorCode::kSyntax);
    EXPECT_EQ(cut.error().message.find(about(at("a.png"), "")), 0u);
    EXPECT_GT(cut.error().message.size(), about(at("a.png"), "").size());
    EXPECT_FALSE(std::filesystem::exists(path())) << size;
  }
}

TEST_F(PngParts, AreReadNoFurtherAfterAnError) {
  samples::write(at("a.png"), png_start(8, 2, 0) + png_chunk("IDAT", ""));
  PngReader reader(at("a.png"));
  ASSERT_FALSE(reader.error());
  std::uint8_t row[9];
  EXPECT_FALSE(reader.read_row(row));
  ASSERT_TRUE(reader.error());
  EXPECT_EQ(reader.error()->code, ErrorCode::kSyntax);
  EXPECT_FALSE(reader.read_row(row));
  PngReader none(at("none.png"));
  EXPECT_FALSE(none.read_row(row));
}

TEST_F(PngParts, LeaveNothingWhereTheWholeCannotBeWritten) {
  expect_error(write_png("/nowhere/at/all.png", picture(3, 2)),
               ErrorCode::kUnwritable,
               "/nowhere/at/all.png: cannot be written: No such file or "
               "directory");
  ASSERT_TRUE(write_png(at("few.png"), picture(3, 2)));
  ASSERT_TRUE(write_png(at("many.png"), picture(300, 200)));
  // Few rows fail when the file is closed, many before.
  for (const char* part : {"few.png", "many.png"}) {
    const Result<JoinedSize> joined = [&] {
      const samples::SmallFiles small(50);
      return join_png({at(part)}, path());
    }();
    expect_error(joined, ErrorCode::kUnwritable,
                 about(path(), "cannot be written: File too large"));
    EXPECT_FALSE(std::filesystem::exists(path()));
  }
  // What is no file of bytes stays.
  std::filesystem::create_symlink("/dev/full", path());
  expect_error(join_png({at("few.png")}, path()), ErrorCode::kUnwritable,
               about(path(), "cannot be written: No space left on device"));
  EXPECT_TRUE(std::filesystem::is_symlink(path()));
}

TEST_F(PngParts, AreRemovedIfNeverFinished) {
  {
    PngWriter writer(path(), 3, 2, std::nullopt, 1);
    const std::uint8_t row[9] = {};
    EXPECT_TRUE(writer.write_row(row));
    EXPECT_TRUE(std::filesystem::exists(part_name(path())));
  }
  EXPECT_FALSE(std::filesystem::exists(path()));
  {
    PngWriter writer(path(), 3, 2, std::nullopt, 1);
    const std::uint8_t row[9] = {};
    EXPECT_TRUE(writer.write_row(row));
    // A row is missing.
    const Result<Done> done = writer.finish();
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::kUnwritable);
    EXPECT_FALSE(writer.write_row(row));
  }
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(PngParts, SayWhatWentWrongFirst) {
  const Result<Done> done = [&] {
    const samples::SmallFiles small(10);
    PngWriter writer(path(), 3, 2, std::nullopt, 1);
    const std::uint8_t row[9] = {};
    EXPECT_TRUE(writer.write_row(row));
    return writer.finish();  // a row is missing, and there is no room
  }();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message.find("File too large"), std::string::npos);
  const ColorImage much = picture(3000, 1);
  const samples::SmallFiles small(10);
  PngWriter writer(path(), 3000, 1000, std::nullopt, 1);
  int written = 0;
  while (written < 1000 && writer.write_row(&much.at(0, 0).r)) ++written;
  EXPECT_LT(written, 1000);
}

}  // namespace
}  // namespace halfspace::io
