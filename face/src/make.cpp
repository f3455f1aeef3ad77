#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "halfspace/csg/hull.hpp"
#include "halfspace/csg/primitives.hpp"
#include "halfspace/csg/turned.hpp"
#include "import.hpp"
#include "node.hpp"
#include "number.hpp"

namespace halfspace {
namespace {

using detail::faulty_solid;
using detail::leaf_solid;

constexpr int kMostSegments = 1 << 16;

detail::ImportHow trusted() {
  detail::ImportHow how;
  how.is_trusted = true;
  return how;
}

bool is_size(double value) { return std::isfinite(value) && value > 0; }

/// Twice the area that the loop goes round, counterclockwise, about.
double area2(const std::vector<Point2>& loop) {
  double sum = 0;
  const Point2& o = loop.front();
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Point2& p = loop[i - 1];
    const Point2& q = loop[i];
    sum += (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
  }
  return sum;
}

using NumberPair = std::array<io::Number, 2>;

/// A round solid, that of scripts: decimals, where a grid holds them; `make`
/// makes its mesh by the number of segments.
template <class Make>
Solid round_solid(const std::string& name, int segments, bool is_trusted,
                  const Make& make) {
  if (segments < 3 || segments > kMostSegments) {
    return faulty_solid(name, ErrorCode::kOutOfRange,
                        "there are " + std::to_string(segments) +
                            " segments, not 3 to " +
                            std::to_string(kMostSegments));
  }
  return leaf_solid(name, [=] {
    detail::ImportHow how;
    how.is_free = true;
    how.is_trusted = is_trusted;
    return detail::imported_leaf(
        name, make(static_cast<std::uint32_t>(segments)), nullptr, how);
  });
}

Solid bad_size(const char* name) {
  return faulty_solid(name, ErrorCode::kOutOfRange,
                      "a size is not a number above 0");
}

/// The mesh of a prism from `low` to `high`; the loop counterclockwise.
Mesh prism_mesh(const std::vector<Point2>& loop, double low, double high) {
  Mesh mesh;
  for (const double z : {low, high}) {
    for (const Point2& p : loop) mesh.vertices.push_back({p.x, p.y, z});
  }
  csg::Faces faces = csg::prism_faces(static_cast<std::uint32_t>(loop.size()));
  mesh.first_corner = std::move(faces.first_corner);
  mesh.corners = std::move(faces.corners);
  return mesh;
}

Solid prism_of(std::vector<Point2> loop, double height) {
  if (loop.size() < 3) {
    return faulty_solid("prism", ErrorCode::kTooFewVertices,
                        "a loop has fewer than 3 points");
  }
  if (area2(loop) < 0) std::reverse(loop.begin(), loop.end());
  return leaf_solid("prism", [loop = std::move(loop), height] {
    return detail::mesh_leaf(
        "prism", prism_mesh(loop, std::min(height, 0.0), std::max(height, 0.0)),
        {});
  });
}

}  // namespace

Solid::Solid()
    : Solid(leaf_solid("nothing", [] {
        return detail::mesh_leaf("nothing", Mesh{}, trusted());
      })) {}

Solid Solid::box(Point a, Point b) {
  return leaf_solid("box", [a, b]() -> Result<detail::LeafData> {
    const Point low{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
    const Point high{std::max(a.x, b.x), std::max(a.y, b.y),
                     std::max(a.z, b.z)};
    if (detail::is_finite(a) && detail::is_finite(b) &&
        (low.x == high.x || low.y == high.y || low.z == high.z))
      return Error{ErrorCode::kZeroArea, "box: it is flat"};
    return detail::mesh_leaf("box",
                             prism_mesh({{low.x, low.y},
                                         {high.x, low.y},
                                         {high.x, high.y},
                                         {low.x, high.y}},
                                        low.z, high.z),
                             trusted());
  });
}

Solid Solid::sphere(double radius, int segments) {
  if (!is_size(radius)) return bad_size("sphere");
  return round_solid("sphere", segments, true, [radius](std::uint32_t n) {
    return csg::sphere_mesh(detail::number_of(radius), n);
  });
}

Solid Solid::cylinder(double radius, double height, int segments) {
  if (!is_size(radius) || !is_size(height)) return bad_size("cylinder");
  return round_solid("cylinder", segments, true, [=](std::uint32_t n) {
    const io::Number r = detail::number_of(radius);
    return csg::frustum_mesh(r, r, {}, detail::number_of(height), n);
  });
}

Solid Solid::cone(double bottom, double top, double height, int segments) {
  if (!(is_size(bottom) || bottom == 0) || !(is_size(top) || top == 0) ||
      !is_size(height) || bottom + top == 0)
    return bad_size("cone");
  return round_solid("cone", segments, true, [=](std::uint32_t n) {
    return csg::frustum_mesh(detail::number_of(bottom), detail::number_of(top),
                             {}, detail::number_of(height), n);
  });
}

Solid Solid::torus(double radius, double tube_radius, int segments,
                   int tube_segments) {
  if (!is_size(radius) || !is_size(tube_radius)) return bad_size("torus");
  if (tube_radius >= radius || tube_segments < 3 ||
      tube_segments > kMostSegments) {
    return faulty_solid("torus", ErrorCode::kOutOfRange,
                        "the tube's radius is not below the ring's, or it has "
                        "fewer than 3 segments");
  }
  return round_solid("torus", segments, true, [=](std::uint32_t n) {
    return csg::torus_mesh(detail::number_of(radius),
                           detail::number_of(tube_radius), n,
                           static_cast<std::uint32_t>(tube_segments));
  });
}

Solid Solid::prism(const Outline& outline, double height) {
  if (height == 0 || !std::isfinite(height)) {
    return faulty_solid("prism", ErrorCode::kOutOfRange,
                        "its height is 0 or not finite");
  }
  Solid solid = prism_of(outline.points, height);
  for (const auto& hole : outline.holes) solid -= prism_of(hole, height);
  return solid;
}

Solid Solid::revolution(const std::vector<Point2>& outline, int segments) {
  const bool is_right =
      outline.size() >= 3 &&
      std::all_of(outline.begin(), outline.end(), [](const Point2& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && p.x >= 0;
      });
  if (!is_right) {
    return faulty_solid("revolution", ErrorCode::kOutOfRange,
                        "its outline has fewer than 3 points, or one with r "
                        "below 0 or not finite");
  }
  std::vector<NumberPair> loop;
  for (const Point2& p : outline)
    loop.push_back({detail::number_of(p.x), detail::number_of(p.y)});
  if (area2(outline) < 0) std::reverse(loop.begin(), loop.end());
  return round_solid("revolution", segments, false,
                     [loop = std::move(loop)](std::uint32_t n) {
                       return csg::revolved_mesh(loop, n);
                     });
}

Solid Solid::hull(std::vector<Point> points) {
  return leaf_solid(
      "hull", [points = std::move(points)]() -> Result<detail::LeafData> {
        if (!std::all_of(points.begin(), points.end(), detail::is_finite))
          return Error{ErrorCode::kNotFinite, "hull: a point is not finite"};
        detail::ExactPoints exact = detail::exact_points(points);
        auto mesh = csg::hull_of(std::move(exact.points), exact.decimal);
        if (!mesh) return mesh.error();
        return detail::imported_leaf("hull", *std::move(mesh), nullptr, {});
      });
}

Solid Solid::from_mesh(Mesh mesh, const OperandOptions& options) {
  return leaf_solid(
      "mesh", [kept = std::make_shared<const Mesh>(std::move(mesh)), options] {
        return detail::mesh_leaf("mesh", kept, {.options = options});
      });
}

Solid Solid::from_file(std::filesystem::path path,
                       const OperandOptions& options) {
  std::string name = path.string();
  return leaf_solid(
      name, [name, options] { return detail::file_leaf(name, options); });
}

Result<Mended> mended(const std::filesystem::path& path,
                      const MendOptions& options) {
  std::vector<std::string> done;
  const Result<detail::LeafData> data =
      detail::mended_leaf(path.string(), options, done);
  if (!data) return data.error();
  return Mended{detail::leaf_solid(path.string(), [data] { return data; }),
                std::move(done)};
}

}  // namespace halfspace
