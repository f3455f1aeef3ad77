#include "soup.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "../exact/point_ranks.hpp"

namespace halfspace::csg {

std::vector<SoupEdge> edges_of(const Soup& soup) {
  std::vector<SoupEdge> edges;
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    const auto& corners = soup.polygons[p];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const VertexId from = corners[i];
      const VertexId to = corners[(i + 1) % corners.size()];
      edges.push_back({std::min(from, to), std::max(from, to),
                       static_cast<std::int32_t>(p), from < to});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::vector<std::pair<VertexId, VertexId>> open_edges(const Soup& soup) {
  std::vector<std::pair<VertexId, VertexId>> open;
  for_edges(edges_of(soup), [&](const SoupEdge* first, const SoupEdge* last) {
    std::ptrdiff_t excess = 0;
    for (const SoupEdge* use = first; use < last; ++use)
      excess += use->forward ? 1 : -1;
    for (; excess > 0; --excess) open.emplace_back(first->low, first->high);
    for (; excess < 0; ++excess) open.emplace_back(first->high, first->low);
  });
  return open;
}

Soup soup_of(const io::Imported& imported) {
  const Scene& scene = imported.scene;
  Soup soup;
  soup.unit = scene.unit();
  soup.decimal = soup.unit.base == 10;
  const PointRanks ranks = point_ranks(scene.data().vertices);
  std::vector<VertexId> ids(ranks.points.size(), -1);  // by rank
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    const auto corners = scene.corners(id);
    std::vector<VertexId> polygon;
    polygon.reserve(corners.size());
    for (const VertexId v : corners) {
      VertexId& at = ids[ranks.of_vertex[static_cast<std::size_t>(v)]];
      if (at < 0) {
        at = static_cast<VertexId>(soup.points.size());
        soup.points.push_back(scene.point(v));
      }
      polygon.push_back(at);
    }
    soup.add(std::move(polygon), imported.faces[p], scene.color(id));
  }
  return soup;
}

Result<io::Imported> imported_soup(const Soup& soup) {
  io::Mesh mesh;
  mesh.decimal = soup.decimal;
  const auto number = [&](std::int64_t steps) {
    io::Number result = io::normalised(steps, 0, 0);
    if (result.mantissa == 0) return result;
    result.two += soup.unit.exponent;
    result.five += soup.unit.base == 10 ? soup.unit.exponent : 0;
    return result;
  };
  for (const GridPoint& p : soup.points)
    mesh.vertices.push_back({number(p.x), number(p.y), number(p.z)});
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    mesh.corners.insert(mesh.corners.end(), soup.polygons[p].begin(),
                        soup.polygons[p].end());
    mesh.first_corner.push_back(
        static_cast<std::uint32_t>(mesh.corners.size()));
    mesh.face_colors.push_back(soup.colors[p]);
  }
  Result<io::Imported> imported = io::import_scene(mesh, {});
  if (!imported) return imported;
  for (PolygonId& p : imported->faces)
    p = soup.sources[static_cast<std::size_t>(p)];
  return imported;
}

namespace {

void keep(Soup& soup, const std::vector<bool>& stays) {
  Soup kept;
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    if (stays[p])
      kept.add(std::move(soup.polygons[p]), soup.sources[p], soup.colors[p]);
  }
  soup.polygons = std::move(kept.polygons);
  soup.sources = std::move(kept.sources);
  soup.colors = std::move(kept.colors);
}

}  // namespace

std::size_t drop_duplicates(Soup& soup) {
  // By corners from the least one on, in the direction of the lesser next one.
  struct Entry {
    std::vector<VertexId> corners;
    std::size_t polygon = 0;
    bool reversed = false;
  };
  std::vector<Entry> entries(soup.polygons.size());
  for (std::size_t p = 0; p < entries.size(); ++p) {
    std::vector<VertexId>& key = entries[p].corners;
    key = soup.polygons[p];
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()),
                key.end());
    entries[p].polygon = p;
    entries[p].reversed = key.back() < key[1];
    if (entries[p].reversed) std::reverse(key.begin() + 1, key.end());
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.corners != b.corners ? a.corners < b.corners
                                  : a.polygon < b.polygon;
  });
  std::vector<bool> stays(soup.polygons.size());
  for (std::size_t i = 0; i < entries.size();) {
    std::size_t end = i;
    std::ptrdiff_t excess = 0;
    for (; end < entries.size() && entries[end].corners == entries[i].corners;
         ++end)
      excess += entries[end].reversed ? -1 : 1;
    // One of those that there are more of.
    while (excess != 0 && entries[i].reversed != (excess < 0)) ++i;
    if (excess != 0) stays[entries[i].polygon] = true;
    i = end;
  }
  const std::size_t before = soup.polygons.size();
  keep(soup, stays);
  return before - soup.polygons.size();
}

