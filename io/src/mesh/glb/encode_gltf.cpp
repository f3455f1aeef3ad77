#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/binary.hpp"
#include "mesh/format_table.hpp"
#include "mesh/glb/base64.hpp"
#include "mesh/glb/glb.hpp"
#include "mesh/writers.hpp"

namespace halfspace::io {
namespace {

using GlbJson = nlohmann::ordered_json;

constexpr int kArrayBuffer = 34962, kIndexBuffer = 34963;

/// What triangles of one primitive have in common: object, group, material, and
/// 1 if colours of vertices are not theirs.
using PrimitiveKey = std::array<std::int32_t, 4>;

/// A channel of corners, as vertices of a GLB have it.
struct VertexChannel {
  const Channel* channel;
  std::string semantic;
  std::size_t width;
};

class GlbWriter {
 public:
  explicit GlbWriter(const MeshContent& content)
      : content_(content),
        attributes_(content.attributes ? *content.attributes : none_) {}
  /// Makes the JSON, but for its buffers, and the bytes.
  void write();
  Result<std::string> glb() const;
  Result<std::string> text() const;

 private:
  GlbJson with_buffer(const std::string& uri) const;
  void choose_channels();
  bool has_color(std::size_t triangle) const;
  std::int32_t label(const Labels& labels, std::size_t face) const {
    return labels.of_face.empty() ? -1 : labels.of_face[face];
  }
  void add_materials();
  std::size_t named_image(const std::string& name);
  void add_images();
  GlbJson primitive(const PrimitiveKey& key,
                    const std::vector<std::size_t>& triangles);
  /// The channels of a primitive's vertices.
  std::vector<VertexChannel> channels_of(const PrimitiveKey& key) const;
  void append_row(std::size_t triangle, std::size_t k,
                  const std::vector<VertexChannel>& channels,
                  std::string& row) const;
  void append_channel(const VertexChannel& from, std::size_t corner,
                      std::size_t triangle, std::string& row) const;
  std::array<float, 3> point(VertexId vertex) const {
    const DoublePoint& p = content_.doubles[static_cast<std::size_t>(vertex)];
    // y points up, z to the front.
    return {static_cast<float>(p[0]), static_cast<float>(p[2]),
            static_cast<float>(-p[1])};
  }
  bool has_material(std::size_t triangle) const {
    return !attributes_.face_materials.empty() &&
           attributes_.face_materials[content_.triangle_faces[triangle]] >= 0;
  }
  std::int64_t view(std::size_t bytes, std::optional<int> target,
                    std::size_t stride);
  std::int64_t accessor(std::int64_t view, std::size_t offset, int type,
                        const char* shape, std::size_t count);
  void add_origins(const std::vector<std::size_t>& triangles, GlbJson& to);

