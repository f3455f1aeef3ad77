#include "figure/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "figure/bands.hpp"
#include "halfspace/cap_parts.hpp"
#include "halfspace/fast/predicate.hpp"
#include "halfspace/fast/shade/color_forms.hpp"

namespace halfspace::tools {
namespace {

/// Numbers things in the order in which they come.
template <class Thing>
std::vector<std::int32_t> numbered(const std::vector<Thing>& things) {
  std::map<Thing, std::int32_t> numbers;
  std::vector<std::int32_t> result;
  for (const Thing& thing : things) {
    const auto next = static_cast<std::int32_t>(numbers.size());
    result.push_back(numbers.try_emplace(thing, next).first->second);
  }
  return result;
}

/// Polygons that share vertices are of one part.
std::vector<std::int32_t> parts_of(const Scene& scene) {
  const std::vector<std::uint32_t> parts = connected_parts(scene);
  return {parts.begin(), parts.end()};
}

std::string text_of_part(const ImageOptions& image, const CapItem& cap) {
  if (cap.part == image.parts->count()) return "several parts";
  return "part " + std::to_string(cap.part);
}

/// Colours that are told apart, also by the colour-blind (Okabe and Ito 2008).
constexpr std::array<Rgb, 8> kPalette = {{{230, 159, 0},
                                          {86, 180, 233},
                                          {0, 158, 115},
                                          {240, 228, 66},
                                          {0, 114, 178},
                                          {213, 94, 0},
                                          {204, 121, 167},
                                          {153, 153, 153}}};

constexpr std::string_view kClassNames[] = {
    "section", "border", "silhouette", "intersection", "crease", "given"};

io::FigureRegion region_of(const fast::VisibleMap& map,
                           const fast::MapRegion& region,
                           const Placing& placing) {
  io::FigureRegion drawn;
  drawn.loops = fast::loops_of(map, region);
  for (std::vector<io::FigurePoint>& loop : drawn.loops) {
    for (io::FigurePoint& p : loop) p = placing.at(p[0], p[1]);
  }
  return drawn;
}

bool is_shaded(const Scene& scene, PolygonId polygon) {
  const auto colors = scene.corner_colors(polygon);
  return std::any_of(colors.begin(), colors.end(),
                     [&](Rgb color) { return !(color == colors[0]); });
}

/// Gives a region the colours that its polygon's corners have (S5.4).
void shade(io::FigureRegion& region, const Scene& scene, const Camera& camera,
           PolygonId polygon, const Placing& placing) {
  region.fill = scene.corner_colors(polygon)[0];
  const std::optional<fast::ColorForms> colors =
      fast::color_forms(scene, camera, polygon);
  if (!colors) return;
  io::FigureShade shade;
  for (std::size_t f = 0; f < shade.forms.size(); ++f) {
    const auto& [a, b, c] = colors->forms[f];
    shade.forms[f] = {a / placing.scale, b / placing.scale,
                      c - (a * placing.x + b * placing.y) / placing.scale};
  }
  io::FigurePoint middle = {0, 0};
  const auto& corners = region.loops[0];
  for (const io::FigurePoint& p : corners) {
    const auto count = static_cast<double>(corners.size());
    middle = {middle[0] + p[0] / count, middle[1] + p[1] / count};
  }
  const std::array<double, 3> color = shade.at(middle);
  const auto byte = [](double channel) {
    return static_cast<std::uint8_t>(
        std::lround(std::clamp(channel, 0.0, 255.0)));
  };
  region.fill = {byte(color[0]), byte(color[1]), byte(color[2])};
  region.shade = shade;
}

/// The edges and intervals that a stroke is drawn for. Not by fmt, which would
/// add 50 kB to the web's module.
std::string title_of(const fast::Drawing& drawing, const fast::Stroke& stroke) {
  std::string title;
  for (std::uint32_t k = 0; k < stroke.piece_count; ++k) {
    const auto number =
        static_cast<std::size_t>(drawing.pieces[stroke.first_piece + k]);
    const fast::EdgeInterval& interval = drawing.intervals[number];
    const fast::DrawingEdge& edge =
        drawing.edges[static_cast<std::size_t>(interval.edge)];
    if (!title.empty()) title += "; ";
    if (edge.edge_class == EdgeClass::kGiven) {
      title += "line " + std::to_string(edge.other);
    } else if (edge.from >= 0) {
      title += "polygon " + std::to_string(edge.polygon) + " edge " +
               std::to_string(edge.from) + "-" + std::to_string(edge.to);
    } else if (edge.polygon < 0) {
      title += "where caps meet";
    } else if (edge.other < 0) {
      title += "cut of polygon " + std::to_string(edge.polygon);
    } else {
      title += "polygons " + std::to_string(edge.polygon) + " and " +
               std::to_string(edge.other);
    }
    char way[96];
    std::snprintf(way, sizeof way, " %.6g to %.6g behind ", interval.from_share,
                  interval.to_share);
    title += way + std::to_string(interval.layers);
  }
  return title;
}

}  // namespace

std::vector<std::int32_t> keys_of(const FigureScene& figure,
                                  const std::string& by, bool smooth,
                                  const ImageOptions& image) {
  const Scene& scene = figure.scene();
  const std::size_t count = scene.polygon_count();
  const std::size_t all = count + cap_item_count(image);
  if (by == "polygon") return {};
  if (by == "all") return std::vector<std::int32_t>(all, 0);
  if (by == "part" || by == "file") {
    std::vector<std::int32_t> keys =
        by == "part" ? parts_of(scene) : figure.files;
    const std::int32_t next =
        keys.empty() ? 0 : 1 + *std::max_element(keys.begin(), keys.end());
    for (std::size_t k = 0; k < all - count; ++k) {
      const CapItem cap = cap_item(k);
      keys.push_back(next + static_cast<std::int32_t>(2 * cap.part) +
                     (cap.is_hatched ? 1 : 0));
    }
    return keys;
  }
  const bool is_face = by == "face";
  const fast::PlaneTable planes = fast::intern_planes(scene);
  std::vector<std::tuple<std::int32_t, bool, Rgb>> faces;
  for (std::size_t p = 0; p < count; ++p) {
    const auto id = static_cast<PolygonId>(p);
    if (smooth && by == "colour") {
      faces.emplace_back(is_shaded(scene, id) ? id : -1, false,
                         scene.corner_colors(id)[0]);
      continue;
    }
    if (by == "colour" && figure.scalars && figure.scalars->banded[p]) {
      faces.emplace_back(id, false, Rgb{});
      continue;
    }
    faces.emplace_back(is_face ? planes.plane_of[p] : -1,
                       is_face && planes.same_orientation[p], scene.color(id));
  }
  for (std::size_t k = 0; k < all - count; ++k) {
    faces.emplace_back(is_face ? -1 - static_cast<std::int32_t>(k) : -1, false,
                       color_of(image, cap_item(k)));
  }
  return numbered(faces);
}

void add_regions(io::Figure& figure, const fast::VisibleMap& map,
                 const FigureScene& scene, const FillStyle& style,
                 const Placing& placing) {
  const bool has_palette = style.by == "part" || style.by == "file";
  const auto count = static_cast<PolygonId>(scene.scene().polygon_count());
  std::optional<BandCutter> bands;
  if (style.scalar_view != nullptr)
    bands.emplace(scene.scene(), *style.scalar_view, *scene.scalars);
  for (const fast::MapRegion& region : map.regions) {
    const bool is_background = region.item == kBackground;
    if (is_background && !style.has_background) continue;
    io::FigureRegion drawn = region_of(map, region, placing);
    drawn.is_background = is_background;
    const std::string key = std::to_string(region.key);
    drawn.id = "region-" + std::to_string(figure.regions.size());
    drawn.title = is_background ? "background" : style.by + " " + key;
    drawn.class_of = is_background ? "background" : style.by + "-" + key;
    if (is_background) {
      drawn.fill = style.background;
    } else if (style.by == "composed") {
      drawn.fill = color_of_key(region.key);
    } else if (region.item >= count) {
      const CapItem cap =
          cap_item(static_cast<std::size_t>(region.item - count));
      drawn.title = cap.is_hatched ? "hatching" : "cap";
      drawn.class_of = drawn.title;
      drawn.fill = color_of(*style.caps, cap);
      if (style.caps->parts)
        drawn.title += " of " + text_of_part(*style.caps, cap);
    } else if (has_palette) {
      drawn.fill =
          kPalette[static_cast<std::size_t>(region.key) % kPalette.size()];
    } else if (bands &&
               scene.scalars->banded[static_cast<std::size_t>(region.item)]) {
      auto parts = bands->cut(drawn, region.item, placing);
      for (io::FigureRegion& part : parts) {
        part.id = "region-" + std::to_string(figure.regions.size());
        figure.regions.push_back(std::move(part));
      }
      continue;
    } else if (style.smooth_view != nullptr) {
      shade(drawn, scene.scene(), *style.smooth_view, region.item, placing);
    } else {
      drawn.fill = scene.scene().color(region.item);
    }
    figure.regions.push_back(std::move(drawn));
  }
}

std::vector<bool> cuts_of(const Scene& scene, const CutPlane& plane) {
  const double unit =
      std::pow(static_cast<double>(scene.unit().base), scene.unit().exponent);
  const double at = std::round(plane.at / unit);
  std::vector<bool> cuts;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto corners = scene.corners(static_cast<PolygonId>(p));
    cuts.push_back(std::all_of(corners.begin(), corners.end(), [&](VertexId v) {
      const GridPoint& g = scene.point(v);
      const std::int64_t c[3] = {g.x, g.y, g.z};
      return static_cast<double>(c[plane.axis]) == at;
    }));
  }
  return cuts;
}

