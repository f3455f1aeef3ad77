#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/csg/evaluate.hpp"
#include "halfspace/csg/outcome.hpp"
#include "halfspace/csg/script.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "halfspace/io/write_mesh.hpp"
#include "laws/law.hpp"

/// The law of what files say of faces (S6.9). Each face of an operand has a
/// name, a material, an affine function of places as its texture points, and
/// its normal: so the names that a polygon of the result has say what its
/// corners must have, wherever they are.
namespace halfspace::painted {
namespace {

namespace fs = std::filesystem;
using Vector = std::array<double, 3>;

constexpr int kResults = 300;
constexpr std::size_t kMaterials = 3;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

struct PaintedFace {
  std::vector<std::size_t> corners;
  /// Texture points of a place: the last number, and the others by coordinate.
  std::array<std::array<int, 4>, 2> function;
};

struct PaintedSolid {
  std::string name;
  std::vector<Vector> points;
  std::vector<PaintedFace> faces;

  Vector normal(std::size_t face) const {
    const auto& c = faces[face].corners;
    return cross(minus(points[c[1]], points[c[0]]),
                 minus(points[c[2]], points[c[0]]));
  }
  std::array<double, 2> texture(std::size_t face, const Vector& p) const {
    std::array<double, 2> values{};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& f = faces[face].function[i];
      values[i] = (f[0] * p[0] + f[1] * p[1] + f[2] * p[2] + f[3]) / 64;
    }
    return values;
  }
};

/// A box or a tetrahedron of small integers.
PaintedSolid some_solid(const std::string& name) {
  const auto number = [](int low, int high) {
    return static_cast<double>(*rc::gen::inRange(low, high));
  };
  PaintedSolid solid{name, {}, {}};
  const Vector low = {number(-4, 1), number(-4, 1), number(-4, 1)};
  const Vector size = {number(2, 6), number(2, 6), number(2, 6)};
  const bool is_box = *rc::gen::inRange(0, 2) == 0;
  const auto add = [&](std::size_t i) {
    Vector p = low;
    for (std::size_t k = 0; k < 3; ++k) p[k] += (i >> k & 1) ? size[k] : 0;
    solid.points.push_back(p);
  };
  std::vector<std::vector<std::size_t>> faces;
  if (is_box) {
    for (std::size_t i = 0; i < 8; ++i) add(i);
    faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  } else {
    for (const std::size_t i : {0u, 1u, 2u, 4u}) add(i);
    faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  }
  for (auto& corners : faces) {
    PaintedFace face{std::move(corners), {}};
    for (auto& f : face.function) {
      for (int& value : f) value = *rc::gen::inRange(-5, 6);
    }
    solid.faces.push_back(std::move(face));
  }
  return solid;
}

std::string material_of(const PaintedSolid& solid, std::size_t face) {
  return solid.name + " paint " + std::to_string(face % kMaterials);
}

void write(const PaintedSolid& solid, const fs::path& folder) {
  std::ofstream mtl(folder / (solid.name + ".mtl"));
  for (std::size_t i = 0; i < kMaterials; ++i) {
    mtl << "newmtl " << material_of(solid, i) << "\nKd 0." << i + 1
        << " 0.5 0.25\n";
  }
  std::ofstream obj(folder / (solid.name + ".obj"));
  obj << "mtllib " << solid.name << ".mtl\no " << solid.name << '\n';
  for (const Vector& p : solid.points)
    obj << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  std::size_t vt = 0;
  for (std::size_t i = 0; i < solid.faces.size(); ++i) {
    const Vector n = solid.normal(i);
    obj << "vn " << n[0] << ' ' << n[1] << ' ' << n[2] << "\ng face " << i
        << "\nusemtl " << material_of(solid, i) << '\n';
    std::string face = "f";
    for (const std::size_t corner : solid.faces[i].corners) {
      const auto uv = solid.texture(i, solid.points[corner]);
      obj.precision(17);
      obj << "vt " << uv[0] << ' ' << uv[1] << '\n';
      face += " " + std::to_string(corner + 1) + "/" + std::to_string(++vt) +
              "/" + std::to_string(i + 1);
    }
    obj << face << '\n';
  }
}

/// A map of a solid, in a script's words, and the way back.
struct Placing {
  std::string before, after;
  std::size_t axis = 0;
  double cosine = 1, sine = 0;  ///< of a turn about it
  Vector factors{1, 1, 1};      ///< first
  Vector shift{};               ///< last

