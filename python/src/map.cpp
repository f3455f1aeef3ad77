#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <string>

#include "display.hpp"
#include "halfspace/fast/traverse.hpp"
#include "halfspace/fast/visible_map.hpp"
#include "halfspace/io/figure.hpp"

namespace halfspace::python {
namespace {

using glm::dvec3;

/// Rows of a projective map: a point p of model units is shown at
/// (x . (p, 1) / w . (p, 1), y . (p, 1) / w . (p, 1)). Units: pixels.
struct ImageRows {
  std::array<double, 4> x, y, w;
};

dvec3 direction(const std::array<double, 4>& row) {
  return {row[0], row[1], row[2]};
}

/// The vector that lies on three planes row . (p, 1) = 0, or rather
/// row . (p, 1) = value.
dvec3 solved(const std::array<dvec3, 3>& rows, const dvec3& values) {
  const dvec3 yz = glm::cross(rows[1], rows[2]);
  const dvec3 zx = glm::cross(rows[2], rows[0]);
  const dvec3 xy = glm::cross(rows[0], rows[1]);
  return (values.x * yz + values.y * zx + values.z * xy) /
         glm::dot(rows[0], yz);
}

double largest(const dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

LatticeVector rounded(const dvec3& v) {
  const auto component = [](double value) {
    return static_cast<Int128>(std::nearbyint(value));
  };
  return {component(v.x), component(v.y), component(v.z)};
}

/// How long the vectors of a camera may be. Units: of the lattice.
double lattice_range(const Scene& scene) {
  return std::ldexp(
      1, scene.grid_bits() - 1 + kLatticeBits + kCameraRangeBits - 1);
}

/// The length of a grid step. Units: model units.
double step_of(const Scene& scene) {
  const Unit unit = scene.unit();
  return std::pow(static_cast<double>(unit.base),
                  static_cast<double>(unit.exponent));
}

/// The camera that shows what the rows say, rounded once to the lattice: the
/// image plane is as far away as the lattice reaches.
Result<Camera> camera_of_rows(const Scene& scene, ImageRows rows,
                              const dvec3& to_viewer, std::int32_t width_px,
                              std::int32_t height_px) {
  const double lattice_step = std::ldexp(step_of(scene), -kLatticeBits);
  for (auto* row : {&rows.x, &rows.y, &rows.w}) {
    for (std::size_t i = 0; i < 3; ++i) (*row)[i] *= lattice_step;
  }
  const dvec3 x = direction(rows.x), y = direction(rows.y);
  const dvec3 w = direction(rows.w);
  const double range = lattice_range(scene);
  CameraData data;
  data.width_px = width_px;
  data.height_px = height_px;
  data.perspective = w != dvec3(0);
  if (data.perspective) {
    const dvec3 eye = solved({x, y, w}, {-rows.x[3], -rows.y[3], -rows.w[3]});
    const dvec3 ahead = glm::cross(x, y);
    const double scale = (glm::dot(w, ahead) < 0 ? -1 : 1) *
                         (range - largest(eye)) / largest(ahead);
    if (!(range > 2 * largest(eye)))
      return Error{ErrorCode::kOutOfRange, "the eye is too far away"};
    data.eye = rounded(eye);
    data.s0 = rounded(eye + scale * ahead);
    data.sx = rounded(scale * glm::cross(y, w));
    data.sy = rounded(scale * glm::cross(w, x));
  } else {
    const dvec3 along = glm::cross(x, y);
    const double sign = glm::dot(along, to_viewer) < 0 ? -1 : 1;
    const std::array<dvec3, 3> axes = {x, y, along};
    data.eye = rounded(sign * range / largest(along) / 2 * along);
    data.s0 = rounded(solved(axes, {-rows.x[3], -rows.y[3], 0}));
    data.sx = rounded(solved(axes, {1, 0, 0}));
    data.sy = rounded(solved(axes, {0, 1, 0}));
  }
  return make_camera(data, scene.grid_bits());
}

ShownCamera camera_of_matrix(const Shown& shown, const ImageRows& rows,
                             const Triple& to_viewer, std::int32_t width_px,
                             std::int32_t height_px) {
  return {value_of(without_lock([&] {
    return shown.asked([&](const Display& display) {
      return camera_of_rows(display.scene(), rows,
                            {to_viewer[0], to_viewer[1], to_viewer[2]},
                            width_px, height_px);
    });
  }))};
}

/// A map, whose items are polygons of the display.
struct ShownMap {
  fast::VisibleMap map;
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
};

/// Keys by polygon of the scene, from those by polygon of the display.
std::vector<std::int32_t> scene_keys(
    std::span<const std::int32_t> polygons,
    const std::optional<std::vector<std::int32_t>>& keys) {
  std::vector<std::int32_t> result(polygons.begin(), polygons.end());
  if (!keys) return result;
  for (std::int32_t& polygon : result)
    polygon = (*keys)[static_cast<std::size_t>(polygon)];
  return result;
}

std::unique_ptr<ShownMap> visible_map(
    Shown& shown, const ShownCamera& camera,
    const std::optional<ArrayOf<std::int32_t>>& key_array, bool cull,
    std::size_t most_cells) {
  std::optional<std::vector<std::int32_t>> keys;
  if (key_array) keys = rows_of<std::int32_t>(*key_array, "keys");
  auto result = std::make_unique<ShownMap>();
  result->width_px = camera.camera->width_px;
  result->height_px = camera.camera->height_px;
  const auto work = [&](const Display& display,
                        const fast::BspTree& tree) -> Result<Done> {
    if (keys && keys->size() != display.polygon_count()) {
      return Error{ErrorCode::kOutOfRange,
                   std::to_string(keys->size()) + " keys for " +
                       std::to_string(display.polygon_count()) + " polygons"};
    }
    const auto polygons = display.polygons_of_scene();
    auto map =
        fast::visible_map(display.scene(), tree, camera.camera,
                          {cull, scene_keys(polygons, keys)}, {most_cells});
    if (!map) return map.error();
    for (fast::MapRegion& region : map->regions) {
      if (region.item != kBackground)
        region.item = polygons[static_cast<std::size_t>(region.item)];
    }
    result->map = *std::move(map);
    return Done{};
  };
  value_of(without_lock([&] { return shown.asked_with_tree(work); }));
  return result;
}

/// The corners of the scene's polygons as triangles, in model units, and the
/// polygon of the display of each.
py::tuple scene_triangles(const Shown& shown) {
  std::vector<std::array<Point, 3>> triangles;
  std::vector<std::int32_t> polygons;
  without_lock([&] {
    shown.asked([&](const Display& display) {
      const Scene& scene = display.scene();
      const double step = step_of(scene);
      const auto point = [&](VertexId vertex) -> Point {
        const GridPoint& p = scene.point(vertex);
        return {step * static_cast<double>(p.x),
                step * static_cast<double>(p.y),
                step * static_cast<double>(p.z)};
      };
      for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
        const auto corners = scene.corners(static_cast<PolygonId>(p));
        for (std::size_t k = 2; k < corners.size(); ++k) {
          triangles.push_back(
              {point(corners[0]), point(corners[k - 1]), point(corners[k])});
          polygons.push_back(display.polygons_of_scene()[p]);
        }
      }
      return true;
    });
    return true;
  });
  return py::make_tuple(array_of<double>(std::move(triangles)),
                        array_of<std::int32_t>(std::move(polygons)));
}

/// The parts of polygons from back to front as a camera sees them: the polygon
/// of each, where its corners begin, and the corners in model units.
py::tuple painters_order(Shown& shown, const ShownCamera& camera) {
  std::vector<std::int32_t> polygons;
  std::vector<std::uint32_t> first = {0};
  std::vector<Point> points;
  const auto work = [&](const Display& display, const fast::BspTree& tree) {
    const Scene& scene = display.scene();
    const double step = step_of(scene);
    const std::size_t count = scene.data().vertices.size();
    fast::back_to_front(
        tree, scene, camera.camera,
        [&](const fast::Node&, const fast::TreeFragment& fragment) {
          polygons.push_back(
              display.polygons_of_scene()[static_cast<std::size_t>(
                  fragment.source)]);
          for (std::uint32_t k = 0; k < fragment.corner_count; ++k) {
            const auto v = static_cast<std::size_t>(
                tree.corners[fragment.first_corner + k].vertex);
            if (v < count) {
              const GridPoint& p = scene.data().vertices[v];
              points.push_back({step * static_cast<double>(p.x),
                                step * static_cast<double>(p.y),
                                step * static_cast<double>(p.z)});
            } else {
              const fast::Vertex& p = tree.cut_vertices[v - count];
              points.push_back({step * p.x, step * p.y, step * p.z});
            }
          }
          first.push_back(static_cast<std::uint32_t>(points.size()));
          return true;
        });
    return true;
  };
  without_lock([&] { return shown.asked_with_tree(work); });
  return py::make_tuple(array_of<std::int32_t>(std::move(polygons)),
                        array_of<std::uint32_t>(std::move(first)),
                        array_of<double>(std::move(points)));
}

io::FigurePoint point_of(const fast::VisibleMap& map, std::int32_t vertex) {
  const fast::MapVertex& v = map.vertices[static_cast<std::size_t>(vertex)];
  return {v.x, v.y};
}

/// The drawing of a map, as the bytes of a file with that ending.
py::bytes draw(const ShownMap& shown, const std::string& ending,
               const std::optional<ArrayOf<std::uint8_t>>& fills,
               double line_width, int decimals) {
  io::Figure figure;
  figure.width = shown.width_px;
  figure.height = shown.height_px;
  const fast::VisibleMap& map = shown.map;
  std::vector<Rgb> colors;
  if (fills) colors = rows_of<Rgb>(*fills, "fills");
  if (fills && colors.size() != map.regions.size())
    throw std::invalid_argument("fills are not one a region");
  for (std::size_t r = 0; r < colors.size(); ++r) {
    io::FigureRegion drawn;
    drawn.fill = colors[r];
    const fast::MapRegion& region = map.regions[r];
    drawn.is_background = region.item == kBackground;
    drawn.title = region.item == kBackground
                      ? "background"
                      : "polygon " + std::to_string(region.item);
    drawn.loops = fast::loops_of(map, region);
    figure.regions.push_back(std::move(drawn));
  }
  if (line_width > 0) {
    io::FigureStrokes strokes;
    strokes.width = line_width;
    for (const fast::MapArc& arc : map.arcs) {
      if (arc.left >= 0 && arc.right >= 0)
        strokes.strokes.push_back(
            {point_of(map, arc.from), point_of(map, arc.to), {}});
    }
    figure.strokes.push_back(std::move(strokes));
  }
  return py::bytes(value_of(without_lock(
      [&] { return io::figure_bytes(ending, figure, {decimals}); })));
}

/// Binds an array of structs of `columns` numbers as an attribute.
template <class Element, class T>
void def_rows(py::class_<ShownMap>& type, const char* name,
              std::vector<T> fast::VisibleMap::*member, py::ssize_t columns) {
  type.def_property_readonly(name, [member, columns](const py::object& self) {
    const std::vector<T>& rows = self.cast<const ShownMap&>().map.*member;
    const auto count = static_cast<py::ssize_t>(rows.size());
    const auto* data = reinterpret_cast<const Element*>(rows.data());
    std::vector<py::ssize_t> shape{count}, strides{sizeof(T)};
    if (columns > 1) {
      shape.push_back(columns);
      strides.push_back(sizeof(Element));
    }
    py::array_t<Element> array(shape, strides, data, self);
    array.attr("setflags")(py::arg("write") = false);
    return array;
  });
}

}  // namespace

void bind_map(py::module_& module) {
  py::class_<ShownCamera>(module, "Camera");
  py::class_<ShownMap> type(module, "VisibleMap");
  def_rows<double>(type, "vertices", &fast::VisibleMap::vertices, 2);
  def_rows<std::int32_t>(type, "arcs", &fast::VisibleMap::arcs, 4);
  def_rows<std::int32_t>(type, "regions", &fast::VisibleMap::regions, 4);
  def_rows<std::uint32_t>(type, "first_corner", &fast::VisibleMap::first_corner,
                          1);
  def_rows<std::int32_t>(type, "corners", &fast::VisibleMap::corners, 1);
  type.def("draw", &draw);
  module.def("camera", [](const Shown& shown, const py::object& object) {
    const View view = view_from(object);
    return ShownCamera{value_of(without_lock([&] {
      return shown.asked([&](const Display& d) { return d.camera(view); });
    }))};
  });
  module.def(
      "camera_of_matrix", [](const Shown& shown, const ArrayOf<double>& matrix,
                             const Triple& to_viewer, std::int32_t width_px,
                             std::int32_t height_px) {
        const auto rows = rows_of<std::array<double, 4>>(matrix, "matrix");
        if (rows.size() != 3)
          throw std::invalid_argument("matrix has not 3 rows");
        return camera_of_matrix(shown, {rows[0], rows[1], rows[2]}, to_viewer,
                                width_px, height_px);
      });
  module.def("visible_map", &visible_map);
  module.def("scene_triangles", &scene_triangles);
  module.def("painters_order", &painters_order);
}

}  // namespace halfspace::python
