#include "soup.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

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
  std::map<GridPoint, VertexId> ids;
  for (std::size_t p = 0; p < scene.polygon_count(); ++p) {
    const auto id = static_cast<PolygonId>(p);
    std::vector<VertexId> polygon;
    for (const VertexId v : scene.corners(id)) {
      const auto [at, is_new] = ids.try_emplace(
          scene.point(v), static_cast<VertexId>(soup.points.size()));
      if (is_new) soup.points.push_back(scene.point(v));
      polygon.push_back(at->second);
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
  struct Group {
    std::ptrdiff_t excess = 0;
    std::vector<std::size_t> either[2];
  };
  std::map<std::vector<VertexId>, Group> groups;
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    std::vector<VertexId> key = soup.polygons[p];
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()),
                key.end());
    const bool reversed = key.back() < key[1];
    if (reversed) std::reverse(key.begin() + 1, key.end());
    Group& group = groups[std::move(key)];
    group.excess += reversed ? -1 : 1;
    group.either[reversed ? 1 : 0].push_back(p);
  }
  std::vector<bool> stays(soup.polygons.size());
  for (const auto& [key, group] : groups) {
    if (group.excess != 0)
      stays[group.either[group.excess > 0 ? 0 : 1][0]] = true;
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

/// Points in cells as wide as a distance, to find those that are so near.
class Cells {
 public:
  explicit Cells(std::int64_t width)
      : width_(std::max<std::int64_t>(width, 1)) {}
  void add(const GridPoint& p, VertexId v) { cells_[cell_of(p)].push_back(v); }
  template <class Found>
  void for_near(const GridPoint& p, Found&& found) const {
    const GridPoint c = cell_of(p);
    for (std::int64_t x = c.x - 1; x <= c.x + 1; ++x) {
      for (std::int64_t y = c.y - 1; y <= c.y + 1; ++y) {
        for (std::int64_t z = c.z - 1; z <= c.z + 1; ++z) {
          const auto at = cells_.find({x, y, z});
          if (at == cells_.end()) continue;
          for (const VertexId v : at->second) found(v);
        }
      }
    }
  }

 private:
  std::int64_t cell(std::int64_t c) const {
    return c >= 0 ? c / width_ : -((width_ - 1 - c) / width_);
  }
  GridPoint cell_of(const GridPoint& p) const {
    return {cell(p.x), cell(p.y), cell(p.z)};
  }

  std::int64_t width_;
  std::map<GridPoint, std::vector<VertexId>> cells_;
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
  Cells cells(reach);
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
