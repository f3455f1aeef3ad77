
#include <algorithm>
#include <functional>
#include <map>

#include "definition/definition.hpp"
#include "generate/generate.hpp"

namespace halfspace::generate {
namespace {

using definition::Affine;
using definition::Plane;
using definition::Point;
using definition::Projection;

/// A view, taken apart once for all questions.
struct Case {
  const SceneFile& view;
  std::vector<std::vector<Point>> points;
  std::vector<Plane> planes;
  std::vector<definition::Facet> facets;
  std::vector<Projection> seen;

  explicit Case(const SceneFile& file) : view(file) {
    for (std::size_t p = 0; p < file.scene.polygon_count(); ++p) {
      const auto id = static_cast<PolygonId>(p);
      const FragmentName name = definition::whole(file.scene, id);
      points.push_back(definition::points_of(file.scene, name));
      planes.push_back(definition::plane_of(file.scene, id));
      facets.push_back(definition::facet_of(file.scene, name));
      seen.push_back(definition::project(facets.back(), *file.camera, false));
    }
  }
};

/// Whether two different polygons are so related.
bool any_pair(const Case& c,
              const std::function<bool(std::size_t, std::size_t)>& related) {
  for (std::size_t p = 0; p < c.planes.size(); ++p) {
    for (std::size_t q = 0; q < c.planes.size(); ++q) {
      if (p != q && related(p, q)) return true;
    }
  }
  return false;
}

bool coincident(const Case& c, bool same_way) {
  return any_pair(c, [&](std::size_t p, std::size_t q) {
    const Plane& u = c.planes[p];
    const Plane& v = c.planes[q];
    const bool agree = (u.a * v.a + u.b * v.b + u.c * v.c) > 0;
    return agree == same_way &&
           definition::relation(c.points[p], v) == Relation::kCoincident;
  });
}

bool spanning(const Case& c) {
  return any_pair(c, [&](std::size_t p, std::size_t q) {
    return definition::relation(c.points[p], c.planes[q]) ==
           Relation::kSpanning;
  });
}

/// Two polygons that use an edge in opposite directions.
bool shared_edge(const Case& c) {
  return any_pair(c, [&](std::size_t p, std::size_t q) {
    const auto& a = c.points[p];
    const auto& b = c.points[q];
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        if (a[i] == b[(j + 1) % b.size()] && a[(i + 1) % a.size()] == b[j])
          return true;
      }
    }
    return false;
  });
}

bool sliver(const Case& c) {
  return std::any_of(
      c.points.begin(), c.points.end(), [](const std::vector<Point>& polygon) {
        // Height below a twentieth of the longest side: area^2 * 400 < side^4.
        const Point& p = polygon[0];
        const Point& q = polygon[1];
        const Point& r = polygon[2];
        const auto square = [](const Point& a, const Point& b) {
          const auto x = b.x - a.x, y = b.y - a.y, z = b.z - a.z;
          return definition::Integer(x * x + y * y + z * z);
        };
        const auto a = square(p, q), b = square(q, r), d = square(p, r);
        const definition::Integer longest = std::max({a, b, d});
        // Heron: 16 area^2.
        const definition::Integer area =
            2 * a * b + 2 * b * d + 2 * a * d - a * a - b * b - d * d;
        return polygon.size() == 3 && 100 * area < longest * longest;
      });
}

/// The eye as a point of the grid's space, if it is one.
Point eye_of(const Camera& camera) {
  const auto number = [](Int128 value) {
    return definition::Integer(to_string(value));
  };
  return {number(camera->eye.x), number(camera->eye.y), number(camera->eye.z),
          definition::Integer(1) << kLatticeBits};
}

bool eye_on_plane(const Case& c) {
  return std::any_of(c.seen.begin(), c.seen.end(),
                     [](const Projection& p) { return p.nothing; });
}

/// The eye on the plane of a polygon and on that of one of its edges.
bool eye_on_line(const Case& c) {
  if (!c.view.camera.value()->perspective) return false;
  const Point eye = eye_of(*c.view.camera);
  for (const auto& facet : c.facets) {
    if (definition::side_of(facet.support, eye) != 0) continue;
    for (const Plane& edge : facet.edges) {
      if (definition::side_of(edge, eye) == 0) return true;
    }
  }
  return false;
}

bool eye_on_vertex(const Case& c) {
  if (!c.view.camera.value()->perspective) return false;
  const Point eye = eye_of(*c.view.camera);
  for (const auto& polygon : c.points) {
    if (std::find(polygon.begin(), polygon.end(), eye) != polygon.end())
      return true;
  }
  return false;
}

/// Polygons wholly before and wholly behind the image's plane through the eye.
bool eye_within(const Case& c) {
  if (!c.view.camera.value()->perspective) return false;
  const Point eye = eye_of(*c.view.camera);
  bool less = false, more = false;
  for (const auto& polygon : c.points) {
    for (const Point& p : polygon) {
      less = less || p.x * eye.w < eye.x;
      more = more || p.x * eye.w > eye.x;
    }
  }
  return less && more;
}

