#include "halfspace/fast/drawing.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "drawing/clip_forms.hpp"
#include "drawing/crossings.hpp"
#include "drawing/edge_class.hpp"
#include "drawing/hiding.hpp"
#include "drawing/image_points.hpp"
#include "drawing/scene_edges.hpp"
#include "drawing/sight.hpp"
#include "drawing/strokes.hpp"
#include "halfspace/assert.hpp"

namespace halfspace::fast {
namespace {

/// The scene with the ends of given lines and the given points as vertices of
/// no polygon, in this order.
Scene with_given(const Scene& scene, const DrawingOptions& options) {
  SceneData data = scene.data();
  for (const GivenLine& line : options.lines) {
    data.vertices.push_back(line.from);
    data.vertices.push_back(line.to);
  }
  data.vertices.insert(data.vertices.end(), options.points.begin(),
                       options.points.end());
  Result<Scene> extended = make_scene(std::move(data));
  HALFSPACE_ASSERT(extended.has_value());
  return std::move(*extended);
}

/// A drawing, edge by edge.
class Drawer {
 public:
  Drawer(const Scene& scene, const Camera& camera,
         const DrawingOptions& options, const DrawingLimits& limits)
      : options_(options), limits_(limits), sight_(scene, camera) {}

  Result<Drawing> run() {
    const Scene& scene = sight_.scene();
    std::vector<std::int8_t> eye_signs;
    std::vector<bool> present;
    for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
      const int eye = sight_.eye_sign(static_cast<PolygonId>(p));
      eye_signs.push_back(static_cast<std::int8_t>(eye));
      present.push_back(!(options_.cull && eye < 0));
    }
    const SceneEdges edges(scene, present);
    const ClipForms clips(sight_, options_.clips, options_.caps,
                          options_.whole && !options_.cull);
    Hiding hiding(sight_, edges, std::move(eye_signs), clips, present);
    if (options_.edges) {
      add_edges(edges, hiding, clips);
      add_crossings(edges, present, clips);
      add_sections(edges, present, clips);
    }
    add_given(hiding);
    const ImagePoints points(sight_, hiding);
    add_points(hiding, points);
    if (!divide(hiding, points)) {
      return Error{ErrorCode::kOutOfRange,
                   "the drawing has more than " +
                       std::to_string(limits_.most_intervals) +
                       " intervals of edges, which is the limit"};
    }
    add_strokes(drawing_, lines_, pieces_, hiding, points);
    drawing_.decisions = sight_.stats();
    return std::move(drawing_);
  }

 private:
  void add_edges(const SceneEdges& edges, const Hiding& hiding,
                 const ClipForms& clips) {
    const PlaneTable planes = intern_planes(sight_.scene());
    for (const SceneEdge& edge : edges.edges()) {
      const auto sides = edges.sides(edge);
      const auto edge_class = class_of(sides, sight_, hiding, planes, options_);
      if (!edge_class) continue;
      Line line;
      line.from = hiding.point(edge.from);
      line.to = hiding.point(edge.to);
      for (const EdgeSide& side : sides) line.polygons.push_back(side.polygon);
      std::sort(line.polygons.begin(), line.polygons.end());
      if (clips.takes_away(line)) continue;
      drawing_.edges.push_back(
          {*edge_class, edge.from, edge.to, line.polygons[0],
           line.polygons.size() > 1 ? line.polygons[1] : PolygonId{-1}});
      lines_.push_back(std::move(line));
    }
  }

  void add_crossings(const SceneEdges& edges, const std::vector<bool>& present,
                     const ClipForms& clips) {
    for (Line& line : crossings(sight_, edges, present)) {
      if (clips.takes_away(line)) continue;
      DrawingEdge edge;
      edge.edge_class = EdgeClass::kIntersection;
      edge.polygon = line.polygons[0];
      edge.other = line.polygons[1];
      drawing_.edges.push_back(edge);
      lines_.push_back(std::move(line));
    }
  }

