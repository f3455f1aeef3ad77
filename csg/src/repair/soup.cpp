#include "soup.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>

#include "../exact/by_low_end.hpp"
#include "../exact/repeats.hpp"

namespace halfspace::csg {

std::vector<SoupEdge> edges_of(const Soup& soup) {
  std::vector<SoupEdge> edges;
  edges.reserve(4 * soup.polygons.size());
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    const auto& corners = soup.polygons[p];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const VertexId from = corners[i];
      const VertexId to = corners[(i + 1) % corners.size()];
      edges.push_back({std::min(from, to), std::max(from, to),
                       static_cast<std::int32_t>(p), from < to});
    }
  }
  sort_by_low_end(
      edges, soup.points.size(), [](const SoupEdge& use) { return use.low; },
      std::less<>());
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

std::vector<BadEdge> bad_edges(const Soup& soup) {
  std::vector<BadEdge> bad;
  for_edges(edges_of(soup), [&](const SoupEdge* first, const SoupEdge* last) {
    std::int64_t excess = 0;
    for (const SoupEdge* use = first; use < last; ++use)
      excess += use->forward ? 1 : -1;
    const GridPoint &low = soup.at(first->low), &high = soup.at(first->high);
    if (excess > 0) bad.push_back({low, high, excess});
    if (excess < 0) bad.push_back({high, low, -excess});
  });
  return bad;
}

Soup soup_of(const io::Imported& imported) {
  const Scene& scene = imported.scene;
  Soup soup;
  soup.unit = scene.unit();
  soup.decimal = soup.unit.base == 10;
  std::vector<VertexId> ids(scene.data().vertices.size(), -1);
  soup.polygons.reserve(scene.polygon_count());
  soup.sources.reserve(scene.polygon_count());
  soup.colors.reserve(scene.polygon_count());
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    const auto corners = scene.corners(id);
    std::vector<VertexId> polygon;
    polygon.reserve(corners.size());
    for (const VertexId v : corners) {
      VertexId& at = ids[static_cast<std::size_t>(v)];
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
  std::vector<VertexId> ids(soup.points.size(), -1);  // points in use
  std::size_t corners = 0;
  for (const auto& polygon : soup.polygons) corners += polygon.size();
  mesh.corners.reserve(corners);
  mesh.first_corner.reserve(soup.polygons.size() + 1);
  mesh.face_colors.reserve(soup.polygons.size());
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    for (const VertexId v : soup.polygons[p])
      ids[static_cast<std::size_t>(v)] = 0;
    mesh.corners.insert(mesh.corners.end(), soup.polygons[p].begin(),
                        soup.polygons[p].end());
    mesh.first_corner.push_back(
        static_cast<std::uint32_t>(mesh.corners.size()));
    mesh.face_colors.push_back(soup.colors[p]);
  }
  mesh.vertices.reserve(
      static_cast<std::size_t>(std::count(ids.begin(), ids.end(), 0)));
  for (std::size_t v = 0; v < ids.size(); ++v) {
    if (ids[v] < 0) continue;
    const GridPoint& p = soup.points[v];
    ids[v] = static_cast<VertexId>(mesh.vertices.size());
    mesh.vertices.push_back({number(p.x), number(p.y), number(p.z)});
  }
  for (VertexId& corner : mesh.corners)
    corner = ids[static_cast<std::size_t>(corner)];
  Result<io::Imported> imported = io::import_scene(mesh, {});
  if (!imported) return imported;
  imported->report.vertices = soup.points.size();
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
  // Polygons with the same corners have the same sum over them.
  std::vector<std::uint64_t> sums;
  sums.reserve(soup.polygons.size());
  for (const auto& polygon : soup.polygons) {
    std::uint64_t sum = 0;
    for (const VertexId v : polygon)
      sum += spread(static_cast<std::uint64_t>(v) + 1);
    sums.push_back(spread(sum));
  }
  const std::vector<bool> is_suspect = may_repeat(sums);
  std::vector<Entry> entries;
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    if (!is_suspect[p]) continue;
    Entry& entry = entries.emplace_back();
    std::vector<VertexId>& key = entry.corners;
    key = soup.polygons[p];
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()),
                key.end());
    entry.polygon = p;
    entry.reversed = key.back() < key[1];
    if (entry.reversed) std::reverse(key.begin() + 1, key.end());
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.corners != b.corners ? a.corners < b.corners
                                  : a.polygon < b.polygon;
  });
  std::vector<bool> stays = is_suspect;
  stays.flip();
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
  const auto dropped =
      static_cast<std::size_t>(std::count(stays.begin(), stays.end(), false));
  if (dropped > 0) keep(soup, stays);
  return dropped;
}

namespace {

std::int64_t distance(const GridPoint& p, const GridPoint& q) {
  return std::max(
      {std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z)});
}

/// Points in cells four to eight times as wide as a distance, to find those
/// that are so near: most points have no other cell within it.
class Cells {
 public:
  Cells(std::int64_t reach, std::size_t points)
      : reach_(reach),
        shift_(2 + static_cast<int>(
                       std::bit_width(static_cast<std::uint64_t>(reach)))),
        first_(std::bit_ceil(2 * points + 1), -1) {
    entries_.reserve(points / 2);
  }

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
  GridPoint cell_of(const GridPoint& p) const {
    return {p.x >> shift_, p.y >> shift_, p.z >> shift_};
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
  int shift_;                        // cells are 2^shift_ wide
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
  std::vector<bool> is_end(soup.points.size());
  for (const auto& [from, to] : open_edges(soup))
    is_end[static_cast<std::size_t>(from)] =
        is_end[static_cast<std::size_t>(to)] = true;
  // Each takes the place of the first one that is near and stays: no chain of
  // them moves farther than one step.
  std::vector<VertexId> become(soup.points.size());
  std::iota(become.begin(), become.end(), 0);
  Cells cells(reach, static_cast<std::size_t>(
                         std::count(is_end.begin(), is_end.end(), true)));
  Welded welded;
  for (VertexId v = 0; static_cast<std::size_t>(v) < is_end.size(); ++v) {
    if (!is_end[static_cast<std::size_t>(v)]) continue;
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
