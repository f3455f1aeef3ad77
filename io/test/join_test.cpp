#include "halfspace/io/join.hpp"

#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include "halfspace/io/picture.hpp"
#include "npy.hpp"
#include "png_rows.hpp"
#include "samples.hpp"

namespace halfspace::io {
namespace {

using samples::expect_error;
using samples::raw_bytes;
using Paths = std::vector<std::filesystem::path>;

/// A folder for the parts and the whole of an image.
class JoinTest : public ::testing::Test {
 protected:
  std::filesystem::path at(const std::string& name) const {
    return folder_.path().parent_path() / name;
  }
  std::filesystem::path path() const { return folder_.path(); }

  /// The whole's name in front of the message.
  std::string told(const std::filesystem::path& path,
                   const std::string& what) const {
    return path.string() + ": " + what;
  }

 private:
  samples::TemporaryFile folder_{"whole"};
};

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

using PngParts = JoinTest;

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
    const Result<JoinedSize> size = join_png(parts, path());
    ASSERT_TRUE(size) << size.error().message;
    EXPECT_EQ(size->width_px, 5);
    EXPECT_EQ(size->height_px, 7);
    EXPECT_EQ(raw_bytes(path()), raw_bytes(at("want.png")));
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
               told(parts[1], "begins with row 3, but row 0 comes next"), 0);
  expect_error(join_png({parts[0], parts[2]}, path()), ErrorCode::kBadIndex,
               told(parts[2], "begins with row 4, but row 3 comes next"), 1);
  expect_error(join_png({parts[0], parts[1]}, path()), ErrorCode::kBadIndex,
               told(parts[1], "is the last part and ends with row 3 of 7 rows"),
               1);
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(PngParts, HaveOneWidth) {
  ASSERT_TRUE(write_png(at("a.png"), picture(5, 1)));
  ASSERT_TRUE(write_png(at("b.png"), picture(4, 1)));
  expect_error(join_png({at("a.png"), at("a.png"), at("b.png")}, path()),
               ErrorCode::kOutOfRange,
               told(at("b.png"), "has 4 columns, the parts before it 5"), 2);
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
      told(at("b.png"), "with this the image has more than 65536 rows"), 2);
}

