#include "display.hpp"

#include <string>
#include <string_view>

#include "halfspace/fast/display_tree.hpp"
#include "halfspace/moving_display.hpp"
#include "halfspace/scalar_display.hpp"

namespace halfspace::python {

const fast::BspTree& Shown::tree() {
  const std::lock_guard lock(mutex_);
  if (!tree_) {
    tree_ = fast::build_display_tree(display_.scene());
    fast::divide_leaves(*tree_, display_.scene());
  }
  return *tree_;
}

Result<Shown::Cut> Shown::cut(const WorkOptions& options) const {
  const std::shared_lock lock(changes_);
  Result<CutDisplay> made = CutDisplay::of(display_, options);
  if (!made) return made.error();
  return Cut{*std::move(made), version_};
}

namespace {

using Color = std::array<std::uint8_t, 3>;

Rgb rgb_of(const py::handle& object) {
  const auto color = object.cast<Color>();
  return {color[0], color[1], color[2]};
}

/// The attributes of halfspace.CapStyle, or nothing.
std::optional<CapStyle> caps_from(const py::object& object) {
  if (object.is_none()) return std::nullopt;
  CapStyle caps;
  caps.color = rgb_of(object.attr("color"));
  if (!object.attr("hatch").is_none())
    caps.hatch = rgb_of(object.attr("hatch"));
  return caps;
}

}  // namespace

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
  for (const auto& [normal, offset] :
       object.attr("clips").cast<std::vector<std::pair<Triple, double>>>())
    view.clips.push_back({point_of(normal), offset});
  view.caps = caps_from(object.attr("caps"));
  view.caps_by_solid = object.attr("caps_by_solid").cast<bool>();
  view.background = rgb_of(object.attr("background"));
  if (!object.attr("back_color").is_none())
    view.back_color = rgb_of(object.attr("back_color"));
  view.alpha = object.attr("alpha").cast<std::uint8_t>();
  const py::object anti_aliasing = object.attr("anti_aliasing");
  view.anti_aliasing = py::isinstance<py::str>(anti_aliasing)
                           ? AntiAliasing::kExactArea
                           : AntiAliasing{anti_aliasing.cast<std::uint8_t>()};
  view.threads = object.attr("threads").cast<int>();
  view.lazy = object.attr("lazy").cast<bool>();
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

/// An array over the rows' member, which is `Element`s one after another.
/// Nothing is copied: it keeps `owner`, which keeps the rows.
template <class Element, class Row, class Member>
py::array column_of(const std::vector<Row>& rows, Member Row::*member,
                    const py::capsule& owner) {
  constexpr auto kColumns =
      static_cast<py::ssize_t>(sizeof(Member) / sizeof(Element));
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(rows.size())};
  std::vector<py::ssize_t> strides{sizeof(Row)};
  if (kColumns > 1) {
    shape.push_back(kColumns);
    strides.push_back(sizeof(Element));
  }
  const Row empty{};
  const Row& first = rows.empty() ? empty : rows.front();
  return py::array_t<Element>(
      shape, strides, reinterpret_cast<const Element*>(&(first.*member)),
      rows.empty() ? py::handle() : py::handle(owner));
}

/// Hands rows over to Python: the rows, and the capsule that keeps them.
template <class Row>
std::pair<const std::vector<Row>*, py::capsule> kept(std::vector<Row> rows) {
  auto owned = std::make_unique<std::vector<Row>>(std::move(rows));
  const std::vector<Row>* kept = owned.get();
  py::capsule owner(owned.get(), [](void* vector) {
    delete static_cast<std::vector<Row>*>(vector);
  });
  static_cast<void>(owned.release());
  return {kept, std::move(owner)};
}

/// The answer of `question` to a display and a view of Python.
template <class Question>
auto asked(const Shown& shown, const py::object& object,
           const Question& question) {
  return asked_of_view(object, [&](const View& view) {
    return shown.asked(
        [&](const Display& display) { return question(display, view); });
  });
}

py::tuple picture_of(Picture picture) {
  return py::make_tuple(image_array<std::int32_t>(std::move(picture.polygons)),
                        image_array<std::uint8_t>(std::move(picture.colors)));
}

py::tuple render(const Shown& shown, const py::object& object) {
  return picture_of(
      asked(shown, object,
            [](const Display& d, const View& view) { return d.render(view); }));
}