  const Attributes none_;
  const MeshContent& content_;
  const Attributes& attributes_;
  const Channel* face_colors_ = nullptr;
  bool has_colors_ = false;
  std::vector<VertexChannel> channels_;
  std::map<std::string, std::size_t> named_;
  GlbJson file_;
  std::string bytes_;
};

/// A path as a URI: bytes that a URI gives no meaning to stay (RFC 3986).
std::string uri_of(const std::string& path) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string uri;
  for (const char c : path) {
    const bool is_plain =
        (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
        (c >= 'A' && c <= 'Z') ||
        std::string_view("-._~/").find(c) != std::string_view::npos;
    if (is_plain) {
      uri += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    uri += '%';
    uri += kDigits[byte >> 4];
    uri += kDigits[byte & 15];
  }
  return uri;
}

/// Which channels go into a file: glTF has names for three; others are its
/// own, of at most four numbers.
void GlbWriter::choose_channels() {
  for (const Channel& channel : attributes_.faces) {
    if (channel.kind == ChannelKind::kColor) face_colors_ = &channel;
  }
  for (const Channel& channel : attributes_.corners) {
    std::string semantic = "_" + channel.name;
    if (channel.kind == ChannelKind::kTexture && channel.width == 2)
      semantic = "TEXCOORD_0";
    if (channel.kind == ChannelKind::kNormal && channel.width == 3)
      semantic = "NORMAL";
    if (channel.kind == ChannelKind::kColor) semantic = "COLOR_0";
    const bool is_there = std::any_of(
        channels_.begin(), channels_.end(),
        [&](const VertexChannel& other) { return other.semantic == semantic; });
    if (is_there || channel.width > 4) continue;
    has_colors_ = has_colors_ || semantic == "COLOR_0";
    channels_.push_back({&channel, semantic, channel.width});
  }
  if (face_colors_ != nullptr && !has_colors_) {
    has_colors_ = true;
    channels_.push_back({nullptr, "COLOR_0", 3});
  }
}

/// Whether the triangle, or a corner of it, has a colour.
bool GlbWriter::has_color(std::size_t triangle) const {
  for (const VertexChannel& from : channels_) {
    if (from.semantic != "COLOR_0") continue;
    if (from.channel == nullptr) {
      const auto at = face_colors_->at(content_.triangle_faces[triangle]);
      return !std::isnan(at[0]);
    }
    const auto& corners = content_.triangle_corners[triangle];
    return std::any_of(corners.begin(), corners.end(), [&](std::size_t corner) {
      return !std::isnan(from.channel->at(corner)[0]);
    });
  }
  return false;
}

void GlbWriter::add_materials() {
  if (attributes_.face_materials.empty()) return;
  for (std::size_t i = 0; i < attributes_.materials.size(); ++i) {
    const Material& material = attributes_.materials[i];
    GlbJson json;
    json["name"] = material.name;
    GlbJson& pbr = json["pbrMetallicRoughness"];
    if (material.color) {
      pbr["baseColorFactor"] = {
          static_cast<float>(linear_of(material.color->r / 255.0)),
          static_cast<float>(linear_of(material.color->g / 255.0)),
          static_cast<float>(linear_of(material.color->b / 255.0)),
          static_cast<float>(material.opacity)};
    } else if (material.opacity != 1) {
      pbr["baseColorFactor"] = {1, 1, 1, static_cast<float>(material.opacity)};
    }
    if (const std::int32_t image = content_.images.at(i); image >= 0) {
      pbr["baseColorTexture"]["index"] = image;
    } else if (!material.texture.empty()) {
      pbr["baseColorTexture"]["index"] = named_image(material.texture);
    }
    pbr["metallicFactor"] = material.metallic.value_or(0);
    if (material.roughness) pbr["roughnessFactor"] = *material.roughness;
    if (material.opacity < 1) json["alphaMode"] = "BLEND";
    file_["materials"].push_back(std::move(json));
  }
}

/// The place of an image that is not in the file. Texture i has image i.
std::size_t GlbWriter::named_image(const std::string& name) {
  const auto [at, is_new] =
      named_.try_emplace(name, content_.images.images.size() + named_.size());
  return at->second;
}

/// Adds the images, those that are in the file at the end of its bytes.
void GlbWriter::add_images() {
  GlbJson images = GlbJson::array();
  for (const EmbeddedImage& image : content_.images.images) {
    bytes_ += image.bytes;
    const std::int64_t place = view(image.bytes.size(), std::nullopt, 0);
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    images.push_back({{"name", image.name},
                      {"mimeType", image.type},
                      {"bufferView", place}});
  }
  std::vector<const std::string*> names(named_.size());
  for (const auto& [name, place] : named_) names[place - images.size()] = &name;
  for (const std::string* name : names)
    images.push_back({{"uri", uri_of(*name)}});
  for (std::size_t i = 0; i < images.size(); ++i)
    file_["textures"].push_back({{"source", i}});
  if (!images.empty()) file_["images"] = std::move(images);
}

void append_float(double value, std::string& row) {
  store(row, static_cast<float>(value) + 0.0f);
}

/// A direction of length 1; upwards where there is none.
std::array<double, 3> unit_of(const std::array<double, 3>& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  if (!(length > 0) || !std::isfinite(length)) return {0, 1, 0};
  return {v[0] / length, v[1] / length, v[2] / length};
}

void GlbWriter::append_channel(const VertexChannel& from, std::size_t corner,
                               std::size_t triangle, std::string& row) const {
  std::array<double, 4> values{0, 0, 0, 1};
  if (from.channel != nullptr) {
    const auto at = from.channel->at(corner);
    std::copy(at.begin(), at.end(), values.begin());
  } else {
    const auto at = face_colors_->at(content_.triangle_faces[triangle]);
    std::copy_n(at.begin(), 3, values.begin());
  }
  if (from.semantic == "NORMAL") {
    const std::array<double, 3> normal =
        unit_of({values[0], values[2], -values[1]});
    for (const double value : normal) append_float(value, row);
    return;
  }
  if (from.semantic == "TEXCOORD_0") values[1] = 1 - values[1];
  if (from.semantic == "COLOR_0") {
    // White leaves a material's colour as it is.
    const Rgb none =
        has_material(triangle) ? Rgb{255, 255, 255} : kUsualSurface;
    const std::uint8_t usual[] = {none.r, none.g, none.b};
    for (std::size_t k = 0; k < 3; ++k) {
      const double share = std::isnan(values[k]) ? usual[k] / 255.0 : values[k];
      values[k] = linear_of(std::clamp(share, 0.0, 1.0));
    }
    if (!std::isfinite(values[3])) values[3] = 1;
  }
  for (std::size_t k = 0; k < from.width; ++k)
    append_float(std::isfinite(values[k]) ? values[k] : 0, row);
}

/// The bytes of a vertex.
void GlbWriter::append_row(std::size_t triangle, std::size_t k,
                           const std::vector<VertexChannel>& channels,
                           std::string& row) const {
  for (const float value : point(content_.triangles[triangle][k]))
    store(row, value + 0.0f);
  const std::size_t corner = content_.triangle_corners[triangle][k];
  for (const VertexChannel& channel : channels)
    append_channel(channel, corner, triangle, row);
}

std::vector<VertexChannel> GlbWriter::channels_of(
    const PrimitiveKey& key) const {
  std::vector<VertexChannel> channels = channels_;
  std::erase_if(channels, [&key](const VertexChannel& from) {
    return key[3] == 1 && from.semantic == "COLOR_0";
  });
  return channels;
}

/// Adds a view of what was added last to the bytes.
std::int64_t GlbWriter::view(std::size_t bytes, std::optional<int> target,
                             std::size_t stride) {
  GlbJson json{{"buffer", 0},
               {"byteOffset", bytes_.size() - bytes},
               {"byteLength", bytes}};
  if (stride > 0) json["byteStride"] = stride;
  if (target) json["target"] = *target;
  file_["bufferViews"].push_back(std::move(json));
  return static_cast<std::int64_t>(file_["bufferViews"].size()) - 1;
}

std::int64_t GlbWriter::accessor(std::int64_t view, std::size_t offset,
                                 int type, const char* shape,
                                 std::size_t count) {
  file_["accessors"].push_back({{"bufferView", view},
                                {"byteOffset", offset},
                                {"componentType", type},
                                {"count", count},
                                {"type", shape}});
  return static_cast<std::int64_t>(file_["accessors"].size()) - 1;
}

void GlbWriter::add_origins(const std::vector<std::size_t>& triangles,
                            GlbJson& to) {
  for (const char* name : {"origin_solid", "origin_polygon"}) {
    const Channel* channel = channel_named(attributes_.faces, name);
    if (channel == nullptr || channel->width != 1) continue;
    for (const std::size_t triangle : triangles) {
      const double value = channel->at(content_.triangle_faces[triangle])[0];
      store(bytes_, value >= 0 ? static_cast<std::uint32_t>(value)
                               : std::numeric_limits<std::uint32_t>::max());
    }
    to["extras"][name] = accessor(view(4 * triangles.size(), std::nullopt, 0),
                                  0, kGlbUint32, "SCALAR", triangles.size());
  }
}

GlbJson GlbWriter::primitive(const PrimitiveKey& key,
                             const std::vector<std::size_t>& triangles) {
  const std::vector<VertexChannel> channels = channels_of(key);
  std::unordered_map<std::string, std::uint32_t> places;
  std::string rows, indices, row;
  std::array<float, 3> low, high;
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
  for (const std::size_t triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      row.clear();
      append_row(triangle, k, channels, row);
      const auto next = static_cast<std::uint32_t>(places.size());
      const auto [place, is_new] = places.try_emplace(row, next);
      store(indices, place->second);
      if (!is_new) continue;
      rows += row;
      const auto at = point(content_.triangles[triangle][k]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], at[axis] + 0.0f);
        high[axis] = std::max(high[axis], at[axis] + 0.0f);
      }
    }
  }
  bytes_ += rows;
  const std::int64_t vertices = view(rows.size(), kArrayBuffer, row.size());
  constexpr const char* kShapes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  GlbJson json;
  const std::int64_t position =
      accessor(vertices, 0, kGlbFloat, "VEC3", places.size());
  file_["accessors"].back()["min"] = low;
  file_["accessors"].back()["max"] = high;
  json["attributes"]["POSITION"] = position;
  std::size_t offset = 12;
  for (const VertexChannel& channel : channels) {
    json["attributes"][channel.semantic] = accessor(
        vertices, offset, kGlbFloat, kShapes[channel.width - 1], places.size());
    offset += 4 * channel.width;
  }
  bytes_ += indices;
  json["indices"] = accessor(view(indices.size(), kIndexBuffer, 0), 0,
                             kGlbUint32, "SCALAR", 3 * triangles.size());
  if (key[2] >= 0) json["material"] = key[2];
  if (key[1] >= 0) {
    json["extras"]["group"] =
        attributes_.groups.names[static_cast<std::size_t>(key[1])];
  }
  add_origins(triangles, json);
  return json;
}

