#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "halfspace/api.hpp"
#include "halfspace/display.hpp"
#include "halfspace/image.hpp"
#include "halfspace/mesh.hpp"
#include "halfspace/result.hpp"
#include "halfspace/solid.hpp"

namespace halfspace {

/// What MovingPicture::polygons has at the cap of the first clip plane (S10.3);
/// at those of others one less each.
constexpr std::int32_t kFirstCap = -2;

/// A picture of objects: at each pixel its colour, whose polygon is seen at its
/// centre, or at each of its samples, and which one of that model's mesh.
struct HALFSPACE_API MovingPicture {
  ColorImage colors;
  /// 0: the world's; kBackground where there is none, and at caps that
  /// View::caps_by_solid does not tell apart, or several objects have.
  ItemImage objects;
  ItemImage polygons;  ///< of the mesh; kBackground where there is none

  /// Writes the colours as PNG, large ones in all threads that the machine has.
  /// Error: kUnwritable.
  Result<Done> save(const std::filesystem::path& path) const;
};

/// A world with objects that move, come and go while no tree of what they are
/// made of changes (S12; FAG83 sec. 4.1).
///
/// An object is a model in a region, which no other region of its owner shares
/// and no polygon of its owner reaches into. The world is model 0 and object 0.
/// One object may be changed by one thread, and shown by several.
///
/// Units:  model units, of each model its own as its mesh has them.
/// Source: S12 of spec/, with the papers that it names.
class HALFSPACE_API MovingDisplay {
 public:
  /// The world's polygons, which stay where they are. Errors: those of
  /// Display::of().
  static Result<MovingDisplay> of(const Mesh& world);

  MovingDisplay(MovingDisplay&&) noexcept;
  MovingDisplay& operator=(MovingDisplay&&) noexcept;
  ~MovingDisplay();

  /// Takes polygons that objects are made of, and returns the model's number.
  /// Errors: those of Display::of().
  Result<std::int32_t> add_model(const Mesh& mesh);

  /// Adds an object of a model to the world, or to every object of another
  /// model, and returns its number. Its region is a box, by two corners, or the
  /// convex hull of 4 to 30 points; they are rounded to the owner's grid.
  /// It is not there before it is placed.
  /// Cost:   the owner's tree, made anew when the next picture is. The models'
  ///         own trees stay.
  /// Errors: kBadIndex (no such model; one that is not after its owner);
  ///         kNotFinite; kOutOfRange (no region; one that shares space with
  ///         another one of the owner).
  Result<std::int32_t> insert(std::int32_t model, std::span<const Point> region,
                              std::int32_t owner = 0);
  /// Takes an object away for good; its region is free for others. The others
  /// keep their numbers. Cost: as of insert(). Error: kBadIndex.
  Result<Done> remove(std::int32_t object);

  /// Where an object stands in its owner, rounded to some 20 bits; and that it
  /// is not there. Cost: none. Error: kBadIndex.
  Result<Done> place(std::int32_t object, const AffineMap& map);
  Result<Done> hide(std::int32_t object);

  /// The picture, exact: that of all polygons moved (S12.5). With
  /// View::caps_by_solid each object has a look of its own.
  /// Cost:   that of the world, and a walk for each object that is seen; with
  ///         anti-aliasing, an alpha or a colour of back faces a tree of all
  ///         that has moved (S12.7).
  /// Errors: those of Display::render(); kOutOfRange (an object that leaves its
  ///         region; a region that is not free, or that is interlocked with
  ///         others; a tree of all whose grid does not hold what has moved);
  ///         kZeroArea (a singular map).
  Result<MovingPicture> render(const View& view = {}) const;

 private:
  struct State;
  explicit MovingDisplay(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace halfspace
