#include "display.hpp"

#include "halfspace/fast/display_tree.hpp"

namespace halfspace::python {

const fast::BspTree& Shown::tree() {
  const std::lock_guard lock(mutex_);
  if (!tree_) {
    tree_ = fast::build_display_tree(display_.scene());
    fast::divide_leaves(*tree_, display_.scene());
  }
  return *tree_;
}

Result<Done> Shown::insert(const Mesh& mesh) {
  const std::unique_lock lock(changes_);
  const Result<Done> done = display_.insert(mesh);
  if (done) tree_.reset();
  return done;
}

View view_from(const py::object& object) {
  const auto point = [&object](const char* name) -> std::optional<Point> {
    const auto triple = object.attr(name).cast<std::optional<Triple>>();
    return triple ? std::optional(point_of(*triple)) : std::nullopt;
  };
  View view;
  view.eye = point("eye");
  view.target = point("target");
  view.up = point("up");
  view.fov_deg = object.attr("fov_deg").cast<double>();
  view.orthographic = object.attr("orthographic").cast<bool>();
  view.ortho_height = object.attr("ortho_height").cast<double>();
  view.near = object.attr("near").cast<std::optional<double>>();
  view.width_px = object.attr("width_px").cast<std::int32_t>();
  view.height_px = object.attr("height_px").cast<std::int32_t>();
  view.cull = object.attr("cull").cast<bool>();
  const auto background =
      object.attr("background").cast<std::array<std::uint8_t, 3>>();
  view.background = {background[0], background[1], background[2]};
  view.threads = object.attr("threads").cast<int>();
  return view;
}

namespace {

/// An image as an array of rows and columns, which owns it.
template <class Element, class T>
py::array image_array(Grid2<T> image) {
  std::vector<py::ssize_t> shape{image.height_px, image.width_px};
  if (sizeof(T) > sizeof(Element))
    shape.push_back(static_cast<py::ssize_t>(sizeof(T) / sizeof(Element)));
  return array_of<Element>(std::move(image.pixels)).reshape(shape);
}

py::tuple render(const Shown& shown, const py::object& object) {
  const View view = view_from(object);
  Picture picture = value_of(without_lock([&] {
    return shown.asked([&](const Display& d) { return d.render(view); });
  }));
  return py::make_tuple(image_array<std::int32_t>(std::move(picture.polygons)),
                        image_array<std::uint8_t>(std::move(picture.colors)));
}

py::object pick(const Shown& shown, const py::object& object, std::int32_t x,
                std::int32_t y) {
  const View view = view_from(object);
  const std::optional<Pick> pick = value_of(without_lock([&] {
    return shown.asked([&](const Display& d) { return d.pick(view, x, y); });
  }));
  if (!pick) return py::none();
  return py::make_tuple(pick->polygon, pick->solid, triple_of(pick->point),
                        pick->distance);
}

py::tuple hit_tuple(const Hit& hit) {
  return py::make_tuple(hit.polygon, hit.solid, triple_of(hit.point),
                        hit.distance, hit.parameter, hit.fraction);
}

py::object first_hit(const Shown& shown, const Triple& from,
                     const Triple& along) {
  const std::optional<Hit> hit = value_of(without_lock([&] {
    return shown.asked([&](const Display& d) {
      return d.first_hit(point_of(from), point_of(along));
    });
  }));
  return hit ? py::object(hit_tuple(*hit)) : py::none();
}

/// All hits of a ray, or of the way to a point.
py::list hits(const Shown& shown, const Triple& from, const Triple& to,
              bool is_way) {
  const std::vector<Hit> found = value_of(without_lock([&] {
    return shown.asked([&](const Display& d) {
      return is_way ? d.hits_between(point_of(from), point_of(to))
                    : d.all_hits(point_of(from), point_of(to));
    });
  }));
  py::list result;
  for (const Hit& hit : found) result.append(hit_tuple(hit));
  return result;
}

bool see_each_other(const Shown& shown, const Triple& a, const Triple& b) {
  return value_of(without_lock([&] {
    return shown.asked([&](const Display& d) {
      return d.see_each_other(point_of(a), point_of(b));
    });
  }));
}

/// A traversal as arrays: lists of lists are one array and where each begins.
struct Order {
  std::vector<std::int32_t> polygons;
  std::vector<std::uint32_t> first_point = {0};
  std::vector<Point> points;
  std::vector<std::uint32_t> first_projected = {0};
  std::vector<Point2> projected;
  std::vector<std::uint32_t> first_span = {0};
  std::vector<PixelSpan> spans;
};

py::tuple order(const Shown& shown, const py::object& object,
                bool front_to_back, bool with_spans) {
  const View view = view_from(object);
  Order order;
  const auto visit = [&](const SeenPolygon& seen) {
    order.polygons.push_back(seen.polygon);
    order.points.insert(order.points.end(), seen.points.begin(),
                        seen.points.end());
    order.first_point.push_back(
        static_cast<std::uint32_t>(order.points.size()));
    order.projected.insert(order.projected.end(), seen.projected.begin(),
                           seen.projected.end());
    order.first_projected.push_back(
        static_cast<std::uint32_t>(order.projected.size()));
    if (with_spans) {
      const std::vector<PixelSpan> spans = seen.spans();
      order.spans.insert(order.spans.end(), spans.begin(), spans.end());
    }
    order.first_span.push_back(static_cast<std::uint32_t>(order.spans.size()));
    return true;
  };
  value_of(without_lock([&] {
    return shown.asked([&](const Display& display) {
      return front_to_back ? display.front_to_back(view, visit)
                           : display.back_to_front(view, visit);
    });
  }));
  return py::make_tuple(
      array_of<std::int32_t>(std::move(order.polygons)),
      array_of<std::uint32_t>(std::move(order.first_point)),
      array_of<double>(std::move(order.points)),
      array_of<std::uint32_t>(std::move(order.first_projected)),
      array_of<double>(std::move(order.projected)),
      array_of<std::uint32_t>(std::move(order.first_span)),
      array_of<std::int32_t>(std::move(order.spans)));
}

std::unique_ptr<Shown> shown_of(const std::vector<Solid>& solids) {
  return std::make_unique<Shown>(
      value_of(without_lock([&] { return Display::of(solids); })));
}

std::unique_ptr<Shown> shown_of_mesh(const Mesh& mesh) {
  return std::make_unique<Shown>(
      value_of(without_lock([&] { return Display::of(mesh); })));
}

std::unique_ptr<Shown> shown_of_file(const std::string& path) {
  return std::make_unique<Shown>(
      value_of(without_lock([&] { return Display::of_file(path); })));
}

/// Writes colours as PNG. Shape: rows, columns, 3.
void save_picture(const std::string& path,
                  const ArrayOf<std::uint8_t>& colors) {
  if (colors.ndim() != 3 || colors.shape(2) != 3)
    throw std::invalid_argument("colors are not rows of columns of 3");
  Picture picture;
  picture.colors.width_px = static_cast<std::int32_t>(colors.shape(1));
  picture.colors.height_px = static_cast<std::int32_t>(colors.shape(0));
  const auto* pixels = reinterpret_cast<const Rgb*>(colors.data());
  picture.colors.pixels.assign(pixels, pixels + colors.size() / 3);
  value_of(without_lock([&] { return picture.save(path); }));
}

void bind_screen(py::module_& module) {
  py::class_<DynamicScreen>(module, "DynamicScreen")
      .def(py::init<std::int32_t, std::int32_t>())
      .def("light",
           [](DynamicScreen& screen, const ArrayOf<std::int32_t>& spans) {
             return array_of<std::int32_t>(
                 screen.light(rows_of<PixelSpan>(spans, "spans")));
           })
      .def("is_full", &DynamicScreen::is_full);
}

}  // namespace

void bind_display(py::module_& module) {
  static_assert(sizeof(PixelSpan) == 3 * sizeof(std::int32_t));
  static_assert(sizeof(Point2) == 2 * sizeof(double));
  py::class_<Shown>(module, "Display")
      .def_static("of_solids", &shown_of)
      .def_static("of_mesh", &shown_of_mesh)
      .def_static("of_file", &shown_of_file)
      .def("polygon_count",
           [](const Shown& shown) {
             return without_lock([&] {
               return shown.asked(
                   [](const Display& d) { return d.polygon_count(); });
             });
           })
      .def("render", &render)
      .def("pick", &pick)
      .def("first_hit", &first_hit)
      .def("hits", &hits)
      .def("see_each_other", &see_each_other)
      .def("order", &order)
      .def("insert", [](Shown& shown, const Mesh& mesh) {
        value_of(without_lock([&] { return shown.insert(mesh); }));
      });
  module.def("save_picture", &save_picture);
  bind_screen(module);
}

}  // namespace halfspace::python
