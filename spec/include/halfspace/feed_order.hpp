#pragma once

#include <cstdint>

namespace halfspace {

/// In which order the triangles of an order feed come (S3.8).
enum class FeedOrder : std::uint8_t { kBackToFront, kFrontToBack };

}  // namespace halfspace
