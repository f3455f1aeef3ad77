#pragma once

#include <cstdint>
#include <vector>

#include "intersect/radial_order.hpp"
#include "intersect/self_contacts.hpp"
#include "solid/dynamic_bvh.hpp"

namespace halfspace::fast {

/// What is round the edges of one surface, and how often it winds round that.
class SelfWings {
 public:
  SelfWings(const Solid& solid, TableLease& lease);
  SelfWings(const SelfWings&) = delete;
  SelfWings& operator=(const SelfWings&) = delete;

  SelfContacts& contacts() { return contacts_; }
  const FaceIndex& index() const { return index_; }

  /// The faces that have the segment in them or along an edge, right beside its
  /// low end, by their angles round it.
  const std::vector<Wing>& at(const Segment& segment);
  /// How often the surface winds round the wedge before the first of them.
  int level_before_first(const Segment& segment) const;
  /// How often it winds round what is before the face, along its first edge.
  int level_outside(std::int32_t face);

 private:
  const Face& face(std::int32_t f) const { return contacts_.operand.face(f); }
  void add_wings(std::int32_t f, const Segment& segment);

  const Solid& solid_;
  GeometryTable& table_;
  SelfContacts contacts_;
  FaceIndex index_;
  Locator locator_;
  std::vector<Wing> wings_;
};

/// For each face that is not left out, the first one of those that it hangs
/// together with across edges that no others have.
std::vector<std::int32_t> parts_of_surface(
    const Operand& operand, const std::vector<std::uint8_t>& left_out);

}  // namespace halfspace::fast
