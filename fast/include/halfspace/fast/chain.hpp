#pragma once

#include <memory>
#include <span>

#include "halfspace/boolean.hpp"
#include "halfspace/fast/solid.hpp"

namespace halfspace::fast {

/// A solid that one boolean after another changes in place.
///
/// The same point sets as by boolean(), and the same faces but for their order
/// and `Face::source`, which means nothing here. A solid is best made with
/// to_solid(solid, chain.solid()), which spares moving it to the chain's table.
///
/// Threads: a chain is for one thread at a time; other threads may use the
///          solids that went in or came out.
class Chain {
 public:
  explicit Chain(Solid first);
  Chain(Chain&&) noexcept;
  Chain& operator=(Chain&&) noexcept;
  ~Chain();

  /// Exact: yes.
  /// Cost:  the faces near the other solid, as of boolean(), and what it takes
  ///        to find them: amortised, (log n)^2 for each that comes or goes. Of
  ///        an intersection: the result.
  void apply(BooleanOp operation, const Solid& other);

  /// The solid as it is now. Cost: a copy; of a chain that is no longer needed,
  /// none where the last boolean left nothing of it as it was.
  Solid solid() const&;
  Solid solid() &&;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The union, intersection or symmetric difference (the points in an odd
/// number) of all solids, or the first one without the others. Pairs first,
/// then pairs of pairs, so that n solids that are apart cost n log n.
/// `Face::source` means nothing here.
///
/// The same point set as one after the other. With `Merge::kPlane`, the same
/// mesh, whatever the order of the solids of a union (S6.4). With more threads
/// (0: as many as the machine has) blocks of solids are combined at once, each
/// in a table of its own: the faces
/// and the mesh are the same, but points and planes may have other ids.
/// Requires: not empty, and all in one unit.
Solid boolean_all(BooleanOp operation, std::span<const Solid> solids,
                  int threads = 1);

}  // namespace halfspace::fast
