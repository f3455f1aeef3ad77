#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "base/binary.hpp"
#include "halfspace/message.hpp"
#include "mesh/glb/glb.hpp"
#include "mesh/label_maker.hpp"
#include "mesh/mesh_builder.hpp"
#include "mesh/number_math.hpp"
#include "mesh/readers.hpp"

namespace halfspace::io {
namespace {

using Json = nlohmann::json;

/// A scene's description is smaller, and not as deep.
constexpr std::size_t kMostJsonBytes = std::size_t{1} << 25;
constexpr int kMostJsonDepth = 100;
/// More vertices than these are not made by placing meshes again and again.
constexpr std::size_t kMostPlacedVertices = std::size_t{1} << 23;

/// What is wrong with a file, and where; thrown within this file alone.
struct GlbFault {
  ErrorCode code;
  std::string message;
};

[[noreturn]] void fault(ErrorCode code, std::string message) {
  throw GlbFault{code, std::move(message)};
}

std::string item(const char* list, std::size_t i) {
  return std::string(list) + "[" + std::to_string(i) + "]";
}

/// A whole number of an object; `other` where it has none of the name.
std::int64_t whole(const Json& object, const char* name, std::int64_t other,
                   const std::string& place) {
  const auto found = object.find(name);
  if (found == object.end()) return other;
  if (found->is_number_unsigned() &&
      found->get<std::uint64_t>() <= (std::uint64_t{1} << 53))
    return static_cast<std::int64_t>(found->get<std::uint64_t>());
  fault(ErrorCode::kSyntax,
        place + "." + name + " is no whole number of 0 or more");
}

/// An entry of a list of the file.
const Json& entry_at(const Json& file, const char* list, std::int64_t i,
                     const std::string& place) {
  const auto found = file.find(list);
  const std::size_t count =
      found == file.end() || !found->is_array() ? 0 : found->size();
  if (i < 0 || static_cast<std::uint64_t>(i) >= count) {
    fault(ErrorCode::kBadIndex, place + ": there is no " +
                                    item(list, static_cast<std::size_t>(i)) +
                                    ", only " + std::to_string(count));
  }
  const Json& entry = (*found)[static_cast<std::size_t>(i)];
  if (!entry.is_object()) {
    fault(ErrorCode::kSyntax,
          item(list, static_cast<std::size_t>(i)) + " is no object");
  }
  return entry;
}

std::string text_in(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>()
                                                     : std::string();
}

/// The list of an object; an empty one where it has none of the name.
const Json& list_in(const Json& object, const char* name,
                    const std::string& place) {
  static const Json kEmptyList = Json::array();
  const auto found = object.find(name);
  if (found == object.end()) return kEmptyList;
  if (!found->is_array())
    fault(ErrorCode::kSyntax, place + "." + name + " is no list");
  return *found;
}

std::vector<double> doubles_of(const Json& list, std::size_t count,
                               const std::string& place) {
  std::vector<double> values;
  if (!list.is_array() || list.size() != count)
    fault(ErrorCode::kSyntax,
          place + " is no list of " + std::to_string(count) + " numbers");
  for (const Json& value : list) {
    if (!value.is_number())
      fault(ErrorCode::kSyntax, place + " has what is no number");
    values.push_back(value.get<double>());
    if (!std::isfinite(values.back()))
      fault(ErrorCode::kNotFinite, place + " has a number beyond doubles");
  }
  return values;
}

std::size_t bytes_of_type(std::int64_t type) {
  switch (type) {
    case kGlbInt8:
    case kGlbUint8:
      return 1;
    case kGlbInt16:
    case kGlbUint16:
      return 2;
    case kGlbUint32:
    case kGlbFloat:
      return 4;
    default:
      return 0;
  }
}

/// The numbers of an accessor (glTF 2.0, sec. 3.6.2), in place.
class Accessor {
 public:
  Accessor(const Json& file, std::string_view bytes, std::int64_t id,
           const std::string& place);

