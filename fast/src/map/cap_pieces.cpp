#include "map/cap_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "map/cap_segments.hpp"
#include "map/cell_tree.hpp"

namespace halfspace::fast {
namespace {

/// The doubles of points and planes are off by far less than this share of the
/// sum of what is added up; who is in doubt is on both sides.
constexpr double kShare = 0x1p-40;

/// The image of a clip plane, divided by segments, and what is cap of it.
class CapDivider {
 public:
  CapDivider(const TreeReader& reader, const View& view,
             const CameraData& camera, const ImageOptions& image, std::size_t k,
             int side, LineTable& lines)
      : reader_(reader),
        view_(view),
        camera_(camera),
        image_(image),
        k_(k),
        side_(side),
        lines_(lines),
        cutter_(lines),
        segments_(reader, camera, image.clips[k]),
        windings_(image.parts.get()) {}

  std::vector<CapPiece> run() {
    Part all;
    all.polygon = cutter_.rectangle();
    for (const HalfPlane& limit : limits()) {
      if (!cutter_.clip(all.polygon, limit, kOwnEdge)) return {};
    }
    for (std::size_t s = 0; s < segments_.all().size(); ++s) {
      if (may_be_in_image(segments_.all()[s])) all.segments.push_back(s);
    }
    std::vector<Part> parts;
    parts.push_back(std::move(all));
    while (!parts.empty()) {
      Part part = std::move(parts.back());
      parts.pop_back();
      if (divide(part, parts)) continue;
      find_windings(part.polygon);
      if (windings_.is_cap())
        add(std::move(part.polygon), {k_, windings_.part(), false});
    }
    return std::move(pieces_);
  }

 private:
  /// A convex polygon of the image and the segments that may pass it.
  struct Part {
    std::vector<CellEdge> polygon;
    std::vector<std::size_t> segments;
  };

  /// Where the plane is in front of the eye and beyond the near distance, on
  /// the positive sides of all others.
  std::vector<HalfPlane> limits() {
    const PlaneId plane = plane_id_of_clip(k_);
    std::vector<HalfPlane> limits;
    if (camera_.perspective) limits.push_back({lines_.horizon(plane), side_});
    if (camera_.near) limits.push_back({lines_.near(plane), side_});
    for (std::size_t other = 0; other < image_.clips.size(); ++other) {
      if (other == k_) continue;
      limits.push_back({lines_.meet(plane, plane_id_of_clip(other)), side_});
    }
    return limits;
  }

  /// Whether a segment is not told to be beside the image.
  bool may_be_in_image(const CapSegment& segment) const {
    // Whether both ends are in front, and where c0 + c1 t is negative.
    const auto is_beyond = [&](const Affine3& f, double scale, double add) {
      for (const CapPoint* end : {&segment.from, &segment.to}) {
        const auto& [x, y, z] = end->near;
        const double t = view_.perspective ? view_.t.at(x, y, z) : 1;
        const double size =
            view_.perspective
                ? std::abs(view_.t.a * x) + std::abs(view_.t.b * y) +
                      std::abs(view_.t.c * z) + std::abs(view_.t.d)
                : 1;
        if (!(t > kShare * size)) return false;
        const double value = scale * f.at(x, y, z) + add * t;
        const double doubt =
            kShare * (std::abs(f.a * x) + std::abs(f.b * y) +
                      std::abs(f.c * z) + std::abs(f.d) + add * size);
        if (!(value < -doubt)) return false;
      }
      return true;
    };
    return !is_beyond(view_.x, 1, 0) && !is_beyond(view_.y, 1, 0) &&
           !is_beyond(view_.x, -1, camera_.width_px) &&
           !is_beyond(view_.y, -1, camera_.height_px);
  }

  LineId line_of(std::size_t s) {
    return lines_.meet(plane_id_of_clip(k_), segments_.all()[s].polygon);
  }

