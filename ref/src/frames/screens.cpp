#include "halfspace/ref/screens.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "halfspace/ref/clip.hpp"
#include "halfspace/ref/projection.hpp"
#include "halfspace/ref/scan.hpp"
#include "halfspace/ref/screen.hpp"
#include "halfspace/ref/shade.hpp"
#include "halfspace/ref/traverse.hpp"

namespace halfspace::ref {
namespace {

using PaintPixel = std::function<void(std::int32_t i, std::int32_t j)>;

/// A screen that fragments are lit on, front to back.
class AnyScreen {
 public:
  virtual ~AnyScreen() = default;
  /// Lights a fragment; paints what was unlit of it.
  virtual void light(const Fragment& fragment, const Projection& projection,
                     PolygonId item) = 0;
  virtual bool full() const = 0;
  /// Paints what is known at the end only.
  virtual void finish() {}
};

/// F2B's lists.
class ListScreen : public AnyScreen {
 public:
  ListScreen(ItemImage& items)
      : items_(items), screen_(items.width_px, items.height_px) {}
  void light(const Fragment& fragment, const Projection& projection,
             PolygonId item) override {
    for (const auto& [line, span] : scan_convert(fragment, projection)) {
      screen_.merge(line, {span}, [&, row = line](Span lit) {
        for (std::int32_t i = lit.first; i <= lit.last; ++i)
          items_.at(i, row) = item;
      });
    }
  }
  bool full() const override { return screen_.full(); }

 private:
  ItemImage& items_;
  DynamicScreen screen_;
};

/// The unlit pixels of a line as a tree: a node divides its pixels at a
/// boundary; a leaf is lit or unlit (FAQ).
class LineTree {
 public:
  explicit LineTree(std::int32_t width) : end_(width) {}

  /// Lights [first, last]; calls paint(i) for what was unlit of it.
  void light(std::int32_t first, std::int32_t last,
             const std::function<void(std::int32_t)>& paint) {
    light(root_, 0, end_, first, last + 1, paint);
  }
  bool full() const { return root_.full; }

 private:
  struct Node {
    bool full = false;
    std::int32_t split = 0;  ///< pixels before it are the lower child's
    std::unique_ptr<Node> lower, upper;
  };
  static void light(Node& node, std::int32_t low, std::int32_t high,
                    std::int32_t first, std::int32_t end,
                    const std::function<void(std::int32_t)>& paint) {
    if (node.full || end <= low || high <= first) return;
    if (!node.lower && first <= low && high <= end) {
      node.full = true;
      for (std::int32_t i = low; i < high; ++i) paint(i);
      return;
    }
    if (!node.lower) {
      // A splitter is an end of the object segment.
      node.split = low < first ? first : end;
      node.lower = std::make_unique<Node>();
      node.upper = std::make_unique<Node>();
    }
    light(*node.lower, low, node.split, first, end, paint);
    light(*node.upper, node.split, high, first, end, paint);
    node.full = node.lower->full && node.upper->full;
  }
  std::int32_t end_;
  Node root_;
};

class LineTreeScreen : public AnyScreen {
 public:
  LineTreeScreen(ItemImage& items) : items_(items) {
    for (std::int32_t j = 0; j < items.height_px; ++j)
      lines_.emplace_back(items.width_px);
  }
  void light(const Fragment& fragment, const Projection& projection,
             PolygonId item) override {
    for (const auto& [line, span] : scan_convert(fragment, projection)) {
      lines_[static_cast<std::size_t>(line)].light(
          span.first, span.last,
          [&, row = line](std::int32_t i) { items_.at(i, row) = item; });
    }
  }
  bool full() const override {
    for (const LineTree& line : lines_) {
      if (!line.full()) return false;
    }
    return true;
  }

 private:
  ItemImage& items_;
  std::vector<LineTree> lines_;
};

/// Squares of pixels, each lit, unlit, or divided into four.
class QuadScreen : public AnyScreen {
 public:
  QuadScreen(ItemImage& items) : items_(items) {
    while (size_ < items.width_px || size_ < items.height_px) size_ *= 2;
    // Beyond the image everything is lit.
    clear(root_, 0, 0, size_);
  }
  void light(const Fragment& fragment, const Projection& projection,
             PolygonId item) override {
    Grid2<char> covered(items_.width_px, items_.height_px, 0);
    for (const auto& [line, span] : scan_convert(fragment, projection)) {
      for (std::int32_t i = span.first; i <= span.last; ++i)
        covered.at(i, line) = 1;
    }
    light(root_, 0, 0, size_, covered, item);
  }
  bool full() const override { return root_.full; }

