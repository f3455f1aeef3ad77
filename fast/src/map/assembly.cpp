#include "map/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <unordered_map>

#include "base/disjoint_sets.hpp"

namespace halfspace::fast {
namespace {

/// The outside of the image, as a cell or a region.
constexpr std::int32_t kOutside = -1;

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

/// A corner of a cell is the start of an edge, and has its number. The lines
/// before and after it meet there.
struct CornerLines {
  LineId before = 0;
  LineId after = 0;
};

/// An edge of a cell on the line of a node, from its lower to its upper end
/// along the direction (b, -a) of the line.
struct Part {
  std::int32_t cell = 0;
  std::int32_t low = 0;  ///< corners
  std::int32_t high = 0;
  LineId low_line = 0;  ///< the other line there, of the same cell
  LineId high_line = 0;
};

/// A piece of the boundary before points are numbered, by corners: from the
/// lower to the upper end along the line.
struct Piece {
  LineId line = 0;
  std::int32_t low = 0;
  std::int32_t high = 0;
  std::int32_t positive = 0;  ///< the cell on the line's positive side
  std::int32_t negative = 0;
};

/// A piece between two points, seen from one of its ends.
struct HalfPiece {
  LineId line = 0;
  std::int32_t direction = 1;  ///< 1: along (b, -a); -1: against it
  std::int32_t to = 0;         ///< a point
  std::int32_t twin = 0;
  std::int32_t region = 0;  ///< on the positive side of a turn from it
  std::int32_t next = -1;   ///< round that region
};

class Assembly {
 public:
  Assembly(const CellTree& cells, LineTable& lines,
           const std::function<std::int32_t(PolygonId)>& key_of)
      : lines_(lines), tree_(cells), key_of_(key_of) {}

  VisibleMap run() {
    collect_cells();
    cut_along_nodes();
    number_points();
    link();
    VisibleMap map;
    map.cells = cells_.size();
    write(map);
    return map;
  }

 private:
  /// A cell, in the order of the tree's nodes.
  struct CellKey {
    PolygonId item = kBackground;
    std::int32_t key = kBackgroundKey;
    std::int32_t first_edge = 0;
    std::int32_t edge_count = 0;
  };

  const CellEdge& edge(std::int32_t e) const { return tree_.edges()[at(e)]; }
  const MapPoint& point_at(std::int32_t corner) const {
    return edge(corner).start;
  }
  /// The edges round the cell of an edge, before and after it.
  std::int32_t before(std::int32_t e) const {
    const CellKey& cell = cells_[at(cell_of_[at(e)])];
    return e == cell.first_edge ? cell.first_edge + cell.edge_count - 1 : e - 1;
  }
  std::int32_t after(std::int32_t e) const {
    const CellKey& cell = cells_[at(cell_of_[at(e)])];
    return e + 1 == cell.first_edge + cell.edge_count ? cell.first_edge : e + 1;
  }
  CornerLines lines_at(std::int32_t corner) const {
    return {edge(before(corner)).line, edge(corner).line};
  }
  Part part_of(std::int32_t e) const {
    const std::int32_t next = after(e);
    Part part = {cell_of_[at(e)], e, next, edge(before(e)).line,
                 edge(next).line};
    // Edges go round with the interior on the positive side of a turn from x
    // to y: along (b, -a) if that is the line's positive side.
    if (edge(e).side < 0) {
      std::swap(part.low, part.high);
      std::swap(part.low_line, part.high_line);
    }
    return part;
  }

  void collect_cells() {
    cell_of_.assign(tree_.edges().size(), -1);
    cells_.reserve(tree_.cell_count());
    tree_.for_cells([&](const Cell& cell) {
      const auto id = static_cast<std::int32_t>(cells_.size());
      const auto first = static_cast<std::int32_t>(cell.first_edge);
      const auto count = static_cast<std::int32_t>(cell.edge_count);
      cells_.push_back({cell.item, key_of_(cell.item), first, count});
      for (std::int32_t e = first; e < first + count; ++e) cell_of_[at(e)] = id;
    });
  }

