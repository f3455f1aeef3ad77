#include "map/line_table.hpp"

#include <bit>
#include <cmath>

#include "box/box.hpp"
#include "exact/nearest_double.hpp"

namespace halfspace::fast {
namespace {

/// Widths for lines whose coefficients have 6n + 37 bits (S7, "Finite and
/// exact"): 193, 277 and 361. A cross product of two has twice as many and one
/// more, 387, 555 and 723; a determinant of three 18n + 114.
template <int kBits>
constexpr std::size_t kCrossWords = kBits == 26   ? 7
                                    : kBits == 40 ? 9
                                                  : 12;
template <int kBits>
constexpr std::size_t kDeterminantWords = kBits == 26   ? 10
                                          : kBits == 40 ? 14
                                                        : 18;

/// The point where two lines meet, homogeneous: (x / w, y / w).
template <std::size_t kWords>
struct Meet {
  Wide<kWords> x;
  Wide<kWords> y;
  Wide<kWords> w;
};

template <std::size_t kResult, std::size_t kWords>
Meet<kResult> meet_of(const EdgeFunction<kWords>& l,
                      const EdgeFunction<kWords>& m) {
  const auto minor = [](const auto& p, const auto& q, const auto& r,
                        const auto& s) {
    return multiply<kResult>(p, q) - multiply<kResult>(r, s);
  };
  return {minor(l.b, m.c, l.c, m.b), minor(l.c, m.a, l.a, m.c),
          minor(l.a, m.b, l.b, m.a)};
}

template <std::size_t kWords>
EdgeFunction<kWords> constant_slopes(int a, int b, std::int64_t c) {
  return {Wide<kWords>(a), Wide<kWords>(b), Wide<kWords>(c)};
}

template <std::size_t kWords, std::size_t kOther>
EdgeFunction<kWords> widened(const EdgeFunction<kOther>& line) {
  return {Wide<kWords>(line.a), Wide<kWords>(line.b), Wide<kWords>(line.c)};
}

std::uint64_t pair_of(std::int32_t first, std::int32_t second) {
  return std::uint64_t{static_cast<std::uint32_t>(first)} << 32 |
         static_cast<std::uint32_t>(second);
}

}  // namespace

LineTable::LineTable(const TreeReader& reader, const CameraData& camera,
                     const Rectangle& rectangle,
                     const std::vector<ClipPlane>& clips)
    : reader_(reader),
      camera_(camera),
      clips_(clips),
      grid_bits_(reader.scene().grid_bits()) {
  upright(rectangle.left);
  level(rectangle.top);
  upright(rectangle.right);
  level(rectangle.bottom);
}

template <int kBits>
ProjectedPlane<kBits> LineTable::seen(PlaneId plane) const {
  if (plane < 0)
    return projected<kBits>(clips_[static_cast<std::size_t>(-2 - plane)],
                            camera_);
  return projected(reader_.planes().exact<kBits>(plane), camera_);
}

template <int kBits>
EdgeFunction<Grid<kBits>::kWords> LineTable::exact_line(
    const Line& line) const {
  constexpr std::size_t kWords = Grid<kBits>::kWords;
  const Scene& scene = reader_.scene();
  switch (line.kind) {
    case Kind::kColumn:
      return constant_slopes<kWords>(1, 0, -2 * std::int64_t{line.first});
    case Kind::kRow:
      return constant_slopes<kWords>(0, 1, -2 * std::int64_t{line.first});
    case Kind::kEdge:
      return widened<kWords>(edge_function(scene.point(line.first),
                                           scene.point(line.second), camera_));
    case Kind::kMeet:
      return meet_function<kBits>(seen<kBits>(line.first),
                                  seen<kBits>(line.second));
    case Kind::kNear:
      return widened<kWords>(near_function<kBits>(
          seen<kBits>(line.first), *camera_.near, camera_.perspective));
    case Kind::kHorizon: {
      // C(e) - C(s), twice.
      const auto clip = seen<kBits>(line.first);
      return {-Wide<kWords>(clip.a), -Wide<kWords>(clip.b),
              multiply<kWords>(Wide<kWords>(clip.eye), Int128{2}) -
                  Wide<kWords>(clip.c)};
    }
    case Kind::kSum:
    case Kind::kDifference:
      break;
  }
  return constant_slopes<kWords>(1, line.kind == Kind::kSum ? 1 : -1,
                                 -std::int64_t{line.first});
}

int LineTable::side_of_eye(PlaneId plane) const {
  return with_grid(grid_bits_,
                   [&](auto bits) { return sign(seen<bits()>(plane).eye); });
}

LineId LineTable::named(Kind kind, std::int32_t first, std::int32_t second) {
  Line line;
  line.kind = kind;
  line.first = first;
  line.second = second;
  if (kind == Kind::kEdge) {
    line.from = first;
    line.to = second;
  }
  with_grid(grid_bits_, [&](auto bits) {
    const auto exact = exact_line<bits()>(line);
    line.a = to_double(exact.a);
    line.b = to_double(exact.b);
    line.c = to_double(exact.c);
  });
  const double size = std::max(std::abs(line.a), std::abs(line.b));
  if (size > 0) {
    line.exponent = static_cast<std::int16_t>(std::ilogb(size));
    const double scale = std::ldexp(1.0, -line.exponent);
    line.a *= scale;
    line.b *= scale;
    line.c *= scale;
  }
  lines_.push_back(line);
  return static_cast<LineId>(lines_.size() - 1);
}

LineId LineTable::axis(Kind kind, std::int32_t coordinate) {
  return named(kind, coordinate, 0);
}

LineId LineTable::edge(VertexId from, VertexId to) {
  const auto [found, is_new] = edges_.try_emplace(pair_of(from, to), 0);
  if (is_new) found->second = named(Kind::kEdge, from, to);
  return found->second;
}

LineId LineTable::meet(PolygonId support, PlaneId splitter) {
  const auto [found, is_new] =
      meets_.try_emplace(pair_of(support, splitter), 0);
  if (is_new) found->second = named(Kind::kMeet, support, splitter);
  return found->second;
}

LineId LineTable::near(PolygonId polygon) {
  return named(Kind::kNear, polygon, 0);
}

int LineTable::exact_side(LineId line, LineId a, LineId b) {
  ++stats_.exact;
  const int decided = with_grid(grid_bits_, [&](auto bits) {
    constexpr int kBits = bits();
    constexpr std::size_t kWords = kDeterminantWords<kBits>;
    const auto l = exact_line<kBits>(at(line));
    const auto point = meet_of<kCrossWords<kBits>>(exact_line<kBits>(at(a)),
                                                   exact_line<kBits>(at(b)));
    return sign(multiply<kWords>(l.a, point.x) +
                multiply<kWords>(l.b, point.y) +
                multiply<kWords>(l.c, point.w)) *
           sign(point.w);
  });
  stats_.zero += decided == 0 ? 1 : 0;
  return decided;
}

int LineTable::turn(LineId a, LineId b) {
  if (a == b) return 0;
  const double p = at(a).a * at(b).b;
  const double q = at(a).b * at(b).a;
  const double bound = 8 * kRounding * (std::abs(p) + std::abs(q));
  if (p - q > bound || p - q < -bound) {
    ++stats_.filtered;
    return p > q ? 1 : -1;
  }
  ++stats_.exact;
  const int decided = with_grid(grid_bits_, [&](auto bits) {
    constexpr int kBits = bits();
    const auto point = meet_of<kCrossWords<kBits>>(exact_line<kBits>(at(a)),
                                                   exact_line<kBits>(at(b)));
    return sign(point.w);
  });
  stats_.zero += decided == 0 ? 1 : 0;
  return decided;
}

/// Products are off by 5u of themselves, 2u for either factor, so a numerator
/// or the divisor by 6u of the sum of its products' sizes: 8u with a margin.
/// The quotient p / w of values off by g and h is off by
/// (g + |p / w| h) / (|w| - h), and by u of itself.
MapPoint LineTable::point(LineId a, LineId b) const {
  const Line& l = at(a);
  const Line& m = at(b);
  MapPoint point;
  if (l.kind == Kind::kEdge && m.kind == Kind::kEdge) {
    if (l.from == m.from || l.from == m.to) point.vertex = l.from;
    if (l.to == m.from || l.to == m.to) point.vertex = l.to;
  }
  constexpr double kDoubt = 8 * kRounding;
  const double w = l.a * m.b - l.b * m.a;
  const double w_error = kDoubt * (std::abs(l.a * m.b) + std::abs(l.b * m.a));
  const double sure = std::abs(w) - w_error;
  if (!(sure > w_error)) {
    point.error = std::numeric_limits<float>::infinity();
    return point;
  }
  point.x = (l.b * m.c - l.c * m.b) / w;
  point.y = (l.c * m.a - l.a * m.c) / w;
  const auto error_of = [&](double value, double size) {
    return (kDoubt * size + std::abs(value) * w_error) / sure +
           kDoubt * std::abs(value);
  };
  point.error = rounded_up(
      std::max(error_of(point.x, std::abs(l.b * m.c) + std::abs(l.c * m.b)),
               error_of(point.y, std::abs(l.c * m.a) + std::abs(l.a * m.c))) *
      kMargin);
  return point;
}

MapVertex LineTable::vertex(LineId a, LineId b) const {
  return with_grid(grid_bits_, [&](auto bits) {
    constexpr int kBits = bits();
    auto point = meet_of<kCrossWords<kBits>>(exact_line<kBits>(at(a)),
                                             exact_line<kBits>(at(b)));
    if (point.w.is_negative()) point = {-point.x, -point.y, -point.w};
    const auto twice = point.w + point.w;
    bool rounded = false;
    return MapVertex{quotient(point.x, twice, rounded),
                     quotient(point.y, twice, rounded),
                     {a, b}};
  });
}

int LineTable::compare(const std::array<LineId, 2>& p,
                       const std::array<LineId, 2>& q) const {
  return with_grid(grid_bits_, [&](auto bits) {
    constexpr int kBits = bits();
    constexpr std::size_t kWords = kCrossWords<kBits>;
    const auto point_of = [&](const std::array<LineId, 2>& lines) {
      auto point = meet_of<kWords>(exact_line<kBits>(at(lines[0])),
                                   exact_line<kBits>(at(lines[1])));
      if (point.w.is_negative()) point = {-point.x, -point.y, -point.w};
      return point;
    };
    const auto f = point_of(p);
    const auto g = point_of(q);
    const auto order = [&](const auto& u, const auto& v) {
      return sign(multiply<2 * kWords>(u, g.w) - multiply<2 * kWords>(v, f.w));
    };
    const int by_x = order(f.x, g.x);
    return by_x != 0 ? by_x : order(f.y, g.y);
  });
}

MapLine LineTable::exact(LineId line) const {
  return with_grid(grid_bits_, [&](auto bits) {
    const auto exact = widened<8>(exact_line<bits()>(at(line)));
    return MapLine{exact.a.words, exact.b.words, exact.c.words};
  });
}

}  // namespace halfspace::fast