/// How many edges of one polygon pass through one pixel's centre, at a place
/// where the polygon is, and through how many centres one edge passes.
struct Touches {
  int edges_at_a_centre = 0;
  int centres_on_an_edge = 0;
};

Touches touches_of(const Case& c) {
  Touches most;
  const CameraData& camera = c.view.camera->data();
  for (const Projection& p : c.seen) {
    if (p.nothing) continue;
    std::vector<int> centres(p.edges.size(), 0);
    for (std::int32_t j = 0; j < camera.height_px; ++j) {
      for (std::int32_t i = 0; i < camera.width_px; ++i) {
        std::vector<std::size_t> zero;
        bool within = true;
        for (std::size_t k = 0; k < p.edges.size() && within; ++k) {
          const Affine& f = p.edges[k];
          const definition::Integer at =
              2 * f.c + (2 * i + 1) * f.x + (2 * j + 1) * f.y;
          within = at >= 0;
          if (at == 0) zero.push_back(k);
        }
        if (!within) continue;
        most.edges_at_a_centre =
            std::max(most.edges_at_a_centre, static_cast<int>(zero.size()));
        for (const std::size_t k : zero) {
          most.centres_on_an_edge =
              std::max(most.centres_on_an_edge, ++centres[k]);
        }
      }
    }
  }
  return most;
}

/// A polygon with corners on either side of the plane that is parallel to the
/// image, at this ray parameter.
bool crosses_depth(const Case& c, const definition::Integer& near) {
  const CameraData& d = c.view.camera->data();
  const auto number = [](Int128 value) {
    return definition::Integer(to_string(value));
  };
  const auto cross = [&](const LatticeVector& u, const LatticeVector& v) {
    const auto ux = number(u.x), uy = number(u.y), uz = number(u.z);
    const auto vx = number(v.x), vy = number(v.y), vz = number(v.z);
    return Plane{uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx, 0};
  };
  const auto dot = [&](const Plane& n, const LatticeVector& v) {
    return definition::Integer(n.a * number(v.x) + n.b * number(v.y) +
                               n.c * number(v.z));
  };
  // n.(p - origin) = near / 2^16 * n.step, in lattice steps.
  Plane n = cross(d.sx, d.sy);
  const definition::Integer at_eye = dot(n, d.eye);
  const definition::Integer at_s0 = dot(n, d.s0);
  const definition::Integer origin = d.perspective ? at_eye : at_s0;
  const definition::Integer step = d.perspective
                                       ? definition::Integer(at_s0 - at_eye)
                                       : definition::Integer(-at_eye);
  const definition::Integer whole = definition::Integer(1) << kNearBits;
  n.d = -(whole * origin + near * step);
  n.a = n.a * whole << kLatticeBits;
  n.b = n.b * whole << kLatticeBits;
  n.c = n.c * whole << kLatticeBits;
  return std::any_of(c.points.begin(), c.points.end(), [&](const auto& p) {
    return definition::relation(p, n) == Relation::kSpanning;
  });
}

bool at_limit(const Case& c, int bits) {
  const std::int64_t far = (std::int64_t{1} << (bits - 1)) / 2;
  return c.view.scene.grid_bits() == bits &&
         std::any_of(
             c.view.scene.data().vertices.begin(),
             c.view.scene.data().vertices.end(), [&](const GridPoint& p) {
               return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) >
                      far;
             });
}

/// A vertex of one polygon strictly inside an edge of another.
bool t_junction(const Case& c) {
  return any_pair(c, [&](std::size_t p, std::size_t q) {
    const auto& edges = c.facets[q].edges;
    const auto& ends = c.points[q];
    return std::any_of(
        c.points[p].begin(), c.points[p].end(), [&](const Point& v) {
          if (definition::side_of(c.facets[q].support, v) != 0) return false;
          int zero = 0;
          for (const Plane& edge : edges) {
            const int side = definition::side_of(edge, v);
            if (side < 0) return false;
            zero += side == 0 ? 1 : 0;
          }
          return zero > 0 &&
                 std::find(ends.begin(), ends.end(), v) == ends.end();
        });
  });
}

/// The eye strictly inside a polygon.
bool eye_in_polygon(const Case& c) {
  if (!c.view.camera.value()->perspective) return false;
  const Point eye = eye_of(*c.view.camera);
  return std::any_of(
      c.facets.begin(), c.facets.end(), [&](const definition::Facet& facet) {
        return definition::side_of(facet.support, eye) == 0 &&
               std::all_of(facet.edges.begin(), facet.edges.end(),
                           [&](const Plane& edge) {
                             return definition::side_of(edge, eye) > 0;
                           });
      });
}