  bool is_exact() const { return sine == 0; }
  Vector back(Vector p) const {
    p = minus(p, shift);
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double x = cosine * p[u] + sine * p[v];
    p[v] = cosine * p[v] - sine * p[u];
    p[u] = x;
    for (std::size_t k = 0; k < 3; ++k) p[k] /= factors[k];
    return p;
  }
};

Placing some_placing() {
  Placing placing;
  placing.axis = static_cast<std::size_t>(*rc::gen::inRange(0, 3));
  const auto list = [](const Vector& v) {
    std::string text;
    for (const double value : v)
      text += ", " + std::to_string(static_cast<int>(value));
    return text;
  };
  for (double& value : placing.shift) value = *rc::gen::inRange(-2, 3);
  if (*rc::gen::inRange(0, 2) == 0) {
    for (double& value : placing.factors)
      value = *rc::gen::element(-2.0, -1.0, 1.0, 2.0);
    placing.before = "scale(";
    placing.after = list(placing.factors) + ")";
  }
  if (*rc::gen::inRange(0, 2) == 0) {
    const int degrees = *rc::gen::inRange(1, 90);
    placing.cosine = std::cos(degrees * std::acos(-1.0) / 180);
    placing.sine = std::sin(degrees * std::acos(-1.0) / 180);
    Vector axis{};
    axis[placing.axis] = 1;
    placing.before = "rotate(" + placing.before;
    placing.after += list(axis) + ", " + std::to_string(degrees) + ")";
  }
  placing.before = "translate(" + placing.before;
  placing.after += list(placing.shift) + ")";
  return placing;
}

/// A folder that is gone with the object.
class Folder {
 public:
  Folder() {
    path_ = fs::temp_directory_path() /
            ("halfspace-attributes-" + std::to_string(::getpid()));
    fs::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

csg::Outcome result_of(const std::string& text, const fs::path& folder) {
  const auto script = csg::parse_script(text);
  HALFSPACE_LAW(script.has_value());
  const auto plan = csg::make_plan(*script);
  HALFSPACE_LAW(plan.has_value());
  auto operands =
      csg::Operands::load(*script, *plan, {.folder = folder.string()});
  HALFSPACE_LAW(operands.has_value());
  auto outcome = csg::evaluate_fast(*plan, *operands, {});
  HALFSPACE_LAW(outcome.has_value() && outcome->has_value());
  return **std::move(outcome);
}

std::string name_of(const io::Labels& labels, std::size_t face) {
  HALFSPACE_LAW(face < labels.of_face.size() && labels.of_face[face] >= 0);
  return labels.names[static_cast<std::size_t>(labels.of_face[face])];
}

/// How far numbers of a file may be off.
struct Tolerances {
  double place;
  double number;
  bool has_lengths;  ///< of normals
};

/// That a polygon has what the face says that it is a part of.
void expect_of_face(const PaintedSolid& solid, const Placing& placing,
                    const io::AttributedFaces& faces, std::size_t polygon,
                    const Tolerances& within) {
  const std::string group = name_of(faces.attributes.groups, polygon);
  HALFSPACE_LAW(group.starts_with("face "));
  const std::size_t face = std::stoul(group.substr(5));
  HALFSPACE_LAW(face < solid.faces.size());
  const auto material =
      static_cast<std::size_t>(faces.attributes.face_materials.at(polygon));
  HALFSPACE_LAW(faces.attributes.materials.at(material).name ==
                material_of(solid, face));
  const io::Channel* uv = io::channel_named(faces.attributes.corners, "uv");
  const io::Channel* vn = io::channel_named(faces.attributes.corners, "normal");
  HALFSPACE_LAW(uv != nullptr && vn != nullptr);
  const auto point = [&](std::size_t corner) {
    return faces.vertices[static_cast<std::size_t>(faces.corners[corner])];
  };
  const std::size_t first = faces.first_corner[polygon];
  const std::size_t end = faces.first_corner[polygon + 1];
  Vector area{};
  for (std::size_t i = first + 1; i + 1 < end; ++i) {
    const Vector part =
        cross(minus(point(i), point(first)), minus(point(i + 1), point(first)));
    for (std::size_t k = 0; k < 3; ++k) area[k] += part[k];
  }
  const Vector n = solid.normal(face);
  const Vector& base = solid.points[solid.faces[face].corners[0]];
  for (std::size_t i = first; i < end; ++i) {
    const Vector p = placing.back(point(i));
    HALFSPACE_LAW(std::abs(dot(n, minus(p, base))) <=
                  within.place * std::sqrt(dot(n, n)));
    const auto value = solid.texture(face, p);
    for (std::size_t k = 0; k < 2; ++k)
      HALFSPACE_LAW(std::abs(uv->at(i)[k] - value[k]) <= within.number);
    // What has hardly a width has a direction only as good as its corners.
    if (std::sqrt(dot(area, area)) < 1000 * within.place) continue;
    const Vector normal = {vn->at(i)[0], vn->at(i)[1], vn->at(i)[2]};
    const double length = std::sqrt(dot(normal, normal));
    if (within.has_lengths)
      HALFSPACE_LAW(std::abs(length / std::sqrt(dot(n, n)) - 1) < 1e-12);
    const Vector off = cross(normal, area);
    HALFSPACE_LAW(std::sqrt(dot(off, off)) <= 100 * within.place * length);
    HALFSPACE_LAW(dot(normal, area) > 0);
  }
}

/// S6.L20: what a file says of its faces and corners is that of the result's
/// polygons and corners, after they went through a file again, too.
TEST(S6Attributes, L20PolygonsAndCornersHaveWhatTheirFacesSay) {
  const Folder folder;
  law::Cases cases(
      {"obj", "ply", "glb", "gltf", "mirrored", "turned", "empty"});
  law::check(kResults, [&] {
    const std::array<PaintedSolid, 2> solids = {some_solid("a"),
                                                some_solid("b")};
    const std::array<Placing, 2> placings = {some_placing(), some_placing()};
    std::string text;
    for (std::size_t i = 0; i < 2; ++i) {
      write(solids[i], folder.path());
      if (i == 1) text += *rc::gen::element(" & ", " | ", " - ", " ^ ");
      text += placings[i].before + "'" + solids[i].name + ".obj'" +
              placings[i].after;
      const Vector& f = placings[i].factors;
      if (f[0] * f[1] * f[2] < 0) cases.meet("mirrored");
      if (!placings[i].is_exact()) cases.meet("turned");
    }
    const std::string ending =
        *rc::gen::element<std::string>("obj", "ply", "glb", "gltf");
    const csg::Outcome outcome = result_of(text, folder.path());
    if (outcome.polygons == 0) return cases.meet("empty");
    cases.meet(ending);
    const fs::path path = folder.path() / ("result." + ending);
    const auto written =
        outcome.scene ? io::write_scene_mesh(path, *outcome.scene,
                                             outcome.attributes.get(), true)
                      : [&] {
                          io::OutputMesh mesh = outcome.mesh;
                          mesh.attributes = outcome.attributes;
                          return io::write_mesh(path, mesh);
                        }();
    HALFSPACE_LAW(written.has_value() && written->lost.empty());
    const auto again = io::read_mesh(path);
    HALFSPACE_LAW(again.has_value());
    const io::AttributedFaces faces = io::attributed_faces(*again);
    // Places have at most a few units; a grid of 26 bits holds turned ones.
    const bool has_floats = ending == "glb" || ending == "gltf";
    const Tolerances within{1e-5, 1e-5, !has_floats};
    for (std::size_t p = 0; p + 1 < faces.first_corner.size(); ++p) {
      const std::string object = name_of(faces.attributes.objects, p);
      HALFSPACE_LAW(object == "a" || object == "b");
      const std::size_t i = object == "a" ? 0 : 1;
      expect_of_face(solids[i], placings[i], faces, p, within);
    }
  });
  cases.expect_all();
}

}  // namespace
}  // namespace halfspace::painted
