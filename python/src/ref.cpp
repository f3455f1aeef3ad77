#include <algorithm>
#include <cmath>
#include <string>

#include "display.hpp"
#include "halfspace/ref/boolean.hpp"
#include "halfspace/ref/render.hpp"
#include "halfspace/ref/visible_map.hpp"

namespace halfspace::python {
namespace {

/// The solid whose surface is a mesh of whole numbers, a grid step each.
Result<ref::Solid> ref_solid(const Mesh& mesh) {
  SceneData data;
  for (const Point& p : mesh.vertices) {
    for (const double c : {p.x, p.y, p.z}) {
      if (c != std::nearbyint(c) || std::abs(c) > 0x1p53)
        return Error{ErrorCode::kOutOfRange,
                     "the reference takes whole numbers only"};
    }
    data.vertices.push_back({static_cast<std::int64_t>(p.x),
                             static_cast<std::int64_t>(p.y),
                             static_cast<std::int64_t>(p.z)});
  }
  data.first_corner = mesh.first_corner;
  data.corners = mesh.corners;
  data.colors = mesh.colors;
  data.colors.resize(mesh.polygon_count());
  data.grid_bits = grid_bits_for(data.vertices);
  Result<Scene> scene = make_scene(std::move(data));
  if (!scene) return scene.error();
  const Result<GridSolid> solid = make_solid(*std::move(scene));
  if (!solid) return solid.error();
  return ref::to_solid(*solid);
}

ref::Solid combined(char operation, const ref::Solid& a, const ref::Solid& b) {
  const BooleanOp op = operation == '+'   ? BooleanOp::kUnion
                       : operation == '-' ? BooleanOp::kDifference
                       : operation == '&' ? BooleanOp::kIntersection
                                          : BooleanOp::kSymmetricDifference;
  return without_lock([&] { return ref::boolean(op, a, b); });
}

std::string text_of(const ref::Rational& number) { return number.big().str(); }

Mesh rounded_mesh(const ref::Solid& solid) {
  const ref::RoundedSolid rounded = ref::rounded(solid, Unit{});
  Mesh mesh;
  for (const auto& v : rounded.vertices)
    mesh.vertices.push_back({v[0], v[1], v[2]});
  mesh.first_corner = rounded.first_corner;
  mesh.corners = rounded.corners;
  mesh.colors = rounded.colors;
  return mesh;
}

py::array render(const Shown& shown, const py::object& object) {
  const View view = view_from(object);
  using Ids = std::vector<PolygonId>;
  const auto work = [&](const Display& display) -> Result<Ids> {
    const Result<Camera> camera = display.camera(view);
    if (!camera) return camera.error();
    const Scene& scene = display.scene();
    ImageOptions options;
    options.cull = view.cull;
    options.background = view.background;
    Ids ids = ref::render(scene, ref::build(scene, {}), *camera, options)
                  .items.pixels;
    for (PolygonId& id : ids) {
      if (id != kBackground)
        id = display.polygons_of_scene()[static_cast<std::size_t>(id)];
    }
    return ids;
  };
  Ids ids = value_of(without_lock([&] { return shown.asked(work); }));
  return array_of<std::int32_t>(std::move(ids))
      .reshape(std::vector<py::ssize_t>{view.height_px, view.width_px});
}

py::list visible_map(const Shown& shown, const py::object& object) {
  const View view = view_from(object);
  using Arcs = std::vector<ref::MapArc>;
  const auto work = [&](const Display& display) -> Result<Arcs> {
    const Result<Camera> camera = display.camera(view);
    if (!camera) return camera.error();
    const auto keys = display.polygons_of_scene();
    return ref::visible_map(display.scene(), *camera,
                            {view.cull, {keys.begin(), keys.end()}});
  };
  const Arcs arcs = value_of(without_lock([&] { return shown.asked(work); }));
  py::list result;
  for (const ref::MapArc& arc : arcs) {
    result.append(py::make_tuple(text_of(arc.from.x), text_of(arc.from.y),
                                 text_of(arc.to.x), text_of(arc.to.y), arc.left,
                                 arc.right));
  }
  return result;
}

}  // namespace

void bind_ref(py::module_& module) {
  py::class_<ref::Solid>(module, "RefSolid")
      .def_static(
          "of",
          [](const Mesh& mesh) {
            return value_of(without_lock([&] { return ref_solid(mesh); }));
          })
      .def("combined", [](const ref::Solid& a, const ref::Solid& b,
                          char operation) { return combined(operation, a, b); })
      .def("volume6",
           [](const ref::Solid& solid) {
             return text_of(without_lock([&] { return ref::volume6(solid); }));
           })
      .def("bad_edge_count",
           [](const ref::Solid& solid) {
             return without_lock([&] { return ref::bad_edges(solid).size(); });
           })
      .def("mesh", [](const ref::Solid& solid) {
        return std::make_shared<Mesh>(
            without_lock([&] { return rounded_mesh(solid); }));
      });
  module.def("ref_render", &render);
  module.def("ref_visible_map", &visible_map);
}

}  // namespace halfspace::python