/// A polygon that covers samples above a line and below it, but none on it.
bool thinner_than_a_pixel(const Case& c) {
  return std::any_of(
      c.facets.begin(), c.facets.end(), [&](const definition::Facet& facet) {
        const auto mask = definition::coverage(facet, *c.view.camera, false);
        int runs = 0;
        bool before = false;
        for (std::int32_t j = 0; j < mask.height_px; ++j) {
          bool some = false;
          for (std::int32_t i = 0; i < mask.width_px; ++i)
            some = some || mask.at(i, j) != 0;
          runs += some && !before ? 1 : 0;
          before = some;
        }
        return runs > 1;
      });
}

/// Polygons that hide each other in a circle: no order of whole polygons
/// paints them right.
bool cyclic_overlap(const Case& c) {
  const std::size_t count = c.seen.size();
  std::vector<std::vector<bool>> before(count, std::vector<bool>(count));
  const CameraData& camera = c.view.camera->data();
  for (std::int32_t j = 0; j < camera.height_px; ++j) {
    for (std::int32_t i = 0; i < camera.width_px; ++i) {
      std::vector<std::size_t> here;
      for (std::size_t p = 0; p < count; ++p) {
        if (!c.seen[p].nothing && definition::covers(c.seen[p], i, j))
          here.push_back(p);
      }
      for (const std::size_t p : here) {
        for (const std::size_t q : here) {
          if (p == q || before[p][q]) continue;
          before[p][q] =
              definition::compare_depth(c.seen[p], c.seen[q], i, j) < 0;
        }
      }
    }
  }
  // Whatever has nothing before it is painted last; what is left is cyclic.
  std::vector<bool> gone(count);
  for (std::size_t left = count; left > 0; --left) {
    std::size_t next = count;
    for (std::size_t p = 0; p < count && next == count; ++p) {
      bool is_free = !gone[p];
      for (std::size_t q = 0; q < count; ++q)
        is_free = is_free && (gone[q] || !before[q][p]);
      if (is_free) next = p;
    }
    if (next == count) return true;
    gone[next] = true;
  }
  return false;
}

using Question = std::function<bool(const Case&)>;

const std::map<std::string, Question>& questions() {
  static const std::map<std::string, Question> all = {
      {"coincident polygons",
       [](const Case& c) { return coincident(c, true); }},
      {"opposite polygons", [](const Case& c) { return coincident(c, false); }},
      {"spanning polygons", spanning},
      {"shared edges", shared_edge},
      {"T-junctions", t_junction},
      {"cyclic overlap", cyclic_overlap},
      {"slivers", sliver},
      {"thinner than a pixel", thinner_than_a_pixel},
      {"eye on splitter", eye_on_plane},
      {"eye on edge", eye_on_line},
      {"eye at vertex", eye_on_vertex},
      {"eye inside", eye_within},
      {"eye in a polygon", eye_in_polygon},
      {"vertex on pixel centre",
       [](const Case& c) { return touches_of(c).edges_at_a_centre > 1; }},
      {"edge through pixel centres",
       [](const Case& c) { return touches_of(c).centres_on_an_edge > 1; }},
      {"polygon partly behind the eye",
       [](const Case& c) {
         return (*c.view.camera)->perspective && crosses_depth(c, 0);
       }},
      {"near through polygon",
       [](const Case& c) {
         return (*c.view.camera)->near &&
                crosses_depth(c, *(*c.view.camera)->near);
       }},
      {"grid of 26 bits at its limit",
       [](const Case& c) { return at_limit(c, 26); }},
      {"grid of 40 bits at its limit",
       [](const Case& c) { return at_limit(c, 40); }},
      {"grid of 54 bits at its limit",
       [](const Case& c) { return at_limit(c, 54); }},
      {"perspective",
       [](const Case& c) { return (*c.view.camera)->perspective; }},
      {"orthographic",
       [](const Case& c) { return !(*c.view.camera)->perspective; }},
      {"culled", [](const Case& c) { return c.view.options.cull; }},
      {"corner colours",
       [](const Case& c) {
         return c.view.options.shading == Shading::kGouraud &&
                !c.view.scene.data().corner_colors.empty();
       }},
      {"no polygons", [](const Case& c) { return c.planes.empty(); }},
  };
  return all;
}

}  // namespace

std::set<std::string> troubles_in(const SceneFile& view,
                                  const std::set<std::string>& troubles) {
  std::set<std::string> found;
  const Case taken_apart(view);
  for (const std::string& trouble : troubles) {
    if (questions().at(trouble)(taken_apart)) found.insert(trouble);
  }
  return found;
}

std::set<std::string> all_troubles() {
  std::set<std::string> names;
  for (const auto& [name, question] : questions()) names.insert(name);
  return names;
}

}  // namespace halfspace::generate