  std::size_t count() const { return count_; }
  std::size_t width() const { return width_; }
  std::int64_t type() const { return type_; }
  std::int64_t integer(std::size_t i, std::size_t k) const;
  double number(std::size_t i, std::size_t k) const;

 private:
  std::string_view bytes_;
  std::string place_;
  std::size_t count_ = 0;
  std::size_t width_ = 1;
  std::int64_t type_ = 0;
  std::size_t stride_ = 0;
  bool is_normalized_ = false;
};

Accessor::Accessor(const Json& file, std::string_view bytes, std::int64_t id,
                   const std::string& place)
    : place_(item("accessors", static_cast<std::size_t>(id))) {
  const Json& accessor = entry_at(file, "accessors", id, place);
  constexpr std::pair<const char*, std::size_t> kWidths[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  const std::string shape = text_in(accessor, "type");
  const auto* const found =
      std::find_if(std::begin(kWidths), std::end(kWidths),
                   [&](const auto& entry) { return shape == entry.first; });
  type_ = whole(accessor, "componentType", 0, place_);
  const std::size_t size = bytes_of_type(type_);
  if (found == std::end(kWidths) || size == 0)
    fault(ErrorCode::kSyntax, place_ + " has no type that is read");
  if (accessor.contains("sparse"))
    fault(ErrorCode::kUnknownFormat, place_ + " is sparse, which is not read");
  width_ = found->second;
  const auto normalized = accessor.find("normalized");
  is_normalized_ = normalized != accessor.end() && normalized->is_boolean() &&
                   normalized->get<bool>();
  const std::int64_t count = whole(accessor, "count", 0, place_);
  const std::int64_t view_id = whole(accessor, "bufferView", -1, place_);
  if (view_id < 0) fault(ErrorCode::kSyntax, place_ + " has no bufferView");
  const Json& view = entry_at(file, "bufferViews", view_id, place_);
  const std::string view_place =
      item("bufferViews", static_cast<std::size_t>(view_id));
  if (whole(view, "buffer", 0, view_place) != 0) {
    fault(ErrorCode::kUnknownFormat,
          view_place +
              " is of another buffer than the file's own, which is "
              "not read");
  }
  const auto offset =
      static_cast<std::uint64_t>(whole(view, "byteOffset", 0, view_place));
  const auto length =
      static_cast<std::uint64_t>(whole(view, "byteLength", 0, view_place));
  if (offset > bytes.size() || length > bytes.size() - offset) {
    fault(ErrorCode::kTruncated, view_place + " reaches to byte " +
                                     std::to_string(offset + length) + " of " +
                                     std::to_string(bytes.size()));
  }
  const std::size_t row = size * width_;
  stride_ = static_cast<std::size_t>(
      whole(view, "byteStride", static_cast<std::int64_t>(row), view_place));
  const auto first =
      static_cast<std::uint64_t>(whole(accessor, "byteOffset", 0, place_));
  if (stride_ < row || stride_ > 4096)
    fault(ErrorCode::kSyntax, view_place + ".byteStride is too small or large");
  if (count > 0 && (first > length || length - first < row ||
                    static_cast<std::uint64_t>(count - 1) >
                        (length - first - row) / stride_)) {
    fault(ErrorCode::kTruncated,
          place_ + " counts " + std::to_string(count) +
              " elements, more than its bufferView has room for");
  }
  count_ = static_cast<std::size_t>(count);
  bytes_ = bytes.substr(static_cast<std::size_t>(offset));
  if (count > 0) bytes_.remove_prefix(static_cast<std::size_t>(first));
}

std::int64_t Accessor::integer(std::size_t i, std::size_t k) const {
  const std::size_t at = i * stride_ + k * bytes_of_type(type_);
  switch (type_) {
    case kGlbInt8:
      return load<std::int8_t>(bytes_, at, ByteOrder::kLittle);
    case kGlbUint8:
      return load<std::uint8_t>(bytes_, at, ByteOrder::kLittle);
    case kGlbInt16:
      return load<std::int16_t>(bytes_, at, ByteOrder::kLittle);
    case kGlbUint16:
      return load<std::uint16_t>(bytes_, at, ByteOrder::kLittle);
    default:
      return load<std::uint32_t>(bytes_, at, ByteOrder::kLittle);
  }
}

double Accessor::number(std::size_t i, std::size_t k) const {
  if (type_ == kGlbFloat) {
    return load<float>(bytes_, i * stride_ + k * 4, ByteOrder::kLittle);
  }
  const auto value = static_cast<double>(integer(i, k));
  if (!is_normalized_) return value;
  switch (type_) {
    case kGlbInt8:
      return std::max(value / 127, -1.0);
    case kGlbInt16:
      return std::max(value / 32767, -1.0);
    case kGlbUint8:
      return value / 255;
    default:
      return value / 65535;
  }
}

/// Where a node's own map puts things; in exact numbers of its doubles.
ExactMap map_of_node(const Json& node, const std::string& place) {
  ExactMap map = identity_map();
  if (const auto matrix = node.find("matrix"); matrix != node.end()) {
    const auto values = doubles_of(*matrix, 16, place + ".matrix");
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 4; ++column)
        map.rows[row][column] = number_of(values[4 * column + row]);
    }
    return map;
  }
  std::vector<double> scale = {1, 1, 1};
  if (const auto found = node.find("scale"); found != node.end())
    scale = doubles_of(*found, 3, place + ".scale");
  std::array<std::array<double, 3>, 3> turn = {
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (const auto found = node.find("rotation"); found != node.end()) {
    const auto q = doubles_of(*found, 4, place + ".rotation");
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    turn = {
        {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
         {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
         {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
  }
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      const double value = turn[row][column] * scale[column];
      if (!std::isfinite(value))
        fault(ErrorCode::kNotFinite, place + " is moved beyond doubles");
      map.rows[row][column] = number_of(value);
    }
  }
  if (const auto found = node.find("translation"); found != node.end()) {
    const auto values = doubles_of(*found, 3, place + ".translation");
    for (std::size_t row = 0; row < 3; ++row)
      map.rows[row][3] = number_of(values[row]);
  }
  return map;
}

class GlbReader {
 public:
  GlbReader(const Json& file, std::string_view bytes)
      : file_(file), bytes_(bytes) {}
  Mesh read();

 private:
  struct Placed {
    std::size_t node;
    ExactMap map;
    int depth;
  };
  /// One channel that some primitives have, and others may lack.
  struct GrowingChannel {
    Channel channel;
    std::string semantic;
  };
  void check_extensions();
  void read_materials();
  std::vector<std::size_t> roots() const;
  void read_node(const Placed& placed, std::vector<Placed>& stack);
  void read_primitive(const Json& primitive, const ExactMap& map,
                      const std::string& place);
  std::vector<std::array<std::size_t, 3>> triangles_of(
      const Json& primitive, std::size_t vertex_count,
      const std::string& place);
  void add_channels(const Json& attributes, const ExactMap& map,
                    const std::vector<std::size_t>& corners,
                    std::size_t vertex_count, const std::string& place);
  Channel& channel_for(const std::string& semantic, std::size_t width);
  void append_row(const Accessor& from, std::size_t row,
                  const std::array<std::array<double, 3>, 3>& turn,
                  Channel& to) const;
  void add_origins(const Json& primitive, std::size_t triangles,
                   const std::string& place);
  void finish();

  const Json& file_;
  std::string_view bytes_;
  MeshBuilder builder_;
  LabelMaker objects_;
  LabelMaker groups_;
  std::vector<GrowingChannel> channels_;
  std::vector<std::int32_t> face_materials_;
  std::array<std::vector<double>, 2> origins_;
  std::size_t placed_vertices_ = 0;
  std::size_t passed_over_ = 0;  // primitives of points and lines
};

/// Extensions without which a file can be read all the same.
bool can_be_passed_over(const std::string& extension) {
  return extension == "KHR_mesh_quantization" ||
         extension == "KHR_lights_punctual" ||
         extension.starts_with("KHR_materials_") ||
         extension.starts_with("KHR_texture_") ||
         extension == "EXT_texture_webp";
}

void GlbReader::check_extensions() {
  for (const Json& name : list_in(file_, "extensionsRequired", "the file")) {
    if (name.is_string() && can_be_passed_over(name.get<std::string>()))
      continue;
    fault(ErrorCode::kUnknownFormat,
          "the file needs the extension " +
              in_quotes(name.is_string() ? name.get<std::string>() : "?") +
              ", which is not read; export it without");
  }
}

void GlbReader::read_materials() {
  const Json& list = list_in(file_, "materials", "the file");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string place = item("materials", i);
    const Json& json =
        entry_at(file_, "materials", static_cast<std::int64_t>(i), "the file");
    Material material{text_in(json, "name")};
    if (material.name.empty()) material.name = "material " + std::to_string(i);
    const auto pbr = json.find("pbrMetallicRoughness");
    if (pbr != json.end() && pbr->is_object()) {
      std::vector<double> factor = {1, 1, 1, 1};
      if (const auto found = pbr->find("baseColorFactor"); found != pbr->end())
        factor = doubles_of(*found, 4, place + ".baseColorFactor");
      std::array<double, 3> shares{};
      for (std::size_t k = 0; k < 3; ++k)
        shares[k] = share_of_linear(std::clamp(factor[k], 0.0, 1.0));
      material.color = rgb_of(shares);
      material.opacity = std::clamp(factor[3], 0.0, 1.0);
      const auto texture = pbr->find("baseColorTexture");
      if (texture != pbr->end() && texture->is_object()) {
        const Json& of = entry_at(file_, "textures",
                                  whole(*texture, "index", 0, place), place);
        const std::int64_t source = whole(of, "source", -1, place);
        if (source >= 0) {
          const Json& image = entry_at(file_, "images", source, place);
          material.texture = text_in(image, "uri");
          if (material.texture.empty() ||
              material.texture.starts_with("data:")) {
            material.texture.clear();
            builder_.mesh.attributes.notes.push_back(
                "the image of " + in_quotes(material.name) +
                " is in the file itself, and is passed over");
          }
        }
      }
    }
    builder_.mesh.attributes.materials.push_back(std::move(material));
  }
}

std::vector<std::size_t> GlbReader::roots() const {
  std::vector<std::size_t> roots;
  const Json& nodes = list_in(file_, "nodes", "the file");
  if (list_in(file_, "scenes", "the file").empty()) {
    // Then all nodes that are no other's.
    std::vector<bool> is_child(nodes.size());
    for (const Json& node : nodes) {
      if (!node.is_object()) continue;
      for (const Json& child : list_in(node, "children", "a node")) {
        if (child.is_number_unsigned() &&
            child.get<std::uint64_t>() < nodes.size())
          is_child[child.get<std::size_t>()] = true;
      }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!is_child[i]) roots.push_back(i);
    }
    return roots;
  }
  const std::int64_t scene = whole(file_, "scene", 0, "the file");
  const std::string place = item("scenes", static_cast<std::size_t>(scene));
  for (const Json& node :
       list_in(entry_at(file_, "scenes", scene, "the file"), "nodes", place)) {
    if (!node.is_number_unsigned())
      fault(ErrorCode::kSyntax, place + ".nodes has what is no index");
    roots.push_back(node.get<std::size_t>());
  }
  return roots;
}

/// The first corners of the triangles, as vertices of the primitive.
std::vector<std::array<std::size_t, 3>> GlbReader::triangles_of(
    const Json& primitive, std::size_t vertex_count, const std::string& place) {
  std::optional<Accessor> indices;
  if (primitive.contains("indices")) {
    indices.emplace(file_, bytes_, whole(primitive, "indices", 0, place),
                    place);
    if (indices->type() == kGlbFloat || indices->width() != 1)
      fault(ErrorCode::kSyntax, place + ".indices are no whole numbers");
  }
  const std::size_t count = indices ? indices->count() : vertex_count;
  const auto vertex = [&](std::size_t i) {
    const auto at =
        indices ? static_cast<std::size_t>(indices->integer(i, 0)) : i;
    if (at >= vertex_count) {
      fault(ErrorCode::kBadIndex, place + ": index " + std::to_string(i) +
                                      " is " + std::to_string(at) + ", of " +
                                      std::to_string(vertex_count) +
                                      " vertices");
    }
    return at;
  };
  const std::int64_t mode = whole(primitive, "mode", 4, place);
  std::vector<std::array<std::size_t, 3>> triangles;
  if (mode < 4 || mode > 6) {
    ++passed_over_;
    return triangles;
  }
  if (mode == 4 && count % 3 != 0) {
    fault(ErrorCode::kSyntax, place + " has " + std::to_string(count) +
                                  " corners, not three for each triangle");
  }
  const std::size_t step = mode == 4 ? 3 : 1;
  for (std::size_t i = 0; i + 2 < count; i += step) {
    if (mode == 6) {
      triangles.push_back({vertex(0), vertex(i + 1), vertex(i + 2)});
    } else if (mode == 5 && i % 2 == 1) {
      triangles.push_back({vertex(i + 1), vertex(i), vertex(i + 2)});
    } else {
      triangles.push_back({vertex(i), vertex(i + 1), vertex(i + 2)});
    }
  }
  return triangles;
}

/// The channel of an attribute of primitives, where it has been so far.
Channel& GlbReader::channel_for(const std::string& semantic,
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

/// Adds what a vertex has to a channel: turned, and as other files have it.
void GlbReader::append_row(const Accessor& from, std::size_t row,
                           const std::array<std::array<double, 3>, 3>& turn,
                           Channel& to) const {
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
    const std::array<double, 3> normal = {values[0], values[1], values[2]};
    for (std::size_t k = 0; k < 3; ++k) {
      values[k] = turn[k][0] * normal[0] + turn[k][1] * normal[1] +
                  turn[k][2] * normal[2];
    }
    const double length = std::hypot(values[0], values[1], values[2]);
    if (length > 0) {
      for (std::size_t k = 0; k < 3; ++k) values[k] /= length;
    }
  }
  to.values.insert(to.values.end(), values.begin(),
                   values.begin() + static_cast<std::ptrdiff_t>(to.width));
}

/// The map's cofactors, by which normals are turned.
std::array<std::array<double, 3>, 3> turn_of(const ExactMap& map) {
  std::array<std::array<double, 3>, 3> m{}, turn{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) m[i][k] = to_double(map.rows[i][k]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      turn[i][k] = m[(i + 1) % 3][(k + 1) % 3] * m[(i + 2) % 3][(k + 2) % 3] -
                   m[(i + 1) % 3][(k + 2) % 3] * m[(i + 2) % 3][(k + 1) % 3];
      if (is_mirror(map)) turn[i][k] = -turn[i][k];
    }
  }
  return turn;
}

void GlbReader::add_channels(const Json& attributes, const ExactMap& map,
                             const std::vector<std::size_t>& corners,
                             std::size_t vertex_count,
                             const std::string& place) {
  const auto turn = turn_of(map);
  const std::size_t end = builder_.mesh.corners.size();
  const std::size_t begin = end - corners.size();
  for (const auto& [semantic, id] : attributes.items()) {
    const bool is_known = semantic == "TEXCOORD_0" || semantic == "NORMAL" ||
                          semantic == "COLOR_0";
    if (!is_known && (semantic.size() < 2 || semantic[0] != '_')) continue;
    if (!id.is_number_unsigned())
      fault(ErrorCode::kSyntax, place + "." + semantic + " is no index");
    const Accessor from(file_, bytes_, id.get<std::int64_t>(),
                        place + "." + semantic);
    if (from.count() < vertex_count) {
      fault(ErrorCode::kTruncated,
            place + "." + semantic + " has " + std::to_string(from.count()) +
                " of " + std::to_string(vertex_count) + " vertices");
    }
    const std::size_t width = semantic == "NORMAL"       ? 3
                              : semantic == "TEXCOORD_0" ? 2
                                                         : from.width();
    Channel& to = channel_for(semantic, width);
    to.values.resize(begin * to.width, kNoValue);
    for (const std::size_t corner : corners) append_row(from, corner, turn, to);
  }
  for (GrowingChannel& growing : channels_)
    growing.channel.values.resize(end * growing.channel.width, kNoValue);
}

/// What `--keep-origin` wrote.
void GlbReader::add_origins(const Json& primitive, std::size_t triangles,
                            const std::string& place) {
  const auto extras = primitive.find("extras");
  if (extras == primitive.end() || !extras->is_object()) return;
  const char* const names[] = {"origin_solid", "origin_polygon"};
  for (std::size_t k = 0; k < 2; ++k) {
    if (!extras->contains(names[k])) continue;
    const Accessor from(file_, bytes_, whole(*extras, names[k], 0, place),
                        place);
    if (from.count() < triangles || from.type() == kGlbFloat) continue;
    origins_[k].resize(builder_.mesh.face_count() - triangles, kNoValue);
    for (std::size_t i = 0; i < triangles; ++i)
      origins_[k].push_back(static_cast<double>(from.integer(i, 0)));
  }
}

void GlbReader::read_primitive(const Json& primitive, const ExactMap& map,
                               const std::string& place) {
  const auto attributes = primitive.find("attributes");
  if (attributes == primitive.end() || !attributes->is_object())
    fault(ErrorCode::kSyntax, place + " has no attributes");
  if (!attributes->contains("POSITION")) return;
  const Accessor points(file_, bytes_, whole(*attributes, "POSITION", 0, place),
                        place + ".POSITION");
  if (points.width() != 3)
    fault(ErrorCode::kSyntax, place + ".POSITION is no VEC3");
  placed_vertices_ += points.count();
  if (placed_vertices_ > std::max(kMostPlacedVertices, bytes_.size() / 3)) {
    fault(ErrorCode::kOutOfRange,
          place + ": meshes are placed so often that there are more than " +
              std::to_string(kMostPlacedVertices) + " vertices");
  }
  const auto triangles = triangles_of(primitive, points.count(), place);
  if (triangles.empty()) return;
  const bool is_mirrored = is_mirror(map);
  const bool is_same = map == identity_map();
  std::vector<VertexId> ids(points.count(), -1);
  std::vector<std::size_t> corners;
  const std::int64_t material = whole(primitive, "material", -1, place);
  if (material >= 0) entry_at(file_, "materials", material, place);
  const auto extras = primitive.find("extras");
  groups_.name_from_here(extras != primitive.end() && extras->is_object()
                             ? text_in(*extras, "group")
                             : std::string());
  for (auto triangle : triangles) {
    if (is_mirrored) std::swap(triangle[1], triangle[2]);
    for (const std::size_t vertex : triangle) {
      corners.push_back(vertex);
      if (ids[vertex] < 0) {
        std::array<Number, 3> at;
        for (std::size_t k = 0; k < 3; ++k) {
          const double value = points.number(vertex, k);
          if (!std::isfinite(value)) {
            fault(ErrorCode::kNotFinite, place + ": vertex " +
                                             std::to_string(vertex) + " is " +
                                             std::to_string(value));
          }
          at[k] = number_of(value);
        }
        if (!is_same) at = image_of(map, at);
        // The file's y points up, and its z to the front; ours are z and -y.
        at[2].mantissa = -at[2].mantissa;
        std::swap(at[1], at[2]);
        if (auto error = builder_.add_corner_at(std::move(at)))
          fault(error->code, error->message);
        ids[vertex] = builder_.mesh.corners.back();
        continue;
      }
      if (auto error = builder_.add_corner(ids[vertex]))
        fault(error->code, error->message);
    }
    const std::size_t face = builder_.mesh.face_count();
    objects_.add_face(face);
    groups_.add_face(face);
    face_materials_.push_back(static_cast<std::int32_t>(material));
    builder_.end_face();
  }
  add_channels(*attributes, map, corners, points.count(), place);
  add_origins(primitive, triangles.size(), place);
}

void GlbReader::read_node(const Placed& placed, std::vector<Placed>& stack) {
  const std::string place = item("nodes", placed.node);
  const Json& node =
      entry_at(file_, "nodes", static_cast<std::int64_t>(placed.node), place);
  if (placed.depth > kMostJsonDepth)
    fault(ErrorCode::kOutOfRange, place + " is too deep in the tree of nodes");
  const auto map = product_of(placed.map, map_of_node(node, place));
  if (!map) fault(ErrorCode::kOutOfRange, place + " is moved by long numbers");
  const Json& children = list_in(node, "children", place);
  for (auto child = children.rbegin(); child != children.rend(); ++child) {
    if (!child->is_number_unsigned())
      fault(ErrorCode::kSyntax, place + ".children has what is no index");
    stack.push_back({child->get<std::size_t>(), *map, placed.depth + 1});
  }
  const std::int64_t mesh_id = whole(node, "mesh", -1, place);
  if (mesh_id < 0) return;
  const Json& mesh = entry_at(file_, "meshes", mesh_id, place);
  const std::string mesh_place =
      item("meshes", static_cast<std::size_t>(mesh_id));
  const std::string name = text_in(node, "name");
  objects_.name_from_here(name.empty() ? text_in(mesh, "name") : name);
  const Json& primitives = list_in(mesh, "primitives", mesh_place);
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const std::string at = mesh_place + "." + item("primitives", i);
    if (!primitives[i].is_object())
      fault(ErrorCode::kSyntax, at + " is no object");
    read_primitive(primitives[i], *map, at);
  }
}