void GlbWriter::write() {
  choose_channels();
  std::map<PrimitiveKey, std::vector<std::size_t>> primitives;
  for (std::size_t i = 0; i < content_.triangles.size(); ++i) {
    const std::size_t face = content_.triangle_faces[i];
    const std::int32_t material = attributes_.face_materials.empty()
                                      ? -1
                                      : attributes_.face_materials[face];
    primitives[{label(attributes_.objects, face),
                label(attributes_.groups, face), material,
                has_color(i) ? 0 : 1}]
        .push_back(i);
  }
  file_["asset"] = {{"version", "2.0"}, {"generator", "halfspace"}};
  file_["scene"] = 0;
  file_["scenes"] = GlbJson::array({GlbJson::object()});
  add_materials();
  std::optional<std::int32_t> object;
  for (const auto& [key, triangles] : primitives) {
    if (object != key[0]) {
      object = key[0];
      GlbJson node{{"mesh", file_["meshes"].size()}};
      if (key[0] >= 0)
        node["name"] =
            attributes_.objects.names[static_cast<std::size_t>(key[0])];
      // A new member moves the others: none is referred to meanwhile.
      const std::size_t number = file_["nodes"].size();
      file_["scenes"][0]["nodes"].push_back(number);
      file_["nodes"].push_back(std::move(node));
      file_["meshes"].push_back(GlbJson::object());
    }
    GlbJson made = primitive(key, triangles);
    file_["meshes"].back()["primitives"].push_back(std::move(made));
  }
  if (!attributes_.origins.empty())
    file_["asset"]["extras"]["origins"] = attributes_.origins;
  add_images();
}

