#include <algorithm>
#include <optional>

#include "definition/definition.hpp"

namespace halfspace::definition {
namespace {

/// An integer of 128 bits, in two halves.
Integer integer(Int128 value) {
  const Int128 base = Int128{1} << 32;
  const auto low = static_cast<std::int64_t>(((value % base) + base) % base);
  const Int128 rest = (value - low) / base;
  const auto middle = static_cast<std::int64_t>(((rest % base) + base) % base);
  const auto high = static_cast<std::int64_t>((rest - middle) / base);
  return ((Integer(high) << 32) + middle) * (Integer(1) << 32) + low;
}

Integer dot(const Plane& plane, const LatticeVector& v) {
  return plane.a * integer(v.x) + plane.b * integer(v.y) +
         plane.c * integer(v.z);
}

/// 2^8 times the plane's value at a point of the lattice.
Integer value_at(const Plane& plane, const LatticeVector& v) {
  return dot(plane, v) + (plane.d << kLatticeBits);
}

/// The same for the eye, which may be at infinity.
Integer value_at_eye(const Plane& plane, const Camera& camera) {
  return camera->perspective ? value_at(plane, camera->eye)
                             : dot(plane, camera->eye);
}

Affine value_on_image(const Plane& plane, const Camera& camera) {
  return {value_at(plane, camera->s0), dot(plane, camera->sx),
          dot(plane, camera->sy)};
}

Affine constant(const Integer& value) { return {value, 0, 0}; }

Affine operator-(const Affine& f, const Affine& g) {
  return {f.c - g.c, f.x - g.x, f.y - g.y};
}

Affine operator*(const Integer& k, const Affine& f) {
  return {k * f.c, k * f.x, k * f.y};
}

/// The product of two functions, one of which is constant.
Affine operator*(const Affine& f, const Affine& g) {
  return f.x == 0 && f.y == 0 ? f.c * g : g.c * f;
}

/// Twice the value at the centre of pixel (i, j).
Integer twice_at_centre(const Affine& f, std::int32_t i, std::int32_t j) {
  return 2 * f.c + (2 * i + 1) * f.x + (2 * j + 1) * f.y;
}

std::vector<Projection> project_all(const Scene& scene, const Camera& camera,
                                    bool cull) {
  std::vector<Projection> all;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    all.push_back(project(facet_of(scene, whole(scene, id)), camera, cull));
  }
  return all;
}

PolygonId seen_at(const std::vector<Projection>& polygons, std::int32_t i,
                  std::int32_t j) {
  PolygonId seen = kBackground;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    if (!covers(polygons[p], i, j)) continue;
    if (seen == kBackground ||
        compare_depth(polygons[p], polygons[static_cast<std::size_t>(seen)], i,
                      j) < 0) {
      seen = static_cast<PolygonId>(p);
    }
  }
  return seen;
}

/// The mean of three corner values with the weights of the edges opposite,
/// rounded half up.
std::uint8_t mean(const Integer (&weight)[3], int c0, int c1, int c2) {
  const Integer den = weight[0] + weight[1] + weight[2];
  // The edge that leaves corner k lies opposite corner k + 2.
  const Integer num = weight[1] * c0 + weight[2] * c1 + weight[0] * c2;
  return static_cast<std::uint8_t>((2 * num + den) / (2 * den));
}

Rgb color_at(const Scene& scene, PolygonId polygon, const Projection& seen,
             const ImageOptions& options, std::int32_t i, std::int32_t j) {
  const auto colors = scene.corner_colors(polygon);
  if (options.shading == Shading::kFlat || colors.empty())
    return scene.color(polygon);
  const bool equal =
      std::all_of(colors.begin(), colors.end(),
                  [&](const Rgb& color) { return color == colors.front(); });
  if (equal) return colors.front();
  const Integer weight[3] = {twice_at_centre(seen.edges[0], i, j),
                             twice_at_centre(seen.edges[1], i, j),
                             twice_at_centre(seen.edges[2], i, j)};
  return {mean(weight, colors[0].r, colors[1].r, colors[2].r),
          mean(weight, colors[0].g, colors[1].g, colors[2].g),
          mean(weight, colors[0].b, colors[1].b, colors[2].b)};
}

}  // namespace

