#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "halfspace/message.hpp"
#include "mesh/glb/glb.hpp"
#include "mesh/glb/gltf_accessor.hpp"
#include "mesh/glb/gltf_attributes.hpp"
#include "mesh/glb/gltf_file.hpp"
#include "mesh/mesh_builder.hpp"
#include "mesh/number_math.hpp"
#include "mesh/readers.hpp"

namespace halfspace::io {
namespace {

/// More vertices than these are not made by placing meshes again and again.
constexpr std::size_t kMostPlacedVertices = std::size_t{1} << 23;

/// Where a node's rotation and scale put things.
Result<ExactMap> scaled_turn_of(const Json& node, const std::string& place) {
  const auto scale = doubles_in(node, "scale", {1, 1, 1}, place);
  if (!scale) return scale.error();
  const auto q = doubles_in(node, "rotation", {0, 0, 0, 1}, place);
  if (!q) return q.error();
  const double x = (*q)[0], y = (*q)[1], z = (*q)[2], w = (*q)[3];
  const std::array<std::array<double, 3>, 3> turn = {
      {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
       {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
       {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
  ExactMap map = identity_map();
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      const double value = turn[row][column] * (*scale)[column];
      if (!std::isfinite(value)) {
        return Error{ErrorCode::kNotFinite, place + " is moved beyond doubles"};
      }
      map.rows[row][column] = number_of(value);
    }
  }
  return map;
}

/// Where a node's own map puts things; in exact numbers of its doubles.
Result<ExactMap> map_of_node(const Json& node, const std::string& place) {
  if (node.contains("matrix")) {
    const auto values =
        doubles_in(node, "matrix", std::vector<double>(16), place);
    if (!values) return values.error();
    ExactMap map = identity_map();
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 4; ++column)
        map.rows[row][column] = number_of((*values)[4 * column + row]);
    }
    return map;
  }
  Result<ExactMap> map = scaled_turn_of(node, place);
  if (!map) return map;
  const auto shift = doubles_in(node, "translation", {0, 0, 0}, place);
  if (!shift) return shift.error();
  for (std::size_t row = 0; row < 3; ++row)
    map->rows[row][3] = number_of((*shift)[row]);
  return map;
}

/// Extensions without which a file can be read all the same.
bool can_be_passed_over(const std::string& extension) {
  return extension == "KHR_mesh_quantization" ||
         extension == "KHR_lights_punctual" ||
         extension.starts_with("KHR_materials_") ||
         extension.starts_with("KHR_texture_") ||
         extension == "EXT_texture_webp";
}

/// Puts the meshes of a scene's nodes together.
class GltfReader {
 public:
  GltfReader(const GltfFile& file, const Stop& stop)
      : file_(file), builder_(stop), attributes_(file, builder_.mesh) {}
  Result<Mesh> read();

 private:
  struct Placed {
    std::size_t node;
    ExactMap map;
    int depth;
  };
  std::optional<Error> check_extensions() const;
  Result<std::vector<std::size_t>> roots() const;
  Result<std::vector<std::size_t>> nodes_in(const Json& object,
                                            const char* name,
                                            const std::string& place) const;
  std::optional<Error> read_nodes();
  std::optional<Error> read_node(const Placed& placed,
                                 std::vector<Placed>& stack);
  std::optional<Error> read_primitive(const Json& primitive,
                                      const ExactMap& map,
                                      const std::string& place);
  Result<std::vector<std::size_t>> corners_of(const Json& primitive,
                                              std::size_t vertex_count,
                                              const std::string& place);
  std::optional<Error> add_triangles(const Accessor& points,
                                     const GltfTriangles& triangles);

  const GltfFile& file_;
  MeshBuilder builder_;
  GltfAttributes attributes_;
  std::size_t placed_vertices_ = 0;
  std::size_t passed_over_ = 0;  // primitives of points and lines
};

std::optional<Error> GltfReader::check_extensions() const {
  const auto list = list_in(file_.json, "extensionsRequired", "the file");
  if (!list) return list.error();
  for (const Json& name : **list) {
    const std::string text =
        name.is_string() ? name.get<std::string>() : std::string("?");
    if (can_be_passed_over(text)) continue;
    return Error{ErrorCode::kUnknownFormat,
                 "the file needs the extension " + in_quotes(text) +
                     ", which is not read; export it without"};
  }
  return std::nullopt;
}

/// A list of numbers of nodes.
Result<std::vector<std::size_t>> GltfReader::nodes_in(
    const Json& object, const char* name, const std::string& place) const {
  const auto list = list_in(object, name, place);
  if (!list) return list.error();
  std::vector<std::size_t> nodes;
  for (const Json& node : **list) {
    if (!node.is_number_unsigned()) {
      return Error{ErrorCode::kSyntax,
                   place + "." + name + " has what is no index"};
    }
    nodes.push_back(node.get<std::size_t>());
  }
  return nodes;
}

Result<std::vector<std::size_t>> GltfReader::roots() const {
  const auto scenes = list_in(file_.json, "scenes", "the file");
  if (!scenes) return scenes.error();
  if (!(*scenes)->empty()) {
    const auto scene = whole(file_.json, "scene", 0, "the file");
    if (!scene) return scene.error();
    const auto entry = entry_at(file_.json, "scenes", *scene, "the file");
    if (!entry) return entry.error();
    return nodes_in(**entry, "nodes",
                    item("scenes", static_cast<std::size_t>(*scene)));
  }
  // Then all nodes that are no other's.
  const auto nodes = list_in(file_.json, "nodes", "the file");
  if (!nodes) return nodes.error();
  std::vector<bool> is_child((*nodes)->size());
  for (const Json& node : **nodes) {
    if (!node.is_object()) continue;
    const auto children = nodes_in(node, "children", "a node");
    if (!children) return children.error();
    for (const std::size_t child : *children) {
      if (child < is_child.size()) is_child[child] = true;
    }
  }
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) roots.push_back(i);
  }
  return roots;
}

