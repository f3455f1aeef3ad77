#include "mesh/glb/gltf_attributes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/plain_file.hpp"
#include "halfspace/message.hpp"
#include "mesh/glb/glb.hpp"
#include "mesh/images.hpp"

namespace halfspace::io {
namespace {

using Turn = std::array<std::array<double, 3>, 3>;

constexpr const char* kOriginNames[] = {"origin_solid", "origin_polygon"};

/// The map's cofactors, by which normals are turned.
Turn turn_of(const ExactMap& map) {
  Turn m{}, turn{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) m[i][k] = to_double(map.rows[i][k]);
  }
  const bool is_mirrored = is_mirror(map);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      turn[i][k] = m[(i + 1) % 3][(k + 1) % 3] * m[(i + 2) % 3][(k + 2) % 3] -
                   m[(i + 1) % 3][(k + 2) % 3] * m[(i + 2) % 3][(k + 1) % 3];
      if (is_mirrored) turn[i][k] = -turn[i][k];
    }
  }
  return turn;
}

std::array<double, 3> turned(const Turn& turn, const double* normal) {
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) result[i] += turn[i][k] * normal[k];
  }
  const double length = std::hypot(result[0], result[1], result[2]);
  if (length > 0) {
    for (double& value : result) value /= length;
  }
  return result;
}

/// A number from 0 to 1, if there is one of the name.
Result<std::optional<double>> share_in(const Json& json, const char* name,
                                       const std::string& place) {
  const auto found = json.find(name);
  if (found == json.end()) return std::optional<double>();
  if (!found->is_number()) {
    return Error{ErrorCode::kSyntax, place + "." + name + " is no number"};
  }
  return std::optional(std::clamp(found->get<double>(), 0.0, 1.0));
}

/// Adds what a vertex has to a channel: turned, and as other files have it.
void append_row(const Accessor& from, std::size_t row, const Turn& turn,
                Channel& to) {
  std::array<double, 4> values{kNoValue, kNoValue, kNoValue, 1};
  for (std::size_t k = 0; k < std::min<std::size_t>(from.width(), 4); ++k) {
    values[k] = from.number(row, k);
    if (!std::isfinite(values[k])) values[k] = kNoValue;
  }
  if (to.kind == ChannelKind::kTexture) {
    values[1] = 1 - values[1];
  } else if (to.kind == ChannelKind::kColor) {
    for (std::size_t k = 0; k < 3; ++k)
      values[k] = share_of_linear(std::clamp(values[k], 0.0, 1.0));
  } else if (to.kind == ChannelKind::kNormal) {
    const auto normal = turned(turn, values.data());
    // The file's y points up, and its z to the front; ours are z and -y.
    values = {normal[0], 0 - normal[2], normal[1], 1};
  }
  to.values.insert(to.values.end(), values.begin(),
                   values.begin() + static_cast<std::ptrdiff_t>(to.width));
}

}  // namespace

std::optional<Error> GltfAttributes::read_materials() {
  const auto list = list_in(file_.json, "materials", "the file");
  if (!list) return list.error();
  for (std::size_t i = 0; i < (*list)->size(); ++i) {
    const auto json = entry_at(file_.json, "materials",
                               static_cast<std::int64_t>(i), "the file");
    if (!json) return json.error();
    if (auto error = read_material(**json, i)) return error;
  }
  return std::nullopt;
}

std::optional<Error> GltfAttributes::read_material(const Json& json,
                                                   std::size_t i) {
  const std::string place = item("materials", i);
  Material material{text_in(json, "name")};
  if (material.name.empty()) material.name = "material " + std::to_string(i);
  if (const Json* pbr = object_in(json, "pbrMetallicRoughness")) {
    const auto factor =
        doubles_in(*pbr, "baseColorFactor", {1, 1, 1, 1}, place);
    if (!factor) return factor.error();
    std::array<double, 3> shares{};
    for (std::size_t k = 0; k < 3; ++k)
      shares[k] = share_of_linear(std::clamp((*factor)[k], 0.0, 1.0));
    material.color = rgb_of(shares);
    material.opacity = std::clamp((*factor)[3], 0.0, 1.0);
    const auto metallic = share_in(*pbr, "metallicFactor", place);
    if (!metallic) return metallic.error();
    // What is no metal is what all others are, too.
    if (*metallic != 0.0) material.metallic = metallic->value_or(1);
    const auto roughness = share_in(*pbr, "roughnessFactor", place);
    if (!roughness) return roughness.error();
    material.roughness = *roughness;
    if (auto error = read_texture(*pbr, place, material)) return error;
  }
  mesh_.attributes.materials.push_back(std::move(material));
  return std::nullopt;
}

