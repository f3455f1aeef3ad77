#include "halfspace/fast/chain.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "boolean/assemble.hpp"
#include "boolean/conform.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/boolean.hpp"
#include "solid/dynamic_bvh.hpp"
#include "solid/loops.hpp"
#include "solid/move_to_table.hpp"

namespace halfspace::fast {
namespace {

/// Copies the face with its edges to the end of a solid.
void append(const Solid& from, const Face& face, Solid& to) {
  to.faces.push_back(face);
  to.faces.back().first_edge = static_cast<std::uint32_t>(to.edges.size());
  const auto first =
      from.edges.begin() + static_cast<std::ptrdiff_t>(face.first_edge);
  to.edges.insert(to.edges.end(), first,
                  first + static_cast<std::ptrdiff_t>(face.edge_count));
}

Solid without_faces(const Solid& solid) {
  return {{},         {},          solid.unbounded,
          solid.unit, solid.table, solid.is_conforming};
}

/// A solid with some of the faces of another.
Solid with_faces(const Solid& solid, const std::vector<std::int32_t>& faces) {
  Solid result = without_faces(solid);
  std::size_t edges = 0;
  for (const std::int32_t f : faces)
    edges += solid.faces[static_cast<std::size_t>(f)].edge_count;
  result.faces.reserve(faces.size());
  result.edges.reserve(edges);
  for (const std::int32_t f : faces)
    append(solid, solid.faces[static_cast<std::size_t>(f)], result);
  return result;
}

}  // namespace

/// Faces that have gone stay where they are until they are half of all, and
/// their edges until those are.
struct Chain::State {
  explicit State(Solid first) : solid(std::move(first)) {
    pack_edges(solid);
    restart();
  }

  /// With another solid.
  void restart() {
    solid.is_conforming = is_known_conforming(solid);
    blocks = std::make_shared<EdgePackets>(solid);
    begin();
  }
  void begin() {
    extent = kEmptyBox;
    index = DynamicBvh();
    index.reserve(solid.faces.size());
    is_indexed = false;
    is_fresh = true;
    for (const Face& face : solid.faces) extend(extent, face.box);
    gone_faces = gone_edges = 0;
  }

  std::vector<std::int32_t> present_faces() const {
    std::vector<std::int32_t> faces;
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
      if (!index.is_gone(static_cast<std::int32_t>(f)))
        faces.push_back(static_cast<std::int32_t>(f));
    }
    return faces;
  }
  Solid present() const {
    return gone_faces == 0 ? solid : with_faces(solid, present_faces());
  }

  std::vector<std::int32_t> faces_near(const Box& reach);
  void apply(BooleanOp operation, const Solid& other, TableLease& lease);
  void exchange(const std::vector<std::int32_t>& near, const Solid& result,
                const EdgePackets& result_blocks, const Arrangement& found);
  void drop_gone_edges();
  void drop_gone_faces();

  Solid solid;
  DynamicBvh index;
  /// One boolean is quicker without an index: it is made for the second one.
  bool is_indexed = false;
  bool is_fresh = true;
  Box extent;
  std::shared_ptr<EdgePackets> blocks;
  std::size_t gone_faces = 0;
  std::size_t gone_edges = 0;
};

std::vector<std::int32_t> Chain::State::faces_near(const Box& reach) {
  std::vector<std::int32_t> near;
  if (!is_fresh && !is_indexed) {
    index.add(solid, 0);
    is_indexed = true;
  }
  if (is_indexed) {
    index.find(reach, [&](std::int32_t f) { near.push_back(f); });
    std::sort(near.begin(), near.end());
    return near;
  }
  is_fresh = false;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    if (overlap(solid.faces[f].box, reach))
      near.push_back(static_cast<std::int32_t>(f));
  }
  return near;
}

