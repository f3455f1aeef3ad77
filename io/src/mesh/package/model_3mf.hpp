#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/io/attributes.hpp"
#include "halfspace/result.hpp"
#include "mesh/number_math.hpp"
#include "mesh/package/package.hpp"

namespace halfspace::io {

/// The namespaces of a 3MF model: of the core, of properties of materials, of
/// sets of triangles, of productions, and our own: where triangles come from,
/// and which material has texture points.
inline constexpr const char* kModelSpace =
    "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
inline constexpr const char* kMaterialSpace =
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";
inline constexpr const char* kSetSpace =
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07";
inline constexpr const char* kProductionSpace =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
inline constexpr const char* kOriginSpace = "urn:halfspace:origin";

/// A triangle of an object: vertices, and properties of a group.
struct Model3mfTriangle {
  std::array<std::uint32_t, 3> vertices{};
  std::int64_t group = -1;  ///< its id; -1 for none
  std::array<std::uint32_t, 3> properties{};
  std::array<std::int64_t, 2> origin = {-1, -1};  ///< solid, polygon
};

/// Triangles that have a name.
struct Model3mfSet {
  std::string name;
  std::string identifier;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;  ///< both in it
};

/// An object, placed.
struct Model3mfUse {
  std::int64_t object = -1;
  std::string part;  ///< of the package; empty: the same
  ExactMap map = identity_map();
  std::int64_t line = 0;
};

struct Model3mfObject {
  std::string name;
  std::vector<ExactPoint3> vertices;
  std::vector<Model3mfTriangle> triangles;
  std::vector<Model3mfSet> sets;
  std::vector<Model3mfUse> components;
};

/// A group of properties: materials, colours or texture points.
struct Model3mfGroup {
  std::vector<Material> materials;
  std::vector<std::array<double, 4>> colors;
  std::vector<std::array<double, 2>> texture;
  std::int64_t texture_id = -1;
  /// The material that has the texture: a group's id, and a place in it.
  std::int64_t material_group = -1;
  std::size_t material = 0;
  /// The surfaces of the materials: a list's id.
  std::int64_t surfaces_id = -1;
};

/// How metallic and how rough a surface is, from 0 to 1.
struct Model3mfSurface {
  double metallic = 0;
  double roughness = 1;
};

/// A model part of a 3MF package, as it stands.
struct Model3mf {
  Number unit{1, 0, 0};  ///< in millimetres
  std::map<std::int64_t, Model3mfObject> objects;
  std::map<std::int64_t, Model3mfGroup> groups;
  std::map<std::int64_t, std::string> textures;  ///< paths in the package
  std::map<std::int64_t, std::vector<Model3mfSurface>> surfaces;
  std::vector<Model3mfUse> items;
  std::map<std::size_t, std::string> origins;
};

/// Reads a model part.
/// Errors: those of the package; kSyntax, kNotFinite, kOutOfRange, kBadIndex,
///         kUnknownFormat (an extension that the model requires). The message
///         names the part and the line.
Result<Model3mf> read_model_3mf(const PackageReader& package,
                                const std::string& part);

}  // namespace halfspace::io
