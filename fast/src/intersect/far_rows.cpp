#include "intersect/far_rows.hpp"

#include <utility>

namespace halfspace::fast {

/// How many edges from this one on are known to be far, and form a chain or
/// whole loops. `loop`: where the current loop begins.
std::uint32_t FarRows::far_from(std::uint32_t edge, std::uint32_t& loop) {
  if (list_ != nullptr) {
    const auto blocks = list_->blocks();
    while (block_ < blocks.size() && blocks[block_].first < edge) ++block_;
    if (block_ < blocks.size() && blocks[block_].first == edge &&
        !overlap(blocks[block_].box, operand_.reach)) {
      const EdgePacket& block = blocks[block_];
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

}  // namespace halfspace::fast
