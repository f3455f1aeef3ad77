#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "halfspace/message.hpp"
#include "mesh/images.hpp"
#include "mesh/label_maker.hpp"
#include "mesh/mesh_builder.hpp"
#include "mesh/package/model_3mf.hpp"
#include "mesh/readers.hpp"

namespace halfspace::io {
namespace {

/// Components within one another, and vertices that placing objects again and
/// again makes, are no more than these.
constexpr int kMost3mfDepth = 32;
constexpr std::size_t kMost3mfVertices = std::size_t{1} << 23;
/// Images that unpack to more are passed over.
constexpr std::uint64_t kMost3mfImageBytes = std::uint64_t{1} << 28;

/// The part of a package that holds the model: what its relationships name,
/// which is the usual one or the only one that ends so.
std::string model_part_of(const PackageReader& package) {
  const std::string usual = "3D/3dmodel.model";
  if (package.has(usual)) return usual;
  std::string text;
  const auto take = [&text](std::string_view bytes, bool) {
    text += bytes;
    return true;
  };
  constexpr std::uint64_t kMostRelations = 1 << 20;
  if (package.read("_rels/.rels", kMostRelations, take)) {
    const std::size_t end = text.find(".model\"");
    const std::size_t begin =
        end == std::string::npos ? end : text.rfind('"', end);
    if (begin != std::string::npos) {
      std::string name = text.substr(begin + 1, end + 6 - begin - 1);
      if (name.starts_with('/')) name.erase(0, 1);
      if (package.has(name)) return name;
    }
  }
  for (const std::string& name : package.names()) {
    if (name.ends_with(".model")) return name;
  }
  return usual;
}

/// Puts the objects of a build together.
class Builder3mf {
 public:
  Builder3mf(const PackageReader& package, const Stop& stop)
      : package_(package), builder_(stop) {}
  Result<Mesh> build();

 private:
  /// A group of properties of one part, and where its materials are among the
  /// mesh's.
  struct Placed {
    const Model3mfGroup* group;
    std::size_t first_material;
  };
  Error at(const std::string& part, std::int64_t line,
           const std::string& what) const {
    return {ErrorCode::kBadIndex,
            part + ", line " + std::to_string(line) + ": " + what, line};
  }
  std::optional<Error> load(const std::string& part);
  static Material material_at(const Model3mf& model, const Model3mfGroup& group,
                              std::size_t i);
  Material textured_material(const Model3mf& model, std::int64_t id,
                             const Model3mfGroup& group);
  std::shared_ptr<const Image> image_at(const std::string& path);
  std::optional<Error> add(const std::string& part, const Model3mfUse& use,
                           const ExactMap& outer, int depth);
  std::optional<Error> add_mesh(const std::string& part,
                                const Model3mfObject& object,
                                const ExactMap& map);
  void add_sets(const Model3mfObject& object, std::size_t first_face);
  void add_properties(const std::string& part, const Model3mfTriangle& triangle,
                      std::array<std::size_t, 3> order);
  void finish();

