#include "halfspace/io/format.hpp"

#include <algorithm>

#include "mesh/format_table.hpp"
#include "mesh/readers.hpp"
#include "mesh/writers.hpp"

namespace halfspace::io {
namespace {

Result<std::string> encoded_obj(const MeshContent& content) {
  return obj_text(content.texts, content.faces, content.attributes,
                  content.library);
}

Result<std::string> encoded_stl(const MeshContent& content) {
  return stl_binary(content.doubles, content.triangles);
}

Result<std::string> encoded_ply(const MeshContent& content) {
  return content.texts.empty()
             ? ply_binary(content.doubles, content.faces, content.attributes,
                          content.textures)
             : ply_text(content.texts, content.faces, content.attributes,
                        content.textures);
}

Result<std::string> encoded_off(const MeshContent& content) {
  return off_text(content.texts, content.faces);
}

/// A reader of what is in the file alone.
template <Result<Mesh> (*read)(std::string_view, const Stop&)>
Result<Mesh> read_alone(std::string_view bytes, const std::filesystem::path*,
                        const Stop& stop) {
  return read(bytes, stop);
}

Result<Mesh> read_obj_in(std::string_view bytes,
                         const std::filesystem::path* folder,
                         const Stop& stop) {
  Result<Mesh> mesh = read_obj(bytes, stop);
  if (mesh && !mesh->attributes.files.empty()) add_materials(folder, *mesh);
  return mesh;
}

Result<Mesh> read_ply_in(std::string_view bytes,
                         const std::filesystem::path* folder,
                         const Stop& stop) {
  Result<Mesh> mesh = read_ply(bytes, stop);
  if constexpr (kHasImages) {
    if (mesh) find_images(folder, *mesh);
  }
  return mesh;
}

using enum Coordinates;
constexpr unsigned kObjRoom = kMaterialRoom | kObjectRoom | kGroupRoom |
                              kTextureRoom | kNormalRoom | kCornerColorRoom |
                              kFaceColorRoom;
constexpr unsigned kPlyRoom = kObjRoom | kCornerNumberRoom | kFaceNumberRoom;
constexpr unsigned k3mfRoom = kMaterialRoom | kObjectRoom | kGroupRoom |
                              kCornerColorRoom | kFaceColorRoom | kOriginRoom;
constexpr unsigned kGlbRoom = kObjRoom | kCornerNumberRoom | kOriginRoom;

/// In the order of the enumerators.
constexpr FormatEntry kFormats[] = {
    {Format::kObj, "OBJ", ".obj", kText, false, kObjRoom, read_obj_in,
     encoded_obj},
    {Format::kStl, "STL", ".stl", kFloats, true, 0, read_alone<read_stl>,
     encoded_stl},
    {Format::kPly, "PLY", ".ply", kTextOrDoubles, false, kPlyRoom, read_ply_in,
     encoded_ply},
    {Format::kOff, "OFF", ".off", kText, false, kFaceColorRoom,
     read_alone<read_off>, encoded_off},
    {Format::k3mf, "3MF", ".3mf", kFloats, true, k3mfRoom, read_alone<read_3mf>,
     three_mf_bytes},
    {Format::kGlb, "GLB", ".glb", kFloats, true, kGlbRoom, read_gltf,
     glb_bytes},
    {Format::kGltf, "glTF", ".gltf", kFloats, true, kGlbRoom, read_gltf,
     gltf_text}};

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace

std::span<const FormatEntry> format_table() { return kFormats; }

const FormatEntry* entry_of(Format format) {
  const auto i = static_cast<std::size_t>(format);
  return i < std::size(kFormats) ? &kFormats[i] : nullptr;
}

std::optional<Format> format_of(const std::filesystem::path& path) {
  std::filesystem::path name = path.filename();
  if (lower_extension(name) == ".gz") name = name.stem();
  const std::string extension = lower_extension(name);
  const auto entry = std::find_if(
      std::begin(kFormats), std::end(kFormats),
      [&](const FormatEntry& e) { return e.extension == extension; });
  if (entry == std::end(kFormats)) return std::nullopt;
  return entry->format;
}

bool has_floats(Format format) {
  const FormatEntry* entry = entry_of(format);
  return entry != nullptr && entry->coordinates == Coordinates::kFloats;
}

std::string format_extensions(std::string_view other) {
  std::vector<std::string_view> words;
  for (const FormatEntry& entry : kFormats) words.push_back(entry.extension);
  if (!other.empty()) words.push_back(other);
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) list += i + 1 < words.size() ? ", " : " or ";
    list += words[i];
  }
  return list;
}

std::vector<std::string> lost_words(const Attributes& attributes,
                                    unsigned room) {
  std::vector<std::string> words;
  const auto note = [&](bool is_there, unsigned bit, const std::string& what) {
    if (is_there && (room & bit) == 0) words.push_back(what);
  };
  note(!attributes.face_materials.empty(), kMaterialRoom, "materials");
  note(!attributes.objects.of_face.empty(), kObjectRoom, "names of objects");
  note(!attributes.groups.of_face.empty(), kGroupRoom, "groups");
  for (const Channel& channel : attributes.corners) {
    switch (channel.kind) {
      case ChannelKind::kTexture:
        note(true, kTextureRoom, "texture points");
        break;
      case ChannelKind::kNormal:
        note(true, kNormalRoom, "normals");
        break;
      case ChannelKind::kColor:
        note(true, kCornerColorRoom, "colours of corners");
        break;
      case ChannelKind::kNumber:
        note(true, kCornerNumberRoom, "numbers of corners: " + channel.name);
    }
  }
  for (const Channel& channel : attributes.faces) {
    const bool is_color = channel.kind == ChannelKind::kColor;
    note(is_color, kFaceColorRoom, "colours of faces");
    const bool is_origin =
        channel.name == "origin_solid" || channel.name == "origin_polygon";
    note(!is_color, is_origin ? kFaceNumberRoom | kOriginRoom : kFaceNumberRoom,
         "numbers of faces: " + channel.name);
  }
  return words;
}

std::vector<std::string> words_of(const Attributes& attributes) {
  return lost_words(attributes, 0);
}

std::string format_names() {
  std::string list;
  for (const FormatEntry& entry : kFormats) {
    if (!list.empty()) list += ", ";
    list += entry.name;
  }
  return list;
}

}  // namespace halfspace::io
