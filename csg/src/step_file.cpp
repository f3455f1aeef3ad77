#include "halfspace/csg/step_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "halfspace/big_integer.hpp"
#include "halfspace/csg/components.hpp"
#include "halfspace/csg/interval.hpp"
#include "halfspace/csg/surface.hpp"
#include "halfspace/fast/solid_data.hpp"
#include "halfspace/io/load_scene.hpp"

namespace halfspace::csg {
namespace {

using StepPoint = std::array<double, 3>;

StepPoint minus(const StepPoint& a, const StepPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot_of(const StepPoint& a, const StepPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

StepPoint cross_product(const StepPoint& a, const StepPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

/// Requires: the vector is not zero.
StepPoint unit_vector(const StepPoint& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

/// A real number as Part 21 has it: with a point, and E.
std::string real_text(double value) {
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value + 0.0).ptr;
  std::string text(digits, end);
  const std::size_t power = text.find('e');
  if (text.find('.') == std::string::npos)
    text.insert(power == std::string::npos ? text.size() : power, ".");
  if (power != std::string::npos) text[text.find('e')] = 'E';
  return text;
}

/// A text as Part 21 has it: printable ASCII, quotes twice.
std::string string_text(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c < ' ' || c > '~' || c == '\\') {
      quoted += '_';
    } else {
      quoted += c == '\'' ? std::string("''") : std::string(1, c);
    }
  }
  return quoted + "'";
}

/// A loop of a face: vertices in order, the face on the left.
using StepLoop = std::vector<std::size_t>;

/// A connected region of a plane: its outer loop, and its holes.
struct StepFace {
  StepPoint normal{};
  std::vector<StepLoop> loops;
};

/// A connected part of a surface.
struct StepShell {
  std::vector<std::size_t> faces;
  double volume = 0;
};

class StepWriter {
 public:
  std::string written(const std::vector<fast::Solid>& parts,
                      const std::string& name);

 private:
  std::size_t add(const std::string& entity) {
    body_ += "#" + std::to_string(++last_) + "=" + entity + ";\n";
    return last_;
  }
  static std::string at(std::size_t id) { return "#" + std::to_string(id); }
  template <class Ids>
  static std::string list(const Ids& ids) {
    std::string text = "(";
    for (const std::size_t id : ids) text += (text == "(" ? "" : ",") + at(id);
    return text + ")";
  }
  std::size_t triple(const char* entity, const StepPoint& p) {
    return add(std::string(entity) + "(''," + "(" + real_text(p[0]) + "," +
               real_text(p[1]) + "," + real_text(p[2]) + "))");
  }
  void take(const fast::Solid& part);
  void take_face(const StepPoint& normal, std::vector<StepLoop> loops);
  StepPoint area_of(const StepLoop& loop) const;
  bool holds(const StepLoop& outer, const StepLoop& inner,
             const StepPoint& normal) const;
  std::vector<StepShell> shells() const;
  std::size_t edge_between(std::size_t from, std::size_t to, bool& is_forward);
  std::size_t vertex(std::size_t v);
  std::size_t face(const StepFace& face);
  std::size_t solid(const std::string& name);
  void frame(const std::vector<std::size_t>& solids, const std::string& name);

  std::string body_;
  std::size_t last_ = 0;
  double greatest_ = 0;
  // Of the part that is being written.
  std::vector<StepPoint> points_;
  std::vector<StepFace> faces_;
  std::vector<std::size_t> vertex_ids_;
  /// Edges of which one face is written yet, by their ends, the lower first,
  /// and by whether that face ran from it.
  std::map<std::pair<std::pair<std::size_t, std::size_t>, bool>,
           std::vector<std::size_t>>
      open_edges_;
};

StepPoint StepWriter::area_of(const StepLoop& loop) const {
  StepPoint sum{};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const StepPoint part =
        cross_product(minus(points_[loop[i]], points_[loop[0]]),
                      minus(points_[loop[i + 1]], points_[loop[0]]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return sum;
}

/// Whether the inner loop is within the outer one: by a corner of it that is
/// no corner of that.
bool StepWriter::holds(const StepLoop& outer, const StepLoop& inner,
                       const StepPoint& normal) const {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  }
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (const std::size_t corner : inner) {
    if (std::find(outer.begin(), outer.end(), corner) != outer.end()) continue;
    const StepPoint& p = points_[corner];
    bool is_in = false;
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const StepPoint& a = points_[outer[i]];
      const StepPoint& b = points_[outer[(i + 1) % outer.size()]];
      if ((a[v] > p[v]) == (b[v] > p[v])) continue;
      const double cut = a[u] + (p[v] - a[v]) / (b[v] - a[v]) * (b[u] - a[u]);
      if (p[u] < cut) is_in = !is_in;
    }
    return is_in;
  }
  return true;
}

/// Adds the connected regions of a face: each outer loop, with the holes that
/// no smaller one holds.
void StepWriter::take_face(const StepPoint& normal,
                           std::vector<StepLoop> loops) {
  std::vector<std::pair<double, StepLoop>> outer;
  std::vector<StepLoop> holes;
  for (StepLoop& loop : loops) {
    const double area = dot_of(area_of(loop), normal);
    if (area > 0) {
      outer.emplace_back(area, std::move(loop));
    } else {
      holes.push_back(std::move(loop));
    }
  }
  std::sort(outer.begin(), outer.end());
  const std::size_t first = faces_.size();
  for (auto& [area, loop] : outer)
    faces_.push_back({normal, {std::move(loop)}});
  for (StepLoop& hole : holes) {
    for (std::size_t i = first; i < faces_.size(); ++i) {
      if (i + 1 < faces_.size() && !holds(faces_[i].loops[0], hole, normal))
        continue;
      faces_[i].loops.push_back(std::move(hole));
      break;
    }
  }
}

void StepWriter::take(const fast::Solid& part) {
  points_.clear();
  faces_.clear();
  open_edges_.clear();
  const SolidData data = fast::data_of(part, {""});
  const Scale scale = scale_of(data.unit, 1);
  const auto double_of = [&scale](const Integer& above, const Integer& below) {
    return nearest_double(above * scale.numerator, below * scale.denominator);
  };
  // The data's vertices are in the order of the faces' corners, as the solid's
  // loops are, so points are found by what the data say of them.
  const auto plane = [&](std::uint32_t p) {
    const SolidData::Plane& q = data.planes[p];
    Integers3 normal;
    for (std::size_t k = 0; k < 3; ++k)
      normal[k] = to_big<Integer>(q.normal[k]);
    return std::pair(normal,
                     Integer(normal[0] * q.origin.x + normal[1] * q.origin.y +
                             normal[2] * q.origin.z));
  };
  for (const GridPoint& p : data.points)
    points_.push_back(
        {double_of(p.x, 1), double_of(p.y, 1), double_of(p.z, 1)});
  for (const auto& meet : data.meets) {
    const auto [n0, d0] = plane(meet[0]);
    const auto [n1, d1] = plane(meet[1]);
    const auto [n2, d2] = plane(meet[2]);
    const Integers3 c0 = cross(n1, n2), c1 = cross(n2, n0), c2 = cross(n0, n1);
    Integer below = dot(n0, c0);
    const int sign = below < 0 ? -1 : 1;
    below *= sign;
    StepPoint point{};
    for (std::size_t k = 0; k < 3; ++k) {
      point[k] = double_of(
          Integer((d0 * c0[k] + d1 * c1[k] + d2 * c2[k]) * sign), below);
    }
    points_.push_back(point);
  }
  vertex_ids_.assign(points_.size(), 0);
  for (const StepPoint& p : points_) {
    for (const double value : p)
      greatest_ = std::max(greatest_, std::abs(value));
  }
  std::size_t loop = 0, corner = 0;
  for (const SolidData::Face& face : data.faces) {
    const auto [normal, offset] = plane(face.plane);
    StepPoint outwards{};
    for (std::size_t k = 0; k < 3; ++k) {
      outwards[k] = normal[k].convert_to<double>() * (face.flipped ? -1 : 1);
    }
    std::vector<StepLoop> loops(face.loop_count);
    for (StepLoop& made : loops) {
      for (std::uint32_t i = 0; i < data.loops[loop]; ++i)
        made.push_back(data.corners[corner++].vertex);
      ++loop;
    }
    // A slit bounds nothing.
    std::erase_if(loops, [](const StepLoop& made) { return made.size() < 3; });
    take_face(unit_vector(outwards), std::move(loops));
  }
}

/// The connected parts of the surface, along edges, by their first faces.
std::vector<StepShell> StepWriter::shells() const {
  std::vector<std::size_t> root(faces_.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&root](std::size_t f) {
    while (root[f] != f) f = root[f] = root[root[f]];
    return f;
  };
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> first;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (const StepLoop& loop : faces_[f].loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const auto ends = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
        const auto [at, is_new] =
            first.try_emplace({ends.first, ends.second}, f);
        if (!is_new) root[find(f)] = find(at->second);
      }
    }
  }
  std::map<std::size_t, StepShell> made;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    StepShell& shell = made[find(f)];
    shell.faces.push_back(f);
    for (const StepLoop& loop : faces_[f].loops)
      shell.volume += dot_of(area_of(loop), points_[loop[0]]);
  }
  std::vector<StepShell> shells;
  for (auto& [key, shell] : made) shells.push_back(std::move(shell));
  // The one around all others comes first.
  std::stable_sort(shells.begin(), shells.end(),
                   [](const StepShell& a, const StepShell& b) {
                     return a.volume > b.volume;
                   });
  return shells;
}

