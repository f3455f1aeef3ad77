#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/clip.hpp"
#include "halfspace/polygon.hpp"

namespace halfspace::fast {

/// The winding numbers of parts at a point of a clip plane (S10.6), while it
/// moves: what is asked costs nothing, whatever the number of parts.
class CapWindings {
 public:
  /// Of all polygons as one part where there are none.
  explicit CapWindings(const CapParts* parts)
      : parts_(parts), windings_(parts != nullptr ? parts->count() : 1) {}

  void add(PolygonId polygon, std::int32_t by) {
    const std::uint32_t part =
        parts_ != nullptr ? parts_->part_of[static_cast<std::size_t>(polygon)]
                          : 0;
    add_to(part, by);
  }
  void add_to(std::uint32_t part, std::int32_t by) {
    std::int32_t& own = windings_[part];
    if (own == 0) touched_.push_back(part);
    const bool was_inside = own > 0;
    own += by;
    all_ += by;
    if (was_inside == (own > 0)) return;
    // Of the parts whose number is positive their count and the sum of their
    // ids, which is the only one's.
    count_ += was_inside ? -1 : 1;
    sum_ += was_inside ? 0 - std::size_t{part} : std::size_t{part};
  }
  bool is_cap() const { return all_ > 0; }
  /// CapItem::part. Requires: is_cap().
  std::size_t part() const {
    return parts_ == nullptr || count_ == 1 ? sum_ : parts_->count();
  }
  /// To where all are 0.
  void clear() {
    for (const std::uint32_t part : touched_) windings_[part] = 0;
    touched_.clear();
    all_ = 0;
    count_ = 0;
    sum_ = 0;
  }

 private:
  const CapParts* parts_;
  std::vector<std::int32_t> windings_;
  std::vector<std::uint32_t> touched_;  ///< that may not be 0
  std::int32_t all_ = 0;
  std::int32_t count_ = 0;
  std::size_t sum_ = 0;
};

}  // namespace halfspace::fast
