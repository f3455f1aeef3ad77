#include "boolean/common_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "box/bvh.hpp"
#include "exact/cell_hash.hpp"

namespace halfspace::fast {
namespace {

using Faces = std::vector<std::int32_t>;

/// The faces near the other operand that have edges, and whose planes are
/// marked.
Faces near_faces(const Operand& operand,
                 const EpochArray<std::uint8_t>& marked) {
  Faces near;
  for (std::size_t f = 0; f < operand.solid->faces.size(); ++f) {
    const Face& face = operand.solid->faces[f];
    if (marked.get(face.plane, 0) != 0 && face.edge_count != 0 &&
        overlap(face.box, operand.reach))
      near.push_back(static_cast<std::int32_t>(f));
  }
  return near;
}

struct KeyedFace {
  std::uint64_t key;
  std::int32_t face;
  bool operator<(const KeyedFace& other) const {
    return key != other.key ? key < other.key : face < other.face;
  }
};

/// Keys that do not depend on the order of a face's edges.
std::vector<KeyedFace> keyed(const Operand& operand, const Faces& faces) {
  std::vector<KeyedFace> result;
  result.reserve(faces.size());
  for (const std::int32_t f : faces) {
    const Face& face = operand.face(f);
    std::uint64_t sum = 0;
    for (std::uint32_t i = 0; i < face.edge_count; ++i) {
      sum += mixed(static_cast<std::uint64_t>(operand.edges_of(f)[i].from) + 1);
    }
    result.push_back({mixed(sum + static_cast<std::uint64_t>(face.plane)), f});
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The face's edges in order; with `reversed`, each from its end.
void take_edges(const Operand& operand, std::int32_t f, bool reversed,
                std::vector<std::pair<std::int32_t, std::int32_t>>& edges) {
  edges.clear();
  for (std::uint32_t i = 0; i < operand.face(f).edge_count; ++i) {
    const SolidEdge& edge = operand.edges_of(f)[i];
    edges.emplace_back(reversed ? edge.to : edge.from,
                       reversed ? edge.from : edge.to);
  }
  std::sort(edges.begin(), edges.end());
}

/// Pairs of faces with equal edges in one plane.
class Pairing {
 public:
  Pairing(const Operand& a, const Operand& b) : a_(a), b_(b) {}

  std::vector<std::pair<std::int32_t, std::int32_t>> pairs(const Faces& of_a,
                                                           const Faces& of_b) {
    std::vector<std::pair<std::int32_t, std::int32_t>> result;
    const auto as = keyed(a_, of_a);
    const auto bs = keyed(b_, of_b);
    auto b = bs.begin();
    for (const KeyedFace& a : as) {
      while (b != bs.end() && b->key < a.key) ++b;
      for (auto g = b; g != bs.end() && g->key == a.key; ++g) {
        if (!are_equal(a.face, g->face)) continue;
        result.emplace_back(a.face, g->face);
        break;
      }
    }
    return result;
  }

 private:
  bool are_equal(std::int32_t f, std::int32_t g) {
    const Face& face = a_.face(f);
    const Face& other = b_.face(g);
    if (face.plane != other.plane || face.edge_count != other.edge_count)
      return false;
    take_edges(a_, f, false, edges_);
    take_edges(b_, g, face.flipped != other.flipped, others_);
    return edges_ == others_;
  }

  const Operand& a_;
  const Operand& b_;
  std::vector<std::pair<std::int32_t, std::int32_t>> edges_, others_;
};

/// The boxes of the faces near the other operand that are not marked.
void add_boxes(const Operand& operand, const std::vector<std::uint8_t>& marked,
               std::vector<Box>& boxes) {
  for (std::size_t f = 0; f < operand.solid->faces.size(); ++f) {
    const Face& face = operand.solid->faces[f];
    if (marked[f] == 0 && overlap(face.box, operand.reach))
      boxes.push_back(face.box);
  }
}

}  // namespace

void find_common_faces(Operand& a, Operand& b, BooleanScratch& scratch) {
  // Step 1: the faces whose planes the other operand has, too.
  EpochArray<std::uint8_t>& marked = scratch.planes;
  marked.clear();
  for (const Face& face : a.solid->faces) {
    if (overlap(face.box, a.reach)) marked.set(face.plane, 1);
  }
  const Faces of_b = near_faces(b, marked);
  if (of_b.empty()) return;
  marked.clear();
  for (const std::int32_t g : of_b) marked.set(b.face(g).plane, 1);
  const Faces of_a = near_faces(a, marked);
  // Step 2: those that are equal.
  const auto pairs = Pairing(a, b).pairs(of_a, of_b);
  if (pairs.empty()) return;
  std::vector<std::uint8_t> in_a(a.solid->faces.size());
  std::vector<std::uint8_t> in_b(b.solid->faces.size());
  for (const auto& [f, g] : pairs)
    in_a[static_cast<std::size_t>(f)] = in_b[static_cast<std::size_t>(g)] = 1;
  // Step 3: without those near other faces.
  std::vector<Box> boxes;
  add_boxes(a, in_a, boxes);
  add_boxes(b, in_b, boxes);
  std::vector<std::int32_t> items(boxes.size());
  for (std::size_t i = 0; i < items.size(); ++i)
    items[i] = static_cast<std::int32_t>(i);
  const BoxTree others(
      [&](std::int32_t i) -> const Box& {
        return boxes[static_cast<std::size_t>(i)];
      },
      items);
  for (const auto& [f, g] : pairs) {
    bool is_alone = true;
    others.find(a.face(f).box, [&](std::int32_t) { is_alone = false; });
    if (!is_alone) continue;
    const bool is_same = a.face(f).flipped == b.face(g).flipped;
    for (auto [operand, face] : {std::pair(&a, f), std::pair(&b, g)}) {
      if (operand->common.empty())
        operand->common.resize(operand->solid->faces.size());
      operand->common[static_cast<std::size_t>(face)] =
          is_same ? Operand::kSame : Operand::kOpposite;
    }
  }
}

}  // namespace halfspace::fast
