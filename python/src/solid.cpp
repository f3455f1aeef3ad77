#include <map>
#include <optional>
#include <string>

#include "binding.hpp"

namespace halfspace::python {
namespace {

void evaluate(const Solid& solid, int threads, const py::object& progress) {
  Watch watch(progress);
  const Result<Done> done = without_lock([&] {
    return solid.evaluate({threads, watch.progress()});
  });
  watch.rethrow();
  value_of(done);
}

/// The answer to a question: the solid is worked out first, so that Ctrl-C
/// stops that.
template <class Question>
auto asked(const Solid& solid, const Question& question, int threads = 0,
           const py::object& progress = py::none()) {
  evaluate(solid, threads, progress);
  return value_of(without_lock([&] { return question(solid); }));
}

OperandOptions operand_options(bool resolve, bool merge_coplanar,
                               bool may_round) {
  return {resolve, merge_coplanar, may_round};
}

MeshOptions mesh_options(const std::string& merge, bool triangles,
                         int threads) {
  MeshOptions options;
  options.threads = threads;
  options.merge = merge == "plane"  ? MergeFaces::kPlane
                  : merge == "none" ? MergeFaces::kNone
                                    : MergeFaces::kOrigin;
  options.triangles = triangles;
  return options;
}

std::vector<Point2> outline_of(const ArrayOf<double>& points) {
  return rows_of<Point2>(points, "an outline");
}

py::list regions_of(std::vector<Region> regions) {
  py::list result;
  for (Region& region : regions) {
    py::list holes;
    for (std::vector<Point>& hole : region.holes)
      holes.append(array_of<double>(std::move(hole)));
    result.append(py::make_tuple(array_of<double>(std::move(region.boundary)),
                                 std::move(holes)));
  }
  return result;
}

void bind_makers(py::class_<Solid>& type) {
  type.def(py::init<>());
  type.def_static("box", [](const Triple& corner, const Triple& opposite) {
    return Solid::box(point_of(corner), point_of(opposite));
  });
  type.def_static("sphere", &Solid::sphere);
  type.def_static("cylinder", &Solid::cylinder);
  type.def_static("cone", &Solid::cone);
  type.def_static("torus", &Solid::torus);
  type.def_static("prism",
                  [](const ArrayOf<double>& points,
                     const std::vector<ArrayOf<double>>& holes, double height) {
                    Outline outline{outline_of(points)};
                    for (const auto& hole : holes)
                      outline.holes.push_back(outline_of(hole));
                    return Solid::prism(outline, height);
                  });
  type.def_static("revolution",
                  [](const ArrayOf<double>& points, int segments) {
                    return Solid::revolution(outline_of(points), segments);
                  });
  type.def_static("hull", [](const ArrayOf<double>& points) {
    return Solid::hull(rows_of<Point>(points, "points"));
  });
  type.def_static("from_mesh", [](const Mesh& mesh, bool resolve,
                                  bool merge_coplanar, bool may_round) {
    return Solid::from_mesh(
        mesh, operand_options(resolve, merge_coplanar, may_round));
  });
  type.def_static("from_file", [](const std::string& path, bool resolve,
                                  bool merge_coplanar, bool may_round) {
    return Solid::from_file(
        path, operand_options(resolve, merge_coplanar, may_round));
  });
  type.def_static("from_text",
                  [](const std::string& script, const std::string& folder) {
                    return Solid::from_text(script, folder);
                  });
  type.def_static("half_space", [](const Triple& normal, double offset) {
    return Solid::half_space({point_of(normal), offset});
  });
}

void bind_algebra(py::class_<Solid>& type) {
  type.def("translated", [](const Solid& solid, const Triple& by) {
    return solid.translated(point_of(by));
  });
  type.def("scaled", [](const Solid& solid, const Triple& factors) {
    return solid.scaled(point_of(factors));
  });
  type.def("rotated",
           [](const Solid& solid, const Triple& axis, double degrees) {
             return solid.rotated(point_of(axis), degrees);
           });
  type.def("mirrored",
           [](const Solid& solid, const Triple& normal, double offset) {
             return solid.mirrored({point_of(normal), offset});
           });
  type.def("transformed", &Solid::transformed);
  type.def("named", &Solid::named);
  type.def("name", &Solid::name);
  type.def("union", [](const Solid& a, const Solid& b) { return a + b; });
  type.def("difference", [](const Solid& a, const Solid& b) { return a - b; });
  type.def("intersection",
           [](const Solid& a, const Solid& b) { return a & b; });
  type.def("symmetric_difference",
           [](const Solid& a, const Solid& b) { return a ^ b; });
  type.def("complement", [](const Solid& a) { return ~a; });
  type.def_static("union_of", [](const std::vector<Solid>& solids) {
    return Solid::union_of(solids);
  });
  type.def_static("intersection_of", [](const std::vector<Solid>& solids) {
    return Solid::intersection_of(solids);
  });
  type.def("split",
           [](const Solid& solid, const Triple& normal, double offset) {
             return solid.split({point_of(normal), offset});
           });
  type.def("is_same", [](const Solid& a, const Solid& b) { return a == b; });
}

void bind_results(py::class_<Solid>& type) {
  type.def("evaluate", &evaluate);
  type.def("mesh", [](const Solid& solid, const std::string& merge,
                      bool triangles, int threads, const py::object& progress) {
    const MeshOptions options = mesh_options(merge, triangles, threads);
    return std::make_shared<Mesh>(asked(
        solid, [&](const Solid& s) { return s.mesh(options); }, threads,
        progress));
  });
  type.def("save", [](const Solid& solid, const std::string& path,
                      const std::string& merge, bool triangles, int threads,
                      const py::object& progress) {
    const MeshOptions options = mesh_options(merge, triangles, threads);
    asked(
        solid, [&](const Solid& s) { return s.save(path, options); }, threads,
        progress);
  });
  type.def("decompose", [](const Solid& solid) {
    return asked(solid, [](const Solid& s) { return s.decompose(); });
  });
  type.def("polygons_by_operand", [](const Solid& solid) {
    return asked(solid, [](const Solid& s) { return s.polygons_by_operand(); });
  });
  type.def("operands", [](const Solid& solid) {
    return asked(solid, [](const Solid& s) { return s.operands(); });
  });
  type.def("rounding", [](const Solid& solid) {
    const RoundingReport report =
        asked(solid, [](const Solid& s) { return s.rounding(); });
    return py::make_tuple(report.moved, report.max_move, report.step,
                          report.grid_bits);
  });
  type.def("section",
           [](const Solid& solid, const Triple& normal, double offset) {
             return regions_of(asked(solid, [&](const Solid& s) {
               return s.section({point_of(normal), offset});
             }));
           });
}

/// Binds a question without arguments whose answer Python knows.
template <class T>
void def_question(py::class_<Solid>& type, const char* name,
                  Result<T> (Solid::*question)() const) {
  type.def(name, [question](const Solid& solid) {
    return asked(solid, [&](const Solid& s) { return (s.*question)(); });
  });
}

void bind_questions(py::class_<Solid>& type) {
  def_question(type, "is_empty", &Solid::is_empty);
  def_question(type, "volume", &Solid::volume);
  def_question(type, "area", &Solid::area);
  def_question(type, "exact_volume", &Solid::exact_volume);
  def_question(type, "exact_area", &Solid::exact_area);
  def_question(type, "inertia", &Solid::inertia);
  def_question(type, "shell_count", &Solid::shell_count);
  def_question(type, "genus", &Solid::genus);
  type.def("bounds", [](const Solid& solid) {
    const Bounds bounds =
        asked(solid, [](const Solid& s) { return s.bounds(); });
    return std::array{triple_of(bounds.low), triple_of(bounds.high)};
  });
  type.def("centroid", [](const Solid& solid) {
    return triple_of(asked(solid, [](const Solid& s) { return s.centroid(); }));
  });
  type.def("locate", [](const Solid& solid, const ArrayOf<double>& points) {
    std::vector<std::int8_t> sides;
    for (const Point& point : rows_of<Point>(points, "points")) {
      const Location at =
          asked(solid, [&](const Solid& s) { return s.locate(point); });
      sides.push_back(at == Location::kInside    ? std::int8_t{-1}
                      : at == Location::kOutside ? std::int8_t{1}
                                                 : std::int8_t{0});
    }
    return array_of<std::int8_t>(std::move(sides));
  });
  const auto def_pair = [&](const char* name, Result<bool> (Solid::*question)(
                                                  const Solid&) const) {
    type.def(name, [question](const Solid& solid, const Solid& other) {
      evaluate(other, 0, py::none());
      return asked(solid, [&](const Solid& s) { return (s.*question)(other); });
    });
  };
  def_pair("overlaps", &Solid::overlaps);
  def_pair("touches", &Solid::touches);
  def_pair("contains", &Solid::contains);
}

}  // namespace

void bind_solid(py::module_& module) {
  py::class_<Solid> type(module, "Solid");
  bind_makers(type);
  bind_algebra(type);
  bind_results(type);
  bind_questions(type);
  module.def("mended", [](const std::string& path, std::optional<double> weld,
                          bool close_all, std::optional<double> thicken) {
    Mended result = value_of(without_lock([&] {
      return mended(path, {weld, close_all, thicken});
    }));
    return py::make_tuple(std::move(result.solid), std::move(result.done));
  });
}

}  // namespace halfspace::python
