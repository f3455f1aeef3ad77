#include "intersect/candidates.hpp"

#include <algorithm>
#include <utility>

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
      operand->blocks = std::make_shared<const EdgeBlocks>(solid);
  }
  scratch.on_other.clear();
  a.reach = b.extent;
  b.reach = a.extent;
}

std::vector<std::pair<std::int32_t, std::int32_t>> near_pairs(Operand& a,
                                                              Operand& b,
                                                              int threads) {
  const auto near = [](const Operand& of) {
    std::vector<std::int32_t> items;
    for (std::size_t f = 0; f < of.solid->faces.size(); ++f) {
      if (overlap(of.solid->faces[f].box, of.reach))
        items.push_back(static_cast<std::int32_t>(f));
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
  drop_lonely(*a.solid, faces, *b.solid, others, common);
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
  Pairs pairs;
  for (const Pairs& some : found)
    pairs.insert(pairs.end(), some.begin(), some.end());
  for (const auto& [f, g] : pairs) {
    std::uint8_t& is_active = a.is_active[static_cast<std::size_t>(f)];
    if (is_active == 0) a.active.push_back(f);
    is_active = 1;
    b.is_active[static_cast<std::size_t>(g)] = 1;
  }
  for (std::size_t g = 0; g < b.is_active.size(); ++g) {
    if (b.is_active[g]) b.active.push_back(static_cast<std::int32_t>(g));
  }
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
    const BlockList* list = operand.blocks->of(f);
    if (list == nullptr) {
      add(face.first_edge, face.edge_count);
      continue;
    }
    list->visit(
        [&](const Box& box) { return overlap(box, operand.reach); },
        [&](const EdgeBlock& b) { add(face.first_edge + b.first, b.count); });
  }
  sort_by_key(keyed);
  // Step 2: name each once, in the direction of an axis.
  operand.uses.reserve(entries.size());
  for (std::size_t i = 0; i < keyed.size();) {
    const std::uint64_t ends = keyed[i].key;
    const Entry& first = entries[keyed[i].index];
    LineEdge edge{static_cast<std::int32_t>(ends >> 32),
                  static_cast<std::int32_t>(ends & 0xffffffff)};
    edge.axis = table.edge_axis(edge.low, edge.high);
    if (table.compare(edge.axis, edge.low, edge.high) > 0)
      std::swap(edge.low, edge.high);
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
    }
    operand.edges.push_back(edge);
  }
}

/// How many edges from this one on are known to be far at once, and go on from
/// each other or are whole loops; `loop` is where the loop at hand begins.
std::uint32_t FarRows::far_from(std::uint32_t edge, std::uint32_t& loop) {
  if (list_ != nullptr) {
    const auto blocks = list_->blocks();
    while (block_ < blocks.size() && blocks[block_].first < edge) ++block_;
    if (block_ < blocks.size() && blocks[block_].first == edge &&
        !overlap(blocks[block_].box, operand_.reach)) {
      const EdgeBlock& block = blocks[block_];
      const bool is_whole = block.is_closed && edge == loop;
      if (is_whole) loop = edge + block.count;
      if (is_whole || block.is_row) return block.count;
    }
  }
  return operand_.edge_of[face_.first_edge + edge] < 0 ? 1 : 0;
}

std::optional<FarRows::Row> FarRows::next() {
  if (rest_.first < rest_.last) return std::exchange(rest_, Row());
  while (at_ < face_.edge_count) {
    const std::uint32_t first = at_;
    std::uint32_t loop = first;  // where the last loop of the row begins
    while (at_ < face_.edge_count) {
      if (at_ > loop && !goes_on(at_)) {
        if (list_ == nullptr || edges_[at_ - 1].to != edges_[loop].from) break;
        loop = at_;
      }
      const std::uint32_t count = far_from(at_, loop);
      if (count == 0) break;
      at_ += count;
    }
    if (at_ == first) {
      ++at_;
      continue;
    }
    const bool is_whole =
        at_ == loop || edges_[at_ - 1].to == edges_[loop].from;
    if (is_whole || loop == first) return Row{first, at_};
    rest_ = {loop, at_};
    return Row{first, loop};
  }
  return std::nullopt;
}

namespace {

/// A plane through two points of the grid and along an axis that is not in the
/// plane, which holds them: the one that its normal is most along.
std::int32_t plane_beside(std::int32_t u, std::int32_t v, std::int32_t plane,
                          GeometryTable& table) {
  const Plane& n = table.plane(plane).filter.plane;
  const std::array<double, 3> size{std::abs(n.a), std::abs(n.b), std::abs(n.c)};
  const auto axis = std::max_element(size.begin(), size.end()) - size.begin();
  return table.add_line_plane(u, v, static_cast<int>(axis));
}

}  // namespace

std::int32_t second_plane(LineEdge& edge, const Operand& operand,
                          GeometryTable& table) {
  if (edge.other >= 0) return edge.other;
  // Two planes of faces at one edge are equal, or meet along it.
  for (std::uint32_t u = 0; u < edge.use_count; ++u) {
    const auto at = static_cast<std::size_t>(edge.first_use + u);
    const std::int32_t plane = operand.face(operand.uses[at].face).plane;
    if (plane != edge.plane) return edge.other = plane;
  }
  return edge.other = plane_beside(edge.low, edge.high, edge.plane, table);
}

std::int32_t plane_athwart(const SolidEdge& edge, const Face& face,
                           GeometryTable& table) {
  return edge.other >= 0 ? edge.other
                         : plane_beside(edge.from, edge.to, face.plane, table);
}

}  // namespace halfspace::fast