/// The corners of the triangles, as vertices of the primitive.
Result<std::vector<std::size_t>> GltfReader::corners_of(
    const Json& primitive, std::size_t vertex_count, const std::string& place) {
  std::vector<std::size_t> order;
  if (primitive.contains("indices")) {
    const auto id = whole(primitive, "indices", 0, place);
    if (!id) return id.error();
    const auto indices = Accessor::of(file_, *id, place);
    if (!indices) return indices.error();
    if (indices->type() == kGlbFloat || indices->width() != 1)
      return Error{ErrorCode::kSyntax, place + ".indices are no whole numbers"};
    for (std::size_t i = 0; i < indices->count(); ++i) {
      order.push_back(static_cast<std::size_t>(indices->integer(i, 0)));
      if (order.back() < vertex_count) continue;
      return Error{ErrorCode::kBadIndex,
                   place + ": index " + std::to_string(i) + " is " +
                       std::to_string(order.back()) + ", of " +
                       std::to_string(vertex_count) + " vertices"};
    }
  } else {
    for (std::size_t i = 0; i < vertex_count; ++i) order.push_back(i);
  }
  const auto mode = whole(primitive, "mode", 4, place);
  if (!mode) return mode.error();
  if (*mode < 4 || *mode > 6) {
    ++passed_over_;
    return std::vector<std::size_t>{};
  }
  if (*mode == 4) {
    if (order.size() % 3 == 0) return order;
    return Error{ErrorCode::kSyntax,
                 place + " has " + std::to_string(order.size()) +
                     " corners, not three for each triangle"};
  }
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i + 2 < order.size(); ++i) {
    // A strip's triangles take turns; a fan's all begin at its first corner.
    const bool is_fan = *mode == 6;
    const std::size_t odd = !is_fan && i % 2 == 1 ? 1 : 0;
    corners.push_back(order[is_fan ? 0 : i + odd]);
    corners.push_back(order[i + 1 - odd]);
    corners.push_back(order[i + 2]);
  }
  return corners;
}

std::optional<Error> GltfReader::add_triangles(const Accessor& points,
                                               const GltfTriangles& triangles) {
  const ExactMap& map = *triangles.map;
  const bool is_same = map == identity_map();
  std::vector<VertexId> ids(points.count(), -1);
  for (std::size_t i = 0; i < triangles.corners.size(); ++i) {
    const std::size_t vertex = triangles.corners[i];
    if (ids[vertex] >= 0) {
      if (auto error = builder_.add_corner(ids[vertex])) return error;
    } else {
      std::array<Number, 3> at;
      for (std::size_t k = 0; k < 3; ++k) {
        const double value = points.number(vertex, k);
        if (!std::isfinite(value)) {
          return Error{ErrorCode::kNotFinite,
                       triangles.place + ": vertex " + std::to_string(vertex) +
                           " is " + std::to_string(value)};
        }
        at[k] = number_of(value);
      }
      if (!is_same) at = image_of(map, at);
      // The file's y points up, and its z to the front; ours are z and -y.
      at[2].mantissa = -at[2].mantissa;
      std::swap(at[1], at[2]);
      if (auto error = builder_.add_corner_at(std::move(at))) return error;
      ids[vertex] = builder_.mesh.corners.back();
    }
    if (i % 3 == 2) builder_.end_face();
  }
  return std::nullopt;
}