std::optional<Error> GltfAttributes::read_texture(const Json& pbr,
                                                  const std::string& place,
                                                  Material& material) {
  const Json* use = object_in(pbr, "baseColorTexture");
  if (use == nullptr) return std::nullopt;
  const auto index = whole(*use, "index", 0, place);
  if (!index) return index.error();
  const auto texture = entry_at(file_.json, "textures", *index, place);
  if (!texture) return texture.error();
  const auto source = whole(**texture, "source", -1, place);
  if (!source) return source.error();
  if (*source < 0) return std::nullopt;
  const auto image = entry_at(file_.json, "images", *source, place);
  if (!image) return image.error();
  if (auto error = read_image(**image, *source, place, material)) return error;
  const auto points = whole(*use, "texCoord", 0, place);
  if (!points) return points.error();
  const bool is_moved = use->contains("extensions");
  if (*points == 0 && !is_moved) return std::nullopt;
  mesh_.attributes.notes.push_back(
      "the image of " + in_quotes(material.name) +
      (is_moved ? " is placed by an extension, which is passed over"
                : " has texture points of its own, and is passed over"));
  if (*points == 0) return std::nullopt;
  material.texture.clear();
  material.image = nullptr;
  return std::nullopt;
}

/// The bytes of an image in the file, or its file beside it.
std::optional<Error> GltfAttributes::read_image(const Json& image,
                                                std::int64_t id,
                                                const std::string& place,
                                                Material& material) {
  if (images_.contains(id)) {
    material.texture = images_[id].first;
    material.image = images_[id].second;
    return std::nullopt;
  }
  const std::string uri = text_in(image, "uri");
  if (uri.empty() && !image.contains("bufferView")) return std::nullopt;
  if (!uri.empty() && !uri.starts_with("data:")) {
    material.texture = name_of_uri(uri);
    const std::filesystem::path name = material.texture;
    if (file_.folder && name.is_relative() &&
        uri.find("://") == std::string::npos) {
      const std::filesystem::path path = *file_.folder / name;
      if (is_plain_file(path)) {
        material.image = std::make_shared<const Image>(Image{path, {}});
        mesh_.attributes.files.push_back(path);
      }
    }
  } else {
    std::string bytes;
    if (!uri.empty()) {
      auto decoded = bytes_of_data_uri(uri);
      if (!decoded)
        return Error{ErrorCode::kSyntax, place + ": an image is no base64"};
      bytes = *std::move(decoded);
    } else {
      const auto view = whole(image, "bufferView", 0, place);
      if (!view) return view.error();
      const auto found = bytes_of_view(file_, *view, place);
      if (!found) return found.error();
      bytes = *found;
    }
    if (image_type(bytes) == nullptr) {
      mesh_.attributes.notes.push_back(
          "the image of " + in_quotes(material.name) +
          " is neither a PNG nor a JPEG, and is passed over");
      return std::nullopt;
    }
    material.texture = text_in(image, "name");
    if (material.texture.empty())
      material.texture = "image " + std::to_string(id);
    material.image = std::make_shared<const Image>(Image{{}, std::move(bytes)});
  }
  images_[id] = {material.texture, material.image};
  return std::nullopt;
}

std::optional<Error> GltfAttributes::add(const GltfTriangles& triangles) {
  const Json& primitive = *triangles.primitive;
  const auto material = whole(primitive, "material", -1, triangles.place);
  if (!material) return material.error();
  if (*material >= 0) {
    const auto there =
        entry_at(file_.json, "materials", *material, triangles.place);
    if (!there) return there.error();
  }
  add_names(triangles, *material);
  if (auto error = add_channels(triangles)) return error;
  return add_origins(triangles);
}

void GltfAttributes::add_names(const GltfTriangles& triangles,
                               std::int64_t material) {
  const Json* extras = object_in(*triangles.primitive, "extras");
  groups_.name_from_here(extras == nullptr ? std::string()
                                           : text_in(*extras, "group"));
  const std::size_t end = mesh_.face_count();
  for (std::size_t face = end - triangles.corners.size() / 3; face < end;
       ++face) {
    objects_.add_face(face);
    groups_.add_face(face);
    face_materials_.push_back(static_cast<std::int32_t>(material));
  }
}

