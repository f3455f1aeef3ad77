#pragma once

#include <memory>
#include <vector>

#include "halfspace/io/mesh.hpp"
#include "halfspace/result.hpp"
#include "halfspace/solid.hpp"
#include "halfspace/viewer/model.hpp"
#include "halfspace/viewer/state.hpp"

namespace halfspace::viewer {

/// Several parts as one mesh.
struct CombinedMesh {
  io::Mesh mesh;
  std::vector<std::uint32_t> parts;  ///< of each face; kCapPart: none
  std::vector<PolygonId> faces;      ///< of each face, in its part's file
};

/// A part of a state and the mesh in its file.
struct ReadPart {
  std::uint32_t index = 0;
  const Part* part = nullptr;
  std::shared_ptr<const io::Mesh> mesh;
};

/// The parts beside each other, shifted and coloured.
/// Exact: yes.
CombinedMesh joined(const std::vector<ReadPart>& parts);

/// Gives the faces that are none of a cut the colours that the state asks for.
void color_faces(const std::vector<ReadPart>& parts, Coloring coloring,
                 CombinedMesh& mesh);

/// What the boolean, and sections of solids, make of the parts, each face in
/// the colour of the part that it comes from, caps in one of their own.
/// Exact:  rounded to doubles, once.
/// Errors: those of Solid::mesh(); kEmpty.
Result<CombinedMesh> combined(const std::vector<ReadPart>& parts,
                              const State& state, Sections sections,
                              const Report& report);

/// The solid of a state's visible parts: their boolean, or their union.
Solid solid_of(const State& state);

/// The same boolean, written to a file.
/// Errors: also those of Solid::save().
Result<Done> save_combined(const State& state,
                           const std::filesystem::path& path,
                           const Report& report);

/// The surface of the exact solid in a `.hsolid` file, in doubles.
/// Errors: those of Solid::mesh(), which name the file.
Result<io::Mesh> mesh_of_solid(const std::string& path);

/// The polygons of a scene as a mesh.
io::Mesh mesh_of(const Scene& scene);

}  // namespace halfspace::viewer
