#include "polygons.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace halfspace::shadow {
namespace {

using Vector = std::array<Bounded, 3>;

Vector bounded(const LatticeVector& v) {
  return {shadow::bounded(v.x), shadow::bounded(v.y), shadow::bounded(v.z)};
}

Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
          u[0] * v[1] - u[1] * v[0]};
}

Bounded dot(const Bounded (&u)[3], const Vector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// The edge function of the line from p to q: the determinant of (x, y, 1), p
/// and q (PIN88; OG97).
Affine line_through(const Projected& p, const Projected& q) {
  return {p.x * q.y - p.y * q.x, p.y * q.w - p.w * q.y, p.w * q.x - p.x * q.w};
}

/// The determinant of three points.
Bounded volume(const Affine& line, const Projected& p) {
  return p.x * line.dx + p.y * line.dy + p.w * line.c;
}

Affine operator-(const Affine& f) { return {-f.c, -f.dx, -f.dy}; }

Affine operator+(const Affine& f, const Affine& g) {
  return {f.c + g.c, f.dx + g.dx, f.dy + g.dy};
}

Affine operator*(const Bounded& a, const Affine& f) {
  return {a * f.c, a * f.dx, a * f.dy};
}

Affine operator/(const Affine& f, const Bounded& a) {
  return {f.c / a, f.dx / a, f.dy / a};
}

double centre(std::int32_t pixel) { return pixel + 0.5; }

/// The pixel of a coordinate, clamped to one pixel outside the image.
/// Coordinates from -1 to 0 give 0, which only enlarges the bounds.
std::int32_t pixel(double value, std::int32_t size) {
  return static_cast<std::int32_t>(
      std::clamp(value, -1.0, static_cast<double>(size)));
}

}  // namespace

Polygons::Polygons(const Scene& scene, const Camera& camera,
                   const ImageOptions& options)
    : scene_(scene),
      camera_(camera),
      cull_(options.cull),
      origin_(camera->perspective ? camera->eye : camera->s0) {
  const LatticeVector& s0 = camera->s0;
  const LatticeVector& eye = camera->eye;
  const Vector depth =
      bounded(camera->perspective
                  ? LatticeVector{s0.x - eye.x, s0.y - eye.y, s0.z - eye.z}
                  : LatticeVector{-eye.x, -eye.y, -eye.z});
  const Vector sx = bounded(camera->sx);
  const Vector sy = bounded(camera->sy);
  // Cramer's rule for X sx + Y sy + T depth = p - origin.
  const Vector rows[3] = {cross(sy, depth), cross(depth, sx), cross(sx, sy)};
  volume_ =
      rows[2][0] * depth[0] + rows[2][1] * depth[1] + rows[2][2] * depth[2];
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t k = 0; k < 3; ++k) rows_[r][k] = rows[r][k] / volume_;
  }
  const Bounded step = exactly(1 << kLatticeBits);
  for (const ClipPlane& clip : options.clips) {
    const Vector normal = {shadow::bounded(clip.a), shadow::bounded(clip.b),
                           shadow::bounded(clip.c)};
    const auto along = [&](const Vector& v) {
      return normal[0] * v[0] + normal[1] * v[1] + normal[2] * v[2];
    };
    const Bounded offset = step * shadow::bounded(clip.d);
    const Bounded at_eye = along(bounded(eye));
    clips_.push_back({camera->perspective ? at_eye + offset : at_eye,
                      {along(bounded(s0)) + offset, along(sx), along(sy)}});
  }
  vertices_.reserve(scene.data().vertices.size());
  for (const GridPoint& p : scene.data().vertices)
    vertices_.push_back(project(p));
}