std::size_t StepWriter::vertex(std::size_t v) {
  if (vertex_ids_[v] == 0) {
    const std::size_t point = triple("CARTESIAN_POINT", points_[v]);
    vertex_ids_[v] = add("VERTEX_POINT(''," + at(point) + ")");
  }
  return vertex_ids_[v];
}

/// The edge that the other face named already, or a new one.
std::size_t StepWriter::edge_between(std::size_t from, std::size_t to,
                                     bool& is_forward) {
  const auto ends = std::minmax(from, to);
  const std::pair<std::size_t, std::size_t> key{ends.first, ends.second};
  auto& others = open_edges_[{key, to < from}];
  if (!others.empty()) {
    const std::size_t edge = others.back();
    others.pop_back();
    is_forward = false;
    return edge;
  }
  const std::size_t start = vertex(from), end = vertex(to);
  const std::size_t direction =
      triple("DIRECTION", unit_vector(minus(points_[to], points_[from])));
  const std::size_t vector = add("VECTOR(''," + at(direction) + ",1.)");
  const std::size_t line =
      add("LINE(''," + at(start - 1) + "," + at(vector) + ")");
  const std::size_t edge = add("EDGE_CURVE(''," + at(start) + "," + at(end) +
                               "," + at(line) + ",.T.)");
  open_edges_[{key, from < to}].push_back(edge);
  is_forward = true;
  return edge;
}