  /// Cuts a part by one of its segments; false if none passes it.
  bool divide(Part& part, std::vector<Part>& parts) {
    while (!part.segments.empty()) {
      // Any one of them, so that the parts are of like size.
      std::swap(part.segments[part.segments.size() / 2], part.segments.back());
      const std::size_t s = part.segments.back();
      part.segments.pop_back();
      const LineId line = line_of(s);
      if (cutter_.classify(part.polygon, line) !=
          (kSomeNegative | kSomePositive))
        continue;
      Part positive;
      Part negative;
      cutter_.cut(part.polygon, line, kOwnEdge, positive.polygon,
                  negative.polygon);
      share_out(part.segments, s, positive, negative);
      parts.push_back(std::move(positive));
      parts.push_back(std::move(negative));
      return true;
    }
    return false;
  }

  /// The sides of a segment's plane on which another may have points.
  int sides_of(std::size_t s, std::size_t other) const {
    const CapSegment& by = segments_.all()[s];
    const Plane p = reader_.planes().plane(by.polygon);
    int found = 0;
    for (const CapPoint* end :
         {&segments_.all()[other].from, &segments_.all()[other].to}) {
      const auto& [x, y, z] = end->near;
      const double value = p.a * x + p.b * y + p.c * z + p.d;
      const double doubt = kShare * (std::abs(p.a * x) + std::abs(p.b * y) +
                                     std::abs(p.c * z) + std::abs(p.d));
      if (value > doubt) {
        found |= kSomePositive;
      } else if (value < -doubt) {
        found |= kSomeNegative;
      } else if (!is_same(*end, by.from) && !is_same(*end, by.to)) {
        found |= kSomePositive | kSomeNegative;
      }
    }
    return found;
  }
  static bool is_same(const CapPoint& p, const CapPoint& q) {
    return p.u == q.u && p.v == q.v;
  }

  /// In front of the eye the line has the sign of the polygon's function at the
  /// plane's points, times that of the eye's side.
  void share_out(const std::vector<std::size_t>& segments, std::size_t s,
                 Part& positive, Part& negative) {
    Part& above = side_ > 0 ? positive : negative;
    Part& below = side_ > 0 ? negative : positive;
    for (const std::size_t other : segments) {
      const int sides = sides_of(s, other);
      if ((sides & kSomePositive) != 0) above.segments.push_back(other);
      if ((sides & kSomeNegative) != 0) below.segments.push_back(other);
    }
  }

  /// The winding numbers in a polygon of the image that no segment passes.
  void find_windings(const std::vector<CellEdge>& polygon) {
    windings_.clear();
    double x = 0;
    double y = 0;
    for (const CellEdge& edge : polygon) {
      x += edge.start.x / static_cast<double>(polygon.size());
      y += edge.start.y / static_cast<double>(polygon.size());
    }
    if (is_inside(polygon, x, y))
      return segments_.add_at(BigRational(x), BigRational(y), windings_);
    // Corners too near for doubles: exactly.
    BigRational sum_x = 0;
    BigRational sum_y = 0;
    LineId before = polygon.back().line;
    for (const CellEdge& edge : polygon) {
      const auto [at_x, at_y] = corner(before, edge.line);
      sum_x += at_x;
      sum_y += at_y;
      before = edge.line;
    }
    const auto count = static_cast<int>(polygon.size());
    segments_.add_at(sum_x / count, sum_y / count, windings_);
  }
  /// Whether doubles tell that a point is inside.
  bool is_inside(const std::vector<CellEdge>& polygon, double x,
                 double y) const {
    if (!std::isfinite(x) || !std::isfinite(y)) return false;
    return std::all_of(
        polygon.begin(), polygon.end(), [&](const CellEdge& edge) {
          const double a = lines_.slope_x(edge.line) * x;
          const double b = lines_.slope_y(edge.line) * y;
          const double c = lines_.offset(edge.line);
          return edge.side * (a + b + c) >
                 kShare * (std::abs(a) + std::abs(b) + std::abs(c));
        });
  }
  /// Where two lines meet, in twice the image's coordinates.
  std::array<BigRational, 2> corner(LineId l, LineId m) const {
    const MapLine p = lines_.exact(l);
    const MapLine q = lines_.exact(m);
    const auto minor = [](const auto& f, const auto& g, const auto& h,
                          const auto& k) -> BigInteger {
      return to_big_integer(f) * to_big_integer(g) -
             to_big_integer(h) * to_big_integer(k);
    };
    const BigInteger w = minor(p.a, q.b, p.b, q.a);
    return {quotient_of(minor(p.b, q.c, p.c, q.b), w),
            quotient_of(minor(p.c, q.a, p.a, q.c), w)};
  }