void add_hatching(io::Figure& figure, const fast::VisibleMap& map, double gap,
                  double width, const Placing& placing) {
  io::FigureStrokes strokes;
  strokes.name = "hatching";
  strokes.width = width;
  for (const fast::MapRegion& region : map.regions) {
    if (region.key != 1) continue;
    const auto lines = io::hatching(region_of(map, region, placing), gap);
    strokes.strokes.insert(strokes.strokes.end(), lines.begin(), lines.end());
  }
  if (strokes.strokes.empty()) return;
  io::order_for_pen(strokes.strokes);
  figure.strokes.push_back(std::move(strokes));
}

void add_borders(io::Figure& figure, const fast::VisibleMap& map, double width,
                 const Placing& placing) {
  io::FigureStrokes strokes;
  strokes.width = width;
  strokes.name = "borders";
  const auto point = [&](std::int32_t v) {
    const fast::MapVertex& vertex = map.vertices[static_cast<std::size_t>(v)];
    return placing.at(vertex.x, vertex.y);
  };
  for (const fast::MapArc& arc : map.arcs) {
    if (arc.left < 0 || arc.right < 0) continue;
    strokes.strokes.push_back({point(arc.from), point(arc.to), {}});
  }
  io::order_for_pen(strokes.strokes);
  figure.strokes.push_back(std::move(strokes));
}