std::size_t StepWriter::face(const StepFace& face) {
  std::vector<std::size_t> bounds;
  for (const StepLoop& loop : face.loops) {
    std::vector<std::size_t> edges;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      bool is_forward = true;
      const std::size_t edge =
          edge_between(loop[i], loop[(i + 1) % loop.size()], is_forward);
      edges.push_back(add("ORIENTED_EDGE('',*,*," + at(edge) +
                          (is_forward ? ",.T.)" : ",.F.)")));
    }
    const std::size_t made = add("EDGE_LOOP(''," + list(edges) + ")");
    bounds.push_back(
        add(std::string(bounds.empty() ? "FACE_OUTER_BOUND" : "FACE_BOUND") +
            "(''," + at(made) + ",.T.)"));
  }
  const StepLoop& outer = face.loops[0];
  const std::size_t origin = triple("CARTESIAN_POINT", points_[outer[0]]);
  const std::size_t axis = triple("DIRECTION", face.normal);
  const std::size_t across = triple(
      "DIRECTION", unit_vector(minus(points_[outer[1]], points_[outer[0]])));
  const std::size_t placement = add("AXIS2_PLACEMENT_3D(''," + at(origin) +
                                    "," + at(axis) + "," + at(across) + ")");
  const std::size_t plane = add("PLANE(''," + at(placement) + ")");
  return add("ADVANCED_FACE(''," + list(bounds) + "," + at(plane) + ",.T.)");
}