void Chain::State::apply(BooleanOp operation, const Solid& other,
                         TableLease& lease) {
  // Step 1: the faces near the other solid.
  Box reach = kEmptyBox;
  for (const Face& face : other.faces) extend(reach, face.box);
  const std::vector<std::int32_t> near = faces_near(reach);
  // To take most of them apart from the others is not worth it.
  const bool all_near = near.size() == solid.faces.size() ||
                        (!is_indexed && 2 * near.size() > solid.faces.size());
  const Solid part = all_near ? without_faces(solid) : with_faces(solid, near);
  Arrangement::Whole whole{&solid, is_indexed ? &index : nullptr, extent,
                           blocks, blocks};
  if (!all_near)
    whole.part_blocks = std::make_shared<const EdgePackets>(*blocks, near);
  // Step 2: what becomes of them.
  Arrangement found(operation, all_near ? solid : part, other, lease, whole);
  found.find_contacts();
  if (!found.conforms(0)) {
    solid = conforming(present(), lease);
    restart();
    return apply(operation, other, lease);
  }
  if (!found.conforms(1))
    return apply(operation, conforming(other, lease), lease);
  auto [result, result_blocks] = assembled(found);
  solid.is_conforming = solid.is_conforming && result.is_conforming;
  // Step 3: the others are all beyond the other solid's box.
  const bool beyond = other.unbounded;
  const bool stay = is_member(operation, true, beyond) &&
                    !is_member(operation, false, beyond);
  solid.unbounded = result.unbounded;
  if (!stay || all_near) {
    result.is_conforming = solid.is_conforming;
    solid = std::move(result);
    *blocks = std::move(result_blocks);
    begin();
    return;
  }
  exchange(near, result, result_blocks, found);
}

/// Puts the result in the place of the near faces; what is as it was stays.
void Chain::State::exchange(const std::vector<std::int32_t>& near,
                            const Solid& result,
                            const EdgePackets& result_blocks,
                            const Arrangement& found) {
  std::vector<std::uint8_t> stays(near.size());
  const auto first = static_cast<std::int32_t>(solid.faces.size());
  for (std::size_t f = 0; f < result.faces.size(); ++f) {
    const Face& face = result.faces[f];
    if (face.from_first && !found.is_touched(0, face.source)) {
      const auto at = static_cast<std::size_t>(face.source);
      const Face& old = solid.faces[static_cast<std::size_t>(near[at])];
      if (old.edge_count == face.edge_count && old.flipped == face.flipped) {
        stays[at] = 1;
        continue;
      }
    }
    append(result, face, solid);
    extend(extent, face.box);
    blocks->set(solid.faces.size() - 1,
                result_blocks.shared(static_cast<std::int32_t>(f)));
  }
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (stays[i] != 0) continue;
    const auto f = static_cast<std::size_t>(near[i]);
    index.remove(near[i]);
    blocks->set(f, nullptr);
    ++gone_faces;
    gone_edges += solid.faces[f].edge_count;
  }
  if (is_indexed) {
    index.add(solid, first);
  } else {
    index.reserve(solid.faces.size());
  }
  if (2 * gone_faces > solid.faces.size()) {
    drop_gone_faces();
  } else if (2 * gone_edges > solid.edges.size()) {
    drop_gone_edges();
  }
}

/// The faces' edges stand in the order of the faces, as booleans leave them.
/// All that stays is moved within its memory: new memory takes longer to be had
/// than to be filled.
void Chain::State::drop_gone_edges() {
  std::uint32_t kept = 0;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    if (index.is_gone(static_cast<std::int32_t>(f))) continue;
    Face& face = solid.faces[f];
    const auto at = [this](std::uint32_t edge) {
      return solid.edges.begin() + static_cast<std::ptrdiff_t>(edge);
    };
    std::copy(at(face.first_edge), at(face.first_edge + face.edge_count),
              at(kept));
    face.first_edge = kept;
    kept += face.edge_count;
  }
  solid.edges.resize(kept);
  gone_edges = 0;
}