int side_of_eye(const Plane& plane, const Camera& camera) {
  return value_at_eye(plane, camera).sign();
}

int sign_at_sample(const Affine& f, std::int32_t i, std::int32_t j) {
  const int centre = twice_at_centre(f, i, j).sign();
  if (centre != 0) return centre;
  return f.x.sign() != 0 ? f.x.sign() : f.y.sign();
}

Projection project(const Facet& facet, const Camera& camera, bool cull) {
  Projection p;
  const Integer at_eye = value_at_eye(facet.support, camera);
  const int sigma = at_eye.sign();
  p.nothing = sigma == 0 || (cull && sigma < 0);
  const Affine on_image = value_on_image(facet.support, camera);
  for (const Plane& edge : facet.edges) {
    p.edges.push_back(Integer(sigma) * (at_eye * value_on_image(edge, camera) -
                                        value_at_eye(edge, camera) * on_image));
  }
  p.inside = p.edges;
  // p(t) = eye + t (s - eye) has h = 0 at t = h(eye) / (h(eye) - h(s));
  // p(t) = s - t eye at t = h(s) / n.eye.
  if (camera->perspective) {
    p.num = constant(sigma * at_eye);
    p.den = Integer(sigma) * (constant(at_eye) - on_image);
    p.inside.push_back(p.den);
  } else {
    p.num = Integer(sigma) * on_image;
    p.den = constant(sigma * at_eye);
  }
  if (camera->near) {
    p.inside.push_back((Integer(1) << kNearBits) * p.num -
                       Integer(*camera->near) * p.den);
  }
  return p;
}

bool covers(const Projection& p, std::int32_t i, std::int32_t j) {
  if (p.nothing) return false;
  return std::all_of(p.inside.begin(), p.inside.end(), [&](const Affine& f) {
    return sign_at_sample(f, i, j) > 0;
  });
}

int compare_depth(const Projection& p, const Projection& q, std::int32_t i,
                  std::int32_t j) {
  return sign_at_sample(p.num * q.den - q.num * p.den, i, j);
}

Grid2<std::uint8_t> coverage(const Facet& facet, const Camera& camera,
                             bool cull) {
  const Projection p = project(facet, camera, cull);
  Grid2<std::uint8_t> mask(camera->width_px, camera->height_px, 0);
  for (std::int32_t j = 0; j < mask.height_px; ++j) {
    for (std::int32_t i = 0; i < mask.width_px; ++i)
      mask.at(i, j) = covers(p, i, j) ? 1 : 0;
  }
  return mask;
}

ItemImage item_image(const Scene& scene, const Camera& camera,
                     const ImageOptions& options) {
  const auto polygons = project_all(scene, camera, options.cull);
  ItemImage image(camera->width_px, camera->height_px, kBackground);
  for (std::int32_t j = 0; j < image.height_px; ++j) {
    for (std::int32_t i = 0; i < image.width_px; ++i)
      image.at(i, j) = seen_at(polygons, i, j);
  }
  return image;
}

ColorImage color_image(const Scene& scene, const Camera& camera,
                       const ImageOptions& options) {
  const auto polygons = project_all(scene, camera, options.cull);
  ColorImage image(camera->width_px, camera->height_px, options.background);
  for (std::int32_t j = 0; j < image.height_px; ++j) {
    for (std::int32_t i = 0; i < image.width_px; ++i) {
      const PolygonId seen = seen_at(polygons, i, j);
      if (seen == kBackground) continue;
      image.at(i, j) = color_at(
          scene, seen, polygons[static_cast<std::size_t>(seen)], options, i, j);
    }
  }
  return image;
}

}  // namespace halfspace::definition