py::object pick(const Shown& shown, const py::object& object, std::int32_t x,
                std::int32_t y) {
  const std::optional<Pick> pick = asked(
      shown, object,
      [&](const Display& d, const View& view) { return d.pick(view, x, y); });
  if (!pick) return py::none();
  return py::make_tuple(pick->polygon, pick->solid, triple_of(pick->point),
                        pick->distance);
}

/// Lines as arrays: their ends, what edges they are, and what hides them.
py::tuple lines_of(std::vector<DrawnLine> drawn) {
  const auto [lines, owner] = kept(std::move(drawn));
  return py::make_tuple(
      column_of<double>(*lines, &DrawnLine::from, owner),
      column_of<double>(*lines, &DrawnLine::to, owner),
      column_of<std::uint8_t>(*lines, &DrawnLine::edge_class, owner),
      column_of<std::int32_t>(*lines, &DrawnLine::layers, owner));
}

/// Lines of arrays that lines_of() gave, or the like.
std::vector<DrawnLine> lines_from(const py::object& object) {
  if (object.is_none()) return {};
  const auto from =
      rows_of<Point2>(object.attr("starts").cast<ArrayOf<double>>(), "starts");
  const auto to =
      rows_of<Point2>(object.attr("ends").cast<ArrayOf<double>>(), "ends");
  const auto classes = rows_of<std::uint8_t>(
      object.attr("edge_classes").cast<ArrayOf<std::uint8_t>>(),
      "edge_classes");
  const auto layers = rows_of<std::int32_t>(
      object.attr("layers").cast<ArrayOf<std::int32_t>>(), "layers");
  if (to.size() != from.size() || classes.size() != from.size() ||
      layers.size() != from.size())
    throw std::invalid_argument("the arrays of lines differ in length");
  std::vector<DrawnLine> lines;
  for (std::size_t i = 0; i < from.size(); ++i)
    lines.push_back(
        {from[i], to[i], static_cast<EdgeClass>(classes[i]), layers[i]});
  return lines;
}

py::tuple draw(const Shown& shown, const py::object& object,
               double crease_deg) {
  return lines_of(asked(shown, object, [&](const Display& d, const View& view) {
                    return d.draw(view, crease_deg);
                  }).lines);
}

void save_drawing(const std::string& path, const py::object& object,
                  bool with_hidden) {
  const LineDrawing drawing{object.attr("width_px").cast<std::int32_t>(),
                            object.attr("height_px").cast<std::int32_t>(),
                            lines_from(object)};
  value_of(without_lock([&] { return drawing.save(path, with_hidden); }));
}

/// Regions as arrays: lists of lists are one array and where each begins.
py::tuple figure(const Shown& shown, const py::object& object,
                 const std::string& by) {
  const FigureKey key = by == "polygon" ? FigureKey::kPolygon
                        : by == "solid" ? FigureKey::kSolid
                                        : FigureKey::kColor;
  const Figure figure = asked(
      shown, object,
      [&](const Display& d, const View& view) { return d.figure(view, key); });
  std::vector<std::int32_t> polygons;
  std::vector<Rgb> colors;
  std::vector<std::uint32_t> first_loop = {0}, first_point = {0};
  std::vector<Point2> points;
  for (const SeenRegion& region : figure.regions) {
    polygons.push_back(region.polygon);
    colors.push_back(region.color);
    for (const std::vector<Point2>& loop : region.loops) {
      points.insert(points.end(), loop.begin(), loop.end());
      first_point.push_back(static_cast<std::uint32_t>(points.size()));
    }
    first_loop.push_back(static_cast<std::uint32_t>(first_point.size() - 1));
  }
  return py::make_tuple(array_of<std::int32_t>(std::move(polygons)),
                        array_of<std::uint8_t>(std::move(colors)),
                        array_of<std::uint32_t>(std::move(first_loop)),
                        array_of<std::uint32_t>(std::move(first_point)),
                        array_of<double>(std::move(points)));
}

/// Writes an object with the attributes of halfspace.Figure.
void save_figure(const std::string& path, const py::object& object) {
  Figure figure{object.attr("width_px").cast<std::int32_t>(),
                object.attr("height_px").cast<std::int32_t>(),
                {},
                lines_from(object.attr("lines"))};
  for (const py::handle region : object) {
    SeenRegion& seen = figure.regions.emplace_back();
    seen.polygon = region.attr("polygon").cast<std::int32_t>();
    seen.color = rgb_of(region.attr("color"));
    for (const py::handle loop : region.attr("loops"))
      seen.loops.push_back(
          rows_of<Point2>(loop.cast<ArrayOf<double>>(), "a loop"));
  }
  value_of(without_lock([&] { return figure.save(path); }));
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
  std::vector<Rgb> colors;
};