  void add_piece(const std::vector<CellEdge>& polygon, const CapItem& cap) {
    CapPiece piece;
    piece.cap = cap;
    for (const CellEdge& edge : polygon)
      piece.sides.push_back({edge.line, edge.side});
    pieces_.push_back(std::move(piece));
  }

  /// Adds a polygon that is cap, cut along the stripes of its hatching.
  void add(std::vector<CellEdge> polygon, const CapItem& cap) {
    if (!style_of(image_, cap).hatch) return add_piece(polygon, cap);
    const CapStripes stripes = stripes_of(image_, cap);
    if (!stripes.by_sum || !stripes.by_difference) {
      return add_striped(std::move(polygon), cap, stripes.by_sum,
                         stripes.period);
    }
    // What is between stripes of one kind may be in one of the other.
    std::vector<std::vector<CellEdge>> between;
    add_striped(std::move(polygon), cap, true, stripes.period, &between);
    for (std::vector<CellEdge>& part : between)
      add_striped(std::move(part), cap, false, stripes.period);
  }

  /// Stripes are from 1 up to 5 halves of pixels of x + y, or from -1 to 3 of
  /// x - y. What is between them becomes pieces, too, or goes to `between`.
  void add_striped(std::vector<CellEdge> polygon, CapItem cap, bool is_sum,
                   std::int32_t period,
                   std::vector<std::vector<CellEdge>>* between = nullptr) {
    const auto take = [&](std::vector<CellEdge>& part, bool is_hatched) {
      if (!is_hatched && between != nullptr) {
        between->push_back(std::move(part));
        return;
      }
      cap.is_hatched = is_hatched;
      add_piece(part, cap);
    };
    double least = 2.0 * (camera_.width_px + camera_.height_px);
    double most = -least;
    for (const CellEdge& edge : polygon) {
      const double at =
          is_sum ? edge.start.x + edge.start.y : edge.start.x - edge.start.y;
      least = std::min(least, at);
      most = std::max(most, at);
    }
    const std::int32_t step = 2 * period;
    const auto before = static_cast<std::int32_t>(std::floor(least / step)) - 1;
    const std::int32_t first = step * before + (is_sum ? 1 : -1);
    for (std::int32_t at = first; at <= most + 2 * step; at += step) {
      for (const std::int32_t halves : {at, at + 4}) {
        const LineId line = lines_.stripe(is_sum, halves);
        const int found = cutter_.classify(polygon, line);
        if ((found & kSomeNegative) == 0) continue;
        const bool is_hatched = halves != at;
        if ((found & kSomePositive) == 0) return take(polygon, is_hatched);
        std::vector<CellEdge> above;
        std::vector<CellEdge> below;
        cutter_.cut(polygon, line, kOwnEdge, above, below);
        take(below, is_hatched);
        polygon.swap(above);
      }
    }
  }

  const TreeReader& reader_;
  const View& view_;
  const CameraData& camera_;
  const ImageOptions& image_;
  std::size_t k_;
  int side_;
  LineTable& lines_;
  ConvexCutter cutter_;
  CapSegments segments_;
  CapWindings windings_;
  std::vector<CapPiece> pieces_;
};

}  // namespace

std::vector<CapPiece> cap_pieces(const TreeReader& reader, const View& view,
                                 const CameraData& camera,
                                 const ImageOptions& image, std::size_t k,
                                 int side, LineTable& lines) {
  return CapDivider(reader, view, camera, image, k, side, lines).run();
}

}  // namespace halfspace::fast