 private:
  struct Square {
    bool full = false;
    std::vector<Square> parts;  ///< none, or four
  };

  void clear(Square& square, std::int32_t x, std::int32_t y,
             std::int32_t size) {
    if (x >= items_.width_px || y >= items_.height_px) {
      square.full = true;
    } else if (x + size > items_.width_px || y + size > items_.height_px) {
      divide(square);
      for (std::int32_t k = 0; k < 4; ++k) {
        clear(square.parts[static_cast<std::size_t>(k)], x + (k % 2) * size / 2,
              y + (k / 2) * size / 2, size / 2);
      }
    }
  }
  static void divide(Square& square) { square.parts.resize(4); }

  /// How many pixels of the square are covered.
  std::int32_t covered_in(const Grid2<char>& covered, std::int32_t x,
                          std::int32_t y, std::int32_t size) const {
    std::int32_t count = 0;
    for (std::int32_t j = y; j < y + size && j < items_.height_px; ++j) {
      for (std::int32_t i = x; i < x + size && i < items_.width_px; ++i)
        count += covered.at(i, j);
    }
    return count;
  }

  void light(Square& square, std::int32_t x, std::int32_t y, std::int32_t size,
             const Grid2<char>& covered, PolygonId item) {
    if (square.full) return;
    const std::int32_t count = covered_in(covered, x, y, size);
    if (count == 0) return;
    if (square.parts.empty() && count == size * size) {
      square.full = true;
      for (std::int32_t j = y; j < y + size; ++j) {
        for (std::int32_t i = x; i < x + size; ++i) items_.at(i, j) = item;
      }
      return;
    }
    if (square.parts.empty()) divide(square);
    square.full = true;
    for (std::int32_t k = 0; k < 4; ++k) {
      Square& part = square.parts[static_cast<std::size_t>(k)];
      light(part, x + (k % 2) * size / 2, y + (k / 2) * size / 2, size / 2,
            covered, item);
      square.full = square.full && part.full;
    }
  }

