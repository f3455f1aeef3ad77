#include "halfspace/csg/turned.hpp"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace halfspace::csg {
namespace {

void add_face(Faces& faces, std::span<const std::uint32_t> corners) {
  for (const std::uint32_t corner : corners)
    faces.corners.push_back(static_cast<VertexId>(corner));
  faces.first_corner.push_back(
      static_cast<std::uint32_t>(faces.corners.size()));
}

void add_face(Faces& faces, std::initializer_list<std::uint32_t> corners) {
  add_face(faces, std::span(corners.begin(), corners.size()));
}

class Turning {
 public:
  Turning(std::span<const TurnedPoint> outline, std::uint32_t steps)
      : outline_(outline), steps_(steps) {}

  TurnedFaces faces() && {
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      first_.push_back(static_cast<std::uint32_t>(result_.vertices.size()));
      const std::uint32_t count =
          !outline_[i].is_on_axis ? steps_ : (is_tip(i) ? 1 : 0);
      for (std::uint32_t k = 0; k < count; ++k)
        result_.vertices.push_back({static_cast<std::uint32_t>(i), k});
    }
    for (std::size_t i = 0; i < outline_.size(); ++i) add_band(i);
    return std::move(result_);
  }

 private:
  std::size_t next(std::size_t i) const { return (i + 1) % outline_.size(); }

  /// Whether an edge between a point on the axis and one that is not has
  /// triangles.
  bool has_triangles(std::size_t i) const {
    return !outline_[i].is_level &&
           outline_[i].is_on_axis != outline_[next(i)].is_on_axis;
  }
  bool is_tip(std::size_t i) const {
    const std::size_t before = (i + outline_.size() - 1) % outline_.size();
    return has_triangles(i) || has_triangles(before);
  }
  std::uint32_t vertex(std::size_t point, std::uint32_t k) const {
    return first_[point] + (outline_[point].is_on_axis ? 0 : k % steps_);
  }

  /// The polygons that the edge from a point to the next passes over.
  void add_band(std::size_t i) {
    const std::size_t j = next(i);
    const bool i_on = outline_[i].is_on_axis, j_on = outline_[j].is_on_axis;
    if (i_on && j_on) return;
    if ((i_on || j_on) && outline_[i].is_level) {
      std::vector<std::uint32_t> disc;
      for (std::uint32_t k = 0; k < steps_; ++k)
        disc.push_back(vertex(i_on ? j : i, k));
      if (i_on) std::reverse(disc.begin(), disc.end());
      add_face(result_.faces, disc);
      return;
    }
    for (std::uint32_t k = 0; k < steps_; ++k) {
      if (i_on) {
        add_face(result_.faces, {vertex(i, 0), vertex(j, k + 1), vertex(j, k)});
      } else if (j_on) {
        add_face(result_.faces, {vertex(i, k), vertex(i, k + 1), vertex(j, 0)});
      } else {
        add_face(result_.faces, {vertex(i, k), vertex(i, k + 1),
                                 vertex(j, k + 1), vertex(j, k)});
      }
    }
  }

  std::span<const TurnedPoint> outline_;
  std::uint32_t steps_;
  std::vector<std::uint32_t> first_;  ///< vertices, by point
  TurnedFaces result_;
};

}  // namespace

Faces prism_faces(std::uint32_t n) {
  Faces faces;
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t i = 0; i < n; ++i) {
    bottom.push_back(n - 1 - i);
    top.push_back(n + i);
  }
  add_face(faces, bottom);
  add_face(faces, top);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    add_face(faces, {i, j, n + j, n + i});
  }
  return faces;
}

TurnedFaces turned_faces(std::span<const TurnedPoint> outline,
                         std::uint32_t steps) {
  return Turning(outline, steps).faces();
}

}  // namespace halfspace::csg