  /// The order of two corners on a line along (b, -a); `p` and `q` are the
  /// other lines through them.
  ///
  /// Along (b, -a) of line l the form p grows by p.a l.b - p.b l.a, which is
  /// -turn(l, p); at q's corner it is the growth from its own corner to there.
  int order(LineId line, LineId p, std::int32_t p_corner, LineId q,
            std::int32_t q_corner) {
    if (p_corner == q_corner) return 0;
    const MapPoint& f = point_at(p_corner);
    const MapPoint& g = point_at(q_corner);
    const double a = lines_.slope_x(line);
    const double b = lines_.slope_y(line);
    const double x = b * (g.x - f.x);
    const double y = a * (g.y - f.y);
    const double bound =
        (std::abs(a) + std::abs(b)) * (double{f.error} + g.error) +
        8 * kRounding * (std::abs(x) + std::abs(y)) +
        kRounding * 4 *
            (std::abs(b) * (std::abs(f.x) + std::abs(g.x)) +
             std::abs(a) * (std::abs(f.y) + std::abs(g.y)));
    if (x - y > bound) return 1;
    if (x - y < -bound) return -1;
    return -lines_.turn(line, p) *
           lines_.side_of(p, line, q, lines_.point(line, q));
  }

  /// The edges of cells by node, of each the positive side's first: counted,
  /// then entered.
  std::vector<std::int32_t> edges_by_node() const {
    constexpr std::int32_t kSides = 4;  // of the image, numbered from -4
    const auto place_of = [&](std::int32_t e) {
      return at(2 * (edge(e).node + kSides) + (edge(e).side > 0 ? 0 : 1));
    };
    std::vector<std::int32_t> first(at(2 * (tree_.node_count() + kSides)) + 1);
    for (std::int32_t e = 0; e < std::ssize(cell_of_); ++e) {
      if (cell_of_[at(e)] >= 0) ++first[place_of(e) + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::int32_t> parts(at(first.back()));
    for (std::int32_t e = 0; e < std::ssize(cell_of_); ++e) {
      if (cell_of_[at(e)] >= 0) parts[at(first[place_of(e)]++)] = e;
    }
    return parts;
  }

  void cut_along_nodes() {
    const std::vector<std::int32_t> parts = edges_by_node();
    corner_sets_ = DisjointSets(cell_of_.size());
    cell_sets_ = DisjointSets(cells_.size());
    const std::span<const std::int32_t> all = parts;
    for (std::size_t first = 0; first < all.size();) {
      std::size_t end = first;
      std::size_t middle = first;
      const CellNodeId node = edge(all[first]).node;
      while (end < all.size() && edge(all[end]).node == node) {
        if (edge(all[end]).side > 0) middle = end + 1;
        ++end;
      }
      const LineId line = node < 0 ? node + 4 : tree_.line_of(node);
      merge(line, sorted(line, all.subspan(first, middle - first)),
            sorted(line, all.subspan(middle, end - middle)));
      first = end;
    }
  }

  /// Parts of one side of a node, in their order along its line.
  std::vector<Part> sorted(LineId line, std::span<const std::int32_t> edges) {
    std::vector<Part> parts;
    for (const std::int32_t e : edges) parts.push_back(part_of(e));
    std::sort(parts.begin(), parts.end(), [&](const Part& f, const Part& g) {
      return order(line, f.low_line, f.low, g.low_line, g.low) > 0;
    });
    for (std::size_t k = 1; k < parts.size(); ++k)
      corner_sets_.unite(parts[k - 1].high, parts[k].low);
    return parts;
  }

  void add(const Piece& piece) {
    if (piece.positive != kOutside && piece.negative != kOutside &&
        cells_[at(piece.positive)].key == cells_[at(piece.negative)].key) {
      cell_sets_.unite(piece.positive, piece.negative);
      return;
    }
    pieces_.push_back(piece);
  }

  /// Either side covers the same segment of the line, but a side of the image,
  /// which has nothing beyond it.
  void merge(LineId line, const std::vector<Part>& positive,
             const std::vector<Part>& negative) {
    for (const auto* only : {&positive, &negative}) {
      const bool is_positive = only == &positive;
      if (!(is_positive ? negative : positive).empty()) continue;
      for (const Part& part : *only) {
        add({line, part.low, part.high, is_positive ? part.cell : kOutside,
             is_positive ? kOutside : part.cell});
      }
      return;
    }
    std::size_t p = 0;
    std::size_t q = 0;
    std::int32_t low = positive[0].low;
    corner_sets_.unite(low, negative[0].low);
    while (p < positive.size() && q < negative.size()) {
      const Part& f = positive[p];
      const Part& g = negative[q];
      const int ends = order(line, f.high_line, f.high, g.high_line, g.high);
      const std::int32_t high = ends >= 0 ? f.high : g.high;
      add({line, low, high, f.cell, g.cell});
      if (ends == 0) corner_sets_.unite(f.high, g.high);
      p += ends >= 0 ? 1 : 0;
      q += ends <= 0 ? 1 : 0;
      low = high;
    }
  }

  /// The points of the boundary, and the pieces seen from both of their ends.
  void number_points() {
    std::vector<std::int32_t> numbers(cell_of_.size(), -1);
    const auto point_of = [&](std::int32_t corner) {
      const std::int32_t set = corner_sets_.root(corner);
      std::int32_t& number = numbers[at(set)];
      if (number < 0) {
        number = static_cast<std::int32_t>(point_corner_.size());
        point_corner_.push_back(set);
      }
      return number;
    };
    halves_.reserve(2 * pieces_.size());
    const auto region_of = [&](std::int32_t cell) {
      return cell == kOutside ? kOutside : cell_sets_.root(cell);
    };
    for (const Piece& piece : pieces_) {
      const std::int32_t low = point_of(piece.low);
      const std::int32_t high = point_of(piece.high);
      const auto h = static_cast<std::int32_t>(halves_.size());
      halves_.push_back(
          {piece.line, 1, high, h + 1, region_of(piece.positive)});
      halves_.push_back({piece.line, -1, low, h, region_of(piece.negative)});
    }
    pieces_ = std::vector<Piece>();  // `= {}` would keep the memory
    // Those that leave a point, point after point: counted, then entered.
    first_leaving_.assign(point_corner_.size() + 1, 0);
    for (const HalfPiece& half : halves_)
      ++first_leaving_[at(halves_[at(half.twin)].to) + 1];
    std::partial_sum(first_leaving_.begin(), first_leaving_.end(),
                     first_leaving_.begin());
    leaving_.resize(halves_.size());
    std::vector<std::int32_t> next = first_leaving_;
    for (std::int32_t h = 0; h < std::ssize(halves_); ++h)
      leaving_[at(next[at(halves_[at(halves_[at(h)].twin)].to)]++)] = h;
  }

  std::span<std::int32_t> leaving(std::int32_t point) {
    const std::int32_t first = first_leaving_[at(point)];
    const std::int32_t end = first_leaving_[at(point) + 1];
    return {leaving_.data() + first, static_cast<std::size_t>(end - first)};
  }

  /// Whether the direction of a half is in the lower half-turn: y grows, or it
  /// is 0 and x grows.
  bool is_first_half(const HalfPiece& half) const {
    const double a = lines_.slope_x(half.line) * half.direction;
    const double b = lines_.slope_y(half.line) * half.direction;
    return -a > 0 || (a == 0 && b > 0);
  }
  bool turns_before(std::int32_t f, std::int32_t g) {
    const HalfPiece& p = halves_[at(f)];
    const HalfPiece& q = halves_[at(g)];
    const bool first = is_first_half(p);
    if (first != is_first_half(q)) return first;
    return lines_.turn(p.line, q.line) * p.direction * q.direction > 0;
  }

  /// Round every point, each half goes on along the next one of its region: of
  /// those leaving its end the one before its twin, by angle.
  void link() {
    for (std::int32_t p = 0; p < std::ssize(point_corner_); ++p) {
      const std::span<std::int32_t> halves = leaving(p);
      std::sort(
          halves.begin(), halves.end(),
          [&](std::int32_t f, std::int32_t g) { return turns_before(f, g); });
      for (std::size_t k = 0; k < halves.size(); ++k) {
        const std::int32_t after = halves[k];
        const std::int32_t before = halves[k == 0 ? halves.size() - 1 : k - 1];
        halves_[at(halves_[at(after)].twin)].next = before;
      }
    }
  }

  /// Whether the boundary passes straight through a point (S7.4).
  bool is_straight(std::int32_t point) {
    const std::span<std::int32_t> halves = leaving(point);
    return halves.size() == 2 && lines_.turn(halves_[at(halves[0])].line,
                                             halves_[at(halves[1])].line) == 0;
  }

  void write(VisibleMap& map);
  void number_vertices(VisibleMap& map);
  void write_arcs(VisibleMap& map);
  void write_regions(VisibleMap& map);
  /// From a half that leaves a vertex, the one that ends at the next vertex.
  std::int32_t last_of(std::int32_t half) const {
    while (vertex_of_[at(halves_[at(half)].to)] < 0)
      half = halves_[at(half)].next;
    return half;
  }
  std::int32_t start_of(std::int32_t half) const {
    return vertex_of_[at(halves_[at(halves_[at(half)].twin)].to)];
  }

  LineTable& lines_;
  const CellTree& tree_;
  const std::function<std::int32_t(PolygonId)>& key_of_;
  std::vector<CellKey> cells_;
  std::vector<std::int32_t> cell_of_;  ///< by edge; -1: of none
  DisjointSets corner_sets_{0};
  DisjointSets cell_sets_{0};
  std::vector<Piece> pieces_;
  std::vector<std::int32_t> point_corner_;  ///< by point: one of its corners
  std::vector<HalfPiece> halves_;
  std::vector<std::int32_t> leaving_;        ///< halves, point after point
  std::vector<std::int32_t> first_leaving_;  ///< by point
  std::vector<std::int32_t> vertex_of_;      ///< by point; -1: straight
  std::unordered_map<std::int32_t, std::int32_t> region_of_cell_;
};

void Assembly::number_vertices(VisibleMap& map) {
  std::vector<std::int32_t> points;
  std::vector<MapVertex> vertices;
  for (std::int32_t p = 0; p < std::ssize(point_corner_); ++p) {
    if (is_straight(p)) continue;
    const CornerLines corner = lines_at(point_corner_[at(p)]);
    points.push_back(p);
    vertices.push_back(lines_.vertex(corner.before, corner.after));
  }
  std::vector<std::int32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t f, std::int32_t g) {
    const MapVertex& p = vertices[at(f)];
    const MapVertex& q = vertices[at(g)];
    // Nearest doubles are in the order of what they are nearest to, or equal.
    if (p.x != q.x) return p.x < q.x;
    return f != g && lines_.compare(p.lines, q.lines) < 0;
  });
  vertex_of_.assign(point_corner_.size(), -1);
  std::unordered_map<LineId, std::int32_t> used;
  for (const MapVertex& vertex : vertices) {
    for (const LineId line : vertex.lines) used.try_emplace(line, -1);
  }
  map.lines.reserve(used.size());
  map.vertices.reserve(vertices.size());
  for (const std::int32_t k : order) {
    vertex_of_[at(points[at(k)])] =
        static_cast<std::int32_t>(map.vertices.size());
    MapVertex vertex = vertices[at(k)];
    for (std::int32_t& line : vertex.lines) {
      std::int32_t& number = used[line];
      if (number < 0) {
        number = static_cast<std::int32_t>(map.lines.size());
        map.lines.push_back(lines_.exact(line));
      }
      line = number;
    }
    map.vertices.push_back(vertex);
  }
}

void Assembly::write_arcs(VisibleMap& map) {
  const auto region_of = [&](std::int32_t cell) {
    return cell == kOutside ? kOutside : region_of_cell_.at(cell);
  };
  for (std::int32_t h = 0; h < std::ssize(halves_); ++h) {
    const std::int32_t from = start_of(h);
    if (from < 0) continue;
    const HalfPiece& last = halves_[at(last_of(h))];
    const std::int32_t to = vertex_of_[at(last.to)];
    if (to < from) continue;
    // What a positive turn leads to is on the right where y grows downwards.
    map.arcs.push_back({from, to, region_of(halves_[at(last.twin)].region),
                        region_of(last.region)});
  }
  std::sort(map.arcs.begin(), map.arcs.end(),
            [](const MapArc& f, const MapArc& g) {
              return f.from != g.from ? f.from < g.from : f.to < g.to;
            });
}

/// Turns a loop that begins at its first vertex so that it is the least of
/// those that do: it may pass that vertex several times.
void begin_at_least(std::vector<std::int32_t>& corners) {
  std::vector<std::int32_t> least = corners;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    if (corners[k] != corners[0]) continue;
    std::vector<std::int32_t> turned = corners;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(k),
                turned.end());
    least = std::min(least, turned);
  }
  corners.swap(least);
}