void add_strokes(io::Figure& figure, const fast::Drawing& drawing,
                 const StrokeStyle& style, const Placing& placing) {
  constexpr std::size_t kClasses = std::size(kClassNames);
  for (const bool hidden : {true, false}) {
    if (hidden && style.hidden == Hidden::kGone) continue;
    for (std::size_t k = 0; k < kClasses; ++k) {
      io::FigureStrokes strokes;
      strokes.name = (hidden ? "hidden-" : "") + std::string(kClassNames[k]);
      const auto edge_class = static_cast<EdgeClass>(k);
      const bool is_inner = edge_class == EdgeClass::kCrease ||
                            edge_class == EdgeClass::kIntersection ||
                            edge_class == EdgeClass::kGiven;
      strokes.width = style.width * (hidden ? 0.5 : is_inner ? 0.7 : 1);
      if (hidden && style.hidden == Hidden::kDashed)
        strokes.dashes = {4 * style.width, 3 * style.width};
      for (const fast::Stroke& stroke : drawing.strokes) {
        if (stroke.edge_class != edge_class || (stroke.layers > 0) != hidden)
          continue;
        strokes.strokes.push_back(
            {placing.at(stroke.from.x, stroke.from.y),
             placing.at(stroke.to.x, stroke.to.y),
             style.titles ? title_of(drawing, stroke) : std::string()});
      }
      if (strokes.strokes.empty()) continue;
      io::order_for_pen(strokes.strokes);
      const auto same = std::find_if(
          figure.strokes.begin(), figure.strokes.end(),
          [&](const io::FigureStrokes& s) { return s.name == strokes.name; });
      if (same == figure.strokes.end()) {
        figure.strokes.push_back(std::move(strokes));
      } else {
        same->strokes.insert(same->strokes.end(), strokes.strokes.begin(),
                             strokes.strokes.end());
      }
    }
  }
}

}  // namespace halfspace::tools
