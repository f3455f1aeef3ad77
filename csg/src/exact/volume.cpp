#include "halfspace/csg/volume.hpp"

#include "halfspace/big_integer.hpp"
#include "halfspace/csg/exact_measure.hpp"
#include "halfspace/csg/interval.hpp"

namespace halfspace::csg {
namespace {

using io::Integer;

/// A sum of products of numbers of 54 bits and of 109.
class ProductSum {
 public:
  using Wide = boost::multiprecision::int256_t;

  void add(std::int64_t a, Int128 b) {
    // Of b, 54 bits and the rest: both products have at most 109 bits.
    low_ += (b & kLow) * a;
    high_ += (b >> kShift) * a;
    if (++terms_ == kMostTerms) flush();
  }
  Wide total() {
    flush();
    return total_;
  }

 private:
  static constexpr int kShift = 54;
  static constexpr Int128 kLow = (Int128{1} << kShift) - 1;
  static constexpr int kMostTerms = 1 << 16;  ///< 109 + 16 bits

  void flush() {
    total_ += to_big<Wide>(low_) + (to_big<Wide>(high_) << kShift);
    low_ = high_ = 0;
    terms_ = 0;
  }

  Wide total_ = 0;
  Int128 low_ = 0, high_ = 0;
  int terms_ = 0;
};

/// Six times the volume, in cubic steps. Fixed width: no coordinate has more
/// than 54 bits, so no determinant more than 165, and 2^31 of them 196.
boost::multiprecision::int256_t volume6(const Scene& scene) {
  ProductSum sum;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto corners = scene.corners(static_cast<PolygonId>(p));
    const GridPoint& a = scene.point(corners[0]);
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const GridPoint& b = scene.point(corners[i - 1]);
      const GridPoint& c = scene.point(corners[i]);
      const auto minor = [](std::int64_t r, std::int64_t s, std::int64_t t,
                            std::int64_t u) {
        return static_cast<Int128>(r) * u - static_cast<Int128>(s) * t;
      };
      sum.add(a.x, minor(b.y, b.z, c.y, c.z));
      sum.add(a.y, minor(b.z, b.x, c.z, c.x));
      sum.add(a.z, minor(b.x, b.y, c.x, c.y));
    }
  }
  return sum.total();
}

}  // namespace

double about_volume(const std::vector<std::array<double, 3>>& vertices,
                    const std::vector<std::uint32_t>& first_corner,
                    const std::vector<VertexId>& corners) {
  if (vertices.empty()) return 0;
  // From a corner of its own: far from the origin the terms cancel less.
  const auto& o = vertices.front();
  const auto at = [&](std::size_t corner) {
    const auto& v = vertices[static_cast<std::size_t>(corners[corner])];
    return std::array{v[0] - o[0], v[1] - o[1], v[2] - o[2]};
  };
  double total = 0;
  for (std::size_t p = 0; p + 1 < first_corner.size(); ++p) {
    const auto a = at(first_corner[p]);
    for (std::size_t i = first_corner[p] + 2; i < first_corner[p + 1]; ++i) {
      const auto b = at(i - 1);
      const auto c = at(i);
      total += a[0] * (b[1] * c[2] - b[2] * c[1]) +
               a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
  }
  return total / 6;
}

std::string exact_volume(const Scene& scene) {
  const Scale scale = scale_of(scene.unit(), 3);
  return text_of(Integer(volume6(scene)) * scale.numerator,
                 6 * scale.denominator);
}

}  // namespace halfspace::csg