void Assembly::write_regions(VisibleMap& map) {
  // A loop for every half that leaves the loop's first vertex.
  struct Loop {
    std::int32_t cell = 0;
    bool is_hole = false;
    std::vector<std::int32_t> corners;
  };
  std::vector<Loop> loops;
  std::vector<bool> seen(halves_.size());
  for (std::int32_t h = 0; h < std::ssize(halves_); ++h) {
    if (seen[at(h)]) continue;
    std::int32_t first = -1;
    for (std::int32_t k = h; !seen[at(k)]; k = halves_[at(k)].next) {
      seen[at(k)] = true;
      const std::int32_t vertex = start_of(k);
      if (vertex >= 0 && (first < 0 || vertex < start_of(first))) first = k;
    }
    if (halves_[at(h)].region == kOutside) continue;
    Loop loop;
    loop.cell = halves_[at(h)].region;
    // The first vertex is an extreme one. The loop may pass it several times:
    // it goes round a hole if one of its turns there does.
    const auto turns_back = [&](std::int32_t into, std::int32_t out) {
      const HalfPiece& p = halves_[at(into)];
      const HalfPiece& q = halves_[at(out)];
      return lines_.turn(p.line, q.line) * p.direction * q.direction < 0;
    };
    std::int32_t before = h;
    std::int32_t k = first;
    do {
      if (start_of(k) >= 0) loop.corners.push_back(start_of(k));
      before = k;
      k = halves_[at(k)].next;
      if (start_of(k) == start_of(first))
        loop.is_hole = loop.is_hole || turns_back(before, k);
    } while (k != first);
    begin_at_least(loop.corners);
    loops.push_back(std::move(loop));
  }
  // Outer loops first, by their first vertices; holes follow their regions.
  std::sort(loops.begin(), loops.end(), [](const Loop& f, const Loop& g) {
    if (f.is_hole != g.is_hole) return g.is_hole;
    return f.corners < g.corners;
  });
  std::vector<std::vector<const Loop*>> of_region;
  for (const Loop& loop : loops) {
    if (!loop.is_hole) {
      region_of_cell_.emplace(loop.cell,
                              static_cast<std::int32_t>(of_region.size()));
      of_region.push_back({&loop});
    } else {
      of_region[at(region_of_cell_.at(loop.cell))].push_back(&loop);
    }
  }
  map.regions.resize(of_region.size());
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    const std::int32_t set = cell_sets_.root(static_cast<std::int32_t>(cell));
    MapRegion& region = map.regions[at(region_of_cell_.at(set))];
    region.key = cells_[cell].key;
    const PolygonId item = cells_[cell].item;
    if (item != kBackground &&
        (region.item == kBackground || item < region.item))
      region.item = item;
  }
  for (std::size_t r = 0; r < of_region.size(); ++r) {
    map.regions[r].first_loop =
        static_cast<std::int32_t>(map.first_corner.size() - 1);
    map.regions[r].loop_count = static_cast<std::int32_t>(of_region[r].size());
    for (const Loop* loop : of_region[r]) {
      map.corners.insert(map.corners.end(), loop->corners.begin(),
                         loop->corners.end());
      map.first_corner.push_back(
          static_cast<std::uint32_t>(map.corners.size()));
    }
  }
}

void Assembly::write(VisibleMap& map) {
  number_vertices(map);
  write_regions(map);
  write_arcs(map);
}

}  // namespace

VisibleMap assemble(const CellTree& cells, LineTable& lines,
                    const std::function<std::int32_t(PolygonId)>& key_of) {
  return Assembly(cells, lines, key_of).run();
}

}  // namespace halfspace::fast