  const PackageReader& package_;
  std::map<std::string, Model3mf> parts_;
  std::map<std::pair<std::string, std::int64_t>, std::size_t> first_material_;
  /// By path in the package; null where there is none.
  std::map<std::string, std::shared_ptr<const Image>> images_;
  std::uint64_t image_bytes_ = 0;  // of all of them
  MeshBuilder builder_;
  LabelMaker objects_, groups_;
  std::vector<std::int32_t> face_materials_, set_objects_, set_groups_;
  std::vector<std::array<double, 4>> colors_;  // by corner
  std::vector<std::array<double, 2>> texture_;
  std::array<std::vector<double>, 2> origins_;
  bool has_colors_ = false, has_texture_ = false, has_origins_ = false;
};

std::optional<Error> Builder3mf::load(const std::string& part) {
  if (parts_.contains(part)) return std::nullopt;
  Result<Model3mf> model = read_model_3mf(package_, part);
  if (!model) return model.error();
  Model3mf& loaded = parts_[part] = *std::move(model);
  std::vector<Material>& materials = builder_.mesh.attributes.materials;
  for (auto& [id, group] : loaded.groups) {
    first_material_[{part, id}] = materials.size();
    for (std::size_t i = 0; i < group.materials.size(); ++i)
      materials.push_back(material_at(loaded, group, i));
    if (group.texture.empty()) continue;
    materials.push_back(textured_material(loaded, id, group));
  }
  return std::nullopt;
}

/// A material of a group of them, and how metallic and how rough it is.
Material Builder3mf::material_at(const Model3mf& model,
                                 const Model3mfGroup& group, std::size_t i) {
  Material material = group.materials[i];
  const auto found = model.surfaces.find(group.surfaces_id);
  if (found == model.surfaces.end() || i >= found->second.size())
    return material;
  // What others take where nothing is said is not said.
  const Model3mfSurface& surface = found->second[i];
  if (surface.metallic != 0) material.metallic = surface.metallic;
  if (surface.roughness != 1) material.roughness = surface.roughness;
  return material;
}

/// The material of texture points, with its image.
Material Builder3mf::textured_material(const Model3mf& model, std::int64_t id,
                                       const Model3mfGroup& group) {
  Material material;
  material.name = "texture " + std::to_string(id);
  const auto base = model.groups.find(group.material_group);
  if (base != model.groups.end() &&
      group.material < base->second.materials.size()) {
    material = material_at(model, base->second, group.material);
  }
  const auto path = model.textures.find(group.texture_id);
  if (path == model.textures.end()) return material;
  const std::string& name = path->second;
  material.image = image_at(name);
  if (material.image)
    material.texture = name.substr(name.find_last_of('/') + 1);
  return material;
}

/// The image of the package, read once; null, with a note, where there is none.
std::shared_ptr<const Image> Builder3mf::image_at(const std::string& path) {
  const auto [at, is_new] = images_.try_emplace(path, nullptr);
  if (!is_new) return at->second;
  std::string bytes;
  const auto take = [&bytes](std::string_view some, bool) {
    bytes += some;
    return true;
  };
  const Result<Done> done =
      package_.read(path.starts_with('/') ? path.substr(1) : path,
                    kMost3mfImageBytes - image_bytes_, take);
  if (done && image_type(bytes) != nullptr) {
    image_bytes_ += bytes.size();
    at->second = std::make_shared<const Image>(Image{{}, std::move(bytes)});
    return at->second;
  }
  builder_.mesh.attributes.notes.push_back(
      "the image " + in_quotes(path) + " is passed over: " +
      (done ? "it is neither a PNG nor a JPEG" : done.error().message));
  return nullptr;
}

std::optional<Error> Builder3mf::add(const std::string& part,
                                     const Model3mfUse& use,
                                     const ExactMap& outer, int depth) {
  std::string from = use.part.empty() ? part : use.part;
  if (from.starts_with('/')) from.erase(0, 1);
  if (auto error = load(from)) return error;
  const Model3mf& model = parts_[from];
  const auto found = model.objects.find(use.object);
  if (found == model.objects.end()) {
    return at(part, use.line,
              "there is no object " + std::to_string(use.object));
  }
  if (depth > kMost3mfDepth) {
    return at(part, use.line,
              "there are over " + std::to_string(kMost3mfDepth) +
                  " components within one another");
  }
  const auto map = product_of(outer, use.map);
  if (!map) return at(part, use.line, "the transforms need too many digits");
  const Model3mfObject& object = found->second;
  if (!object.triangles.empty()) {
    objects_.name_from_here(object.name);
    if (auto error = add_mesh(from, object, *map)) return error;
  }
  for (const Model3mfUse& component : object.components) {
    if (auto error = add(from, component, *map, depth + 1)) return error;
    if (builder_.mesh.vertices.size() > kMost3mfVertices &&
        object.components.size() > 1) {
      return at(from, component.line,
                "components are placed so often that there are more than " +
                    std::to_string(kMost3mfVertices) + " vertices");
    }
  }
  return std::nullopt;
}

/// Adds what the corners of a triangle have; they come in this order.
void Builder3mf::add_properties(const std::string& part,
                                const Model3mfTriangle& triangle,
                                std::array<std::size_t, 3> order) {
  std::int32_t material = -1;
  std::array<double, 4> no_color;
  no_color.fill(kNoValue);
  const auto& groups = parts_[part].groups;
  const auto found = groups.find(triangle.group);
  const Model3mfGroup* group = found == groups.end() ? nullptr : &found->second;
  for (const std::size_t k : order) {
    const std::uint32_t at = triangle.properties[k];
    const bool has_color = group && at < group->colors.size();
    const bool has_texture = group && at < group->texture.size();
    colors_.push_back(has_color ? group->colors[at] : no_color);
    texture_.push_back(has_texture ? group->texture[at]
                                   : std::array<double, 2>{kNoValue, kNoValue});
    has_colors_ = has_colors_ || has_color;
    has_texture_ = has_texture_ || has_texture;
  }
  if (group != nullptr) {
    const std::size_t first = first_material_[{part, triangle.group}];
    // What the writer calls none is none.
    if (triangle.properties[0] < group->materials.size() &&
        group->materials[triangle.properties[0]].name != "none")
      material = static_cast<std::int32_t>(first + triangle.properties[0]);
    if (!group->texture.empty())
      material = static_cast<std::int32_t>(first + group->materials.size());
  }
  face_materials_.push_back(material);
  for (std::size_t k = 0; k < 2; ++k) {
    has_origins_ = has_origins_ || triangle.origin[k] >= 0;
    origins_[k].push_back(triangle.origin[k] < 0
                              ? kNoValue
                              : static_cast<double>(triangle.origin[k]));
  }
}

void Builder3mf::add_sets(const Model3mfObject& object,
                          std::size_t first_face) {
  const std::size_t count = object.triangles.size();
  set_objects_.resize(first_face + count, -1);
  set_groups_.resize(first_face + count, -1);
  for (const Model3mfSet& set : object.sets) {
    const bool is_object = set.identifier.starts_with("object");
    LabelMaker& labels = is_object ? objects_ : groups_;
    const std::int32_t name = labels.place_of(set.name);
    for (const auto& [first, last] : set.ranges) {
      for (std::uint64_t i = first; i <= last && i < count; ++i) {
        (is_object ? set_objects_
                   : set_groups_)[first_face + static_cast<std::size_t>(i)] =
            name;
      }
    }
  }
}

std::optional<Error> Builder3mf::add_mesh(const std::string& part,
                                          const Model3mfObject& object,
                                          const ExactMap& map) {
  const bool is_same = map == identity_map();
  const bool is_mirrored = !is_same && is_mirror(map);
  const std::size_t first = builder_.mesh.vertices.size();
  for (const ExactPoint3& point : object.vertices) {
    if (auto error =
            builder_.add_vertex(is_same ? point : image_of(map, point)))
      return error;
  }
  const std::size_t first_face = builder_.mesh.face_count();
  const std::array<std::size_t, 3> order =
      is_mirrored ? std::array<std::size_t, 3>{0, 2, 1}
                  : std::array<std::size_t, 3>{0, 1, 2};
  for (const Model3mfTriangle& triangle : object.triangles) {
    for (const std::size_t k : order) {
      if (auto error = builder_.add_corner(
              static_cast<std::int64_t>(first + triangle.vertices[k])))
        return error;
    }
    objects_.add_face(builder_.mesh.face_count());
    builder_.end_face();
    add_properties(part, triangle, order);
  }
  add_sets(object, first_face);
  return std::nullopt;
}

/// Makes the properties the mesh's; those that no triangle has go.
void Builder3mf::finish() {
  Mesh& mesh = builder_.mesh;
  Attributes& attributes = mesh.attributes;
  const std::size_t faces = mesh.face_count();
  const auto override_by = [faces](const std::vector<std::int32_t>& sets,
                                   Labels& labels) {
    for (std::size_t face = 0; face < faces; ++face) {
      if (sets[face] < 0) continue;
      labels.of_face.resize(faces, -1);
      labels.of_face[face] = sets[face];
    }
  };
  attributes.objects = objects_.taken(faces);
  attributes.groups = groups_.taken(faces);
  set_objects_.resize(faces, -1);
  set_groups_.resize(faces, -1);
  override_by(set_objects_, attributes.objects);
  override_by(set_groups_, attributes.groups);
  if (std::any_of(face_materials_.begin(), face_materials_.end(),
                  [](std::int32_t at) { return at >= 0; }))
    attributes.face_materials = std::move(face_materials_);
  if (has_texture_) {
    Channel channel{"uv", ChannelKind::kTexture, 2, {}, false};
    for (const auto& [u, v] : texture_)
      channel.values.insert(channel.values.end(), {u, v});
    attributes.corners.push_back(std::move(channel));
  }
  const char* const names[] = {"origin_solid", "origin_polygon"};
  for (std::size_t k = 0; has_origins_ && k < 2; ++k) {
    attributes.faces.push_back(
        {names[k], ChannelKind::kNumber, 1, std::move(origins_[k]), true});
  }
  if (!has_colors_) return;
  const auto color_at = [this](std::size_t corner) {
    return rgb_of(colors_[corner]);
  };
  bool is_flat = true;
  for (std::size_t face = 0; face < faces && is_flat; ++face) {
    is_flat = color_at(3 * face) == color_at(3 * face + 1) &&
              color_at(3 * face) == color_at(3 * face + 2);
  }
  if (is_flat) {
    for (std::size_t face = 0; face < faces; ++face)
      mesh.face_colors.push_back(color_at(3 * face));
    return;
  }
  Channel channel{"color", ChannelKind::kColor, 4, {}, false};
  for (const auto& color : colors_)
    channel.values.insert(channel.values.end(), color.begin(), color.end());
  attributes.corners.push_back(std::move(channel));
}

Result<Mesh> Builder3mf::build() {
  builder_.mesh.decimal = true;
  const std::string root = model_part_of(package_);
  if (auto error = load(root)) return *error;
  const Model3mf& model = parts_[root];
  ExactMap scale = identity_map();
  for (std::size_t k = 0; k < 3; ++k) scale.rows[k][k] = model.unit;
  for (const Model3mfUse& item : model.items) {
    if (auto error = add(root, item, scale, 0)) return *error;
    if (builder_.mesh.vertices.size() > kMost3mfVertices &&
        model.items.size() > 1 && model.objects.size() < model.items.size()) {
      return at(root, item.line,
                "objects are placed so often that there are more than " +
                    std::to_string(kMost3mfVertices) + " vertices");
    }
  }
  if (model.items.empty() && !model.objects.empty()) {
    return Error{ErrorCode::kEmpty,
                 root + ": the model has objects, but its build names none",
                 -1};
  }
  finish();
  return std::move(builder_.mesh);
}

}  // namespace

Result<Mesh> read_3mf(std::string_view bytes, const Stop& stop) {
  const Result<PackageReader> package = PackageReader::open(bytes);
  if (!package) return package.error();
  return Builder3mf(*package, stop).build();
}

}  // namespace halfspace::io
