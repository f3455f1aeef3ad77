#include "picture/png_rows.hpp"

#include <array>
#include <cerrno>
#include <csetjmp>
#include <cstring>
#include <system_error>

// The PNG library reports errors by long jumps, so functions that set the mark
// hold nothing to be destroyed while the library works for them.
namespace halfspace::io {
namespace {

/// The name of the note that says which rows a picture holds.
char kPartName[] = "Halfspace rows";

/// The names of chunks. What the library would write of them itself, it would
/// pack in one thread.
constexpr png_byte kRows[] = "IDAT";
constexpr png_byte kEnd[] = "IEND";

void ignore(png_structp, png_const_charp) {}

}  // namespace

PngWriter::PngWriter(const std::filesystem::path& path, std::int32_t width_px,
                     std::int32_t height_px,
                     const std::optional<PartOfPicture>& part, int threads,
                     bool has_alpha)
    : file_(path),
      rows_(static_cast<std::size_t>(width_px) * (has_alpha ? 4 : 3),
            has_alpha ? 4 : 3, height_px, threads) {
  if (part) {
    part_ = std::to_string(part->first_row) + " of " +
            std::to_string(part->whole_height_px);
  }
  if (file_.stream() == nullptr) return;
  png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
  if (png_ != nullptr) info_ = png_create_info_struct(png_);
  if (info_ == nullptr) {
    trouble_ = "there is not enough memory";
    return;
  }
  begin(width_px, height_px,
        has_alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB);
}

PngWriter::~PngWriter() { png_destroy_write_struct(&png_, &info_); }

void PngWriter::fail(png_structp png, png_const_charp why) {
  static_cast<PngWriter*>(png_get_error_ptr(png))->trouble_ = why;
  png_longjmp(png, 1);
}

void PngWriter::write(png_structp png, png_bytep bytes, std::size_t count) {
  auto* const writer = static_cast<PngWriter*>(png_get_io_ptr(png));
  if (std::fwrite(bytes, 1, count, writer->file_.stream()) < count)
    png_error(png, std::strerror(errno));
}

void PngWriter::flush(png_structp) {}

void PngWriter::begin(std::int32_t width_px, std::int32_t height_px,
                      int color_type) {
  if (setjmp(png_jmpbuf(png_)) != 0) return;
  png_set_write_fn(png_, this, write, flush);
  png_set_IHDR(png_, info_, static_cast<png_uint_32>(width_px),
               static_cast<png_uint_32>(height_px), 8, color_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
  if (!part_.empty()) {
    png_text note{};
    note.compression = PNG_TEXT_COMPRESSION_NONE;
    note.key = kPartName;
    note.text = part_.data();
    png_set_text(png_, info_, &note, 1);
  }
  png_write_info(png_, info_);
}

bool PngWriter::write_row(const std::uint8_t* channels) {
  if (info_ == nullptr || !trouble_.empty()) return false;
  rows_.add(channels);
  if (!rows_.full()) return true;
  if (!rows_.pack()) {
    trouble_ = "there is not enough memory";
    return false;
  }
  return write_chunks();
}

bool PngWriter::write_chunks() {
  if (setjmp(png_jmpbuf(png_)) != 0) return false;
  for (const std::vector<std::uint8_t>& chunk : rows_.chunks())
    png_write_chunk(png_, kRows, chunk.data(), chunk.size());
  return true;
}

void PngWriter::end() {
  if (info_ == nullptr || !trouble_.empty()) return;
  if (!rows_.complete()) {
    trouble_ = "rows are missing";
    return;
  }
  if (setjmp(png_jmpbuf(png_)) != 0) return;
  png_write_chunk(png_, kEnd, nullptr, 0);
}

Result<Done> PngWriter::finish() {
  end();
  return file_.finish(trouble_);
}

PngReader::PngReader(const std::filesystem::path& path) : path_(path) {
  std::array<png_byte, 8> signature{};
  file_ = std::fopen(path.c_str(), "rb");
  if (file_ == nullptr) {
    set_error(ErrorCode::kUnreadable,
              std::string("cannot be read: ") + std::strerror(errno));
    return;
  }
  if (std::fread(signature.data(), 1, signature.size(), file_) !=
          signature.size() ||
      png_sig_cmp(signature.data(), 0, signature.size()) != 0) {
    set_error(ErrorCode::kUnknownFormat, "this is no PNG picture");
    return;
  }
  png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
  if (png_ != nullptr) info_ = png_create_info_struct(png_);
  if (info_ == nullptr) {
    set_error(ErrorCode::kUnreadable, "there is not enough memory");
    return;
  }
  png_set_sig_bytes(png_, static_cast<int>(signature.size()));
  begin();
  if (!error_) read_part();
}

PngReader::~PngReader() {
  png_destroy_read_struct(&png_, &info_, nullptr);
  if (file_ != nullptr) std::fclose(file_);
}

void PngReader::set_error(ErrorCode code, const std::string& what) {
  error_ = Error{code, path_.string() + ": " + what};
}

void PngReader::fail(png_structp png, png_const_charp why) {
  static_cast<PngReader*>(png_get_error_ptr(png))
      ->set_error(ErrorCode::kSyntax, why);
  png_longjmp(png, 1);
}

void PngReader::begin() {
  if (setjmp(png_jmpbuf(png_)) != 0) return;
  png_init_io(png_, file_);
  png_read_info(png_, info_);
  width_px_ = static_cast<std::int32_t>(png_get_image_width(png_, info_));
  height_px_ = static_cast<std::int32_t>(png_get_image_height(png_, info_));
  if (png_get_bit_depth(png_, info_) != 8 ||
      png_get_color_type(png_, info_) != PNG_COLOR_TYPE_RGB ||
      png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE) {
    set_error(ErrorCode::kUnknownFormat,
              "pictures have 8 bits each of red, green and blue, row by row; "
              "this is another kind of PNG");
  }
}

void PngReader::read_part() {
  png_textp notes = nullptr;
  int count = 0;
  png_get_text(png_, info_, &notes, &count);
  for (int k = 0; k < count; ++k) {
    if (std::strcmp(notes[k].key, kPartName) != 0) continue;
    PartOfPicture part;
    if (std::sscanf(notes[k].text, "%d of %d", &part.first_row,
                    &part.whole_height_px) == 2) {
      part_ = part;
    }
  }
}

bool PngReader::read_row(std::uint8_t* rgb) {
  if (error_) return false;
  if (setjmp(png_jmpbuf(png_)) != 0) return false;
  png_read_row(png_, rgb, nullptr);
  return true;
}

}  // namespace halfspace::io
