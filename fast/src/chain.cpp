#include "halfspace/fast/chain.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "boolean_engine.hpp"
#include "face_index.hpp"
#include "halfspace/assert.hpp"
#include "halfspace/fast/boolean.hpp"

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
  return {{}, {}, solid.unbounded, solid.unit, solid.space};
}

}  // namespace

/// Faces that have gone stay where they are until they are half of all.
struct Chain::State {
  explicit State(Solid first) : solid(std::move(first)) { begin(); }

  void begin() {
    extent = kEmptyBox;
    index = FaceIndex();
    index.add(solid, 0);
    for (const Face& face : solid.faces) extend(extent, face.box);
    gone_edges = 0;
  }

  Solid present() const {
    Solid result = without_faces(solid);
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
      if (!index.is_gone(static_cast<std::int32_t>(f)))
        append(solid, solid.faces[f], result);
    }
    return result;
  }

  void apply(const Truth& truth, const Solid& other);

  Solid solid;
  FaceIndex index;
  Box extent;
  std::size_t gone_edges = 0;
};

void Chain::State::apply(const Truth& truth, const Solid& other) {
  // Step 1: the faces near the other solid.
  Box reach = kEmptyBox;
  for (const Face& face : other.faces) extend(reach, face.box);
  std::vector<std::int32_t> near;
  index.find(reach, [&](std::int32_t f) { near.push_back(f); });
  std::sort(near.begin(), near.end());
  Solid part = without_faces(solid);
  for (const std::int32_t f : near)
    append(solid, solid.faces[static_cast<std::size_t>(f)], part);
  // Step 2: what becomes of them.
  const Solid result =
      Engine(truth, part, other, *solid.space, solid, index, extent).run();
  // Step 3: the others are all beyond the other solid's box.
  const bool beyond = other.unbounded;
  const bool stay = truth(true, beyond) && !truth(false, beyond);
  solid.unbounded = result.unbounded;
  if (!stay) {
    solid = result;
    begin();
    return;
  }
  for (const std::int32_t f : near) {
    index.remove(f);
    gone_edges += solid.faces[static_cast<std::size_t>(f)].edge_count + 1;
  }
  const auto first = static_cast<std::int32_t>(solid.faces.size());
  for (const Face& face : result.faces) {
    append(result, face, solid);
    extend(extent, face.box);
  }
  index.add(solid, first);
  if (2 * gone_edges > solid.edges.size() + solid.faces.size()) {
    solid = present();
    begin();
  }
}

Chain::Chain(Solid first) : state_(std::make_unique<State>(std::move(first))) {}
Chain::Chain(Chain&&) noexcept = default;
Chain& Chain::operator=(Chain&&) noexcept = default;
Chain::~Chain() = default;

void Chain::apply(BooleanOp operation, const Solid& other) {
  Solid& solid = state_->solid;
  const Truth truth = truth_of(operation);
  if (other.space == solid.space) {
    state_->apply(truth, other);
    return;
  }
  if (other.space->grid_bits() > solid.space->grid_bits()) {
    solid = moved_to(state_->present(),
                     std::make_shared<Space>(other.space->grid_bits()));
    state_->begin();
  }
  state_->apply(truth, moved_to(other, solid.space));
}

Solid Chain::solid() const { return state_->present(); }

Solid combined(BooleanOp operation, std::span<const Solid> solids) {
  HALFSPACE_ASSERT(!solids.empty());
  const bool without = operation == BooleanOp::kDifference;
  const BooleanOp among = without ? BooleanOp::kUnion : operation;
  std::vector<Solid> level(solids.begin() + (without ? 1 : 0), solids.end());
  while (level.size() > 1) {
    std::vector<Solid> next;
    for (std::size_t i = 0; i + 1 < level.size(); i += 2)
      next.push_back(boolean(among, level[i], level[i + 1]));
    if (level.size() % 2 != 0) next.push_back(std::move(level.back()));
    level = std::move(next);
  }
  if (!without) return std::move(level[0]);
  return level.empty() ? solids[0] : boolean(operation, solids[0], level[0]);
}

}  // namespace halfspace::fast