std::optional<Error> GltfAttributes::add_channels(
    const GltfTriangles& triangles) {
  const Turn turn = turn_of(*triangles.map);
  const std::size_t end = mesh_.corners.size();
  const std::size_t begin = end - triangles.corners.size();
  for (const auto& [semantic, id] :
       (*triangles.primitive)["attributes"].items()) {
    const bool is_known = semantic == "TEXCOORD_0" || semantic == "NORMAL" ||
                          semantic == "COLOR_0";
    if (!is_known && (semantic.size() < 2 || semantic[0] != '_')) continue;
    const std::string place = triangles.place + "." + semantic;
    if (!id.is_number_unsigned())
      return Error{ErrorCode::kSyntax, place + " is no index"};
    const auto from = Accessor::of(file_, id.get<std::int64_t>(), place);
    if (!from) return from.error();
    if (from->count() < triangles.vertex_count) {
      return Error{ErrorCode::kTruncated,
                   place + " has " + std::to_string(from->count()) + " of " +
                       std::to_string(triangles.vertex_count) + " vertices"};
    }
    const std::size_t width = semantic == "NORMAL"       ? 3
                              : semantic == "TEXCOORD_0" ? 2
                                                         : from->width();
    Channel& to = channel_for(semantic, width);
    to.values.resize(begin * to.width, kNoValue);
    for (const std::size_t vertex : triangles.corners)
      append_row(*from, vertex, turn, to);
  }
  for (GrowingChannel& growing : channels_)
    growing.channel.values.resize(end * growing.channel.width, kNoValue);
  return std::nullopt;
}

/// The channel of an attribute of primitives, where it has been so far.
Channel& GltfAttributes::channel_for(const std::string& semantic,
                                     std::size_t width) {
  for (GrowingChannel& growing : channels_) {
    if (growing.semantic == semantic) return growing.channel;
  }
  Channel channel;
  channel.width = width;
  if (semantic == "TEXCOORD_0") {
    channel.name = "uv";
    channel.kind = ChannelKind::kTexture;
  } else if (semantic == "NORMAL") {
    channel.name = "normal";
    channel.kind = ChannelKind::kNormal;
  } else if (semantic == "COLOR_0") {
    channel.name = "color";
    channel.kind = ChannelKind::kColor;
  } else {
    channel.name = semantic.substr(1);
  }
  channels_.push_back({std::move(channel), semantic});
  return channels_.back().channel;
}

/// What `--keep-origin` wrote.
std::optional<Error> GltfAttributes::add_origins(
    const GltfTriangles& triangles) {
  const Json* extras = object_in(*triangles.primitive, "extras");
  if (extras == nullptr) return std::nullopt;
  const std::size_t count = triangles.corners.size() / 3;
  for (std::size_t k = 0; k < 2; ++k) {
    if (!extras->contains(kOriginNames[k])) continue;
    const auto id = whole(*extras, kOriginNames[k], 0, triangles.place);
    if (!id) return id.error();
    const auto from = Accessor::of(file_, *id, triangles.place);
    if (!from) return from.error();
    if (from->count() < count || from->type() == kGlbFloat) continue;
    origins_[k].resize(mesh_.face_count() - count, kNoValue);
    for (std::size_t i = 0; i < count; ++i)
      origins_[k].push_back(static_cast<double>(from->integer(i, 0)));
  }
  return std::nullopt;
}

void GltfAttributes::finish() {
  Attributes& attributes = mesh_.attributes;
  const std::size_t faces = mesh_.face_count();
  attributes.objects = objects_.taken(faces);
  attributes.groups = groups_.taken(faces);
  const bool any = std::any_of(face_materials_.begin(), face_materials_.end(),
                               [](std::int32_t at) { return at >= 0; });
  if (any) attributes.face_materials = std::move(face_materials_);
  for (GrowingChannel& growing : channels_)
    attributes.corners.push_back(std::move(growing.channel));
  for (std::size_t k = 0; k < 2; ++k) {
    if (origins_[k].empty()) continue;
    origins_[k].resize(faces, kNoValue);
    attributes.faces.push_back({kOriginNames[k], ChannelKind::kNumber, 1,
                                std::move(origins_[k]), true});
  }
}

}  // namespace halfspace::io