  void add_sections(const SceneEdges& edges, const std::vector<bool>& present,
                    const ClipForms& clips) {
    for (Line& line : clips.sections(edges, present)) {
      DrawingEdge edge;
      edge.edge_class = EdgeClass::kSection;
      edge.polygon = line.polygons[0];
      edge.other = -1;
      drawing_.edges.push_back(edge);
      lines_.push_back(std::move(line));
    }
    for (Line& line : clips.corners(options_.cull)) {
      DrawingEdge edge;
      edge.edge_class = EdgeClass::kSection;
      edge.polygon = -1;
      edge.other = -1;
      drawing_.edges.push_back(edge);
      lines_.push_back(std::move(line));
    }
  }

  /// Given vertices come after the scene's own.
  VertexId given_vertex(std::size_t k) const {
    const std::size_t given =
        2 * options_.lines.size() + options_.points.size();
    return static_cast<VertexId>(sight_.scene().data().vertices.size() - given +
                                 k);
  }

  void add_given(const Hiding& hiding) {
    for (std::size_t k = 0; k < options_.lines.size(); ++k) {
      Line line;
      line.from = hiding.point(given_vertex(2 * k));
      line.to = hiding.point(given_vertex(2 * k + 1));
      line.is_whole = options_.whole;
      drawing_.edges.push_back({EdgeClass::kGiven, -1, -1, PolygonId{-1},
                                static_cast<PolygonId>(k)});
      lines_.push_back(std::move(line));
    }
  }

  void add_points(Hiding& hiding, const ImagePoints& points) {
    for (std::size_t k = 0; k < options_.points.size(); ++k) {
      Line line;
      line.from = hiding.point(given_vertex(2 * options_.lines.size() + k));
      SeenPoint seen;
      seen.visible = hiding.is_visible(line.from, options_.whole);
      if (seen.visible) seen.at = points.point(line, {});
      drawing_.points.push_back(seen);
    }
  }

  /// The intervals of all edges; false if there are too many.
  bool divide(Hiding& hiding, const ImagePoints& points) {
    for (std::int32_t l = 0; l < std::ssize(lines_); ++l) {
      const Line& line = lines_[static_cast<std::size_t>(l)];
      if (hiding.is_point(line)) continue;
      for (const Layered& part : hiding.parts_of(line)) {
        if (drawing_.intervals.size() == limits_.most_intervals) return false;
        EdgeInterval interval;
        interval.edge = l;
        interval.layers = part.layers;
        interval.from_share = points.share(line, part.from);
        interval.to_share = points.share(line, part.to);
        // Where caps meet, parts may lie apart.
        const bool goes_on = !pieces_.empty() && pieces_.back().line == l &&
                             pieces_.back().to.is_same(part.from);
        interval.from = goes_on ? drawing_.intervals.back().to
                                : points.point(line, part.from);
        interval.to = points.point(line, part.to);
        drawing_.intervals.push_back(interval);
        pieces_.push_back({l, part.from, part.to});
      }
    }
    return true;
  }

  const DrawingOptions& options_;
  const DrawingLimits& limits_;
  Sight sight_;
  Drawing drawing_;
  std::vector<Line> lines_;    ///< by edge of the drawing
  std::vector<Piece> pieces_;  ///< by interval
};

}  // namespace

Result<Drawing> draw(const Scene& scene, const Camera& camera,
                     const DrawingOptions& options,
                     const DrawingLimits& limits) {
  HALFSPACE_ASSERT(options.cuts.empty() ||
                   options.cuts.size() == scene.polygon_count());
  HALFSPACE_ASSERT(kGivenInSections || options.clips.empty() ||
                   (options.points.empty() && !options.whole));
  if (options.lines.empty() && options.points.empty())
    return Drawer(scene, camera, options, limits).run();
  const Scene extended = with_given(scene, options);
  return Drawer(extended, camera, options, limits).run();
}

}  // namespace halfspace::fast