void GlbReader::finish() {
  Attributes& attributes = builder_.mesh.attributes;
  const std::size_t faces = builder_.mesh.face_count();
  attributes.objects = objects_.taken(faces);
  attributes.groups = groups_.taken(faces);
  const bool any = std::any_of(face_materials_.begin(), face_materials_.end(),
                               [](std::int32_t at) { return at >= 0; });
  if (any) attributes.face_materials = std::move(face_materials_);
  for (GrowingChannel& growing : channels_) {
    Channel& channel = growing.channel;
    // Normals were turned in the file's axes.
    for (std::size_t i = 0;
         channel.kind == ChannelKind::kNormal && i < channel.values.size();
         i += 3) {
      channel.values[i + 2] = -channel.values[i + 2];
      std::swap(channel.values[i + 1], channel.values[i + 2]);
    }
    attributes.corners.push_back(std::move(channel));
  }
  const char* const names[] = {"origin_solid", "origin_polygon"};
  for (std::size_t k = 0; k < 2; ++k) {
    if (origins_[k].empty()) continue;
    origins_[k].resize(faces, kNoValue);
    attributes.faces.push_back(
        {names[k], ChannelKind::kNumber, 1, std::move(origins_[k]), true});
  }
  if (passed_over_ > 0) {
    attributes.notes.push_back(std::to_string(passed_over_) +
                               " primitives of points or lines are passed "
                               "over");
  }
}