py::tuple order(const Shown& shown, const py::object& object,
                bool front_to_back, bool with_spans) {
  Order order;
  const auto visit = [&](const SeenPolygon& seen) {
    order.polygons.push_back(seen.polygon);
    order.colors.push_back(seen.color);
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
  asked(shown, object, [&](const Display& display, const View& view) {
    return front_to_back ? display.front_to_back(view, visit)
                         : display.back_to_front(view, visit);
  });
  return py::make_tuple(
      array_of<std::int32_t>(std::move(order.polygons)),
      array_of<std::uint32_t>(std::move(order.first_point)),
      array_of<double>(std::move(order.points)),
      array_of<std::uint32_t>(std::move(order.first_projected)),
      array_of<double>(std::move(order.projected)),
      array_of<std::uint32_t>(std::move(order.first_span)),
      array_of<std::int32_t>(std::move(order.spans)),
      array_of<std::uint8_t>(std::move(order.colors)));
}

/// What scan() hands out: polygon, line, first and last pixel.
py::array scan(const Shown& shown, const py::object& object) {
  std::vector<std::array<std::int32_t, 4>> spans;
  asked(shown, object, [&](const Display& display, const View& view) {
    return display.scan(
        view, [&](const SeenPolygon& seen, const PixelSpan& span) {
          spans.push_back({seen.polygon, span.line, span.first, span.last});
        });
  });
  return array_of<std::int32_t>(std::move(spans));
}

std::shared_ptr<Shown> shown_of(const std::vector<Solid>& solids) {
  return std::make_shared<Shown>(
      value_of(without_lock([&] { return Display::of(solids); })));
}

std::shared_ptr<Shown> shown_of_mesh(const Mesh& mesh) {
  return std::make_shared<Shown>(
      value_of(without_lock([&] { return Display::of(mesh); })));
}

std::shared_ptr<Shown> shown_of_file(const std::string& path) {
  return std::make_shared<Shown>(
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

/// A cut display, and the display that it is of.
struct ShownCut {
  std::shared_ptr<Shown> shown;
  Shown::Cut cut;
};

ShownCut cut_of(const std::shared_ptr<Shown>& shown, int threads,
                const py::object& progress) {
  Watch watch(progress);
  auto cut = without_lock([&] {
    return shown->cut({threads, watch.progress()});
  });
  watch.rethrow();
  return {shown, value_of(std::move(cut))};
}

py::tuple seen_areas(const ShownCut& cut, const py::object& object) {
  const auto [areas, owner] = kept(asked_of_view(object, [&](const View& view) {
    return cut.shown->asked_of(cut.cut, [&](const CutDisplay& display) {
      return display.seen_areas(view);
    });
  }));
  return py::make_tuple(
      column_of<std::int32_t>(*areas, &SeenArea::polygon, owner),
      column_of<double>(*areas, &SeenArea::area_px, owner),
      column_of<double>(*areas, &SeenArea::solid_angle, owner));
}

py::tuple vertex_feed(const ShownCut& cut) {
  VertexFeed feed = without_lock([&] {
    return cut.shown->asked_of(cut.cut, [](const CutDisplay& display) {
      return display.vertex_feed();
    });
  });
  return py::make_tuple(array_of<double>(std::move(feed.positions)),
                        array_of<std::int32_t>(std::move(feed.polygons)));
}

py::array feed_indices(const ShownCut& cut, const py::object& object,
                       bool front_to_back) {
  const FeedOrder order =
      front_to_back ? FeedOrder::kFrontToBack : FeedOrder::kBackToFront;
  return array_of<std::uint32_t>(asked_of_view(object, [&](const View& view) {
    return cut.shown->asked_of(cut.cut, [&](const CutDisplay& display) {
      return display.feed_indices(view, order);
    });
  }));
}

void bind_cut(py::module_& module) {
  py::class_<ShownCut>(module, "CutDisplay")
      .def_static("of", &cut_of)
      .def("seen_areas", &seen_areas)
      .def("vertex_feed", &vertex_feed)
      .def("feed_indices", &feed_indices);
}

ScalarStyle style_from(const py::object& object) {
  ScalarStyle style;
  style.map = object.attr("map").cast<std::string>();
  style.low = object.attr("low").cast<std::optional<double>>();
  style.high = object.attr("high").cast<std::optional<double>>();
  style.logarithmic = object.attr("logarithmic").cast<bool>();
  style.steps = object.attr("steps").cast<std::int32_t>();
  style.clamp = object.attr("clamp").cast<bool>();
  style.no_data = rgb_of(object.attr("no_data"));
  style.legend = object.attr("legend").cast<bool>();
  style.title = object.attr("title").cast<std::string>();
  return style;
}

void bind_scalars(py::module_& module) {
  py::class_<ScalarDisplay>(module, "ScalarDisplay")
      .def_static("of",
                  [](const Mesh& mesh, std::size_t field) {
                    return value_of(without_lock(
                        [&] { return ScalarDisplay::of(mesh, field); }));
                  })
      .def("render", [](const ScalarDisplay& display, const py::object& object,
                        const py::object& style_object) {
        const ScalarStyle style = style_from(style_object);
        return picture_of(asked_of_view(object, [&](const View& view) {
          return display.render(view, style);
        }));
      });
}

/// Binds a function that changes a moving display.
template <class Answer, class... Arguments>
void def_change(py::class_<MovingDisplay>& type, const char* name,
                Result<Answer> (MovingDisplay::*change)(Arguments...)) {
  type.def(name, [change](MovingDisplay& display,
                          const std::decay_t<Arguments>&... arguments) {
    const Answer answer =
        value_of(without_lock([&] { return (display.*change)(arguments...); }));
    if constexpr (!std::is_same_v<Answer, Done>) return answer;
  });
}

py::tuple render_moving(const MovingDisplay& display,
                        const py::object& object) {
  MovingPicture picture = asked_of_view(
      object, [&](const View& view) { return display.render(view); });
  return py::make_tuple(image_array<std::int32_t>(std::move(picture.polygons)),
                        image_array<std::int32_t>(std::move(picture.objects)),
                        image_array<std::uint8_t>(std::move(picture.colors)));
}

void bind_moving(py::module_& module) {
  py::class_<MovingDisplay> type(module, "MovingDisplay");
  type.def_static("of", [](const Mesh& world) {
    return value_of(without_lock([&] { return MovingDisplay::of(world); }));
  });
  def_change(type, "add_model", &MovingDisplay::add_model);
  type.def("insert", [](MovingDisplay& display, std::int32_t model,
                        const ArrayOf<double>& region, std::int32_t owner) {
    const auto points = rows_of<Point>(region, "a region");
    return value_of(
        without_lock([&] { return display.insert(model, points, owner); }));
  });
  def_change(type, "remove", &MovingDisplay::remove);
  def_change(type, "place", &MovingDisplay::place);
  def_change(type, "hide", &MovingDisplay::hide);
  type.def("render", &render_moving);
}

}  // namespace

void bind_display(py::module_& module) {
  static_assert(sizeof(PixelSpan) == 3 * sizeof(std::int32_t));
  static_assert(sizeof(Point2) == 2 * sizeof(double));
  static_assert(sizeof(EdgeClass) == 1);
  py::class_<Shown, std::shared_ptr<Shown>>(module, "Display")
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
      .def("scan", &scan)
      .def("draw", &draw)
      .def("figure", &figure)
      .def("insert",
           [](Shown& shown, const Mesh& mesh) {
             value_of(without_lock([&] {
               return shown.changed([&](Display& d) { return d.insert(mesh); });
             }));
           })
      .def("remove",
           [](Shown& shown, const ArrayOf<std::int32_t>& array) {
             const auto polygons = rows_of<std::int32_t>(array, "polygons");
             value_of(without_lock([&] {
               return shown.changed(
                   [&](Display& d) { return d.remove(polygons); });
             }));
           })
      .def("move_to", [](Shown& shown, const ArrayOf<std::int32_t>& vertices,
                         const ArrayOf<double>& points) {
        const auto which = rows_of<std::int32_t>(vertices, "vertices");
        const auto where = rows_of<Point>(points, "points");
        value_of(without_lock([&] {
          return shown.changed(
              [&](Display& d) { return d.move_to(which, where); });
        }));
      });
  module.def("save_picture", &save_picture);
  module.def("save_drawing", &save_drawing);
  module.def("save_figure", &save_figure);
  bind_cut(module);
  bind_scalars(module);
  bind_moving(module);
  bind_screen(module);
}

}  // namespace halfspace::python