  ItemImage& items_;
  std::int32_t size_ = 1;
  Square root_;
};

/// a x + b y + c, positive on one side of a line of the image.
struct ImageLine {
  Rational a, b, c;
  Rational at(const ImagePoint& p) const { return a * p.x + b * p.y + c; }
};

/// The line from p to q, positive where the polygon r is.
ImageLine line_through(const ImagePoint& p, const ImagePoint& q,
                       const std::vector<ImagePoint>& polygon) {
  ImageLine line = {p.y - q.y, q.x - p.x, p.x * q.y - p.y * q.x};
  for (const ImagePoint& r : polygon) {
    if (sign(line.at(r)) < 0) line = {-line.a, -line.b, -line.c};
  }
  return line;
}

/// The part of a convex polygon on the positive side of a line; nothing if that
/// has no area.
std::vector<ImagePoint> part_on(const std::vector<ImagePoint>& polygon,
                                const ImageLine& line) {
  std::vector<ImagePoint> part;
  bool some_positive = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const ImagePoint& p = polygon[k];
    const ImagePoint& q = polygon[(k + 1) % polygon.size()];
    const Rational hp = line.at(p);
    const Rational hq = line.at(q);
    some_positive = some_positive || sign(hp) > 0;
    if (sign(hp) >= 0) part.push_back(p);
    if (sign(hp) * sign(hq) < 0) {
      const Rational t = hp / (hp - hq);
      part.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  if (!some_positive) part.clear();
  return part;
}

/// The 2-D BSP tree of the screen (FAQ): its splitters are lines through edges
/// of fragments, as the camera shows them; leaves are convex cells.
class PlaneTreeScreen : public AnyScreen {
 public:
  PlaneTreeScreen(ItemImage& items) : items_(items) {
    const Rational w = items.width_px;
    const Rational h = items.height_px;
    root_.cell = {{0, 0}, {w, 0}, {w, h}, {0, h}};
  }

  void light(const Fragment& fragment, const Projection& projection,
             PolygonId item) override {
    const Fragment seen = clip(fragment, projection);
    std::vector<ImagePoint> polygon;
    for (const Point& p : seen.vertices)
      polygon.push_back(image_of(p, projection));
    std::vector<ImageLine> edges;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      edges.push_back(
          line_through(polygon[k], polygon[(k + 1) % polygon.size()], polygon));
    }
    if (!polygon.empty()) light(root_, polygon, edges, item);
  }
  bool full() const override { return root_.full; }

  /// Every sample is in one cell, for none is on a line (S4.4).
  void finish() override {
    for (std::int32_t j = 0; j < items_.height_px; ++j) {
      for (std::int32_t i = 0; i < items_.width_px; ++i) {
        const Cell* cell = &root_;
        while (cell->inside)
          cell = is_inside(cell->line, i, j) ? cell->inside.get()
                                             : cell->outside.get();
        items_.at(i, j) = cell->item;
      }
    }
  }

 private:
  struct Cell {
    std::vector<ImagePoint> cell;  ///< of a leaf
    bool full = false;
    PolygonId item = kBackground;
    ImageLine line;  ///< of a node
    std::unique_ptr<Cell> inside, outside;
  };

  static bool is_inside(const ImageLine& line, std::int32_t i, std::int32_t j) {
    const Rational half = Rational(1) / Rational(2);
    const ImagePoint centre = {Rational(i) + half, Rational(j) + half};
    if (const int s = sign(line.at(centre))) return s > 0;
    if (const int s = sign(line.a)) return s > 0;
    return sign(line.b) > 0;
  }

  static ImageLine opposite_of(const ImageLine& line) {
    return {-line.a, -line.b, -line.c};
  }

  static void light(Cell& cell, const std::vector<ImagePoint>& polygon,
                    const std::vector<ImageLine>& edges, PolygonId item) {
    if (cell.full || polygon.empty()) return;
    if (cell.inside) {
      light(*cell.inside, part_on(polygon, cell.line), edges, item);
      light(*cell.outside, part_on(polygon, opposite_of(cell.line)), edges,
            item);
      cell.full = cell.inside->full && cell.outside->full;
      return;
    }
    // An unlit leaf: the first edge that cuts it divides it.
    for (const ImageLine& edge : edges) {
      auto outside = part_on(cell.cell, opposite_of(edge));
      if (outside.empty()) continue;
      auto inside = part_on(cell.cell, edge);
      if (inside.empty()) return;
      cell.line = edge;
      cell.outside = std::make_unique<Cell>();
      cell.outside->cell = std::move(outside);
      cell.inside = std::make_unique<Cell>();
      cell.inside->cell = std::move(inside);
      light(*cell.inside, polygon, edges, item);
      return;
    }
    cell.full = true;
    cell.item = item;
  }

  ItemImage& items_;
  Cell root_;
};

std::unique_ptr<AnyScreen> make_screen(ScreenKind kind, ItemImage& items) {
  switch (kind) {
    case ScreenKind::kList:
      break;
    case ScreenKind::kBsp1:
      return std::make_unique<LineTreeScreen>(items);
    case ScreenKind::kQuad:
      return std::make_unique<QuadScreen>(items);
    case ScreenKind::kBsp2:
      return std::make_unique<PlaneTreeScreen>(items);
  }
  return std::make_unique<ListScreen>(items);
}

}  // namespace

Rendering render_on(const Scene& scene, const BspTree& tree,
                    const Camera& camera, const ImageOptions& options,
                    ScreenKind kind) {
  const std::vector<Plane> planes = planes_of(scene);
  const Projection projection = projection_of(camera);
  Rendering image;
  image.items = ItemImage(camera->width_px, camera->height_px, kBackground);
  const auto screen = make_screen(kind, image.items);
  front_to_back(tree, camera, [&](const Node&, const Fragment& fragment) {
    const Plane& plane = planes[static_cast<std::size_t>(fragment.source)];
    if (options.cull && side_of_eye(plane, camera) == Side::kNegative)
      return true;
    if (!is_there(plane, options)) return true;
    const auto left = clipped(fragment, options);
    if (!left) return true;
    ++image.fragments_displayed;
    screen->light(*left, projection, fragment.source);
    return !screen->full();
  });
  screen->finish();
  for (const PolygonId item : image.items.pixels)
    image.pixels_painted += item == kBackground ? 0 : 1;
  add_caps(scene, camera, options, image.items);
  image.colors = colors_of(scene, camera, image.items, options);
  return image;
}

}  // namespace halfspace::ref
