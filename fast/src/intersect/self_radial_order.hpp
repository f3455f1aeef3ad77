#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "intersect/point_location.hpp"
#include "intersect/radial_order.hpp"
#include "intersect/self_contacts.hpp"
#include "solid/dynamic_bvh.hpp"

namespace halfspace::fast {

/// The radial order of a surface's half-faces round its segments (WEI88), and
/// the winding numbers of the wedges between them.
class SelfRadialOrder {
 public:
  SelfRadialOrder(const Solid& solid, TableLease& lease);
  /// Of what is known; winding_outside() then knows the faces of the contacts.
  SelfRadialOrder(const Solid& solid, TableLease& lease, SelfContacts contacts,
                  DynamicBvh index);
  SelfRadialOrder(const SelfRadialOrder&) = delete;
  SelfRadialOrder& operator=(const SelfRadialOrder&) = delete;

  /// `winding`: what faces that are not the solid's, but of one surface with
  /// them, add to the winding number that a PointLocator finds.
  void set_rest(std::function<int(std::int32_t, std::int32_t)> winding) {
    winding_of_rest_ = std::move(winding);
  }

  SelfContacts& contacts() { return contacts_; }
  const DynamicBvh& index() const { return index_; }

  /// The faces that have the segment in them or along an edge, right beside its
  /// low end, by their angles round it.
  const std::vector<HalfFace>& at(const Segment& segment);
  /// The winding number of the wedge before the first of them.
  int winding_before_first(const Segment& segment) const;
  /// The winding number in front of the face, along its first edge.
  int winding_outside(std::int32_t face);

 private:
  const Face& face(std::int32_t f) const { return contacts_.operand.face(f); }
  void add_half_faces(std::int32_t f, const Segment& segment);

  const Solid& solid_;
  GeometryTable& table_;
  SelfContacts contacts_;
  DynamicBvh index_;
  PointLocator locator_;
  std::function<int(std::int32_t, std::int32_t)> winding_of_rest_;
  std::vector<HalfFace> half_faces_;
};

/// The boxes of all faces.
DynamicBvh index_of(const Solid& solid);

/// For each face that is not left out, the first one of those that it hangs
/// together with across edges that no others have.
std::vector<std::int32_t> parts_of_surface(
    const Operand& operand, const std::vector<std::uint8_t>& left_out);

}  // namespace halfspace::fast
