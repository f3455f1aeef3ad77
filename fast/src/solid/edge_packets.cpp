#include "solid/edge_packets.hpp"

#include <algorithm>
#include <utility>

#include "table/shared_table.hpp"

namespace halfspace::fast {
namespace {

/// Edges in a packet at most. Untuned.
constexpr std::uint32_t kMost = 16;
/// Smaller blocks are made anew, together with what is beside them.
constexpr std::uint32_t kLeast = 8;

/// Where the row of edges from `first` on ends, at `last` at the latest.
std::uint32_t end_of_row(const SolidEdge* edges, std::uint32_t first,
                         std::uint32_t last) {
  std::uint32_t i = first + 1;
  while (i < last && edges[i - 1].to == edges[i].from) ++i;
  return i;
}

}  // namespace

PacketList::PacketList(const Solid& solid, const Face& face,
                       std::span<const EdgePacket> known) {
  std::uint32_t done = 0;
  for (const EdgePacket& block : known) {
    if (block.count < kLeast) continue;
    add_blocks(solid, face, done, block.first);
    blocks_.push_back(block);
    done = block.first + block.count;
  }
  add_blocks(solid, face, done, face.edge_count);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (b % kGroup == 0) groups_.push_back(kEmptyBox);
    extend(groups_.back(), blocks_[b].box);
  }
}

Box PacketList::box() const {
  Box box = kEmptyBox;
  for (const Box& group : groups_) extend(box, group);
  return box;
}

void PacketList::add_blocks(const Solid& solid, const Face& face,
                            std::uint32_t first, std::uint32_t last) {
  const SolidEdge* edges = solid.edges.data() + face.first_edge;
  const auto is_loop = [edges](std::uint32_t from, std::uint32_t to) {
    return edges[to - 1].to == edges[from].from;
  };
  while (first < last) {
    // A part of a row, or as many whole loops as fit.
    const std::uint32_t most = std::min(first + kMost, last);
    std::uint32_t end = end_of_row(edges, first, most);
    EdgePacket block;
    block.first = first;
    block.is_closed = is_loop(first, end);
    while (block.is_closed && end < most) {
      const std::uint32_t next = end_of_row(edges, end, most);
      if (!is_loop(end, next)) break;
      block.is_row = false;
      end = next;
    }
    Bounds bounds;
    for (std::uint32_t i = first; i < end; ++i) {
      bounds.add(solid.table->vertex(edges[i].from).approximate);
      bounds.add(solid.table->vertex(edges[i].to).approximate);
    }
    block.box = bounds.box();
    block.count = end - first;
    blocks_.push_back(block);
    first = end;
  }
}

EdgePackets::EdgePackets(const Solid& solid) {
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Face& face = solid.faces[f];
    if (has_many(face))
      set(f, std::make_shared<const PacketList>(solid, face,
                                                std::span<const EdgePacket>()));
  }
}

EdgePackets::EdgePackets(const EdgePackets& other,
                         const std::vector<std::int32_t>& faces) {
  for (std::size_t f = 0; f < faces.size(); ++f) set(f, other.shared(faces[f]));
}

void EdgePackets::set(std::size_t face, Shared list) {
  if (face >= lists_.size()) {
    if (!list) return;
    lists_.resize(face + 1);
  }
  lists_[face] = std::move(list);
}

int filtered_side(const FilterPlane& plane, const Box& box, double rounding) {
  double at[3];
  double radius = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = (double{box.low[k]} + double{box.high[k]}) / 2;
    radius = std::max(radius, double{box.high[k]} - double{box.low[k]});
  }
  // No point of the box is off its middle by more than half of that; the
  // middle is rounded by less than 2^-20 of it, where it is rounded at all.
  const Vertex middle{at[0], at[1], at[2], radius * (0.5 + 0x1p-20)};
  return filtered_sign(value_at(plane, middle, rounding));
}

}  // namespace halfspace::fast
