#include "import.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "halfspace/csg/repair.hpp"
#include "halfspace/csg/trimmed.hpp"
#include "halfspace/io/import.hpp"
#include "halfspace/io/load_scene.hpp"
#include "halfspace/io/read_mesh.hpp"
#include "number.hpp"

namespace halfspace::detail {
namespace {

/// Whether a file says of its faces, or of their corners, what differs within
/// what has one colour, one material and one name.
bool has_numbers(const io::Attributes& attributes) {
  return !attributes.corners.empty() ||
         std::any_of(attributes.faces.begin(), attributes.faces.end(),
                     [](const io::Channel& channel) {
                       return channel.kind != io::ChannelKind::kColor;
                     });
}

/// Colours that keep apart in one plane what has other properties: polygons
/// merge where these agree.
class Groups {
 public:
  Groups(const Mesh* properties, const io::Attributes* attributes)
      : properties_(properties), attributes_(attributes) {}

  /// Whether polygons may merge at all: the affine functions of fields are the
  /// polygons' own, and there are no more codes than colours.
  bool may_merge() const {
    return (properties_ == nullptr || properties_->field_count == 0) &&
           (attributes_ == nullptr || !has_numbers(*attributes_)) &&
           codes_.size() < kMostCodes;
  }
  Rgb code_of(std::size_t polygon) {
    Key key{{}, {-1, -1, -1, -1}};
    const auto take = [&](std::size_t which,
                          const std::vector<std::int32_t>& of_face) {
      if (!of_face.empty()) key.second[which] = of_face[polygon];
    };
    if (properties_ != nullptr) {
      if (!properties_->colors.empty())
        key.first = properties_->colors[polygon];
      take(0, properties_->materials);
    }
    if (attributes_ != nullptr) {
      take(1, attributes_->face_materials);
      take(2, attributes_->objects.of_face);
      take(3, attributes_->groups.of_face);
    }
    const auto next = static_cast<std::uint32_t>(codes_.size());
    const std::uint32_t code = codes_.try_emplace(key, next).first->second;
    return {static_cast<std::uint8_t>(code >> 16),
            static_cast<std::uint8_t>(code >> 8),
            static_cast<std::uint8_t>(code)};
  }

 private:
  using Key = std::pair<Rgb, std::array<std::int32_t, 4>>;
  static constexpr std::size_t kMostCodes = std::size_t{1} << 24;
  const Mesh* properties_;
  const io::Attributes* attributes_;
  std::map<Key, std::uint32_t> codes_;
};

/// The source that nothing has to be looked for in.
Result<csg::Source> trusted_source(const std::string& name,
                                   const io::Imported& imported) {
  Result<Scene> scene = make_scene(csg::trimmed(imported.scene));
  if (!scene) return io::error_about(name, scene.error());
  auto source = csg::closed_source(name, *std::move(scene), imported);
  if (!source) return io::error_about(name, source.error());
  return source;
}

bool has_colors(const io::Mesh& mesh) {
  const auto any = [](const std::vector<std::optional<Rgb>>& colors) {
    return std::any_of(colors.begin(), colors.end(),
                       [](const auto& color) { return color.has_value(); });
  };
  return any(mesh.vertex_colors) || any(mesh.face_colors) ||
         (!mesh.attributes.face_materials.empty() &&
          std::any_of(
              mesh.attributes.materials.begin(),
              mesh.attributes.materials.end(),
              [](const io::Material& m) { return m.color.has_value(); }));
}

/// The colours that import gives a file's polygons, as properties; which are
/// the file's, in `has_color`.
std::shared_ptr<const Mesh> properties_of(const io::Mesh& mesh,
                                          std::vector<bool>& has_color) {
  if (!has_colors(mesh)) return nullptr;
  auto imported = io::import_scene(mesh, io::unlit());
  if (!imported) return nullptr;
  has_color = std::move(imported->has_color);
  auto properties = std::make_shared<Mesh>();
  properties->colors.resize(mesh.face_count());
  for (std::size_t p = 0; p < imported->faces.size(); ++p) {
    properties->colors[static_cast<std::size_t>(imported->faces[p])] =
        imported->scene.color(static_cast<PolygonId>(p));
  }
  return properties;
}

/// By origin the colour of the first face that has it.
std::vector<Rgb> colors_of_origins(const SolidData& data) {
  std::vector<Rgb> colors(data.origins.size());
  for (auto face = data.faces.rbegin(); face != data.faces.rend(); ++face)
    colors[face->origin] = face->color;
  return colors;
}

}  // namespace

Result<LeafData> imported_leaf(const std::string& name, io::Mesh mesh,
                               std::shared_ptr<const Mesh> properties,
                               const ImportHow& how) {
  std::shared_ptr<const io::AttributedFaces> attributed;
  if (!mesh.attributes.empty() || !mesh.face_colors.empty() ||
      !mesh.vertex_colors.empty()) {
    auto faces =
        std::make_shared<const io::AttributedFaces>(io::attributed_faces(mesh));
    if (!faces->attributes.empty()) attributed = std::move(faces);
  }
  Groups groups(properties.get(),
                attributed ? &attributed->attributes : nullptr);
  mesh.vertex_colors.clear();
  mesh.face_colors.resize(mesh.face_count());
  for (std::size_t p = 0; p < mesh.face_count(); ++p)
    mesh.face_colors[p] = groups.code_of(p);
  Result<io::Imported> imported = io::import_scene(mesh, {});
  if (!imported) return io::error_about(name, imported.error());
  csg::OperandOptions options;
  options.repair = how.options.resolve;
  options.find_coplanar = how.options.merge_coplanar && groups.may_merge();
  options.check.threads = 0;
  options.repair_word = "OperandOptions::resolve";
  Result<csg::Source> source = how.is_trusted
                                   ? trusted_source(name, *imported)
                                   : csg::make_source(name, *imported, options);
  if (!source) return source.error();
  source->is_free = how.is_free;
  source->may_round = how.options.may_round;
  source->merge_coplanar = how.options.merge_coplanar && groups.may_merge();
  source->attributed = std::move(attributed);
  if (!how.has_color.empty()) source->has_color = how.has_color;
  LeafData data;
  if (properties && properties->field_count > 0)
    data.vertices = std::move(mesh.vertices);
  data.source = std::make_shared<const csg::Source>(*std::move(source));
  data.properties = std::move(properties);
  return data;
}

std::optional<Error> fault_of(const Mesh& mesh) {
  const std::size_t corners = mesh.corners.size();
  const auto& first = mesh.first_corner;
  if (first.empty() || first.front() != 0 || first.back() != corners ||
      !std::is_sorted(first.begin(), first.end())) {
    return Error{ErrorCode::kBadIndex,
                 "first_corner does not begin with 0, rise and end with the "
                 "number of corners"};
  }
  for (std::size_t i = 0; i < corners; ++i) {
    const std::int32_t vertex = mesh.corners[i];
    if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh.vertices.size())
      return Error{ErrorCode::kBadIndex,
                   "corner " + std::to_string(i) + " is vertex " +
                       std::to_string(vertex) + ", of " +
                       std::to_string(mesh.vertices.size()),
                   static_cast<std::int64_t>(i)};
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_finite(mesh.vertices[v]))
      return Error{ErrorCode::kNotFinite,
                   "vertex " + std::to_string(v) + " is not finite",
                   static_cast<std::int64_t>(v)};
  }
  const std::size_t polygons = mesh.polygon_count();
  const auto fits = [](std::size_t size, std::size_t wanted) {
    return size == 0 || size == wanted;
  };
  if (!fits(mesh.colors.size(), polygons) ||
      !fits(mesh.materials.size(), polygons) ||
      mesh.fields.size() != corners * mesh.field_count) {
    return Error{ErrorCode::kOutOfRange,
                 "colors or materials are not one a polygon, or fields not "
                 "field_count a corner"};
  }
  for (std::size_t i = 0; i < mesh.fields.size(); ++i) {
    if (!std::isfinite(mesh.fields[i]))
      return Error{ErrorCode::kNotFinite,
                   "a field of corner " + std::to_string(i / mesh.field_count) +
                       " is not finite",
                   static_cast<std::int64_t>(i / mesh.field_count)};
  }
  return std::nullopt;
}

