#pragma once

#include <cstddef>
#include <cstdint>

#include "halfspace/image.hpp"
#include "halfspace/span.hpp"

namespace halfspace {

/// What one scan line of a fragment is, whoever found it.
struct LineSpan {
  std::int32_t line = 0;
  Span span;
};

/// An image, and how many pixels were set for it.
struct Image {
  ItemImage items;
  ColorImage colors;
  std::size_t pixels_painted = 0;
};

}  // namespace halfspace
