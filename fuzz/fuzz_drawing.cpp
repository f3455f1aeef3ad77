#include <algorithm>
#include <tuple>
#include <vector>

#include "fuzz.hpp"
#include "halfspace/boolean.hpp"
#include "halfspace/fast/drawing.hpp"
#include "halfspace/fast/shade/lines.hpp"
#include "halfspace/ref/drawing.hpp"
#include "halfspace/ref/lines.hpp"
#include "views.hpp"

namespace halfspace {
namespace {

/// The reference cuts every edge by everything: beyond so many polygons that
/// takes too long, and nothing is compared.
constexpr std::size_t kMostPolygons = 12;

/// A part of a drawing: its class, layers, and the nearest doubles to its ends.
using Part = std::tuple<double, double, double, double, EdgeClass, int>;

template <class Ends>
Part part_of(EdgeClass edge_class, std::int32_t layers, const Ends& from,
             const Ends& to) {
  const auto f = std::pair{from.x, from.y};
  const auto g = std::pair{to.x, to.y};
  const auto [low, high] = std::minmax(f, g);
  return {low.first, low.second, high.first, high.second, edge_class, layers};
}

fast::DrawingPoint rounded(const ref::ImagePoint& p) {
  return {nearest_double(p.x), nearest_double(p.y)};
}

}  // namespace
}  // namespace halfspace

/// The drawing is the same by both libraries: intervals and strokes with their
/// classes, layers and the nearest doubles to their ends.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  using namespace halfspace;
  fuzz::Bytes bytes(data, size);
  DrawingOptions options;
  options.crease_cosine = static_cast<std::int32_t>(bytes.next())
                          << (kCosineBits - 8);
  const SceneFile view = fuzz::view_of(bytes);
  const std::string text = write_scene(view);
  options.cull = view.options.cull;
  // Every second case is of a section, with a cap if the scene is closed.
  if (size % 2 == 0 && view.scene.polygon_count() > 0) {
    options.clips = *make_clips({fuzz::plane_at_a_corner(view, size / 2)},
                                view.scene.grid_bits());
    options.caps = bad_edges(view.scene).empty();
  }
  // Given lines and points at corners, whole in every third case.
  options.whole = size % 3 == 0;
  const auto& vertices = view.scene.data().vertices;
  for (std::size_t k = 0; k + 1 < vertices.size() && k < 6; ++k) {
    options.points.push_back(vertices[k]);
    if (k % 3 == 0) options.lines.push_back({vertices[k], vertices[k + 1]});
  }
  const auto drawing = fast::draw(view.scene, *view.camera, options);
  HALFSPACE_FUZZ_EXPECT(drawing.has_value(), text);
  if (view.scene.polygon_count() > kMostPolygons) return 0;
  const ref::Drawing expected = ref::draw(view.scene, *view.camera, options);
  std::vector<Part> f;
  std::vector<Part> r;
  for (const fast::EdgeInterval& i : drawing->intervals) {
    const auto& edge = drawing->edges[static_cast<std::size_t>(i.edge)];
    f.push_back(part_of(edge.edge_class, i.layers, i.from, i.to));
  }
  for (const ref::DrawnInterval& i : expected.intervals)
    r.push_back(
        part_of(i.edge_class, i.layers, rounded(i.from), rounded(i.to)));
  std::sort(f.begin(), f.end());
  std::sort(r.begin(), r.end());
  HALFSPACE_FUZZ_EXPECT(f == r, text);
  for (std::size_t k = 0; k < options.points.size(); ++k) {
    HALFSPACE_FUZZ_EXPECT(
        drawing->points[k].visible == expected.points_visible[k], text);
  }
  f.clear();
  r.clear();
  for (const fast::Stroke& s : drawing->strokes)
    f.push_back(part_of(s.edge_class, s.layers, s.from, s.to));
  for (const ref::DrawnStroke& s : expected.strokes)
    r.push_back(
        part_of(s.edge_class, s.layers, rounded(s.from), rounded(s.to)));
  std::sort(f.begin(), f.end());
  std::sort(r.begin(), r.end());
  HALFSPACE_FUZZ_EXPECT(f == r, text);
  // Lines over an image, of a width and classes that the first byte chooses.
  const auto chosen = static_cast<std::uint32_t>(options.crease_cosine >> 22);
  LineStyle style;
  style.width = 1 + static_cast<std::int32_t>(chosen % 64);
  style.classes = kAllClasses - chosen % 3;
  fast::LineOptions how;
  how.samples = 1 << (chosen % 3);
  ColorImage image((*view.camera)->width_px, (*view.camera)->height_px,
                   view.options.background);
  ColorImage expected_image = image;
  fast::add_lines(*drawing, style, how, image);
  ref::add_lines(expected, style, how.samples, expected_image);
  HALFSPACE_FUZZ_EXPECT(image == expected_image, text);
  return 0;
}