Result<LeafData> mesh_leaf(const std::string& name,
                           const std::shared_ptr<const Mesh>& mesh,
                           const ImportHow& how) {
  if (const auto fault = fault_of(*mesh)) return io::error_about(name, *fault);
  ExactPoints exact = exact_points(mesh->vertices);
  io::Mesh made;
  made.vertices = std::move(exact.points);
  made.decimal = exact.decimal;
  made.first_corner = mesh->first_corner;
  made.corners = mesh->corners;
  const bool has_properties = !mesh->colors.empty() ||
                              !mesh->materials.empty() || mesh->field_count > 0;
  Result<LeafData> data = imported_leaf(name, std::move(made),
                                        has_properties ? mesh : nullptr, how);
  if (data) {
    data->from = exact.decimal ? LeafData::From::kShortDecimals
                               : LeafData::From::kDoubles;
  }
  return data;
}

Result<LeafData> mesh_leaf(const std::string& name, Mesh mesh,
                           const ImportHow& how) {
  return mesh_leaf(name, std::make_shared<const Mesh>(std::move(mesh)), how);
}

Result<LeafData> file_leaf(const std::string& path,
                           const OperandOptions& options) {
  ImportHow how;
  how.options = options;
  const bool is_exact = io::is_solid_name(path);
  if (!io::is_scene_name(path) && !is_exact) {
    Result<io::Mesh> mesh = io::read_mesh(path);
    if (!mesh) return mesh.error();
    auto properties = properties_of(*mesh, how.has_color);
    return imported_leaf(path, *std::move(mesh), std::move(properties), how);
  }
  csg::OperandOptions read;
  read.repair = options.resolve;
  read.check.threads = 0;
  read.repair_word = "OperandOptions::resolve";
  Result<csg::Source> source = csg::read_source(path, read);
  if (!source) return source.error();
  source->merge_coplanar = options.merge_coplanar;
  source->may_round = options.may_round;
  auto properties = std::make_shared<Mesh>();
  if (!is_exact) {
    properties->colors = source->scene.data().colors;
  } else if (std::find(source->has_color.begin(), source->has_color.end(),
                       true) != source->has_color.end()) {
    properties->colors = colors_of_origins(*source->exact);
  }
  LeafData data;
  data.source = std::make_shared<const csg::Source>(*std::move(source));
  data.properties = std::move(properties);
  return data;
}

Result<LeafData> mended_leaf(const std::string& path,
                             const MendOptions& options,
                             std::vector<std::string>& done) {
  const Result<io::Mesh> mesh = io::read_mesh(path);
  if (!mesh) return mesh.error();
  csg::RepairOptions how;
  how.weld = options.weld;
  how.close_all = options.close_all;
  how.thicken = options.thicken;
  how.check.threads = 0;
  Result<csg::Repaired> repaired = csg::repaired(path, *mesh, how);
  if (!repaired) return repaired.error();
  done = repaired->report.sentences();
  LeafData data;
  data.source =
      std::make_shared<const csg::Source>(std::move(repaired->source));
  std::vector<bool> has_color;  // the source has it, too
  data.properties = properties_of(*mesh, has_color);
  return data;
}

}  // namespace halfspace::detail
