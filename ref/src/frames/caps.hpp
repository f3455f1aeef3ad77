#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "../covering.hpp"
#include "halfspace/image.hpp"
#include "halfspace/ref/predicate.hpp"
#include "halfspace/scene.hpp"

/// The caps of clip planes (S10.3) as a camera sees them: what decides about
/// them at points of the image.
namespace halfspace::ref {

/// A plane as the camera sees it: P(e), and P(s) (S4.5), x and y counting
/// samples; both times the number of samples along a pixel.
struct SeenPlane {
  Rational at_eye;
  Affine at_image;

  SeenPlane(const Plane& plane, const Camera& camera, std::int32_t samples);
};

/// P(e) Q(s) - Q(e) P(s).
Affine crossed(const SeenPlane& p, const SeenPlane& q);

/// A polygon of the solid, and the planes through its edges that hold the eye.
struct Wall {
  int side;  ///< of the eye
  std::uint32_t part;
  SeenPlane plane;
  std::vector<Affine> edges;  ///< positive within
};

/// A clip plane, and the forms that decide about its cap.
struct CapPlane {
  SeenPlane plane;
  /// Positive where the sample's ray meets the plane where it can be seen, on
  /// the positive side of the other planes.
  std::vector<Affine> limits;
  /// Wall by wall: zero where its plane meets this one.
  std::vector<Affine> beside;
};

class Caps {
 public:
  /// The sign of a form at the point that is asked about.
  using SignOf = std::function<int(const Affine&)>;

  /// Requires: a closed scene; options.caps.
  Caps(const Scene& scene, const Camera& camera, const ImageOptions& options,
       std::int32_t samples);
  /// The same where rays meet none but these polygons.
  Caps(const Scene& scene, const Camera& camera, const ImageOptions& options,
       std::int32_t samples, std::span<const PolygonId> ids);

  /// The same for polygons that are no scene's.
  Caps(std::span<const Fragment> polygons, const Camera& camera,
       const ImageOptions& options, std::int32_t samples);

  std::size_t count() const { return planes_.size(); }
  const SeenPlane& plane(std::size_t k) const { return planes_[k].plane; }
  /// The part whose cap is there in plane k, all else left out, or that of
  /// several (CapItem); nothing where there is none.
  std::optional<std::size_t> part_at(std::size_t k,
                                     const SignOf& sign_of) const;
  bool shows(std::size_t k, const SignOf& sign_of) const {
    return part_at(k, sign_of).has_value();
  }
  /// All forms that shows() asks about the sign of.
  std::vector<Affine> forms() const;

 private:
  std::vector<Affine> limits_of(const Camera& camera, std::size_t k) const;
  std::map<std::uint32_t, int> windings_behind(std::size_t k,
                                               const SignOf& sign_of) const;

  bool cull_;
  std::shared_ptr<const CapParts> parts_;
  std::vector<Wall> walls_;
  std::vector<CapPlane> planes_;
};

}  // namespace halfspace::ref