/// The solid of the part that was taken.
std::size_t StepWriter::solid(const std::string& name) {
  std::size_t outer = 0;
  std::vector<std::size_t> voids;
  for (const StepShell& shell : shells()) {
    std::vector<std::size_t> faces;
    for (const std::size_t f : shell.faces) faces.push_back(face(faces_[f]));
    const std::size_t closed = add("CLOSED_SHELL(''," + list(faces) + ")");
    if (outer == 0) {
      outer = closed;
    } else {
      voids.push_back(
          add("ORIENTED_CLOSED_SHELL('',*," + at(closed) + ",.T.)"));
    }
  }
  if (voids.empty())
    return add("MANIFOLD_SOLID_BREP(" + string_text(name) + "," + at(outer) +
               ")");
  return add("BREP_WITH_VOIDS(" + string_text(name) + "," + at(outer) + "," +
             list(voids) + ")");
}

/// What a reader wants around solids: a product, and its units.
void StepWriter::frame(const std::vector<std::size_t>& solids,
                       const std::string& name) {
  const std::size_t application =
      add("APPLICATION_CONTEXT('configuration controlled 3d designs of "
          "mechanical parts and assemblies')");
  add("APPLICATION_PROTOCOL_DEFINITION('international standard',"
      "'config_control_design',1994," +
      at(application) + ")");
  const std::size_t context =
      add("MECHANICAL_CONTEXT(''," + at(application) + ",'mechanical')");
  const std::size_t product =
      add("PRODUCT(" + string_text(name) + "," + string_text(name) + ",''," +
          list(std::array{context}) + ")");
  const std::size_t formation =
      add("PRODUCT_DEFINITION_FORMATION_WITH_SPECIFIED_SOURCE('',''," +
          at(product) + ",.MADE.)");
  const std::size_t design =
      add("DESIGN_CONTEXT(''," + at(application) + ",'design')");
  const std::size_t definition =
      add("PRODUCT_DEFINITION('',''," + at(formation) + "," + at(design) + ")");
  const std::size_t shape =
      add("PRODUCT_DEFINITION_SHAPE('',''," + at(definition) + ")");
  const std::size_t length =
      add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
  const std::size_t angle =
      add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
  const std::size_t solid_angle =
      add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
  // Points are rounded to doubles, so planes and lines miss them by a little.
  const double uncertainty = std::max(1e-7, greatest_ * 0x1p-40);
  const std::size_t measure = add(
      "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(" + real_text(uncertainty) +
      ")," + at(length) + ",'distance_accuracy_value','')");
  const std::size_t units =
      add("(GEOMETRIC_REPRESENTATION_CONTEXT(3)"
          "GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(" +
          list(std::array{measure}) + ")GLOBAL_UNIT_ASSIGNED_CONTEXT(" +
          list(std::array{length, angle, solid_angle}) +
          ")REPRESENTATION_CONTEXT('',''))");
  const std::size_t representation =
      add("ADVANCED_BREP_SHAPE_REPRESENTATION(''," + list(solids) + "," +
          at(units) + ")");
  add("SHAPE_DEFINITION_REPRESENTATION(" + at(shape) + "," +
      at(representation) + ")");
}

std::string StepWriter::written(const std::vector<fast::Solid>& parts,
                                const std::string& name) {
  std::vector<std::size_t> solids;
  for (const fast::Solid& part : parts) {
    take(part);
    solids.push_back(solid(name));
  }
  frame(solids, name);
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('planar faces'),'2;1');\n"
         "FILE_NAME(" +
         string_text(name) +
         ",'',(''),(''),'halfspace','halfspace','');\n"
         "FILE_SCHEMA(('CONFIG_CONTROL_DESIGN'));\nENDSEC;\nDATA;\n" +
         body_ + "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace

bool is_step_name(const std::filesystem::path& path) {
  const std::filesystem::path name =
      io::has_extension(path, ".gz") ? path.stem() : path;
  return io::has_extension(name, ".step") || io::has_extension(name, ".stp");
}

Result<std::string> step_text(const SolidData& data, const std::string& name) {
  if (data.faces.empty())
    return Error{ErrorCode::kEmpty, "there is no face to write", -1};
  const Result<fast::Solid> solid = fast::to_solid(data);
  if (!solid) return solid.error();
  return StepWriter().written(components_of(*solid), name);
}

}  // namespace halfspace::csg