/// The JSON with its one buffer.
GlbJson GlbWriter::with_buffer(const std::string& uri) const {
  GlbJson file = file_;
  if (bytes_.empty()) return file;
  GlbJson buffer{{"byteLength", bytes_.size()}};
  if (!uri.empty()) buffer["uri"] = uri;
  file["buffers"].push_back(std::move(buffer));
  return file;
}

Result<std::string> GlbWriter::glb() const {
  std::string json =
      with_buffer({}).dump(-1, ' ', false, GlbJson::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t size =
      kGlbHeader + kGlbChunkHeader + json.size() +
      (bytes_.empty() ? 0 : kGlbChunkHeader + bytes_.size());
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    return Error{
        ErrorCode::kOutOfRange,
        "a GLB holds at most 4294967295 bytes, not " + std::to_string(size)};
  }
  std::string file;
  const auto put = [&file](std::size_t value) {
    store(file, static_cast<std::uint32_t>(value));
  };
  for (const std::size_t value : {std::size_t{kGlbMagic}, std::size_t{2}, size,
                                  json.size(), std::size_t{kGlbJson}})
    put(value);
  file += json;
  if (bytes_.empty()) return file;
  put(bytes_.size());
  put(kGlbBytes);
  return file + bytes_;
}

/// A file of its own: what is beside another can get lost.
Result<std::string> GlbWriter::text() const {
  return with_buffer("data:application/octet-stream;base64," +
                     base64_of(bytes_))
             .dump(1, ' ', false, GlbJson::error_handler_t::replace) +
         "\n";
}

}  // namespace

Result<std::string> glb_bytes(const MeshContent& content) {
  if (auto error = beyond_floats(content.doubles)) return *error;
  GlbWriter writer(content);
  writer.write();
  return writer.glb();
}

Result<std::string> gltf_text(const MeshContent& content) {
  if (auto error = beyond_floats(content.doubles)) return *error;
  GlbWriter writer(content);
  writer.write();
  return writer.text();
}

}  // namespace halfspace::io
