#include <algorithm>
#include <numeric>
#include <tuple>

#include "boolean_result.hpp"

namespace halfspace::fast {
namespace {

/// An edge of a face, with its ends in order.
struct Entry {
  std::int32_t low;
  std::int32_t high;
  std::int32_t face;
  std::uint32_t edge;
};

bool may_merge(const Face& f, const Face& g, Merge rule) {
  if (f.plane != g.plane || f.turned != g.turned) return false;
  switch (rule) {
    case Merge::kOrigin:
      return f.part == g.part && f.polygon == g.polygon;
    case Merge::kColor:
      return f.color == g.color;
    case Merge::kPlane:
      break;
  }
  return true;
}

std::vector<Entry> sorted_edges(const Solid& solid) {
  std::vector<Entry> entries;
  entries.reserve(solid.edges.size());
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Face& face = solid.faces[f];
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const std::uint32_t at = face.first_edge + i;
      const auto [low, high] =
          std::minmax(solid.edges[at].from, solid.edges[at].to);
      entries.push_back({low, high, static_cast<std::int32_t>(f), at});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& x, const Entry& y) {
    return std::tie(x.low, x.high, x.edge) < std::tie(y.low, y.high, y.edge);
  });
  return entries;
}

}  // namespace

Solid merged(const Solid& solid, Merge rule) {
  // Step 1: drop the edges that just two faces share which may be one.
  const std::vector<Entry> entries = sorted_edges(solid);
  std::vector<std::int32_t> parent(solid.faces.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t f) {
    while (parent[static_cast<std::size_t>(f)] != f) {
      std::int32_t& up = parent[static_cast<std::size_t>(f)];
      up = parent[static_cast<std::size_t>(up)];
      f = up;
    }
    return f;
  };
  std::vector<bool> dropped(solid.edges.size());
  for (std::size_t i = 0; i < entries.size();) {
    std::size_t j = i + 1;
    while (j < entries.size() && entries[j].low == entries[i].low &&
           entries[j].high == entries[i].high)
      ++j;
    if (j == i + 2) {
      const std::int32_t f = root(entries[i].face);
      const std::int32_t g = root(entries[i + 1].face);
      if (may_merge(solid.faces[static_cast<std::size_t>(f)],
                    solid.faces[static_cast<std::size_t>(g)], rule)) {
        dropped[entries[i].edge] = dropped[entries[i + 1].edge] = true;
        parent[static_cast<std::size_t>(std::max(f, g))] = std::min(f, g);
      }
    }
    i = j;
  }
  // Step 2: what is left, by the first of the faces that are one.
  std::vector<Piece> pieces;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Face& face = solid.faces[f];
    const std::int32_t bucket = root(static_cast<std::int32_t>(f));
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      const SolidEdge& edge = solid.edges[face.first_edge + i];
      if (!dropped[face.first_edge + i])
        pieces.push_back({bucket, face.plane, edge.from, edge.to, edge.other});
    }
  }
  straighten(
      pieces, [](std::int32_t) { return false; }, *solid.space);
  Solid result{{}, {}, solid.unbounded, solid.unit, solid.space};
  std::int64_t last = -1;
  for (const Piece& piece : pieces) {
    if (piece.bucket != last) {
      Face face = solid.faces[static_cast<std::size_t>(piece.bucket)];
      face.first_edge = static_cast<std::uint32_t>(result.edges.size());
      face.edge_count = 0;
      result.faces.push_back(face);
      last = piece.bucket;
    }
    result.edges.push_back({piece.from, piece.to, piece.other});
    ++result.faces.back().edge_count;
  }
  for (Face& face : result.faces) face.box = face_box(result, face);
  return result;
}

}  // namespace halfspace::fast