namespace {

std::int64_t distance(const GridPoint& p, const GridPoint& q) {
  return std::max(
      {std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z)});
}

/// Points in cells four times as wide as a distance, to find those that are so
/// near: most points have no other cell within it.
class Cells {
 public:
  Cells(std::int64_t reach, std::size_t points)
      : reach_(reach),
        width_(4 * std::max<std::int64_t>(reach, 1)),
        first_(std::bit_ceil(2 * points + 1), -1) {}

  void add(const GridPoint& p, VertexId v) {
    const GridPoint cell = cell_of(p);
    std::int32_t& first = first_[slot_of(cell)];
    entries_.push_back({cell, v, first});
    first = static_cast<std::int32_t>(entries_.size()) - 1;
  }

  template <class Found>
  void for_near(const GridPoint& p, Found&& found) const {
    const GridPoint low = cell_of({p.x - reach_, p.y - reach_, p.z - reach_});
    const GridPoint high = cell_of({p.x + reach_, p.y + reach_, p.z + reach_});
    for (std::int64_t x = low.x; x <= high.x; ++x) {
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        for (std::int64_t z = low.z; z <= high.z; ++z)
          in_cell({x, y, z}, found);
      }
    }
  }

 private:
  struct Entry {
    GridPoint cell;
    VertexId vertex = 0;
    std::int32_t next = -1;
  };

  template <class Found>
  void in_cell(const GridPoint& cell, Found&& found) const {
    for (std::int32_t at = first_[slot_of(cell)]; at >= 0;) {
      const Entry& entry = entries_[static_cast<std::size_t>(at)];
      if (entry.cell == cell) found(entry.vertex);
      at = entry.next;
    }
  }
  std::int64_t cell(std::int64_t c) const {
    return c >= 0 ? c / width_ : -((width_ - 1 - c) / width_);
  }
  GridPoint cell_of(const GridPoint& p) const {
    return {cell(p.x), cell(p.y), cell(p.z)};
  }
  std::size_t slot_of(const GridPoint& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t c : {cell.x, cell.y, cell.z}) {
      hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash & (first_.size() - 1);
  }

  std::int64_t reach_;
  std::int64_t width_;
  std::vector<std::int32_t> first_;  // by slot: an entry, or -1
  std::vector<Entry> entries_;
};

/// Corners that repeat the one before go.
void replace_corners(Soup& soup, const std::vector<VertexId>& become) {
  for (auto& polygon : soup.polygons) {
    for (VertexId& v : polygon) v = become[static_cast<std::size_t>(v)];
    polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
    while (polygon.size() > 1 && polygon.front() == polygon.back())
      polygon.pop_back();
  }
  std::vector<bool> stays(soup.polygons.size());
  for (std::size_t p = 0; p < soup.polygons.size(); ++p)
    stays[p] = soup.polygons[p].size() >= 3;
  keep(soup, stays);
}

}  // namespace

Welded weld(Soup& soup, std::int64_t reach) {
  std::vector<VertexId> ends;
  for (const auto& [from, to] : open_edges(soup))
    ends.insert(ends.end(), {from, to});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  // Each takes the place of the first one that is near and stays: no chain of
  // them moves farther than one step.
  std::vector<VertexId> become(soup.points.size());
  std::iota(become.begin(), become.end(), 0);
  Cells cells(reach, ends.size());
  Welded welded;
  for (const VertexId v : ends) {
    VertexId target = v;
    cells.for_near(soup.at(v), [&](VertexId u) {
      if (distance(soup.at(u), soup.at(v)) <= reach)
        target = std::min(target, u);
    });
    become[static_cast<std::size_t>(v)] = target;
    if (target == v) {
      cells.add(soup.at(v), v);
      continue;
    }
    ++welded.vertices;
    welded.move = std::max(welded.move, distance(soup.at(target), soup.at(v)));
  }
  if (welded.vertices > 0) replace_corners(soup, become);
  return welded;
}

}  // namespace halfspace::csg