std::optional<Error> GltfReader::read_primitive(const Json& primitive,
                                                const ExactMap& map,
                                                const std::string& place) {
  const Json* attributes = object_in(primitive, "attributes");
  if (attributes == nullptr)
    return Error{ErrorCode::kSyntax, place + " has no attributes"};
  if (!attributes->contains("POSITION")) return std::nullopt;
  const auto id = whole(*attributes, "POSITION", 0, place);
  if (!id) return id.error();
  const auto points = Accessor::of(file_, *id, place + ".POSITION");
  if (!points) return points.error();
  if (points->width() != 3)
    return Error{ErrorCode::kSyntax, place + ".POSITION is no VEC3"};
  placed_vertices_ += points->count();
  std::size_t bytes = 0;
  for (const std::string_view buffer : file_.buffers) bytes += buffer.size();
  if (placed_vertices_ > std::max(kMostPlacedVertices, bytes / 3)) {
    return Error{ErrorCode::kOutOfRange,
                 place +
                     ": meshes are placed so often that there are more "
                     "than " +
                     std::to_string(kMostPlacedVertices) + " vertices"};
  }
  auto corners = corners_of(primitive, points->count(), place);
  if (!corners) return corners.error();
  if (corners->empty()) return std::nullopt;
  if (is_mirror(map)) {
    for (std::size_t i = 0; i < corners->size(); i += 3)
      std::swap((*corners)[i + 1], (*corners)[i + 2]);
  }
  const GltfTriangles triangles{&primitive, place, points->count(),
                                *std::move(corners), &map};
  if (auto error = add_triangles(*points, triangles)) return error;
  return attributes_.add(triangles);
}

std::optional<Error> GltfReader::read_node(const Placed& placed,
                                           std::vector<Placed>& stack) {
  const std::string place = item("nodes", placed.node);
  const auto node = entry_at(file_.json, "nodes",
                             static_cast<std::int64_t>(placed.node), place);
  if (!node) return node.error();
  if (placed.depth > kMostJsonDepth) {
    return Error{ErrorCode::kOutOfRange,
                 place + " is too deep in the tree of nodes"};
  }
  const auto own = map_of_node(**node, place);
  if (!own) return own.error();
  const auto map = product_of(placed.map, *own);
  if (!map) {
    return Error{ErrorCode::kOutOfRange, place + " is moved by long numbers"};
  }
  const auto children = nodes_in(**node, "children", place);
  if (!children) return children.error();
  for (auto child = children->rbegin(); child != children->rend(); ++child)
    stack.push_back({*child, *map, placed.depth + 1});
  const auto id = whole(**node, "mesh", -1, place);
  if (!id) return id.error();
  if (*id < 0) return std::nullopt;
  const auto mesh = entry_at(file_.json, "meshes", *id, place);
  if (!mesh) return mesh.error();
  const std::string mesh_place = item("meshes", static_cast<std::size_t>(*id));
  const std::string name = text_in(**node, "name");
  attributes_.name_object(name.empty() ? text_in(**mesh, "name") : name);
  const auto primitives = list_in(**mesh, "primitives", mesh_place);
  if (!primitives) return primitives.error();
  for (std::size_t i = 0; i < (*primitives)->size(); ++i) {
    const Json& primitive = (**primitives)[i];
    const std::string at = mesh_place + "." + item("primitives", i);
    if (!primitive.is_object())
      return Error{ErrorCode::kSyntax, at + " is no object"};
    if (auto error = read_primitive(primitive, *map, at)) return error;
  }
  return std::nullopt;
}

std::optional<Error> GltfReader::read_nodes() {
  const auto nodes = list_in(file_.json, "nodes", "the file");
  if (!nodes) return nodes.error();
  const auto first = roots();
  if (!first) return first.error();
  std::vector<Placed> stack;
  for (auto root = first->rbegin(); root != first->rend(); ++root)
    stack.push_back({*root, identity_map(), 0});
  std::vector<bool> is_seen((*nodes)->size());
  while (!stack.empty()) {
    const Placed placed = std::move(stack.back());
    stack.pop_back();
    if (placed.node < is_seen.size()) {
      if (is_seen[placed.node]) {
        return Error{ErrorCode::kSyntax, item("nodes", placed.node) +
                                             " is in the tree of nodes twice"};
      }
      is_seen[placed.node] = true;
    }
    if (auto error = read_node(placed, stack)) return error;
  }
  return std::nullopt;
}

Result<Mesh> GltfReader::read() {
  if (auto error = check_extensions()) return *error;
  if (auto error = attributes_.read_materials()) return *error;
  if (auto error = read_nodes()) return *error;
  attributes_.finish();
  Attributes& attributes = builder_.mesh.attributes;
  attributes.files.insert(attributes.files.begin(), file_.files.begin(),
                          file_.files.end());
  if (passed_over_ > 0) {
    attributes.notes.push_back(std::to_string(passed_over_) +
                               " primitives of points or lines are passed "
                               "over");
  }
  return std::move(builder_.mesh);
}

}  // namespace

Result<Mesh> read_gltf(std::string_view bytes,
                       const std::filesystem::path* folder, const Stop& stop) {
  const Result<GltfFile> file = gltf_file(bytes, folder);
  if (!file) return file.error();
  return GltfReader(*file, stop).read();
}

}  // namespace halfspace::io
