#include <algorithm>
#include <array>
#include <cstddef>

#include "drawing/clip_forms.hpp"
#include "drawing/hiding.hpp"
#include "drawing/short_product.hpp"

/// Where the caps of two clip planes meet (S9.8).
namespace halfspace::fast {
namespace {

std::array<FormInt, 3> normal_of(const Form& f) { return {f.a, f.b, f.c}; }

std::array<FormInt, 3> cross(const std::array<FormInt, 3>& u,
                             const std::array<FormInt, 3>& v) {
  const auto minor = [&](std::size_t k, std::size_t l) {
    return short_product<7>(u[k], v[l]) - short_product<7>(u[l], v[k]);
  };
  return {minor(1, 2), minor(2, 0), minor(0, 1)};
}

FormValue dot(const std::array<FormInt, 3>& u,
              const std::array<FormInt, 3>& v) {
  return short_product<11>(u[0], v[0]) + short_product<11>(u[1], v[1]) +
         short_product<11>(u[2], v[2]);
}

/// The box round a scene, one grid step larger on all sides.
struct WholeBox {
  std::array<std::int64_t, 3> low, high;
};

WholeBox box_round(const Scene& scene) {
  const auto& vertices = scene.data().vertices;
  WholeBox box;
  const auto along = [](const GridPoint& p, std::size_t axis) {
    return static_cast<std::int64_t>(axis == 0 ? p.x : axis == 1 ? p.y : p.z);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element(vertices.begin(), vertices.end(),
                            [&](const GridPoint& p, const GridPoint& q) {
                              return along(p, axis) < along(q, axis);
                            });
    box.low[axis] = along(*low, axis) - 1;
    box.high[axis] = along(*high, axis) + 1;
  }
  return box;
}

/// The points (x, y, z, w), w positive, in which the line of two planes in the
/// direction `d` meets a side of the box, if they are in the box.
struct BoxPoint {
  std::array<FormInt, 3> at;
  FormInt w;
};

/// With x_k = c and the next coordinates y and z, two equations are left:
/// f_y y + f_z z = -(f_w + f_k c), and the same for g. The determinant is d_k.
bool meets_side(const Form& f, const Form& g, const WholeBox& box,
                std::size_t k, std::int64_t c, BoxPoint& point) {
  const auto m = normal_of(f);
  const auto n = normal_of(g);
  const std::size_t y = (k + 1) % 3;
  const std::size_t z = (k + 2) % 3;
  FormInt w = cross(m, n)[k];
  const int turn = sign(w);
  if (turn == 0) return false;
  const auto times = [turn](const FormInt& value) {
    return turn > 0 ? value : -value;
  };
  const FormInt e = f.d + short_product<7>(m[k], Wide<2>(c));
  const FormInt h = g.d + short_product<7>(n[k], Wide<2>(c));
  w = times(w);
  point.w = w;
  point.at[k] = short_product<7>(w, Wide<2>(c));
  point.at[y] = times(short_product<7>(h, m[z]) - short_product<7>(e, n[z]));
  point.at[z] = times(short_product<7>(e, n[y]) - short_product<7>(h, m[y]));
  for (const std::size_t axis : {y, z}) {
    const auto side = [&](std::int64_t at) {
      return sign(point.at[axis] - short_product<7>(w, Wide<2>(at)));
    };
    if (side(box.low[axis]) < 0 || side(box.high[axis]) > 0) return false;
  }
  return true;
}

}  // namespace

/// Points of the first plane beside the line, on the positive side of the
/// second one, are in one direction from the line; those of `beside` are in it.
bool ClipForms::is_cut_off(const Line& line) const {
  const auto n = normal_of(form(line.clip));
  const auto along = cross(n, normal_of(form(line.other_clip)));
  const auto beside = cross(along, n);
  for (std::int32_t k = 0; k < count(); ++k) {
    if (k == line.clip || k == line.other_clip || !holds(k, line)) continue;
    if (sign(dot(normal_of(form(k)), beside)) <= 0) return true;
  }
  return false;
}

std::vector<Line> ClipForms::corners(bool cull) const {
  std::vector<Line> lines;
  if (!kCornersOfCaps || !has_caps_ || bits_.empty()) return lines;
  const WholeBox box = box_round(sight_.scene());
  for (std::int32_t first = 0; first < count(); ++first) {
    for (std::int32_t second = first + 1; second < count(); ++second) {
      if (cull && !has_cap_in_front(first) && !has_cap_in_front(second))
        continue;
      Line line;
      line.clip = first;
      line.other_clip = second;
      bool found = false;
      for (std::size_t side = 0; side < 6; ++side) {
        const std::size_t axis = side / 2;
        BoxPoint p;
        if (!meets_side(form(first), form(second), box, axis,
                        side % 2 == 0 ? box.low[axis] : box.high[axis], p))
          continue;
        const SpacePoint point = sight_.point_of(
            Wide<5>(p.at[0]), Wide<5>(p.at[1]), Wide<5>(p.at[2]), Wide<4>(p.w));
        if (!found || is_before(point, line.from)) line.from = point;
        if (!found || is_before(line.to, point)) line.to = point;
        found = true;
      }
      if (found && is_before(line.from, line.to) && !is_cut_off(line))
        lines.push_back(std::move(line));
    }
  }
  return lines;
}

std::vector<ClipForms::Crossing> ClipForms::crossings(const Line& line) const {
  const Form& f = form(line.clip);
  const Form& g = form(line.other_clip);
  const auto d = cross(normal_of(f), normal_of(g));
  const int x = sign(d[0]);
  const int y = sign(d[1]);
  const int along = x != 0 ? x : y != 0 ? y : sign(d[2]);
  const std::uint32_t both = 1u << line.clip | 1u << line.other_clip;
  std::vector<Crossing> found;
  std::vector<std::array<Wide<4>, 2>> values;
  for (std::size_t p = 0; p < bits_.size(); ++p) {
    const auto polygon = static_cast<PolygonId>(p);
    if (((bits_[p].removed | bits_[p].kept) & both) != 0) continue;
    values.clear();
    for (const VertexId v : sight_.scene().corners(polygon)) {
      const SpacePoint corner = sight_.point_of(v);
      values.push_back(
          {Wide<4>(value_at(f, corner)), Wide<4>(value_at(g, corner))});
    }
    const auto side = [&](std::size_t k) {
      const auto& [fa, ga] = values[k];
      const auto& [fb, gb] = values[k + 1 == values.size() ? 0 : k + 1];
      const int first =
          sign(short_product<7>(fa, gb) - short_product<7>(fb, ga));
      if (first != 0) return first;
      const int second = sign(fb - fa);
      return second != 0 ? second : sign(ga - gb);
    };
    const int inside = side(0);
    bool crosses = inside != 0;
    for (std::size_t k = 1; crosses && k < values.size(); ++k)
      crosses = side(k) == inside;
    // The line leaves the solid where it goes along the polygon's normal.
    if (crosses) found.push_back({polygon, -inside * along});
  }
  return found;
}

}  // namespace halfspace::fast
