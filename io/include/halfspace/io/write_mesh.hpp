#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "halfspace/io/attributes.hpp"
#include "halfspace/polygon.hpp"
#include "halfspace/result.hpp"
#include "halfspace/scene.hpp"

namespace halfspace::io {

/// A mesh to write, already rounded to doubles. Units: model units.
///
/// The corners of face `f` are `corners[first_corner[f]]` up to but not
/// including `corners[first_corner[f + 1]]`.
/// Shape: colors is empty or has one entry a face, and so has has_color.
struct OutputMesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::uint32_t> first_corner = {0};
  std::vector<VertexId> corners;
  std::vector<Rgb> colors;
  /// Whether decimals are the doubles' exact values, however long, and not the
  /// shortest from which they read back: then those who read decimals exactly
  /// have the same points.
  bool exact_decimals = false;
  /// Null where there are none.
  std::shared_ptr<const Attributes> attributes = nullptr;
  /// By face whether it has its colour; empty: all have.
  std::vector<bool> has_color = {};
  /// How many threads write digits; 0: as many as the machine has. The file is
  /// the same.
  int threads = 1;
};

/// What writing did to a mesh (S1.8).
struct ExportReport {
  std::size_t moved = 0;         ///< coordinates that the file holds rounded
  double max_move = 0;           ///< how far at most. Units: model units
  std::size_t triangulated = 0;  ///< faces cut into triangles, for STL
  /// What the format has no room for, such as `groups`.
  std::vector<std::string> lost = {};
  /// What was not to be had for it, such as an image, a sentence each.
  std::vector<std::string> notes = {};
};

/// Where the materials of an OBJ go: a file of the same name beside it that
/// ends in `.mtl`.
std::filesystem::path material_path(const std::filesystem::path& obj);

/// Writes a mesh in the format that the file's name tells (S1.8), gzipped if it
/// ends in `.gz`.
///
/// OBJ and OFF are text of the shortest decimals from which the same doubles
/// read back, or of exact ones where that is asked for; PLY is binary, in
/// doubles; STL is binary, in floats, and moves what those do not hold. STL has
/// triangles only: a face of more corners is cut into a fan from its first.
/// Colours go into PLY and OFF: in a PLY, all of whose faces have colours if
/// one has, faces without one have the usual one. Attributes go where the
/// format has room, an OBJ's materials, and colours of faces as such, into
/// material_path(path); the report says what is lost.
///
/// Images go into a 3MF, a GLB or a glTF. An OBJ or a PLY names their files;
/// those that have none are written beside it, under names that no other file
/// has.
///
/// Errors:   kBadIndex (a corner names no vertex, its index being that of the
///           corner; or a shape is not as above); kTooFewVertices (a face
///           has fewer than 3 corners); kUnwritable (nothing is left at the
///           path); kUnknownFormat; kNotFinite (a coordinate is not finite, or
///           not as a float); kOutOfRange (more triangles than an STL counts).
Result<ExportReport> write_mesh(const std::filesystem::path& path,
                                const OutputMesh& mesh);

/// The same, or not `beside`: without a file of materials.
Result<ExportReport> write_mesh(const std::filesystem::path& path,
                                const OutputMesh& mesh, bool beside);

/// Writes a scene in the format that the file's name tells (S1.8).
///
/// OBJ, OFF and PLY hold every coordinate exactly, as a decimal, if it has at
/// most 80 characters, and else the double next to it; PLY is binary if the
/// unit's base is 2 and doubles are exact. STL is as for a mesh, but polygons
/// are cut so that straight corners make no triangle without area.
///
/// Errors: as for a mesh; kOutOfRange, too, for a polygon of over 100,000
///         corners in an STL.
Result<ExportReport> write_scene_mesh(const std::filesystem::path& path,
                                      const Scene& scene);

/// The same with attributes of the scene's polygons and corners, which may be
/// null, and by polygon whether it has its colour; empty: all have.
Result<ExportReport> write_scene_mesh(const std::filesystem::path& path,
                                      const Scene& scene,
                                      const Attributes* attributes, bool beside,
                                      const std::vector<bool>& has_color = {});

}  // namespace halfspace::io
