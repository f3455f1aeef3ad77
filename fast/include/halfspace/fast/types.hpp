#pragma once

#include <array>

namespace halfspace::fast {

/// A point, approximately: each coordinate is off by at most `error`.
/// Units: grid steps.
struct Vertex {
  double x = 0;
  double y = 0;
  double z = 0;
  double error = 0;
};

/// An oriented plane h(p) = a x + b y + c z + d in doubles. Each coefficient
/// is off by at most 2^-52 of its size.
struct Plane {
  double a = 0;
  double b = 0;
  double c = 0;
  double d = 0;
};

/// A box with faces parallel to the axes. Units: grid steps.
struct Box {
  std::array<float, 3> low{};
  std::array<float, 3> high{};
  friend bool operator==(const Box&, const Box&) = default;
};

}  // namespace halfspace::fast