Mesh GlbReader::read() {
  if (!file_.is_object())
    fault(ErrorCode::kSyntax, "the JSON of the file is no object");
  check_extensions();
  read_materials();
  const Json& nodes = list_in(file_, "nodes", "the file");
  std::vector<Placed> stack;
  const std::vector<std::size_t> first = roots();
  for (auto root = first.rbegin(); root != first.rend(); ++root)
    stack.push_back({*root, identity_map(), 0});
  std::vector<bool> is_seen(nodes.size());
  while (!stack.empty()) {
    const Placed placed = std::move(stack.back());
    stack.pop_back();
    if (placed.node < is_seen.size()) {
      if (is_seen[placed.node])
        fault(ErrorCode::kSyntax,
              item("nodes", placed.node) + " is in the tree of nodes twice");
      is_seen[placed.node] = true;
    }
    read_node(placed, stack);
  }
  finish();
  return std::move(builder_.mesh);
}

/// Brackets that are open at once, outside of texts.
bool is_too_deep(std::string_view text) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_text) {
      if (c == '\\') ++i;
      if (c == '"') in_text = false;
      continue;
    }
    if (c == '"') in_text = true;
    if ((c == '[' || c == '{') && ++depth > kMostJsonDepth) return true;
    if (c == ']' || c == '}') --depth;
  }
  return false;
}