void Chain::State::drop_gone_faces() {
  drop_gone_edges();
  const std::vector<std::int32_t> faces = present_faces();
  for (std::size_t i = 0; i < faces.size(); ++i)
    solid.faces[i] = solid.faces[static_cast<std::size_t>(faces[i])];
  solid.faces.resize(faces.size());
  *blocks = EdgePackets(*blocks, faces);
  begin();
}

Chain::Chain(Solid first) : state_(std::make_unique<State>(std::move(first))) {}
Chain::Chain(Chain&&) noexcept = default;
Chain& Chain::operator=(Chain&&) noexcept = default;
Chain::~Chain() = default;

void Chain::apply(BooleanOp operation, const Solid& other) {
  Solid& solid = state_->solid;
  const int grid_bits = std::max(grid_bits_of(solid), grid_bits_of(other));
  std::optional<TableLease> lease;
  if (solid.table && solid.table->grid_bits() == grid_bits)
    lease = TableLease::of(solid.table);
  if (!lease) {
    lease.emplace(TableLease::of_new(grid_bits));
    solid = moved_to(state_->present(), *lease);
    state_->restart();
  }
  if (other.table == solid.table) {
    state_->apply(operation, other, *lease);
  } else {
    state_->apply(operation, moved_to(other, *lease), *lease);
  }
}

Solid Chain::solid() const& { return state_->present(); }

Solid Chain::solid() && {
  if (state_->gone_faces == 0) return std::move(state_->solid);
  return state_->present();
}

namespace {

/// Pairs first, then pairs of pairs.
Solid paired(BooleanOp operation, std::vector<Solid> level, int threads) {
  while (level.size() > 1) {
    std::vector<Solid> next;
    for (std::size_t i = 0; i + 1 < level.size(); i += 2)
      next.push_back(boolean(operation, level[i], level[i + 1], threads));
    if (level.size() % 2 != 0) next.push_back(std::move(level.back()));
    level = std::move(next);
  }
  return std::move(level[0]);
}

/// The boolean of each block of solids, all in one table. Blocks of 2^k in a
/// row are what pairs of pairs come to.
std::vector<Solid> blocks_of(BooleanOp operation,
                             const std::vector<Solid>& solids, int threads) {
  constexpr std::size_t kBlock = 8;
  int grid_bits = 0;
  for (const Solid& solid : solids)
    grid_bits = std::max(grid_bits, grid_bits_of(solid));
  std::vector<Solid> blocks((solids.size() + kBlock - 1) / kBlock);
  for_blocks(threads, solids.size(), kBlock,
             [&](std::size_t number, std::size_t first, std::size_t last) {
               std::vector<Solid> own;
               {
                 TableLease lease = TableLease::of_new(grid_bits);
                 for (std::size_t i = first; i < last; ++i)
                   own.push_back(moved_to(solids[i], lease));
               }
               blocks[number] = paired(operation, std::move(own), 1);
             });
  std::optional<TableLease> lease;
  if (solids[0].table && solids[0].table->grid_bits() == grid_bits)
    lease = TableLease::of(solids[0].table);
  if (!lease) lease.emplace(TableLease::of_new(grid_bits));
  for (Solid& block : blocks) block = moved_to(block, *lease);
  return blocks;
}

}  // namespace

Solid boolean_all(BooleanOp operation, std::span<const Solid> solids,
                  int threads) {
  HALFSPACE_ASSERT(!solids.empty());
  const bool without = operation == BooleanOp::kDifference;
  const BooleanOp among = without ? BooleanOp::kUnion : operation;
  std::vector<Solid> level(solids.begin() + (without ? 1 : 0), solids.end());
  if (level.empty()) return solids[0];
  constexpr std::size_t kMany = 16;
  threads = thread_count(threads);
  if (threads > 1 && level.size() >= kMany)
    level = blocks_of(among, level, threads);
  Solid result = paired(among, std::move(level), threads);
  if (!without) return result;
  return boolean(operation, solids[0], result, threads);
}

}  // namespace halfspace::fast
