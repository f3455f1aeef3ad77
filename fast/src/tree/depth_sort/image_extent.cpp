#include "tree/depth_sort/image_extent.hpp"

#include <algorithm>
#include <cmath>

namespace halfspace::fast {
namespace {

/// The turn from a to b to c, 0 where it is not certain.
int turn(const ImageCorner& a, const ImageCorner& b, const ImageCorner& c,
         double error) {
  const double bx = b.x - a.x;
  const double by = b.y - a.y;
  const double cx = c.x - a.x;
  const double cy = c.y - a.y;
  const double value = bx * cy - by * cx;
  const double sizes =
      std::abs(bx) + std::abs(by) + std::abs(cx) + std::abs(cy);
  const double bound = 2 * error * sizes + 8 * error * error +
                       0x1p-50 * (std::abs(bx * cy) + std::abs(by * cx));
  return (value > bound) - (value < -bound);
}

/// The side of the line from `a` to `b` that holds all other corners; 0 where
/// that is not certain.
int side_of_all(const ImageOutline& outline, const ImageCorner& a,
                const ImageCorner& b, double error) {
  int side = 0;
  for (const ImageCorner& corner : outline.corners) {
    if (corner.vertex == a.vertex || corner.vertex == b.vertex) continue;
    const int here = turn(a, b, corner, error);
    if (here == 0 || here == -side) return 0;
    side = here;
  }
  return side;
}

}  // namespace

ImageOfVertex image_of_vertex(const View& view, const Vertex& v) {
  ImageOfVertex image;
  image.depth = view.t.at(v.x, v.y, v.z);
  image.depth_error = 2 * (view.t_error + view.t_growth * v.error);
  image.x = view.x.at(v.x, v.y, v.z);
  image.y = view.y.at(v.x, v.y, v.z);
  const double doubt = 2 * (view.xy_error + view.xy_growth * v.error);
  if (!view.perspective) {
    image.error = doubt;
    return image;
  }
  if (!(image.depth > 4 * image.depth_error)) return image;
  image.x /= image.depth;
  image.y /= image.depth;
  // The quotients' own roundings are covered by the doubled bounds.
  const double size = std::max(std::abs(image.x), std::abs(image.y));
  image.error =
      (doubt + size * image.depth_error) / (image.depth - image.depth_error) +
      0x1p-51 * size;
  return image;
}

void extend(ImageExtent& extent, const ImageOfVertex& image, bool is_first) {
  if (is_first) {
    extent = {image.depth - image.depth_error, image.depth + image.depth_error,
              image.x - image.error,           image.x + image.error,
              image.y - image.error,           image.y + image.error};
  } else {
    extent = {std::min(extent.depth_low, image.depth - image.depth_error),
              std::max(extent.depth_high, image.depth + image.depth_error),
              std::min(extent.x_low, image.x - image.error),
              std::max(extent.x_high, image.x + image.error),
              std::min(extent.y_low, image.y - image.error),
              std::max(extent.y_high, image.y + image.error)};
  }
}

bool separates(const ImageOutline& p, const ImageOutline& q) {
  const double error = std::max(p.error, q.error);
  const std::size_t count = p.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    const ImageCorner& a = p.corners[k];
    const ImageCorner& b = p.corners[k + 1 == count ? 0 : k + 1];
    const int side = side_of_all(p, a, b, error);
    if (side != 0 && side_of_all(q, a, b, error) == -side) return true;
  }
  return false;
}

}  // namespace halfspace::fast
