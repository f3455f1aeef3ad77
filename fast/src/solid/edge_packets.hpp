#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "box/box.hpp"
#include "exact/filter.hpp"
#include "halfspace/fast/solid.hpp"

/// Where the edges of faces with many of them are: so a boolean need not walk
/// them all to find those that are near the other operand.
namespace halfspace::fast {

/// A few edges in a row of a face, and their box.
struct EdgePacket {
  Box box;
  std::uint32_t first = 0;  ///< of the face's edges
  std::uint32_t count = 0;
  bool is_row = true;     ///< each begins where the one before it ends
  bool is_closed = true;  ///< they are whole loops
};

/// The blocks of one face, in order, and groups of blocks.
class PacketList {
 public:
  /// `known`: blocks of the face, in order, which need not be all of it.
  /// Cost: a look at each vertex that is not in one of those.
  PacketList(const Solid& solid, const Face& face,
             std::span<const EdgePacket> known);

  std::span<const EdgePacket> blocks() const { return blocks_; }
  /// The box of the face.
  Box box() const;
  /// Calls `visit(block)` for the blocks of whose boxes, and of whose groups'
  /// boxes, `matters(box)` is true.
  template <class Matters, class Visit>
  void visit(Matters&& matters, Visit&& visit) const {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (!matters(groups_[g])) continue;
      const std::size_t last = std::min((g + 1) * kGroup, blocks_.size());
      for (std::size_t b = g * kGroup; b < last; ++b) {
        if (matters(blocks_[b].box)) visit(blocks_[b]);
      }
    }
  }

 private:
  static constexpr std::size_t kGroup = 16;

  void add_blocks(const Solid& solid, const Face& face, std::uint32_t first,
                  std::uint32_t last);

  std::vector<EdgePacket> blocks_;
  std::vector<Box> groups_;
};

/// The blocks of a solid's faces, where they have many edges.
class EdgePackets {
 public:
  using Shared = std::shared_ptr<const PacketList>;

  EdgePackets() = default;
  /// The packets of all faces of the solid.
  explicit EdgePackets(const Solid& solid);
  /// The packets of a solid that is made of these faces of another one.
  EdgePackets(const EdgePackets& other, const std::vector<std::int32_t>& faces);

  /// Whether such a face has blocks.
  static bool has_many(const Face& face) { return face.edge_count >= kMany; }
  /// Makes the list the face's; nothing: it has none.
  void set(std::size_t face, Shared list);
  /// The face's blocks, or nothing.
  const PacketList* of(std::int32_t face) const {
    const auto at = static_cast<std::size_t>(face);
    return at < lists_.size() ? lists_[at].get() : nullptr;
  }
  Shared shared(std::int32_t face) const {
    return of(face) != nullptr ? lists_[static_cast<std::size_t>(face)]
                               : nullptr;
  }

 private:
  static constexpr std::uint32_t kMany = 24;

  std::vector<Shared> lists_;  ///< by face, as far as there are any
};

/// Which side of the plane the box is on, or 0 if it may meet it.
int filtered_side(const FilterPlane& plane, const Box& box, double rounding);

}  // namespace halfspace::fast