Projected Polygons::project(const GridPoint& p) const {
  const Int128 scale = Int128{1} << kLatticeBits;
  const Vector v =
      bounded(LatticeVector{p.x * scale - origin_.x, p.y * scale - origin_.y,
                            p.z * scale - origin_.z});
  Projected place;
  place.x = dot(rows_[0], v);
  place.y = dot(rows_[1], v);
  place.t = dot(rows_[2], v);
  place.w = camera_->perspective ? place.t : exactly(1);
  if (!is_positive(place.w)) return place;
  const double t = camera_->perspective ? place.t.value - place.t.error
                                        : place.t.error - place.t.value;
  constexpr double kUp = 1 + 0x1p-50;
  // In perspective t is w, which is positive. Else kTiny is negligible.
  place.nearness =
      camera_->perspective ? kUp / t : t + 0x1p-50 * std::abs(t) + kTiny;
  if (std::isnan(place.nearness)) place.nearness = HUGE_VAL;
  place.column = place.x.value / place.w.value;
  place.row = place.y.value / place.w.value;
  // The quotient's error is below a pixel if the divisor exceeds the sum of the
  // errors. NaN fails the comparison.
  const double least = (place.w.value - place.w.error) / 2;
  const auto is_close = [&](const Bounded& numerator, double quotient) {
    return std::abs(quotient) < 0x1p40 &&
           numerator.error + std::abs(quotient) * place.w.error < least;
  };
  place.is_placed =
      is_close(place.x, place.column) && is_close(place.y, place.row);
  return place;
}

Plain Polygons::plain(const Affine& f) const {
  // At most four roundings, each of a value below the sum of the sizes.
  const double x = camera_->width_px;
  const double y = camera_->height_px;
  const double size =
      std::abs(f.c.value) + x * std::abs(f.dx.value) + y * std::abs(f.dy.value);
  const double error = f.c.error + x * f.dx.error + y * f.dy.error;
  return {f.c.value, f.dx.value, f.dy.value,
          kSlack * (error + 4 * kUnit * size) + kTiny};
}

double Polygons::nearness_of(PolygonId polygon) const {
  double nearness = -HUGE_VAL;
  for (const VertexId vertex : scene_.corners(polygon)) {
    nearness = std::max(nearness,
                        vertices_[static_cast<std::size_t>(vertex)].nearness);
  }
  return nearness;
}

Bounds Polygons::bounds_of(PolygonId polygon) const {
  const std::int32_t width = camera_->width_px;
  const std::int32_t height = camera_->height_px;
  const Bounds all{0, width - 1, 0, height - 1};
  double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL;
  bool all_behind = true;
  bool all_placed = true;
  for (const VertexId vertex : scene_.corners(polygon)) {
    const Projected& p = vertices_[static_cast<std::size_t>(vertex)];
    all_behind = all_behind && is_negative(p.w);
    all_placed = all_placed && p.is_placed;
    left = std::min(left, p.column);
    right = std::max(right, p.column);
    top = std::min(top, p.row);
    bottom = std::max(bottom, p.row);
  }
  if (all_behind) return {};
  if (!all_placed) return all;
  return {std::max(pixel(left - 1, width), 0),
          std::min(pixel(right + 1, width), width - 1),
          std::max(pixel(top - 1, height), 0),
          std::min(pixel(bottom + 1, height), height - 1)};
}

Affine Polygons::beyond_near(const Affine& nearness,
                             const Bounded& scale) const {
  // T > near / 2^16, with T = scale / nearness, or -nearness / scale.
  const Bounded unit = exactly(1 << kNearBits);
  const Bounded near = exactly(static_cast<double>(*camera_->near));
  const Affine constant{scale, {}, {}};
  return camera_->perspective ? unit * constant + -(near * nearness)
                              : -(unit * nearness) + -(near * constant);
}

/// The point at T has the value C(e) + T (C(s) - C(e)) or C(s) - T C(e), with T
/// = scale / nearness or -nearness / scale: times nearness, or scale.
Affine Polygons::kept_by(const Clip& clip, const Affine& nearness,
                         const Bounded& scale) const {
  const Affine from_eye{clip.at_image.c - clip.at_eye, clip.at_image.dx,
                        clip.at_image.dy};
  return clip.at_eye * nearness +
         scale * (camera_->perspective ? from_eye : clip.at_image);
}