/// The two chunks of a file; errors name the byte.
struct GlbChunks {
  std::string_view json;
  std::string_view bytes;
};

Result<GlbChunks> chunks_of(std::string_view file) {
  const auto word = [&](std::size_t at) {
    return load<std::uint32_t>(file, at, ByteOrder::kLittle);
  };
  if (file.size() < kGlbHeader || word(0) != kGlbMagic)
    return Error{ErrorCode::kUnknownFormat, "a GLB begins with glTF", 0};
  if (word(4) != 2) {
    return Error{ErrorCode::kUnknownFormat,
                 "the GLB is of version " + std::to_string(word(4)) +
                     ", and only 2 is read",
                 4};
  }
  if (word(8) > file.size()) {
    return Error{ErrorCode::kTruncated,
                 "the file ends at byte " + std::to_string(file.size()) +
                     " of " + std::to_string(word(8)),
                 static_cast<std::int64_t>(file.size())};
  }
  file = file.substr(0, word(8));
  GlbChunks chunks;
  std::size_t at = kGlbHeader;
  for (int i = 0; at + kGlbChunkHeader <= file.size(); ++i) {
    const std::uint32_t size = word(at), type = word(at + 4);
    at += kGlbChunkHeader;
    if (size > file.size() - at) {
      return Error{ErrorCode::kTruncated,
                   "the chunk at byte " + std::to_string(at - kGlbChunkHeader) +
                       " claims " + std::to_string(size) + " bytes, but " +
                       std::to_string(file.size() - at) + " are left",
                   static_cast<std::int64_t>(at - kGlbChunkHeader)};
    }
    if (i == 0 && type == kGlbJson) chunks.json = file.substr(at, size);
    if (i == 1 && type == kGlbBytes) chunks.bytes = file.substr(at, size);
    at += size;
  }
  if (chunks.json.empty())
    return Error{ErrorCode::kSyntax, "the GLB has no chunk of JSON", 12};
  if (chunks.json.size() > kMostJsonBytes || is_too_deep(chunks.json)) {
    return Error{ErrorCode::kOutOfRange,
                 "the GLB's JSON has over " + std::to_string(kMostJsonBytes) +
                     " bytes, or over " + std::to_string(kMostJsonDepth) +
                     " brackets within one another",
                 20};
  }
  return chunks;
}

}  // namespace

Result<Mesh> read_glb(std::string_view bytes) {
  const Result<GlbChunks> chunks = chunks_of(bytes);
  if (!chunks) return chunks.error();
  try {
    const Json file = Json::parse(chunks->json);
    return GlbReader(file, chunks->bytes).read();
  } catch (const GlbFault& wrong) {
    return Error{wrong.code, wrong.message, -1};
  } catch (const Json::parse_error& wrong) {
    return Error{
        ErrorCode::kSyntax,
        "byte " + std::to_string(kGlbHeader + kGlbChunkHeader + wrong.byte) +
            " is no JSON",
        static_cast<std::int64_t>(kGlbHeader + kGlbChunkHeader + wrong.byte)};
  } catch (const Json::exception& wrong) {
    return Error{ErrorCode::kSyntax,
                 std::string("the JSON of the GLB: ") + wrong.what(), -1};
  }
}

}  // namespace halfspace::io
