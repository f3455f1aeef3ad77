#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/io/mesh.hpp"
#include "mesh/glb/gltf_accessor.hpp"
#include "mesh/glb/gltf_file.hpp"
#include "mesh/label_maker.hpp"
#include "mesh/number_math.hpp"

namespace halfspace::io {

/// Some triangles of a mesh that are a primitive's: the last that were added.
struct GltfTriangles {
  const Json* primitive;
  std::string place;         ///< what errors call it
  std::size_t vertex_count;  ///< of the primitive
  /// By corner its vertex in the primitive, as the mesh has them.
  std::vector<std::size_t> corners;
  /// What places the primitive, in the file's axes.
  const ExactMap* map;
};

/// What a glTF says of its triangles besides their geometry, while they are
/// added to a mesh, primitive by primitive.
class GltfAttributes {
 public:
  GltfAttributes(const GltfFile& file, Mesh& mesh) : file_(file), mesh_(mesh) {}

  /// Reads the materials. Errors: kBadIndex, kSyntax, kNotFinite.
  std::optional<Error> read_materials();
  /// The primitives from here on are an object's of this name.
  void name_object(const std::string& name) { objects_.name_from_here(name); }
  /// Adds what the file says of these, which the mesh has already.
  std::optional<Error> add(const GltfTriangles& triangles);
  /// Makes it the mesh's.
  void finish();

 private:
  /// One channel that some primitives have, and others may lack.
  struct GrowingChannel {
    Channel channel;
    std::string semantic;
  };
  std::optional<Error> read_material(const Json& json, std::size_t i);
  std::optional<Error> read_texture(const Json& pbr, const std::string& place,
                                    Material& material);
  std::optional<Error> read_image(const Json& image, std::int64_t id,
                                  const std::string& place, Material& material);
  void add_names(const GltfTriangles& triangles, std::int64_t material);
  std::optional<Error> add_channels(const GltfTriangles& triangles);
  Channel& channel_for(const std::string& semantic, std::size_t width);
  std::optional<Error> add_origins(const GltfTriangles& triangles);

  const GltfFile& file_;
  Mesh& mesh_;
  /// By number the images that were read, and what they are called.
  std::map<std::int64_t, std::pair<std::string, std::shared_ptr<const Image>>>
      images_;
  LabelMaker objects_;
  LabelMaker groups_;
  std::vector<GrowingChannel> channels_;
  std::vector<std::int32_t> face_materials_;
  std::array<std::vector<double>, 2> origins_;
};

}  // namespace halfspace::io
