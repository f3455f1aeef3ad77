#include "intersect/candidates.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "base/parallel.hpp"
#include "base/radix_sort.hpp"
#include "solid/grid_prefilter.hpp"

namespace halfspace::fast {

void prepare(Operand& a, Operand& b, BooleanScratch& scratch) {
  for (Operand* operand : {&a, &b}) {
    const Solid& solid = *operand->solid;
    for (const Face& face : solid.faces) extend(operand->extent, face.box);
    operand->is_active.assign(solid.faces.size(), 0);
    operand->touched.assign(solid.faces.size(), 0);
    operand->edge_of.assign(solid.edges.size(), -1);
    operand->on_other = &scratch.on_other;
    if (!operand->blocks)
      operand->blocks = std::make_shared<const EdgePackets>(solid);
  }
  scratch.on_other.clear();
  a.reach = b.extent;
  b.reach = a.extent;
}

List<std::pair<std::int32_t, std::int32_t>> candidate_pairs(Operand& a,
                                                            Operand& b,
                                                            int threads) {
  const auto near = [](const Operand& of) {
    std::vector<std::int32_t> items;
    for (std::size_t f = 0; f < of.solid->faces.size(); ++f) {
      const auto id = static_cast<std::int32_t>(f);
      if (overlap(of.solid->faces[f].box, of.reach) &&
          of.common_at(id) == Operand::kNotCommon)
        items.push_back(id);
    }
    return items;
  };
  const auto box_of = [&](std::int32_t g) -> const Box& {
    return b.face(g).box;
  };
  std::vector<std::int32_t> faces = near(a);
  std::vector<std::int32_t> others = near(b);
  Box common = a.reach;
  for (std::size_t k = 0; k < 3; ++k) {
    common.low[k] = std::max(common.low[k], b.reach.low[k]);
    common.high[k] = std::min(common.high[k], b.reach.high[k]);
  }
  grid_prefilter(*a.solid, faces, *b.solid, others, common);
  const BoxTree tree(box_of, others);
  // Step 1: the pairs, block by block of the first operand's faces.
  using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;
  constexpr std::size_t kBlock = 256;
  std::vector<Pairs> found((faces.size() + kBlock - 1) / kBlock);
  for_blocks(threads, faces.size(), kBlock,
             [&](std::size_t number, std::size_t first, std::size_t last) {
               for (std::size_t i = first; i < last; ++i) {
                 const std::int32_t f = faces[i];
                 tree.find(a.face(f).box, [&](std::int32_t g) {
                   found[number].emplace_back(f, g);
                 });
               }
             });
  // Step 2: all of them, and whose they are.
  std::size_t count = 0;
  for (const Pairs& some : found) count += some.size();
  List<std::pair<std::int32_t, std::int32_t>> pairs;
  pairs.reserve(count);
  for (const Pairs& some : found)
    pairs.insert(pairs.end(), some.begin(), some.end());
  for (const auto& [f, g] : pairs) {
    HALFSPACE_CHECK(overlap(a.face(f).box, b.face(g).box));
    std::uint8_t& is_active = a.is_active[static_cast<std::size_t>(f)];
    if (is_active == 0) a.active.push_back(f);
    is_active = 1;
    b.is_active[static_cast<std::size_t>(g)] = 1;
  }
  for (std::size_t g = 0; g < b.is_active.size(); ++g) {
    if (b.is_active[g]) b.active.push_back(static_cast<std::int32_t>(g));
  }
  // No face stands there twice.
  HALFSPACE_CHECK(a.active.size() <= faces.size());
  HALFSPACE_CHECK(b.active.size() <= others.size());
  return pairs;
}

void add_edges(Operand& operand, const GeometryTable& table) {
  const Solid& solid = *operand.solid;
  // Step 1: bring the edges with the same ends together.
  struct Entry {
    std::uint32_t edge;
    std::int32_t face;
  };
  std::vector<Entry> entries;
  List<KeyedIndex> keyed;  // by the lesser end, then the greater one
  for (const std::int32_t f : operand.active) {
    const Face& face = operand.face(f);
    const auto add = [&](std::uint32_t first, std::uint32_t count) {
      for (std::uint32_t at = first; at < first + count; ++at) {
        const SolidEdge& edge = solid.edges[at];
        if (is_beyond(operand.reach, table.vertex(edge.from).approximate,
                      table.vertex(edge.to).approximate))
          continue;
        const auto [low, high] = std::minmax(edge.from, edge.to);
        keyed.push_back({static_cast<std::uint64_t>(low) << 32 |
                             static_cast<std::uint32_t>(high),
                         static_cast<std::uint32_t>(entries.size())});
        entries.push_back({at, f});
      }
    };
    const PacketList* list = operand.blocks->of(f);
    if (list == nullptr) {
      add(face.first_edge, face.edge_count);
      continue;
    }
    list->visit(
        [&](const Box& box) { return overlap(box, operand.reach); },
        [&](const EdgePacket& b) { add(face.first_edge + b.first, b.count); });
  }
  sort_by_key(keyed);
  // Step 2: name each once, in the direction of an axis.
  operand.uses.reserve(entries.size());
  operand.edges.reserve(entries.size() / 2);  // nearly always all of them
  for (std::size_t i = 0; i < keyed.size();) {
    const std::uint64_t ends = keyed[i].key;
    const Entry& first = entries[keyed[i].index];
    OperandEdge edge{static_cast<std::int32_t>(ends >> 32),
                     static_cast<std::int32_t>(ends & 0xffffffff)};
    edge.axis = table.edge_axis(edge.low, edge.high);
    if (table.compare(edge.axis, edge.low, edge.high) > 0)
      std::swap(edge.low, edge.high);
    HALFSPACE_CHECK(table.compare(edge.axis, edge.low, edge.high) < 0);
    HALFSPACE_CHECK(!is_beyond(operand.reach,
                               table.vertex(edge.low).approximate,
                               table.vertex(edge.high).approximate));
    edge.owner = first.face;
    edge.first_edge = first.edge;
    edge.plane = operand.face(first.face).plane;
    edge.other = solid.edges[first.edge].other;
    edge.first_use = static_cast<std::uint32_t>(operand.uses.size());
    const auto id = static_cast<std::int32_t>(operand.edges.size());
    for (; i < keyed.size() && keyed[i].key == ends; ++i) {
      const Entry& entry = entries[keyed[i].index];
      operand.uses.push_back(
          {entry.face, solid.edges[entry.edge].from == edge.low});
      operand.edge_of[entry.edge] = id;
      ++edge.use_count;
      // Two planes of faces at one edge are equal, or meet along it.
      const std::int32_t plane = operand.face(entry.face).plane;
      if (edge.other < 0 && plane != edge.plane) edge.other = plane;
    }
    operand.edges.push_back(edge);
  }
}

}  // namespace halfspace::fast