Prepared Polygons::prepare(PolygonId polygon) {
  Prepared prepared;
  const auto corners = scene_.corners(polygon);
  const std::size_t count = corners.size();
  const auto corner = [&](std::size_t k) -> const Projected& {
    return vertices_[static_cast<std::size_t>(corners[k % count])];
  };
  lines_.clear();
  prepared.first = static_cast<std::uint32_t>(insides_.size());
  for (std::size_t k = 0; k < count; ++k)
    lines_.push_back(line_through(corner(k), corner(k + 1)));

  // Three consecutive corners span the plane. The largest volume is the best
  // conditioned; a triangle has one volume only.
  const bool is_triangle = count == 3;
  Bounded scale;
  std::size_t at = 0;
  for (std::size_t k = 0; k < (is_triangle ? 1 : count); ++k) {
    const Bounded here = volume(lines_[k], corner(k + 2));
    if (k > 0 && !(std::abs(here.value) > std::abs(scale.value))) continue;
    scale = here;
    at = k;
  }
  const bool turned = is_negative(scale);
  if (!turned && !is_positive(scale)) return prepared;
  // The plane's value at the eye is -scale * volume_ before orientation.
  if (cull_) {
    if (is_positive(scale * volume_)) {
      insides_.push_back({-1, 0, 0, 0});
      prepared.count = 1;
      prepared.certain = true;
      return prepared;
    }
    if (!is_negative(scale * volume_)) return prepared;
  }

  // (x, y, 1) is a linear combination of the three corners; these, divided by
  // `scale`, are the coefficients.
  const Affine ab = lines_[at];
  const Affine bc = lines_[(at + 1) % count];
  const Affine ca =
      is_triangle ? lines_[2] : line_through(corner(at + 2), corner(at));
  Affine nearness = camera_->perspective
                        ? ab + bc + ca
                        : -(corner(at).t * bc + corner(at + 1).t * ca +
                            corner(at + 2).t * ab);
  if (turned) {
    for (Affine& line : lines_) line = -line;
    nearness = -nearness;
    scale = -scale;
  }
  if (camera_->near && (*camera_->near != 0 || !camera_->perspective))
    lines_.push_back(beyond_near(nearness, scale));
  for (const Clip& clip : clips_)
    lines_.push_back(kept_by(clip, nearness, scale));
  for (const Affine& line : lines_) insides_.push_back(plain(line));
  prepared.count = static_cast<std::uint32_t>(lines_.size());
  prepared.nearness = plain(nearness / scale);
  prepared.certain = true;
  return prepared;
}

Verdict Polygons::covers(const Prepared& polygon, std::int32_t i,
                         std::int32_t j) const {
  if (!polygon.certain) return Verdict::kUnknown;
  Verdict verdict = Verdict::kYes;
  for (std::uint32_t k = 0; k < polygon.count; ++k) {
    const Bounded value = insides_[polygon.first + k].at(centre(i), centre(j));
    if (is_negative(value)) return Verdict::kNo;
    if (!is_positive(value)) verdict = Verdict::kUnknown;
  }
  return verdict;
}

Bounded Polygons::nearness_at(const Prepared& polygon, std::int32_t i,
                              std::int32_t j) {
  return polygon.nearness.at(centre(i), centre(j));
}

bool Polygons::has_color(PolygonId polygon, const Prepared& prepared,
                         std::int32_t i, std::int32_t j, Rgb color) const {
  if (!prepared.certain || prepared.count < 3) return false;
  const auto corners = scene_.corner_colors(polygon);
  // Barycentric weights: the edge from corner k is opposite corner k + 2.
  std::array<Bounded, 3> weight;
  for (std::size_t k = 0; k < 3; ++k)
    weight[(k + 2) % 3] = insides_[prepared.first + k].at(centre(i), centre(j));
  const Bounded all = weight[0] + weight[1] + weight[2];
  if (!is_positive(all)) return false;
  const auto is_right = [&](std::uint8_t Rgb::*of) {
    Bounded twice;
    for (std::size_t k = 0; k < 3; ++k)
      twice = twice + exactly(2.0 * (corners[k].*of)) * weight[k];
    // color - 1/2 < value < color + 1/2.
    return is_positive(twice - exactly(2.0 * (color.*of) - 1) * all) &&
           is_positive(exactly(2.0 * (color.*of) + 1) * all - twice);
  };
  return is_right(&Rgb::r) && is_right(&Rgb::g) && is_right(&Rgb::b);
}

}  // namespace halfspace::shadow