TEST_F(PngParts, AreNotOverwritten) {
  ASSERT_TRUE(write_png(at("a.png"), picture(5, 1)));
  ASSERT_TRUE(write_png(at("b.png"), picture(5, 1)));
  const auto before = raw_bytes(at("b.png"));
  std::filesystem::create_symlink("b.png", at("link"));
  expect_error(join_png({at("a.png"), at("b.png")}, at("link")),
               ErrorCode::kUnwritable, told(at("link"), "is a part itself"), 1);
  expect_error(join_npy({at("a.png"), at("b.png")}, at("b.png")),
               ErrorCode::kUnwritable, told(at("b.png"), "is a part itself"),
               1);
  expect_error(join_png({at("b.png"), at("a.png")}, at("b.png")),
               ErrorCode::kUnwritable, told(at("b.png"), "is a part itself"),
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
                 told(at("a.png"),
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
               told(at("a.png"), "cannot be read: No such file or directory"));
  ASSERT_TRUE(write_png(at("a.png"), picture(3, 2)));
  const std::string good = *raw_bytes(at("a.png"));
  for (const std::string& bytes : {std::string(), good.substr(0, 7), "x" + good,
                                   good.substr(0, 7) + "x" + good.substr(8)}) {
    samples::write(at("a.png"), bytes);
    expect_error(join(), ErrorCode::kUnknownFormat,
                 told(at("a.png"), "this is no PNG picture"));
  }
  // The library's own words, whatever they are, after the name.
  for (std::size_t size = 8; size + 12 < good.size(); ++size) {
    samples::write(at("a.png"), good.substr(0, size));
    const Result<JoinedSize> cut = join();
    // The last bytes hold the sum of what is there already.
    if (cut && size + 20 > good.size()) continue;
    ASSERT_FALSE(cut) << size;
    EXPECT_EQ(cut.error().code, ErrorCode::kSyntax);
    EXPECT_EQ(cut.error().message.find(told(at("a.png"), "")), 0u);
    EXPECT_GT(cut.error().message.size(), told(at("a.png"), "").size());
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
  // Of few rows the system says so when the file is closed, of many before.
  const struct {
    std::string part, why;
  } cases[] = {{"few.png", "File too large"}, {"many.png", "Write Error"}};
  for (const auto& [part, why] : cases) {
    const Result<JoinedSize> joined = [&, &name = part] {
      const samples::SmallFiles small(50);
      return join_png({at(name)}, path());
    }();
    expect_error(joined, ErrorCode::kUnwritable,
                 told(path(), "cannot be written: " + why));
    EXPECT_FALSE(std::filesystem::exists(path()));
  }
  // What is no file of bytes stays.
  std::filesystem::create_symlink("/dev/full", path());
  expect_error(join_png({at("few.png")}, path()), ErrorCode::kUnwritable,
               told(path(), "cannot be written: No space left on device"));
  EXPECT_TRUE(std::filesystem::is_symlink(path()));
}

TEST_F(PngParts, AreRemovedIfNeverFinished) {
  {
    PngWriter writer(path(), 3, 2, std::nullopt);
    const std::uint8_t row[9] = {};
    EXPECT_TRUE(writer.write_row(row));
    EXPECT_TRUE(std::filesystem::exists(path()));
  }
  EXPECT_FALSE(std::filesystem::exists(path()));
  {
    PngWriter writer(path(), 3, 2, std::nullopt);
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
    PngWriter writer(path(), 3, 2, std::nullopt);
    const std::uint8_t row[9] = {};
    EXPECT_TRUE(writer.write_row(row));
    return writer.finish();  // a row is missing, and there is no room
  }();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message.find("File too large"), std::string::npos);
  const ColorImage much = picture(3000, 1);
  const samples::SmallFiles small(10);
  PngWriter writer(path(), 3000, 1000, std::nullopt);
  int written = 0;
  while (written < 1000 && writer.write_row(&much.at(0, 0).r)) ++written;
  EXPECT_LT(written, 1000);
}

using NpyParts = JoinTest;

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
  const Result<JoinedSize> size = join_npy(parts, path());
  ASSERT_TRUE(size) << size.error().message;
  EXPECT_EQ(size->width_px, 101);
  EXPECT_EQ(size->height_px, 623);
  EXPECT_EQ(raw_bytes(path()), raw_bytes(at("want.npy")));
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
      told(at("b.npy"), "with this the image has more than 65536 rows"), 2);
  expect_error(join_npy({at("b.npy"), at("c.npy")}, path()),
               ErrorCode::kOutOfRange,
               told(at("c.npy"), "has 2 columns, the parts before it 1"), 1);
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
               told(at("a.npy"), "has 189 bytes, not 188"), 1);
  expect_error(join(good.substr(0, 187)), ErrorCode::kSyntax,
               told(at("a.npy"), "has 187 bytes, not 188"), 1);
  expect_error(join(good.substr(0, 127)), ErrorCode::kTruncated,
               told(at("a.npy"), "the file ends in its header"), 1);
  expect_error(join("PK"), ErrorCode::kUnknownFormat,
               told(at("a.npy"), "this is no NumPy array"), 1);
  expect_error(join(""), ErrorCode::kUnreadable,
               told(at("a.npy"), "cannot be read"), 1);
  std::filesystem::remove(at("a.npy"));
  std::filesystem::create_directory(at("a.npy"));
  expect_error(join_npy({at("a.npy")}, path()), ErrorCode::kUnreadable,
               told(at("a.npy"), "cannot be read"), 0);
  expect_error(join_npy({at("none.npy")}, path()), ErrorCode::kUnreadable,
               told(at("none.npy"), "cannot be read"), 0);
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
                   told(at("a.npy"), "the file ends in its header"), 0);
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
               "/nowhere/at/all.npy: cannot be written");
  for (const char* part : {"few.npy", "many.npy"}) {
    const Result<JoinedSize> joined = [&] {
      const samples::SmallFiles small(140);
      return join_npy({at(part)}, path());
    }();
    expect_error(joined, ErrorCode::kUnwritable,
                 told(path(), "cannot be written"));
    EXPECT_FALSE(std::filesystem::exists(path()));
  }
  std::filesystem::create_symlink("/dev/full", path());
  expect_error(join_npy({at("few.npy")}, path()), ErrorCode::kUnwritable,
               told(path(), "cannot be written"));
  EXPECT_TRUE(std::filesystem::is_symlink(path()));
}

}  // namespace
}  // namespace halfspace::io
