#include "picture/lettering.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#include <stb/stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

// The font's file, as it is.
asm(".pushsection .rodata\n"
    ".balign 16\n"
    ".globl halfspace_font_begin\n"
    ".hidden halfspace_font_begin\n"
    "halfspace_font_begin:\n"
    ".incbin \"" HALFSPACE_FONT
    "\"\n"
    ".popsection\n");
extern "C" {
extern const unsigned char halfspace_font_begin[];
}

namespace halfspace::io {
namespace {

const stbtt_fontinfo& the_font() {
  static const stbtt_fontinfo font = [] {
    stbtt_fontinfo info{};
    stbtt_InitFont(&info, halfspace_font_begin,
                   stbtt_GetFontOffsetForIndex(halfspace_font_begin, 0));
    return info;
  }();
  return font;
}

/// The next character of UTF-8; what is none counts as a question mark.
int next_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                                            : 4;
  if (first >= 0x80 && (first < 0xc0 || length > text.size())) {
    text.remove_prefix(1);
    return '?';
  }
  int value = length == 1 ? first : first & (0xff >> (length + 1));
  for (std::size_t k = 1; k < length; ++k)
    value = value << 6 | (static_cast<unsigned char>(text[k]) & 0x3f);
  text.remove_prefix(length);
  return value;
}

/// Calls `visit(character, x)` with where each begins; gives where the text
/// ends. Units: pixels.
template <class Visit>
double lay_out(std::string_view text, double scale, Visit&& visit) {
  const stbtt_fontinfo& font = the_font();
  double x = 0;
  int before = 0;
  while (!text.empty()) {
    const int character = next_character(text);
    int advance = 0;
    int bearing = 0;
    stbtt_GetCodepointHMetrics(&font, character, &advance, &bearing);
    if (before != 0)
      x += scale * stbtt_GetCodepointKernAdvance(&font, before, character);
    visit(character, x);
    x += scale * advance;
    before = character;
  }
  return x;
}

/// `under` with `share` of 255 parts of `color` over it.
std::uint8_t mixed_channel(int under, int color, int share) {
  return static_cast<std::uint8_t>(
      (2 * (color * share + under * (255 - share)) + 255) / 510);
}

}  // namespace

Lettering::Lettering(double height_px)
    : size_(height_px / 1.2),
      scale_(stbtt_ScaleForMappingEmToPixels(&the_font(),
                                             static_cast<float>(size_))) {}

double Lettering::width_of(std::string_view text) const {
  return lay_out(text, double{scale_}, [](int, double) {});
}

void Lettering::write(std::string_view text, double x, double y,
                      const Rgb& color, ColorImage& picture) const {
  const stbtt_fontinfo& font = the_font();
  const double line = std::floor(y + 0.5);
  std::vector<unsigned char> shares;
  lay_out(text, double{scale_}, [&](int character, double offset) {
    const double left = std::floor(x + offset);
    const auto shift = static_cast<float>(x + offset - left);
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetCodepointBitmapBoxSubpixel(&font, character, scale_, scale_, shift,
                                        0, &x0, &y0, &x1, &y1);
    const int width = x1 - x0;
    const int height = y1 - y0;
    if (width <= 0 || height <= 0) return;
    shares.assign(
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    stbtt_MakeCodepointBitmapSubpixel(&font, shares.data(), width, height,
                                      width, scale_, scale_, shift, 0,
                                      character);
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const auto i = static_cast<std::int32_t>(left) + x0 + column;
        const auto j = static_cast<std::int32_t>(line) + y0 + row;
        if (i < 0 || j < 0 || i >= picture.width_px || j >= picture.height_px)
          continue;
        const int share = shares[static_cast<std::size_t>(row) *
                                     static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(column)];
        Rgb& pixel = picture.at(i, j);
        pixel = {mixed_channel(pixel.r, color.r, share),
                 mixed_channel(pixel.g, color.g, share),
                 mixed_channel(pixel.b, color.b, share)};
      }
    }
  });
}

}  // namespace halfspace::io
