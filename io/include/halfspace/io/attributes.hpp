#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "halfspace/polygon.hpp"

namespace halfspace::io {

/// What stands for a number that is not there.
inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// An image that colours are from: a file of its own, or bytes that were in a
/// mesh's file.
struct Image {
  std::filesystem::path file = {};  ///< empty: the bytes are here
  std::string bytes = {};           ///< a PNG or a JPEG
  friend bool operator==(const Image&, const Image&) = default;
};

/// A material: what the formats have in common.
struct Material {
  std::string name;
  std::optional<Rgb> color = std::nullopt;  ///< diffuse, or base colour
  double opacity = 1;                       ///< 0 to 1
  /// The image that its colour is from, as the mesh's file calls it.
  std::string texture = {};
  /// That image; null where there is none, or where it was not found.
  std::shared_ptr<const Image> image = nullptr;
  /// From 0 to 1; nothing where the file does not say.
  std::optional<double> metallic = std::nullopt;
  std::optional<double> roughness = std::nullopt;
  /// Images are equal where they are the same file or the same bytes.
  friend bool operator==(const Material& a, const Material& b) {
    return a.name == b.name && a.color == b.color && a.opacity == b.opacity &&
           a.texture == b.texture && a.metallic == b.metallic &&
           a.roughness == b.roughness &&
           (a.image == b.image || (a.image && b.image && *a.image == *b.image));
  }
};

/// A name for each face that has one.
struct Labels {
  std::vector<std::string> names;
  /// By face its name's place, -1 for none; empty where no face has one.
  std::vector<std::int32_t> of_face;
  friend bool operator==(const Labels&, const Labels&) = default;
};

/// What the numbers of a channel are. A map that moves a mesh moves its
/// normals.
enum class ChannelKind : std::uint8_t {
  kNumber,   ///< any
  kTexture,  ///< coordinates in an image, v upwards
  kNormal,   ///< a direction
  kColor     ///< red, green, blue and, of width 4, opacity; from 0 to 1
};

/// Numbers at the corners, or at the faces, of a mesh.
///
/// Shape: `values` has `width` numbers for each corner of the faces in order,
///        or for each face; kNoValue where there is none.
struct Channel {
  std::string name;  ///< `uv`, `normal`, `color`, or what the file calls it
  ChannelKind kind = ChannelKind::kNumber;
  std::size_t width = 1;
  std::vector<double> values = {};
  /// Whether each is a whole number of 32 bits.
  bool is_integer = false;

  /// The numbers of a corner or a face.
  std::span<const double> at(std::size_t place) const {
    return {values.data() + place * width, width};
  }
};

/// What a file says of its faces besides their geometry.
struct Attributes {
  std::vector<Material> materials;
  /// By face its material, -1 for none; empty where no face has one.
  std::vector<std::int32_t> face_materials;
  Labels objects;
  Labels groups;
  std::vector<Channel> corners;
  std::vector<Channel> faces;
  /// Of a result that says where its faces come from, in channels
  /// `origin_solid` and `origin_polygon`: the names of the solids.
  std::vector<std::string> origins;
  /// Files beside the mesh's own that were read for it.
  std::vector<std::filesystem::path> files;
  /// What was passed over of the file, a sentence each.
  std::vector<std::string> notes;

  /// Whether no face has any.
  bool empty() const {
    return face_materials.empty() && objects.of_face.empty() &&
           groups.of_face.empty() && corners.empty() && faces.empty();
  }
};

/// The channel of this name; null where there is none.
const Channel* channel_named(const std::vector<Channel>& channels,
                             const std::string& name);

/// The colour of three numbers or more, rounded to 8 bits and kept within them;
/// nothing where one is none.
std::optional<Rgb> rgb_of(std::span<const double> values);

/// The channel of those colours, width 3; one entry where there is none is
/// kNoValue.
Channel color_channel(const std::vector<std::optional<Rgb>>& colors);

/// What there is, in words such as `groups`.
std::vector<std::string> words_of(const Attributes& attributes);

/// Faces of a mesh in doubles, with what a file says of them.
struct AttributedFaces {
  std::vector<std::array<double, 3>> vertices;  ///< rounded; model units
  std::vector<std::uint32_t> first_corner = {0};
  std::vector<VertexId> corners;
  Attributes attributes;
};

}  // namespace halfspace::io
